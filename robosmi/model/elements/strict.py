"""The base class of every generated model class: a pyecore EObject that refuses what Ecore does not know.

pyecore takes a misspelt feature, a misspelt constructor keyword and a text where an enumeration literal is wanted
without a word; `Element` refuses all three and says what was meant. To type checkers it is a plain typed class, since
pyecore has no annotations. Generated packages import this module and pyecore, nothing else. How values are put into a new
element is `construct`'s and `compact_slots`'s business.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

from robosmi.errors import ModelError
from robosmi.model.elements import ecore
from robosmi.model.elements.compact_slots import is_prepared, prepare
from robosmi.model.elements.construct import assign, initialise
from robosmi.model.elements.containment_order import all_contents, contents
from robosmi.model.elements.feature_errors import (
    FeatureValueError,
    UnknownFeatureError,
    declared_features,
    literal_error,
    not_named,
    unknown_feature,
    value_error,
)
from robosmi.model.elements.structure import resource_of

__all__ = ["Element", "EnumLiteral", "FeatureValueError", "UnknownFeatureError", "enum_literal"]

if TYPE_CHECKING:

    class _Base(ecore.EObject):
        """The members of pyecore's EObject that typed code uses; containers and contents are strict elements, too."""

        _robosmi_plan: ClassVar[object]
        """The plan of the class that `xmi_plan` caches here."""
        _robosmi_layout: ClassVar[object]
        """The layout of the class that `xmi_layout` caches here."""

        @property
        def eContents(self) -> list[Element]: ...
        def __init__(self, /, **features: Any) -> None: ...
        def eContainer(self) -> Element | None: ...
        def eAllContents(self) -> list[Element]: ...

    class EnumLiteral(ecore.EEnumLiteral):
        """A literal of an enumeration."""

else:
    _Base = ecore.EObject
    EnumLiteral = ecore.EEnumLiteral

_Literal = TypeVar("_Literal", bound="EnumLiteral")


class Element(_Base):
    """A model element: a pyecore EObject with strict construction and assignment.

    Args:
        features: initial values by feature name; many-valued features take any iterable; None is left out.

    Raises:
        UnknownFeatureError: a name is no feature of the class.
        FeatureValueError: a value is of the wrong kind.
    """

    if not TYPE_CHECKING:

        def __new__(cls, /, *args: Any, **features: Any) -> Any:
            """As pyecore's, without its process-wide set of all instances and without empty containers (`compact_slots`)."""
            if args:
                raise not_named(cls, args)
            if not is_prepared(cls):
                prepare(cls)
            return object.__new__(cls)

        _fixed_features = True
        """Once a class is made its features never change, so that `compact_slots` may keep what it finds of them."""

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
            """The elements that this one contains, in EMF's order: those in features of supertypes first."""
            return contents(self)

        def eAllContents(self) -> list[Any]:
            """All that this one contains, in EMF's order: an element before its contents."""
            return all_contents(self)

        @property
        def eResource(self) -> Any:
            """The resource of the root container."""
            return resource_of(self)

    def __init__(self, /, **features: Any) -> None:
        initialise(self, features)

    if not TYPE_CHECKING:  # to a type checker an element has its features and no others

        def __setattr__(self, name: str, value: Any) -> None:
            enumerations = declared_features(self.__class__)
            expected = enumerations.get(name, _MISSING)
            if expected is _MISSING:
                if name in INTERNAL or name[0] == "_":
                    object.__setattr__(self, name, value)
                    return
                raise unknown_feature(self, name)
            if expected is not None and value.__class__ is str:
                raise literal_error(type(self).__name__, name, expected, value)
            if assign(self, name, value):
                return
            try:
                object.__setattr__(self, name, value)
            except TypeError as error:
                raise value_error(type(self).__name__, name, value, error) from error

        def __reduce_ex__(self, protocol: Any) -> Any:
            """Refuse `copy` and `pickle`, which would follow references into containers, metamodels and listeners."""
            raise ModelError(
                f"{self!r} cannot be copied or pickled: it refers to its container, its metamodel and other models",
                fix="save the model and load it again: robosmi.save_model(root, PATH), robosmi.load_model(PATH)",
            )

        def __getattr__(self, name: str) -> Any:
            if name[:2] == "__":
                raise AttributeError(name)
            raise unknown_feature(self, name)

    def _repr_html_(self) -> str:
        from robosmi.model.elements.show import element_html  # for notebooks only

        return element_html(self)

    def __repr__(self) -> str:
        known = declared_features(self.__class__)
        shown = [
            f"{n}={self.eGet(n)!r}"
            for n in ("name", "title", "label", "path", "elementId", "line")
            if n in known and self.eIsSet(n)
        ]
        return f"<{type(self).__name__}{' ' if shown else ''}{' '.join(shown)}>"


def enum_literal(enumeration: type[_Literal], name: str) -> _Literal:
    """The literal of a generated enumeration by its name, which it has."""
    found: _Literal = getattr(enumeration, name)
    return found


_MISSING: Any = object()
INTERNAL = frozenset({"listeners", "dyn_inst", "eResource"})
