"""Headers that need those which are included before them: what stands before a header in the file that includes it.

`#include "queue.h"` and behind it `#include "pathing.h"` is enough for a compiler where the second one uses types of the first.
Read alone, statements of the second would be lost.
"""

from __future__ import annotations

import os
from collections.abc import Sequence

from robosmi.metamodels import ccode
from robosmi.typed import distinct


def included_before(path: str, units: Sequence[ccode.SourceUnit], above: tuple[str, ...] = ()) -> list[str]:
    """The program's own headers that the first file which includes a header includes before it, those before that file first.

    Args:
        path: of the header.
        units: that are known, in the order of the program's files.
        above: the files whose headers are asked for already.
    """
    wanted = os.path.realpath(path)
    for unit in units:
        found = [os.path.realpath(each.resolvedPath) for each in unit.includes if each.resolvedPath]
        if wanted in found and os.path.realpath(unit.path) not in (wanted, *above):
            outer = included_before(str(unit.path), units, (*above, wanted))
            return [each for each in distinct([*outer, *found[: found.index(wanted)]]) if each != wanted]
    return []
