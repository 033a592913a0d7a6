"""The builders of C and of what C++ adds, put together; programs of both are read with one set."""

from __future__ import annotations

from robosmi.transformations.t2m.c_source import cplusplus, declarations, expressions, statements
from robosmi.transformations.t2m.c_source.context import Builders

BUILDERS = Builders(
    expressions={**expressions.BUILDERS, **cplusplus.EXPRESSIONS},
    statements={**statements.BUILDERS, **cplusplus.STATEMENTS},
    declarations=declarations.BUILDERS,
    block=statements.block,
)
