"""What writing a model's file shares, whatever its form: ids, places of targets, and refusals of what nobody could read again."""

from __future__ import annotations

from robosmi.errors import ModelError
from robosmi.model.elements.ecore import EObject
from robosmi.model.elements.proxies import is_local, proxy_uri, uri_from
from robosmi.model.elements.pyecore_internals import container_of, xmi_id_of
from robosmi.model.xmi.xmi_layout import Column, Layouts
from robosmi.model.xmi.xmi_locations import Unplaced, UnusableId, XmiLocations, shown


class WrittenFile:
    """One file that is written.

    Args:
        name: its name in the model's folder.
        places: where elements are.
    """

    def __init__(self, name: str, places: XmiLocations) -> None:
        self.name = name
        self.places = places
        self.layouts = Layouts()
        self.ids: dict[str, EObject] = {}
        self.found: dict[int, tuple[str, str]] = {}  # elements that were referred to -> their files and fragments

    def problem(self, element: EObject, column: Column | None, what: str, fix: str) -> ModelError:
        """The error for an element or a value."""
        name = f".{column.name}" if column is not None else ""
        return ModelError(f"{self.name}: {shown(element)}{name} {what}", fix=fix)

    def identity(self, element: EObject) -> str | None:
        """The xmi:id that an element is written with; None if it has none of its own.

        Raises:
            ModelError: another element of the file has the id and had it in no file that was read, or it would be read as a path.
        """
        try:
            identity = self.places.identity(element)
        except UnusableId as error:
            fix = "let ids begin with another character than '/'"
            raise self.problem(element, None, f"has the id '{error}', which would be read as a path", fix) from None
        if identity is None:
            return None
        other = self.ids.setdefault(identity, element)
        if other is not element and identity not in self.places.shared_ids:
            fix = "give every element of a file an id of its own"
            raise self.problem(element, None, f"has the id '{identity}', and so has {shown(other)}", fix)
        return identity if xmi_id_of(element) is not None else None

    def place(self, element: EObject, column: Column, target: EObject) -> tuple[str, str]:
        """File and fragment of a target.

        Raises:
            ModelError: it is in no file, or its id would be read as a path.
        """
        known = self.found.get(id(target))
        if known is None:
            known = self.found[id(target)] = self.located(element, column, target)
        return known

    def located(self, element: EObject, column: Column, target: EObject) -> tuple[str, str]:
        """The same, found anew."""
        if proxy_uri(target) is not None:
            return self.name if is_local(target) else "", uri_from(target, self.places.folder)
        try:
            return self.places.find(target)
        except UnusableId as error:
            what = f"refers to {shown(target)}, whose id '{error}' would be read as a path"
            raise self.problem(element, column, what, "let ids begin with another character than '/'") from None
        except Unplaced:
            what = f"refers to {shown(target)}, which is in none of the models that have a file"
            fix = "add the target to a model, save that model first so that it has a file, or remove the reference"
            raise self.problem(element, column, what, fix) from None

    def check_container(self, element: EObject, column: Column, child: EObject) -> None:
        """Make sure that an element contains a child.

        Raises:
            ModelError: another one does.
        """
        if container_of(child) is not element:
            what = f"contains {shown(child)}, whose container is {shown(container_of(child))}"
            raise self.problem(element, column, what, "put the element into one container")

    def check_no_root(self, element: EObject, column: Column, child: EObject) -> None:
        """Make sure that a child which is the root of a file is that of another file.

        Raises:
            ModelError: it is a root of this one.
        """
        if self.place(element, column, child)[0] == self.name:
            fix = "take it out of the roots, or out of here"
            raise self.problem(element, column, f"contains {shown(child)}, which is a root", fix)
