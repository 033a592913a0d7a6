"""Redirects calls inside macros to an invalid pin if their ports cannot be looked up: they would drive other pins of the
target.

Neither the macro's text nor its use belongs to the port alone. So around the use a macro with the function's name passes no
pin; the preprocessor meets it when it has expanded the use. RS335 reports that such calls do nothing yet.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from msgspec import Struct

from robosmi.metamodels import ccode, migration
from robosmi.transformations.queries.port_pins import NO_PIN, UNBOUND
from robosmi.transformations.queries.value_flows import PinArgument


class _Use(Struct, frozen=True):
    """The text range of a macro's outermost use that expands to such calls."""

    unit: ccode.SourceUnit
    start: int
    end: int


def shut_pins(arguments: Iterable[PinArgument], sources: Mapping[str, bytes]) -> dict[int, list[migration.TextChange]]:
    """Make the directives around each macro use that expands to calls whose ports cannot be looked up.

    Args:
        arguments: the pin arguments of the program's calls; only those without a place in the text are considered.
        sources: path of a unit -> its bytes.

    Returns:
        `id()` of the first call at each use -> the changes there.
    """
    found: dict[tuple[str, int], tuple[_Use, list[PinArgument]]] = {}
    for one in arguments:
        if one.unplaced and one.call is not None and one.taken:
            use = _outermost(one.unit, one.call)
            found.setdefault((str(use.unit.path), use.start), (use, []))[1].append(one)
    return {id(given[0].call): list(_around(use, given, sources[str(use.unit.path)])) for use, given in found.values()}


def _outermost(unit: ccode.SourceUnit, call: ccode.Call) -> _Use:
    at = int(call.startOffset)
    uses = [(int(use.startOffset), -int(use.endOffset)) for use in unit.macroUses if use.startOffset <= at < use.endOffset]
    start, minus_end = min(uses, default=(at, -int(call.endOffset)))
    return _Use(unit, start, -minus_end)


def _around(use: _Use, given: list[PinArgument], data: bytes) -> Iterator[migration.TextChange]:
    """Put the directives on lines of their own before and after the use; before it they replace the indentation if possible."""
    functions = list(dict.fromkeys(each.function for each in given))
    before = "".join(f"{_directive(name, [each for each in given if each.function == name])}\n" for name in functions)
    after = "".join(f"\n#undef {name}" for name in functions)
    line = data.rfind(b"\n", 0, use.start) + 1
    blanks = data[line : use.start]
    own_line = bool(blanks) and not blanks.strip() and not data[:line].rstrip(b"\r\n").endswith(b"\\")
    start, text = (line, before + blanks.decode()) if own_line else (use.start, f"\n{before}")
    yield _change(use.unit, start, use.start, text, functions)
    end = use.end + len(data[use.end :]) - len(data[use.end :].lstrip(b" \t"))
    end = end + 1 if data[end : end + 1] == b";" else use.end
    rest = data[end:].split(b"\n", 1)[0].strip()
    yield _change(use.unit, end, end, after + "\n" * bool(rest and not rest.startswith(b"//")), functions)


def _directive(function: str, given: list[PinArgument]) -> str:
    """A macro definition that calls the function with an invalid pin, and with a length of 0 for arrays of pins."""
    calls = [each.call for each in given if each.call is not None]
    names = [f"a{i}" for i in range(min(len(call.arguments) for call in calls))]
    texts = list(names)
    for each in given:
        pin = each.parameter
        if pin.number is None:
            texts[pin.position] = UNBOUND
        elif pin.number < len(texts):
            texts[pin.number] = "0"
    more = any(len(call.arguments) > len(names) for call in calls)
    parameters, passed = ", ".join([*names, *["..."] * more]), ", ".join([*texts, *["##__VA_ARGS__"] * more])
    return f"#define {function}({parameters}) {function}({passed})  // no pin: nothing can look up the port that the macro gives"


def _change(unit: ccode.SourceUnit, start: int, end: int, text: str, functions: list[str]) -> migration.TextChange:
    return migration.TextChange(
        unit=unit, startOffset=start, endOffset=end, replacement=text, rule=NO_PIN, step=migration.Step.hardware,
        reason=f"a macro gives {', '.join(functions)} a number of the source that nothing can look up",
    )  # fmt: skip
