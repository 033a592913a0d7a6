"""The signature of an adapter as its plan has it, typed: printed for the target, or as types alone."""

from __future__ import annotations

from robosmi.metamodels import migration
from robosmi.transformations.queries.expression_type import FunctionType
from robosmi.transformations.queries.signature_text import declare


def target_signature(use: migration.AdapterUse) -> str:
    """The declarator that is generated: return type, name, parameters."""
    shown = [declare(spelling(p.valueType), p.name) for p in use.parameters] + ["..."] * use.variadic
    return declare(spelling(use.result), f"{use.targetName}({', '.join(shown)})")


def target_types(use: migration.AdapterUse) -> FunctionType:
    """What the adapter takes and gives."""
    return FunctionType(spelling(use.result), tuple(spelling(p.valueType) for p in use.parameters))


def spelling(kind: migration.TargetType | None) -> str:
    """How a type is written, `void` where there is none."""
    return str(kind.spelling) if kind is not None else "void"
