"""The headers that are included before another one, for headers that rely on them.

If a file has `#include "queue.h"` and then `#include "pathing.h"`, a compiler is content when the second header uses types of
the first. Read alone, statements of the second header would be lost.
"""

from __future__ import annotations

import os
from collections.abc import Sequence

from robosmi.metamodels import ccode


def included_before(path: str, units: Sequence[ccode.SourceUnit], above: tuple[str, ...] = ()) -> list[str]:
    """The program's own headers that are included before a header by the first file that includes it.

    Headers that come before that file itself are listed first.

    Args:
        path: path of the header.
        units: the known units, in the order of the program's files.
        above: the files that were asked about already, further down this chain of includes.
    """
    wanted = os.path.realpath(path)
    for unit in units:
        found = [os.path.realpath(each.resolvedPath) for each in unit.includes if each.resolvedPath]
        if wanted in found and os.path.realpath(unit.path) not in (wanted, *above):
            outer = included_before(str(unit.path), units, (*above, wanted))
            return [each for each in dict.fromkeys([*outer, *found[: found.index(wanted)]]) if each != wanted]
    return []
