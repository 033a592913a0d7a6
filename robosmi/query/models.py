"""Model and type level of EOL over elements that are in memory: `ModelView`, ids, enumeration literals, create and delete.

A `ModelView` is roots with the packages they are instances of; loading and saving are `robosmi.model`'s. `with Run(m1, m2):`
makes several models known to a query, in which types are named `Book`, `library::Book` or `M!Book`.
Source: Kolovos et al., The Epsilon Object Language, section 3.3; fragments as EMF's ResourceImpl resolves them.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Iterator
from typing import Any

from pyecore.ecore import EClass, EEnum, EObject

from robosmi.errors import ModelError, did_you_mean
from robosmi.query.collections import Q
from robosmi.query.extents import all_contents, all_of_kind, all_of_type, root_of
from robosmi.query.problems import OperandError, unknown_property, unknown_type
from robosmi.query.run import current_run


class ModelView:
    """A model to be queried: root elements and the packages that define their classes.

    Args:
        roots: its root element, or several.
        packages: EPackages, or generated Python packages; those of the roots' classes if None.
        name: what `M!Book` calls it.
    """

    def __init__(self, roots: Any, packages: Iterable[Any] | None = None, name: str = "M") -> None:
        self.name = name
        self.roots: list[Any] = [roots] if isinstance(roots, EObject) else list(roots)
        given = packages if packages is not None else dict.fromkeys(_outermost(r.eClass.ePackage) for r in self.roots)
        self.packages = [p if isinstance(p, EObject) else p.eClass for p in given]

    def __repr__(self) -> str:
        return f"<ModelView {self.name} with {len(self.roots)} roots>"

    def all_contents(self) -> Iterator[Any]:
        """All elements in containment pre-order."""
        for root in list(self.roots):
            if root.eContainer() is None:  # one that was created and then put somewhere is met there
                yield from all_contents(root)

    def all(self, kind: Any) -> Q[Any]:
        """The instances of a type and its subtypes (EOL `T.all`, `T.allInstances`, `T.allOfKind`).

        Raises:
            UnknownTypeError: a name that the packages do not have.
        """
        return all_of_kind(self, self.type_named(kind) if isinstance(kind, str) else kind)

    all_of_kind = all
    all_instances = all

    def all_of_type(self, kind: Any) -> Q[Any]:
        """The instances of exactly a type (EOL `T.allOfType`).

        Raises:
            UnknownTypeError: a name that the packages do not have.
        """
        return all_of_type(self, self.type_named(kind) if isinstance(kind, str) else kind)

    def classifiers(self) -> Iterator[tuple[str, Any]]:
        """All classifiers of the packages and their sub-packages, with the packages' names before theirs."""
        pending = [(p.name, p) for p in reversed(self.packages)]
        while pending:
            path, package = pending.pop()
            for classifier in package.eClassifiers:
                yield f"{path}::{classifier.name}", classifier
            pending.extend((f"{path}::{p.name}", p) for p in reversed(list(package.eSubpackages)))

    def find_type(self, name: str) -> Any:
        """The class of that name, simple or with packages, or None."""
        for path, classifier in self.classifiers():
            if isinstance(classifier, EClass) and name in (classifier.name, path):
                return classifier
        return None

    def type_names(self) -> list[str]:
        """The simple names of all classes."""
        return [c.name for _, c in self.classifiers() if isinstance(c, EClass)]

    def type_named(self, name: str) -> Any:
        """The class of that name (`Book`, `library::Book`, with or without `M!`).

        Raises:
            UnknownTypeError: there is none.
        """
        model, _, plain = name.rpartition("!")
        found = self.find_type(plain) if model in ("", self.name) else None
        if found is None:
            raise unknown_type(name, self.type_names())
        return found

    def literal(self, name: str) -> Any:
        """An enumeration literal, `Genre#fiction` or `library::Genre#fiction`; by its name, else by its literal text.

        Raises:
            UnknownTypeError: there is no such enumeration, or it has no such literal.
        """
        enumeration, _, label = name.rpartition("#")
        known = [(path, c) for path, c in self.classifiers() if isinstance(c, EEnum) and enumeration in ("", c.name, path)]
        for _path, candidate in known:
            if (found := literal_of(candidate, label, None)) is not None:
                return found
        raise unknown_type(
            name,
            [f"{c.name}#{literal.name}" for _path, c in self.classifiers() if isinstance(c, EEnum) for literal in c.eLiterals],
        )

    def element(self, identity: str) -> Any:
        """The element of an id or fragment (EOL `getElementById`), or None.

        Raises:
            ModelError: the fragment names a feature that is none.
        """
        if not identity.startswith("/"):
            return next((x for x in self.all_contents() if _own_id(x) == identity), None)
        start, *steps = identity[1:].split("/")
        if start and not start.isdigit():
            raise ModelError(f"'{identity}' is no fragment: '{start}' is no number of a root")
        position = int(start or 0)
        element = self.roots[position] if position < len(self.roots) else None
        for step in steps:
            if element is None:
                return None
            element = _step(element, step)
        return element

    def id_of(self, element: Any) -> str:
        """The id or fragment of an element (EOL `getElementId`), as EMF writes it."""
        return _fragment(element, self.roots)

    def owns(self, element: Any) -> bool:
        """Whether the element is in this model."""
        if not isinstance(element, EObject):
            return False
        root = root_of(element)
        return any(root is r for r in self.roots)

    def create(self, kind: Any, **features: Any) -> Any:
        """A new element, a root of this model until it is put somewhere (EOL `new T(name = "x")`, `T.createInstance()`).

        Raises:
            UnknownTypeError: there is no such type.
            ModelError: it is abstract, or has no such feature.
        """
        made = create(self.type_named(kind) if isinstance(kind, str) else kind, **features)
        self.roots.append(made)
        return made

    def delete(self, element: Any) -> None:
        """Take an element with all it contains out of this model and out of all references to it (EOL `delete`).

        Raises:
            OperandError: it is not in this model.
        """
        if not self.owns(element):
            raise OperandError(f"{element!r} is not in the model {self.name}")
        delete(element)
        self.roots = [r for r in self.roots if r is not element]


