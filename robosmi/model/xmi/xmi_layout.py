"""How the XMI writer lays out each class: its features in EMF's order, with defaults and conversions to text.

A layout is worked out once per class and file; classes of `strict`, which cannot change, keep what does not depend on the
file. What EMF does not write (transient features, containers, types that cannot be serialised) is not in it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from types import ModuleType
from typing import TYPE_CHECKING, Any, TypeAlias

from robosmi.errors import ModelError
from robosmi.model.elements import datatypes, ecore, features
from robosmi.model.elements.ecore import EClass, EObject, EStructuralFeature
from robosmi.model.elements.feature_values import is_stored
from robosmi.model.elements.pyecore_internals import key_of
from robosmi.model.elements.strict import Element

if TYPE_CHECKING:
    from robosmi.model.elements.ecore import Slots


_KEPT = 1 << 10  # texts of values of one feature
FEATURE_MAP, VALUE, VALUES, LINKS, CHILDREN, DETAILS = range(6)
"""How a feature is written: not at all if it is empty, an attribute, elements with text, references, contained elements, or pairs
of texts."""

_PLAIN = {"EInt": int, "ELong": int, "EString": str, "EIntegerObject": int, "ELongObject": int, "EDouble": float, "EFloat": float}

Root: TypeAlias = "EObject | ModuleType | Sequence[EObject | ModuleType]"
"""What a file of models is written from: a root element or several; a generated package stands for its EPackage."""
Append: TypeAlias = "Callable[[str], None]"
Piece: TypeAlias = "str | tuple[str, str, EObject]"
"""The content of an element: a text, or an element as (beginning of its start tag, tag)."""


class Column:
    """How the values of one feature of a class are written.

    Attributes:
        kind: one of the numbers above.
        feature: pyecore's feature.
        name: its name in the file.
        key: where pyecore keeps its value in the element's `__dict__`.
        start: what stands before its value as attribute.
        many: whether it holds several values.
        upper: its upper bound, negative for none.
        default: the value that is not written.
        convert: value -> text.
        plain: the Python class of values that are texts or whose attributes are kept in `rendered`, or None.
        rendered: what is written for values met before; for contained elements: their class -> the beginning of the start tag.
        declared: the EClass of contained or referred elements.
        names_types: whether a reference to another file names the target's class.
        is_primitive: whether EMF has no "nothing" for it.
        is_unsettable: whether it knows if it was set.
    """

    __slots__ = (
        "convert", "declared", "default", "feature", "is_primitive", "is_unsettable", "key", "kind", "many", "name",
        "names_types", "plain", "rendered", "start", "upper",
    )  # fmt: skip

    def __init__(self, kind: int, feature: EStructuralFeature) -> None:
        self.kind = kind
        self.feature = feature
        self.name = str(feature.name)
        self.key: str = key_of(feature)
        self.start = f' {self.name}="'
        self.many = bool(feature.many)
        self.upper = int(feature.upperBound)
        self.default: Any = None
        self.convert: Any = None
        self.plain: Any = None
        self.rendered: dict[Any, str] = {}
        self.declared: Any = None
        self.names_types = False
        self.is_primitive = False
        self.is_unsettable = bool(feature.unsettable)

    def copy(self) -> Column:
        """The same column with nothing rendered yet."""
        made: Column = object.__new__(Column)
        for name in Column.__slots__:
            setattr(made, name, getattr(self, name))
        made.rendered = {}
        return made


Shaped = tuple[int, str, Any, dict[Any, str], Column]
"""A column with what the writer asks of it for every element."""


class Layout:
    """How a class is written.

    Attributes:
        eclass: the EClass.
        columns: its features in EMF's order.
        shapes: keys of an element's `__dict__` -> the columns among them, each as kind, key, plain, rendered and itself.
            Most elements of a class have one of a few shapes.
        has_id: whether it has an ID attribute.
    """

    __slots__ = ("columns", "eclass", "has_id", "shapes")

    def __init__(self, eclass: EClass) -> None:
        self.eclass = eclass
        self.shapes: dict[tuple[str, ...], list[Shaped]] = {}
        cls = eclass.python_class
        known = cls.__dict__.get("_robosmi_layout")
        if known is None:
            inherited = features.all_features(eclass)
            written = [column for f in inherited if not f.transient and (column := _column(eclass, f)) is not None]
            known = any(f.is_attribute and f.iD for f in inherited), written
            if issubclass(cls, Element):
                cls._robosmi_layout = known
        self.has_id: bool = known[0]
        # start tags have a file's own prefixes; the texts of values are the same in all files
        self.columns: list[Column] = [column.copy() if column.kind == CHILDREN else column for column in known[1]]

    def columns_in(self, slots: Slots) -> list[Shaped]:
        """The columns of an element that has these slots."""
        found = [(c.kind, c.key, c.plain, c.rendered, c) for c in self.columns if c.key in slots]
        if len(self.shapes) < 1 << 10:
            self.shapes[tuple(slots)] = found
        return found


def _column(eclass: EClass, feature: EStructuralFeature) -> Column | None:
    kind = features.declared_type(feature)
    if (feature.many and features.is_computed(feature)) or (feature.derived and not is_stored(feature)):
        return None
    if not feature.is_attribute:
        back = features.opposite(feature)
        if back is not None and back.containment:
            return None
        column = Column(CHILDREN if feature.containment else LINKS, feature)
        column.declared = kind
        column.names_types = bool(kind.abstract and kind is not ecore.EObject.eClass) or features.has_type_parameter(feature)
        return column
    if kind.name == datatypes.FEATURE_MAP:
        return Column(FEATURE_MAP, feature)
    if kind is ecore.EStringToStringMapEntry:
        return Column(DETAILS, feature)
    if features.is_off(kind, "serializable"):
        return None
    column = Column(VALUES if feature.many else VALUE, feature)
    column.convert = datatypes.to_text(kind)
    column.is_primitive = datatypes.is_primitive(kind)
    if isinstance(kind, ecore.EEnum):
        column.plain = ecore.EEnumLiteral
    elif not column.is_unsettable:
        column.plain = _PLAIN.get(kind.name) if features.is_of_ecore(kind) else None
    if not feature.many:
        try:
            column.default = datatypes.default(feature, kind)
        except ValueError as error:
            raise ModelError(
                f"the default value of {eclass.name}.{feature.name} is wrong: {error}", fix="correct it in the .ecore file"
            ) from None
    return column


class Layouts:
    """The layouts of one file, by Python class of the elements."""

    def __init__(self) -> None:
        self.known: dict[type, Layout] = {}

    def of(self, element: EObject) -> Layout:
        """The layout of an element's class."""
        found = self.known[element.__class__] = Layout(element.eClass)
        return found

    def close(self) -> None:
        """Forget the texts of many values, which a class that is kept would keep too."""
        for layout in self.known.values():
            for column in layout.columns:
                if len(column.rendered) > _KEPT:
                    column.rendered.clear()
