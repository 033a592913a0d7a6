"""The parameter values that an adapter can handle, from a marker such as `range frequency 31..65535 or 0: it stays silent`.

A constraint checks whether a program passes other values.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from robosmi.errors import did_you_mean
from robosmi.transformations.knowledge.adapters.adapter_records import ArgumentRange

_VALUES = r"(?:(none)|(-?\d+)?\.\.(-?\d+)?((?: or -?\d+)*))"
_RANGE = re.compile(rf"(\w+) {_VALUES}(?: beside ([\w./]+/\w+))?(?: away from (\w+))?: (.+)")
_NAME = re.compile(r"(\w+)\s*(?:\[[^\]]*\]\s*)*$")


def argument_range(function: str, signatures: Sequence[str], text: str) -> ArgumentRange:
    """What a marker says.

    Args:
        function: name of the adapter.
        signatures: of the source's functions that it stands for, as far as they are read.
        text: what stands behind `range:`.

    Raises:
        ValueError: it is no range, or of no parameter; its arguments are what is wrong and what to do.
    """
    said = _RANGE.fullmatch(text)
    if said is None or not (said[2] or said[3] or said[4]):
        form = "PARAMETER LEAST..MOST [or VALUE] or none [beside HEADER/PIECE] [away from PIN]: WHAT HAPPENS ELSE"
        raise ValueError(f"'{text}' is not a range", f"write: range: {form}")
    names = parameter_names(signatures[0]) if signatures else []
    if said[1] not in names:
        hint = did_you_mean(said[1], [name for name in names if name])
        raise ValueError(f"'{function}' has no parameter '{said[1]}'{hint}", "use a name from `for`, above it")
    least, most = (1, 0) if said[2] else (int(end) if end else None for end in (said[3], said[4]))
    others = [int(word) for word in (said[5] or "").split() if word != "or"]
    return ArgumentRange(said[1], names.index(said[1]), least, most, others, said[6] or "", said[7] or "", said[8])


def parameter_names(signature: str) -> list[str]:
    """The names of the parameters of a signature, empty texts for those without one."""
    from robosmi.transformations.knowledge.adapters.adapter_checks import split_arguments  # built data needs no lexer

    found = [_NAME.search(one) for one in split_arguments(signature[signature.find("(") + 1 : signature.rfind(")")])]
    return [name[1] if name is not None else "" for name in found]