def create(kind: Any, **features: Any) -> Any:
    """A new element of a class or EClass, in no model.

    Raises:
        ModelError: the class is abstract, or has no such feature.
    """
    eclass = kind if isinstance(kind, EClass) else kind.eClass
    if eclass.abstract or eclass.interface:
        raise ModelError(f"{eclass.name} is abstract: it has no instances of its own")
    names = [f.name for f in eclass.eAllStructuralFeatures()]
    for name in features:
        if name not in names:
            raise unknown_property(f"a {eclass.name}", name, names)
    made = eclass.python_class()
    for name, value in features.items():
        if eclass.findEStructuralFeature(name).many:
            getattr(made, name).extend(value)
        elif value is not None:
            setattr(made, name, value)
    return made


def delete(element: Any) -> None:
    """Take an element with all it contains out of its container and out of all references to it."""
    doomed = list(all_contents(element))
    for one in reversed(doomed):
        one.delete(recursive=False)
    if element.eResource is not None:
        element.eResource.remove(element)


def literal_of(enumeration: Any, label: str, *default: Any) -> Any:
    """A literal of an EEnum by its name, else by its literal text.

    Args:
        enumeration: the EEnum.
        label: name or literal text.
        default: given if there is none; without it that is an error.

    Raises:
        UnknownTypeError: there is none.
    """
    literals = list(enumeration.eLiterals)
    for attribute in ("name", "literal"):
        for literal in literals:
            if getattr(literal, attribute, None) == label:
                return literal
    if default:
        return default[0]
    raise unknown_type(f"{enumeration.name}#{label}", [f"{enumeration.name}#{literal.name}" for literal in literals])


