"""The files that a compiler has read, by the rule for `make` that it writes; others than a program's own are refused."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator
from pathlib import Path

from robosmi.errors import VerificationError

_PREREQUISITE = re.compile(r"(?:\\.|[^\s\\])+")
_ESCAPED = re.compile(r"\\(.)")


def used_files(rule: str, folder: Path) -> Iterator[Path]:
    """The files that a rule names after its target.

    Args:
        rule: the text of the rule.
        folder: where the compiler ran.
    """
    for word in _PREREQUISITE.findall(rule.partition(": ")[2].replace("\\\n", " ")):
        yield (folder / _ESCAPED.sub(r"\1", word).replace("$$", "$")).resolve()


def check_used(used: Iterable[Path], only: Collection[Path], places: Collection[Path]) -> None:
    """Check that a program consists of no other files than it may.

    Args:
        used: the files that the compiler has read.
        only: the program's own.
        places: folders of the model, whose files any program may include.

    Raises:
        VerificationError: it has read another one.
    """
    for path in used:
        if path not in only and not any(path.is_relative_to(place) for place in places):
            raise VerificationError(
                f"the plan does not store a file that the original includes: {path}", fix="migrate the program again"
            )
