"""The braces of a block as they are written: `{` and `}`, the digraphs `<%` and `%>`, or macros whose bodies end in a brace.

Programs use `#define FOREVER for (;;) {` and `#define END }` to open and close blocks; such a block's content begins after the
use of the former and ends before the use of the latter.
"""

from __future__ import annotations

from robosmi.metamodels import ccode
from robosmi.query import ancestor_of_kind


def inside(data: bytes, block: ccode.Located) -> tuple[int, int]:
    """The byte range between the braces of a block that is not torn (see `is_torn`).

    Args:
        data: the bytes of the block's unit.
        block: what stands between braces.
    """
    start, end = int(block.startOffset), int(block.endOffset)
    opening, closing = _ends(block)
    first = int(opening.endOffset) if opening is not None else start + (2 if data[start : start + 2] == b"<%" else 1)
    last = int(closing.startOffset) if closing is not None else end - (2 if data[end - 2 : end] == b"%>" else 1)
    return first, last


def is_torn(block: ccode.Located) -> bool:
    """Whether a macro that opens or closes a block contains more than the brace, so that the block's content is no range."""
    opening, closing = _ends(block)
    return not _body(opening).endswith("{") or _body(closing, "}") != "}"


def ends_in_brace(statement: ccode.Located) -> bool:
    """Whether the text of a statement ends in the use of a macro whose body ends in `}`."""
    return _body(_ends(statement)[1], "").endswith("}")


def _ends(block: ccode.Located) -> tuple[ccode.MacroUse | None, ccode.MacroUse | None]:
    """The macro uses that the first and the last byte of a block lie in, None where the brace is written out."""
    unit = ancestor_of_kind(block, ccode.SourceUnit)
    uses = list(unit.macroUses) if unit is not None else []
    opening = (use for use in uses if use.startOffset <= block.startOffset < use.endOffset)
    closing = (use for use in uses if use.startOffset < block.endOffset <= use.endOffset)
    return next(opening, None), next(closing, None)


def _body(use: ccode.MacroUse | None, none: str = "{") -> str:
    """The body of the used macro; `none`, the brace that is written out, if no macro is used."""
    return none if use is None else str(use.macro.body or "").strip() if use.macro is not None else ""
