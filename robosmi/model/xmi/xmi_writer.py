"""Models to XMI text, byte for byte as Eclipse EMF writes them (OMG XMI 2.0 as in EMF's XMIResourceImpl and XMLSaveImpl).

pyecore's own writer truncates a file when it fails, drops references that have no place and decorates every child with a type.
Here all models of a set are turned into bytes, and nothing is written to disk: that is `files`' job. References between the
models of a set become relative URIs; a reference to anything else but a metamodel is an error.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence, Sized
from types import ModuleType
from typing import TYPE_CHECKING, Any

from robosmi.errors import ModelError
from robosmi.model.elements import ecore
from robosmi.model.elements.compact_slots import UNBOXED_TYPES, collector_at_rest
from robosmi.model.elements.datatypes import real
from robosmi.model.elements.ecore import EClass, EObject, EOrderedSet
from robosmi.model.elements.feature_values import FeatureOrderedSet
from robosmi.model.elements.features import as_package
from robosmi.model.elements.proxies import AS_READ, as_read, proxy_uri, uri_from
from robosmi.model.elements.pyecore_internals import container_of, set_features_of, target_in, value_in, xmi_id_of
from robosmi.model.xmi.written_file import WrittenFile
from robosmi.model.xmi.xmi_layout import CHILDREN, DETAILS, LINKS, VALUE, VALUES, Column
from robosmi.model.xmi.xmi_locations import Unplaced, XmiLocations, is_plain_id, metamodel_uri, relative, shown
from robosmi.model.xmi.xml_characters import in_attribute, in_text, markup_in_attribute, refuse_forbidden

if TYPE_CHECKING:
    from robosmi.model.elements.ecore import Value
    from robosmi.model.xmi.xmi_layout import Append, Piece, Root

_PIECES = 20_000  # texts that are joined at a time, so that a large model is not held as millions of small texts


def to_xmi(
    models: Mapping[str, Root],
    wanted: Iterable[str] | None = None,
    places: XmiLocations | None = None,
    schema_locations: Mapping[str, str] | None = None,
) -> dict[str, bytes]:
    """The bytes of a set of models that refer to each other.

    Args:
        models: relative file name -> root element, or a list of root elements; the names are those that references use.
        wanted: the names whose bytes are wanted; all if None.
        places: where the elements of these models are, as far as that was found before; nothing may have moved since.
        schema_locations: namespace -> place of its metamodel, which is written if the namespace is used (xsi:schemaLocation).

    Returns:
        The wanted names -> UTF-8 text of an XMI file.

    Raises:
        ModelError: a reference leads to an element in none of the models, a text of a metamodel holds a character XML
            cannot, a value is not of its feature's type or too many, an id is used twice, or an element contains itself.
    """
    roots = {name: roots_in(given) for name, given in models.items()}
    with collector_at_rest():
        found, names = places or XmiLocations(roots), models if wanted is None else wanted
        return {name: text_with(name, roots[name], found, schema_locations or {}) for name in names}


def text_with(name: str, roots: list[EObject], places: XmiLocations, schema_locations: Mapping[str, str]) -> bytes:
    """The text of one file; see `to_xmi`."""
    return _Writer(name, roots, places, schema_locations).write()


def roots_in(given: Root) -> list[EObject]:
    """The root elements that a file is written from; a generated package stands for its EPackage."""
    roots = given if isinstance(given, Sequence) else [given]
    return [as_package(root) if isinstance(root, ModuleType) else root for root in roots]


class _Writer(WrittenFile):
    """One file."""

    def __init__(self, name: str, roots: list[EObject], places: XmiLocations, schema_locations: Mapping[str, str]) -> None:
        self.schema_locations = schema_locations
        super().__init__(name, places)
        self.roots = roots
        self.prefixes: dict[str, str] = {"xmi": "http://www.omg.org/XMI"}  # prefix -> namespace
        self.qualified: dict[EClass, str] = {}
        self.uses_xsi = False
        self.local: dict[int, str] = {}  # elements of this file that were referred to -> their fragments
        self.elsewhere: dict[int, str] = {}  # elements of other files that were referred to -> their links as they are written

    def write(self) -> bytes:
        """The bytes of the file."""
        if self.roots and all(isinstance(root, (ecore.EPackage, ecore.EClassifier)) for root in self.roots):
            from robosmi.model.xmi.ecore_writer import EcoreText  # few files are metamodels

            return EcoreText(self.metamodel_link, self.metamodel_text).write(self.roots)
        if self.name.endswith(".ecore") and (other := [root for root in self.roots if not isinstance(root, ecore.EModelElement)]):
            what = f"{self.name}: {shown(other[0])} is no element of a metamodel, and an .ecore file holds a metamodel"
            raise ModelError(what, fix="save the model as an .xmi file")
        if len(self.roots) == 1:
            tag = self.name_of(self.roots[0].eClass)
            body = self.elements([("", tag, self.roots[0])], "")
            self.layouts.close()
            return self.head(tag) + body
        named = [(self.name_of(root.eClass), root) for root in self.roots]
        body = self.elements([(f"<{tag}", tag, root) for tag, root in named], "  ")
        self.layouts.close()
        return self.head("xmi:XMI") + (b">\n" + body + b"</xmi:XMI>\n" if self.roots else b"/>\n")

    def head(self, tag: str) -> bytes:
        """The XML declaration, and the first tag with its namespaces; what follows is the first element's own."""
        uris = [uri for _, uri in sorted(self.prefixes.items()) if uri in self.schema_locations]
        located = " ".join(f"{uri} {self.schema_locations[uri]}" for uri in uris)
        xsi = ' xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"' if self.uses_xsi or located else ""
        spaces = "".join(
            f' xmlns{f":{prefix}" if prefix else ""}="{self.plain(uri)}"'
            for prefix, uri in sorted(self.prefixes.items())
            if prefix != "xmi"
        )
        place = f' xsi:schemaLocation="{self.plain(located)}"' if located else ""
        start = f'<{tag} xmi:version="2.0" xmlns:xmi="http://www.omg.org/XMI"{xsi}{spaces}{place}'
        return f'<?xml version="1.0" encoding="UTF-8"?>\n{start}'.encode()

    def name_of(self, eclass: EClass) -> str:
        """The qualified name of a class; its package gets a prefix."""
        found = self.qualified.get(eclass)
        if found is None:
            package = as_package(eclass.ePackage)
            uri = package.nsURI
            if not uri:
                raise ModelError(
                    f"{self.name}: the package '{package.name}' of the class {eclass.name} has no nsURI",
                    fix="give the package a namespace in its .ecore file",
                )
            prefix = next((p for p, u in self.prefixes.items() if u == uri), None)
            if prefix is None:
                wanted = prefix = package.nsPrefix or ""
                number = 0
                while prefix in self.prefixes:
                    number += 1
                    prefix = f"{wanted}_{number}"
                self.prefixes[prefix] = uri
            found = self.qualified[eclass] = f"{prefix}:{eclass.name}" if prefix else str(eclass.name)
        return found

    def elements(self, roots: list[tuple[str, str, EObject]], indent: str) -> bytes:
        """The text of elements and all they contain, each given as the beginning of its start tag, its tag, and itself."""
        done: list[bytes] = []
        out: list[str] = []
        append = out.append
        layouts, nested, ids = self.layouts.known, self.places.nested, self.ids
        held, inside, xmi_id, local, is_plain = value_in, container_of, xmi_id_of, self.local, is_plain_id  # for speed
        has_markup = markup_in_attribute
        stack: list[tuple[Iterator[Piece], str, str]] = []
        work: Iterator[Piece] = iter(roots)
        while True:
            for item in work:
                if isinstance(item, str):
                    append(item)
                    continue
                opening, tag, element = item
                layout = layouts.get(element.__class__) or self.layouts.of(element)
                slots = element.__dict__
                identity = xmi_id(element)
                if identity.__class__ is str and is_plain(identity) and ids.setdefault(identity, element) is element:
                    append(f'{indent}{opening} xmi:id="{identity}"')
                else:
                    append(f"{indent}{opening}")
                    if layout.has_id or identity is not None:
                        self.identify(element, append)
                later: list[Piece] | None = None
                for kind, key, plain, rendered, column in layout.shapes.get(tuple(slots)) or layout.columns_in(slots):
                    slot = slots[key]
                    if kind == VALUE:
                        value = slot if slot.__class__ in UNBOXED_TYPES else held(slot)
                        if value.__class__ is str and plain is str and not has_markup(value):
                            if value != column.default:
                                append(f'{column.start}{value}"')
                        elif value.__class__ is plain and (text := rendered.get(value)) is not None:
                            append(text)
                        else:
                            later = self.value(element, column, value, append, indent, later)
                    elif kind == CHILDREN:
                        if column.many:
                            children = slot.items if isinstance(slot, EOrderedSet) else slot
                        else:
                            children = () if held(slot) is None else (held(slot),)
                        for child in children:
                            begun = rendered.get(child.__class__)
                            if begun is None or inside(child) is not element or (nested and id(child) in nested):
                                later = self.child(element, column, child, indent, later)
                            elif later is None:
                                later = [(begun, column.name, child)]
                            else:
                                later.append((begun, column.name, child))
                        if column.is_unsettable and not children:
                            later = self.nothing(element, column, None, append, indent, later)
                    elif kind == LINKS:
                        if not column.many and (fragment := local.get(id(held(slot)))) is not None and AS_READ not in slots:
                            append(f'{column.start}{fragment}"')
                            continue
                        later = self.links(element, column, slot, append, indent, later)
                    else:
                        later = self.rarer(element, column, slot, append, indent, later)
                if later is None:
                    append("/>\n")
                    continue
                append(">\n")
                stack.append((work, indent, tag))
                indent += "  "
                work = iter(later)
                break
            else:
                if not stack:
                    break
                work, indent, tag = stack.pop()
                append(f"{indent}</{tag}>\n")
                if len(out) > _PIECES:
                    done.append("".join(out).encode())
                    out.clear()
        done.append("".join(out).encode())
        return b"".join(done)

    def metamodel_link(self, element: EObject, name: str, target: Any) -> str:
        """The URI of a metamodel's element, seen from this file."""
        if proxy_uri(target) is not None:  # it is in a file that is not there
            return uri_from(target, self.places.folder)
        try:
            file, fragment = self.places.in_metamodel(target)
            if not file:
                return metamodel_uri(target)
        except Unplaced:
            what = f"refers by '{name}' to {shown(target)}, which is in no package with a namespace"
            raise self.problem(element, None, what, "put it into a package") from None
        return f"#{fragment}" if file == self.name else f"{relative(self.name, file)}#{fragment}"

    def metamodel_text(self, text: str, element: EObject, name: str) -> str:
        """A text of a metamodel, escaped."""
        try:
            return self.plain(text)
        except ModelError as error:
            raise ModelError(f"{self.name}: {shown(element)}.{name}: {error.message}", fix=error.fix) from None

    # --- values

    def value(
        self, element: EObject, column: Column, value: Value, append: Append, indent: str, later: list[Piece] | None
    ) -> list[Piece] | None:
        """A value as attribute; what is written for a plain value is kept for the next time."""
        if value is None or column.is_unsettable:
            return self.nothing(element, column, value, append, indent, later)
        text = ""
        if value != column.default:
            text = f'{column.start}{in_attribute(self.value_text(element, column, value))}"'
            append(text)
        is_zero = value.__class__ is float and not value  # 0.0 and -0.0 are equal, and written in two ways
        if value.__class__ is column.plain and not is_zero and len(column.rendered) < 1 << 16:
            column.rendered[value] = text
        return later

    def value_text(self, element: EObject, column: Column, value: Value) -> str:
        """The text of a value, not yet escaped."""
        try:
            return str(column.convert(value))
        except ValueError as error:
            raise self.problem(element, column, str(error), "set a value of the feature's type") from None

    def plain(self, text: str) -> str:
        """A text between quotes that others read, too (namespaces, metamodels): what XML cannot hold is refused in it."""
        try:
            return in_attribute(refuse_forbidden(text))
        except ValueError as error:
            raise ModelError(f"{self.name}: {error}", fix="remove the character from the source") from None

    def identify(self, element: EObject, append: Append) -> None:
        """Write the xmi:id."""
        if (identity := self.identity(element)) is not None:
            append(f' xmi:id="{in_attribute(identity)}"')

    def nothing(
        self, element: EObject, column: Column, value: Value, append: Append, indent: str, later: list[Piece] | None
    ) -> list[Piece] | None:
        """A feature that holds nothing though its default is something, or that knows whether it was set."""
        if column.is_unsettable:
            if column.feature not in set_features_of(element):
                return later
            if column.many and column.kind != VALUE:
                append(f'{column.start}"')
                return later
            if value is not None:
                append(f'{column.start}{in_attribute(self.value_text(element, column, value))}"')
                return later
        elif column.default is None or column.is_primitive:
            return later
        return self.more(later, self.nil(column, indent))

    def nil(self, column: Column, indent: str) -> str:
        """The element that says "nothing"."""
        self.uses_xsi = True
        return f'{indent}  <{column.name} xsi:nil="true"/>\n'

    @staticmethod
    def more(later: list[Piece] | None, item: Piece) -> list[Piece]:
        """What is written inside of the element, with one more."""
        if later is None:
            return [item]
        later.append(item)
        return later

    def rarer(
        self, element: EObject, column: Column, slot: Any, append: Append, indent: str, later: list[Piece] | None
    ) -> list[Piece] | None:
        """Many values or pairs, as elements; anything else is refused."""
        if column.kind == DETAILS:
            held: Any = slot if isinstance(slot, dict) else value_in(slot)
            for pair in (held or {}).items():
                texts = zip(("key", "value"), pair, strict=True)
                named = "".join(f' {name}="{in_attribute(str(text))}"' for name, text in texts if text is not None)
                later = self.more(later, f"{indent}  <{column.name}{named}/>\n")
            return later
        if column.kind != VALUES:
            if len(slot) if column.many else value_in(slot) is not None:
                raise self.problem(element, column, "is a feature map, which is not supported", "leave it empty")
            return later
        values = list(slot)
        self.limit(element, column, values)
        if not values and column.is_unsettable:
            return self.nothing(element, column, None, append, indent, later)
        for value in values:
            if value is None:
                later = self.more(later, self.nil(column, indent))
                continue
            text = in_text(self.value_text(element, column, value))
            later = self.more(later, f"{indent}  <{column.name}>{text}</{column.name}>\n")
        return later

    def limit(self, element: EObject, column: Column, values: Sized) -> None:
        """Refuse more values than the feature takes."""
        if 1 < column.upper < len(values):
            raise self.problem(element, column, f"takes {column.upper} values, not {len(values)}", "remove what is too much")

    # --- references

    def links(
        self, element: EObject, column: Column, slot: Any, append: Append, indent: str, later: list[Piece] | None
    ) -> list[Piece] | None:
        """References: fragments in an attribute if all lead into this file, else elements with hrefs."""
        target = None if column.many else target_in(slot)
        many = slot.items if slot.__class__ is FeatureOrderedSet or isinstance(slot, EOrderedSet) else slot
        targets: Sequence[EObject] = many if column.many else () if target is None else (target,)
        if AS_READ in element.__dict__:
            links = (as_read(element, column.key, real(each)) for each in targets)
            targets = [link for link in links if link is not None]
        if column.upper > 1:
            self.limit(element, column, targets)
        local = self.local
        fragments = []
        for target in targets:
            fragment = local.get(id(target))
            if fragment is None:
                if id(target) in self.elsewhere:
                    break
                found = real(target)
                identity = xmi_id_of(found)
                if identity.__class__ is str and self.ids.get(identity) is found and is_plain_id(identity):
                    fragment = local[id(target)] = identity  # of an element that is written already
                else:
                    file, fragment = self.located(element, column, found)  # kept in `local`
                    if file != self.name:
                        break
                    fragment = local[id(target)] = in_attribute(fragment)
            fragments.append(fragment)
        else:
            if fragments:
                append(f'{column.start}{" ".join(fragments)}"')
            elif column.is_unsettable:
                return self.nothing(element, column, None, append, indent, later)
            return later
        for given in targets:
            later = self.more(later, self.href(element, column, real(given), indent))
        return later

    def href(self, element: EObject, column: Column, target: EObject, indent: str) -> str:
        """An element with a reference to another file. Its type is given if the declared one is abstract (EMF's rule)."""
        kind = ""
        if column.names_types or (self.places.names_more_types and proxy_uri(target) is not None):
            eclass = target.eClass if isinstance(target, ecore.EObject) else target.__class__.eClass
            if eclass is not column.declared:
                self.uses_xsi = True
                kind = f' xsi:type="{self.name_of(eclass)}"'
        link = self.elsewhere.get(id(target)) or self.link(element, column, target)
        return f'{indent}  <{column.name}{kind} href="{link}"/>\n'

    def link(self, element: EObject, column: Column, target: EObject) -> str:
        """The URI of a target as it is written; that of one in another file is kept for the next time."""
        file, fragment = self.place(element, column, target)
        if file == self.name:
            return in_attribute(f"#{fragment}")
        link = f"{relative(self.name, file)}#{fragment}" if file else fragment
        return self.elsewhere.setdefault(id(target), in_attribute(link))

    def child(self, element: EObject, column: Column, child: EObject, indent: str, later: list[Piece] | None) -> list[Piece]:
        """A child of a class that is met for the first time here, or one that is the root of another file."""
        child = real(child)
        if proxy_uri(child) is not None:
            return self.more(later, self.href(element, column, child, indent))
        self.check_container(element, column, child)
        if AS_READ in element.__dict__ and (link := as_read(element, column.key, child)) not in (child, None):
            return self.more(later, self.href(element, column, link, indent))
        if id(child) not in self.places.nested:
            eclass = child.eClass
            kind = ""
            if eclass is not column.declared:
                self.uses_xsi = True
                kind = f' xsi:type="{self.name_of(eclass)}"'
            begun = column.rendered[child.__class__] = f"<{column.name}{kind}"
            return self.more(later, (begun, column.name, child))
        self.check_no_root(element, column, child)
        return self.more(later, self.href(element, column, child, indent))