def literal_named(name: str) -> Any:
    """The enumeration literal `Genre#fiction` or `M!Genre#fiction` of the current run's models (EOL `Genre#fiction`, `toEnum`).

    Raises:
        UnknownTypeError: there is none.
    """
    wanted, _, plain = name.rpartition("!")
    known: list[str] = []
    for model in current_run().models:
        if not wanted or model.name == wanted:
            try:
                return model.literal(plain)
            except ModelError as error:
                known.append(error.message)
    raise unknown_type(name, known and [plain])


def all_instances(name: str) -> Q[Any]:
    """All instances of a type of the current run's models and its subtypes: `Book`, `library::Book`, `M!Book`.

    Unqualified, the first model that has the type counts; if another has it too there is a warning.

    Raises:
        UnknownTypeError: no model has it.
    """
    wanted, _, plain = name.rpartition("!")
    having = [m for m in current_run().models if (not wanted or m.name == wanted) and m.find_type(plain) is not None]
    if not having:
        raise unknown_type(name, [n for m in current_run().models for n in m.type_names()])
    if len(having) > 1:
        others = ", ".join(f"{m.name}!{plain}" for m in having)
        warnings.warn(f"the type '{name}' may be any of {others}; the first is taken", stacklevel=2)
    return Q(having[0].all(plain))


def model_named(name: str) -> Any:
    """The model of the current run with that name.

    Raises:
        UnknownTypeError: there is none.
    """
    models = current_run().models
    for model in models:
        if model.name == name:
            return model
    known = [m.name for m in models]
    raise ModelError(f"there is no model '{name}'{did_you_mean(name, known)}", fix="name it in `with Run(...)`")


def owning_model(element: Any) -> Any:
    """The model of the current run that holds the element, or None."""
    return next((m for m in current_run().models if m.owns(element)), None)


def id_of(element: Any) -> str:
    """The element's id or fragment (EOL `id()`): `//@sections.0/@items.1`, as EMF writes it."""
    model = owning_model(element)
    resource = root_of(element).eResource
    return _fragment(element, model.roots if model is not None else list(resource.contents) if resource is not None else [])


def _outermost(package: Any) -> Any:
    while package.eSuperPackage is not None:
        package = package.eSuperPackage
    return package


def _own_id(element: Any) -> str | None:
    """The XMI id, or the value of the attribute that is the class's id."""
    identity = getattr(element, "_internal_id", None)
    if identity:
        return str(identity)
    for feature in element.eClass.eAllAttributes() if hasattr(element.eClass, "eAllAttributes") else ():
        if feature.iD and (value := getattr(element, feature.name)) is not None:
            return str(value)
    return None


def _step(element: Any, step: str) -> Any:
    """One step of a fragment, `@items.1` or `@parent`."""
    name, _, position = step[1:].rpartition(".") if step[-1:].isdigit() and "." in step else (step[1:], "", "")
    feature = element.eClass.findEStructuralFeature(name)
    if step[:1] != "@" or feature is None:
        raise ModelError(f"the step '{step}' of the fragment is no feature of {element.eClass.name}")
    value = getattr(element, name)
    if not position:
        return value
    return value[int(position)] if int(position) < len(value) else None


def _fragment(element: Any, roots: list[Any]) -> str:
    if identity := _own_id(element):
        return identity
    steps: list[str] = []
    while (container := element.eContainer()) is not None:
        feature = element.eContainmentFeature()
        if feature.many:
            place = next(i for i, x in enumerate(getattr(container, feature.name)) if x is element)
            steps.append(f"@{feature.name}.{place}")
        else:
            steps.append(f"@{feature.name}")
        element = container
    place = next((i for i, r in enumerate(roots) if r is element), 0)
    return "/".join(["/" if len(roots) < 2 else f"/{place}", *reversed(steps)])
