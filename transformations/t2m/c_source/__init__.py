"""Text-to-model: C and C++ source files become a code model (metamodel `ccode`).

`read_program` is the interface for programs, `read_unit` for single files such as headers. Headers need not be there: names
that nothing declares are declared by how they are used. Which names are a platform's is no question here; the queries in
`queries.code` answer it.
"""

from __future__ import annotations

from robosmi.transformations.t2m.c_source.reader import read_program, read_unit

__all__ = ["read_program", "read_unit"]
