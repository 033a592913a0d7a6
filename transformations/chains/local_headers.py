"""Headers of the program's own that lie beside it: they are read with it, stored with it and carried over with it.

Found are those that a source file, or such a header, includes and that no platform provides; where they are looked for is
what a C compiler does: beside the including file, then in the folders given.
"""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from pathlib import Path

from robosmi import inputs
from robosmi.transformations.knowledge.lexer import tokens
from robosmi.transformations.knowledge.platform_api import ApiIndex
from robosmi.transformations.queries.source_text import HEADERS

_INCLUDE = re.compile(r'#\s*include\s*[<"]([^>"\n]+)[>"]')


def with_headers(paths: Sequence[Path], include_dirs: Sequence[Path], api: ApiIndex) -> list[Path]:
    """The files of a program and behind them the headers of its own that they reach.

    Args:
        paths: the source files.
        include_dirs: folders with headers.
        api: what is known of the source platform; its headers are not the program's.
    """
    found = list(paths)
    seen = {os.path.realpath(path) for path in paths}
    names = {path.name for path in paths}
    for path in found:  # grows while it is walked
        for name in _included(path):
            if api.header_kind(name) is not None or not name.lower().endswith(HEADERS):
                continue
            place = next((p for p in (folder / name for folder in (path.parent, *include_dirs)) if p.is_file()), None)
            if place is not None and os.path.realpath(place) not in seen and place.name not in names:
                seen.add(os.path.realpath(place))
                names.add(place.name)
                found.append(place)
    return found


def _included(path: Path) -> list[str]:
    """The names in a file's include directives; none for a file that cannot be read, which its reader reports."""
    try:
        data = inputs.read_bytes(path, inputs.SOURCE)
    except OSError:
        return []
    directives = (text for kind, _, _, text in tokens(data) if kind == "directive") if b"include" in data else ()
    return [match[1].replace("\\", "/") for match in map(_INCLUDE.match, directives) if match]
