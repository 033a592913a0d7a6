"""The signature of an adapter according to its plan: as a declarator for generated code, or as a `FunctionType`."""

from __future__ import annotations

from robosmi.metamodels import migration
from robosmi.transformations.queries.expression_type import FunctionType
from robosmi.transformations.queries.signature_text import declare


def target_signature(use: migration.AdapterUse) -> str:
    """The declarator of the adapter in generated code: return type, name and parameters."""
    shown = [declare(spelling(p.valueType), p.name) for p in use.parameters] + ["..."] * use.variadic
    return declare(spelling(use.result), f"{use.targetName}({', '.join(shown)})")


def target_types(use: migration.AdapterUse) -> FunctionType:
    """The return type and the parameter types of the adapter."""
    return FunctionType(spelling(use.result), tuple(spelling(p.valueType) for p in use.parameters))


def spelling(kind: migration.TargetType | None) -> str:
    """The C spelling of a type, `void` for None."""
    return str(kind.spelling) if kind is not None else "void"
