"""Text-to-model: C and C++ source files become a code model (metamodel `ccode`).

`read_program` is the interface for programs, `read_unit` for single files such as headers. Headers may be missing: names that
nothing declares are declared according to their uses. Which names belong to a platform is not decided here but by the queries
in `queries.code`.
"""

from __future__ import annotations

from robosmi.transformations.t2m.c_source.reader import read_program, read_unit

__all__ = ["read_program", "read_unit"]
