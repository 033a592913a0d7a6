"""The base class of every generated model class: a pyecore EObject that refuses what Ecore does not know.

pyecore takes a misspelt feature, a misspelt constructor keyword and a text where an enumeration literal is wanted
without a word; `Element` refuses all three and says what was meant. To type checkers it is a plain typed class, since
pyecore has no annotations. Generated packages import this module and pyecore, nothing else; it imports no model code.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, ClassVar

from pyecore import ecore

from robosmi.errors import ModelError, did_you_mean

if TYPE_CHECKING:

    class _Base:
        """What of pyecore's EObject the typed code uses."""

        eClass: ClassVar[Any]
        eResource: Any
        eContents: Sequence[Element]

        def __init__(self, **features: Any) -> None: ...
        def eContainer(self) -> Element | None: ...
        def eContainmentFeature(self) -> Any: ...
        def eAllContents(self) -> Iterator[Element]: ...
        def eIsSet(self, feature: str) -> bool: ...
        def eGet(self, feature: str) -> Any: ...
        def eSet(self, feature: str, value: Any) -> None: ...
        def delete(self, recursive: bool = True) -> None: ...

    class EnumLiteral:
        """A literal of an enumeration."""

        name: str
        value: int

else:
    _Base = ecore.EObject
    EnumLiteral = ecore.EEnumLiteral


class UnknownFeatureError(ModelError, AttributeError):
    """A feature that the element's class does not have."""


class FeatureValueError(ModelError, TypeError):
    """A value that the feature does not take."""


class Element(_Base):
    """A model element: a pyecore EObject with strict construction and assignment.

    Args:
        features: initial values by feature name; many-valued features take any iterable; None is left out.

    Raises:
        UnknownFeatureError: a name is no feature of the class.
        FeatureValueError: a value is of the wrong kind.
    """

    if not TYPE_CHECKING:

        def __new__(cls, *args: Any, **features: Any) -> Any:
            """As pyecore's, without its process-wide set of all instances and without ballast (`lean`)."""
            if "_inverse_rels" not in cls.__dict__:
                from robosmi.model.lean import prepare  # it needs this module

                prepare(cls)
            return object.__new__(cls)

        _renamed: dict[str, str] = {}
        """Names of features that would hide what every element has (`delete`) -> the attribute that has them."""

        def eGet(self, feature: Any) -> Any:
            """The value of a feature, given by its name in the metamodel or itself."""
            name = feature if isinstance(feature, str) else feature.name
            return getattr(self, self._renamed.get(name, name))

        def eSet(self, feature: Any, value: Any) -> None:
            """Set a feature, given by its name in the metamodel or itself."""
            name = feature if isinstance(feature, str) else feature.name
            setattr(self, self._renamed.get(name, name), value)

        @property
        def eContents(self) -> list[Any]:
            """The elements that this one contains."""
            if not self._renamed:
                return super().eContents
            kept = [f for f in self.eClass.eAllReferences() if f.containment and not f.derived]
            found = [(f, self.eGet(f)) for f in kept]
            return [value for f, held in found for value in (held if f.many else [held]) if value is not None]

        @property
        def eResource(self) -> Any:
            """The resource of the root container."""
            return resource_of(self)

    def __init__(self, **features: Any) -> None:
        (_initialise or _find_initialise())(self, features)

    if not TYPE_CHECKING:  # to a type checker an element has its features and no others

        def __setattr__(self, name: str, value: Any) -> None:
            enumerations = _features(type(self))
            expected = enumerations.get(name, _MISSING)
            if expected is _MISSING:
                if name in _INTERNAL or name[0] == "_":
                    object.__setattr__(self, name, value)
                    return
                raise unknown_feature(self, name)
            if expected is not None and value.__class__ is str:
                literals = [literal.name for literal in expected.eLiterals]
                raise FeatureValueError(
                    f"{type(self).__name__}.{name} takes a literal of {expected.name}, not the text '{value}'",
                    fix=f"use one of: {', '.join(f'{expected.name}.{literal}' for literal in literals)}",
                )
            try:
                object.__setattr__(self, name, value)
            except TypeError as error:
                raise FeatureValueError(f"{type(self).__name__}.{name} does not take {value!r}: {error}") from error

        def __getattr__(self, name: str) -> Any:
            if name[:2] == "__":
                raise AttributeError(name)
            raise unknown_feature(self, name)

    def _repr_html_(self) -> str:
        from robosmi.model.show import element_html  # for notebooks only

        return element_html(self)

    def __repr__(self) -> str:
        known = _features(type(self))
        shown = [
            f"{n}={self.eGet(n)!r}"
            for n in ("name", "title", "label", "path", "elementId", "line")
            if n in known and self.eIsSet(n)
        ]
        return f"<{type(self).__name__}{' ' if shown else ''}{' '.join(shown)}>"


def resource_of(element: Any) -> Any:
    """The resource of an element's root container; a loop, since pyecore asks for it at every change, recursively.

    Raises:
        ModelError: the element contains itself.
    """
    steps, limit, seen = 0, 64, element  # a circle passes by one that was seen, sooner or later (Brent)
    while (container := element._container) is not None:
        element = container.dyn_inst
        if element is seen:
            raise ModelError(f"{element!r} contains itself", fix="take it out of what it contains first")
        steps += 1
        if steps == limit:
            steps, limit, seen = 0, limit * 2, element
    return element._eresource


_initialise: Any = None


def _find_initialise() -> Any:
    global _initialise
    from robosmi.model.construct import initialise  # it needs this module's errors

    _initialise = initialise
    return initialise


_MISSING: Any = object()
_INTERNAL = frozenset({"listeners", "dyn_inst", "eResource"})
_CACHE: dict[type, dict[str, Any]] = {}


def _features(cls: type) -> dict[str, Any]:
    """Feature name -> its enumeration, or None where it is of another type."""
    known = _CACHE.get(cls)
    if known is None:
        known = {}
        for base in reversed(cls.__mro__):
            for name, feature in base.__dict__.items():
                if isinstance(feature, ecore.EStructuralFeature):
                    known[name] = feature.eType if isinstance(feature.eType, ecore.EEnum) else None
        if getattr(cls, "eClass", None) is not None:
            _CACHE[cls] = known
    return known


def unknown_feature(element: Element, name: str) -> UnknownFeatureError:
    """The error for a name that is no feature of the element, with the nearest that is."""
    known = _features(type(element))
    return UnknownFeatureError(
        f"{type(element).__name__} has no feature '{name}'{did_you_mean(name, known)}",
        fix=f"use one of: {', '.join(sorted(known))}",
    )
