"""The invariant of pins, checked in each finished program: what reaches a pin of the target is a pin by the plan.

It follows the values through the generated text again (`generated_pins`), counts that each change of a port's number is in the
text, and that no call with a pin was missed. What does not hold is a finding, and the calls that it is about are not ready.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from itertools import accumulate

from robosmi.base.quantities import quantity
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.metamodels import ccode, migration, platform
from robosmi.query import ancestor_of_kind
from robosmi.transformations.knowledge.adapters.adapter_checks import parameters_of
from robosmi.transformations.knowledge.platforms.board_pins import INTERRUPT
from robosmi.transformations.m2m.plan_tasks import plan_findings
from robosmi.transformations.m2m.ports.port_texts import BY_REGISTER, LOOK_UP, MOVES, RULE as MOVED, SAME_NUMBERS
from robosmi.transformations.queries.circuits.circuit import pin_literal
from robosmi.transformations.queries.plans.port_pins import CONSOLE, CONSOLE_NUMBER, PIN_RULE, UNBOUND, source_name, text_in_place
from robosmi.transformations.queries.plans.retained_pins import retains_platform, whole_source_api
from robosmi.transformations.queries.text_changes import all_changes, decision_of, effective
from robosmi.transformations.t2m.c_source.parsing.generated_pins import PinCheck, PinNames, PinPlace, follow_pins
from robosmi.transformations.t2m.c_source.parsing.generated_program import GeneratedProgram

LOOK_UPS = frozenset({"port", "ports", "port_of_channel"})
"""The helpers by which a finished program looks up the pin of a port."""
_TOKENS = re.compile(r"[A-Za-z_]\w*|\d\w*")
_ARGUMENT = re.compile(r"\((\w+)")
_COMMENT = re.compile(r"//[^\n]*|/\*.*?(?:\*/|\Z)", re.DOTALL)
_FIX = "compare the line with the source, and write the pin of the wiring table there"

Place = Callable[[str, int], Location | None]
"""File and line of a finished program -> the place in the source."""


def pin_findings(
    plan: migration.MigrationPlan, program: GeneratedProgram, place: Place, sources: Mapping[str, bytes]
) -> list[migration.PlanFinding]:
    """RS345: the places of a finished program whose pin is not the plan's, or cannot be followed.

    Args:
        plan: the plan, which stays as it is.
        program: the finished program, parsed.
        place: file and line of the program -> the place in the source.
        sources: path of a unit -> its bytes.
    """
    names = pin_names(plan)
    checked = follow_pins(program, names)
    renamed = {
        (str(change.unit.path), int(change.startOffset)): str(change.replacement)
        for change in (all_changes(plan) if retains_platform(plan) else ())
        if change.unit is not None and str(change.replacement).isidentifier()
    }

    def called_there(call: ccode.Call) -> str:
        """What a call calls in the finished program: a rule may write another function."""
        return renamed.get((_path(call), int(call.startOffset)), str(call.calleeName))

    dropped = _dropped(plan)
    taken: Iterable[tuple[str, Sequence[ccode.Call]]] = (
        ((str(use.targetName or use.name), use.calls) for use in plan.adapterUses)
        if not retains_platform(plan)
        else ((called_there(call), [call]) for call in _calls_of_flows(plan))
    )
    calls: dict[str, list[ccode.Call]] = {}
    for name, made_there in taken:
        calls.setdefault(name, []).extend(c for c in made_there if not dropped(_path(c), int(c.startOffset)))
    if any(name in checked.functions and checked.seen[name] < len(known) for name, known in calls.items()):
        checked = follow_pins(program, names) if program.declare_constants() else checked
    calls_at = _concerned(calls, checked.functions)
    made: list[tuple[Finding, Sequence[ccode.Call]]] = []
    alike = {(_path(c), int(c.line)) for f in plan.portFlows if SAME_NUMBERS in f.evidence for c in f.calls}
    for each in checked.wrong:
        at = place(each.file, each.line)
        if at is not None and (at.path, at.line) in alike:
            continue
        written = f", written in line {each.at[1]} of {each.at[0]}" if each.at != (each.file, each.line) and each.at[0] else ""
        message = f"line {each.line} of {each.file}: a pin of '{each.function}' is {each.what}{written}"
        made.append((_finding(message, at), calls_at(each.function, at)))
    made += _missing_changes(plan, program, sources)
    pointed = [c for c in _calls_of_flows(plan) if c.calleeExpression is not None and not c.calleeName]
    made += _unseen_calls(calls, [c for c in pointed if not dropped(_path(c), int(c.startOffset))], checked)
    made += _ports_of_one_name(plan)
    paths = {str(unit.path): str(unit.path) for unit in (plan.program.units if plan.program is not None else ())}
    findings = plan_findings(plan, [finding for finding, _ in made], paths)
    for finding, (_, concerned) in zip(findings, made, strict=True):
        finding.elements.extend(concerned)
    return findings


def _finding(message: str, place: Location | None) -> Finding:
    return Finding(PIN_RULE, Severity.warning, message, place, fix=_FIX)


def pin_names(plan: migration.MigrationPlan) -> PinNames:
    """What counts as a pin in the finished program of a plan."""
    if retains_platform(plan):
        return _kept_names(plan)
    functions = {str(use.targetName or use.name): places for use in plan.adapterUses if (places := _pins_of(use))}
    functions |= {name: [PinPlace(0, looked_up=True)] for name in LOOK_UPS}
    constants = {str(c.name): pin_literal(c.pin) for c in plan.connections if c.pin is not None}
    literals = Counter(
        CONSOLE_NUMBER if binding.choice == CONSOLE else text_in_place(binding)
        for binding in plan.portBindings
        if binding.connection is None and (binding.pin is not None or binding.choice == CONSOLE)
        for change in binding.changes
        if change.rule == MOVED
    )
    return PinNames(functions, LOOK_UPS, constants, literals, int(UNBOUND))


def _kept_names(plan: migration.MigrationPlan) -> PinNames:
    """What counts as a pin in a program whose platform stays: the functions and classes of the platform take pins themselves."""
    api = whole_source_api(plan)  # the rules write calls that the program did not have
    own = {str(d.name) for unit in (plan.program.units if plan.program is not None else ()) for d in unit.declarations}
    functions: dict[str, list[PinPlace]] = {}
    for function, header in api.functions_with_pins():
        facts = api.pins(function, header)
        pins = [p for p in facts.parameters if p.numbering != INTERRUPT] if facts is not None and function not in own else []
        if pins:
            functions[function] = [PinPlace(p.position, p.range_with is not None or p.span != 1, p.none) for p in pins]
    functions |= {name: [PinPlace(0, looked_up=True)] for name in LOOK_UPS}
    bound = {pin_literal(b.pin) for b in plan.portBindings if b.pin is not None}
    words = Counter(
        word for b in plan.portBindings if b.pin is not None for change in b.changes for word in _pins_written(change, bound)
    )
    same = [flow for flow in plan.portFlows if SAME_NUMBERS in flow.evidence]  # such as a loop over pins, which stays
    words.update(pin_literal(b.pin) for flow in same for b in flow.bindings if b.pin is not None)
    return PinNames(functions, LOOK_UPS, {}, words, int(UNBOUND), frozenset(api.pin_constants))


def _pins_written(change: migration.TextChange, bound: Collection[str]) -> list[str]:
    """The words of a change that are pins: its last, or, of a statement about a register, arguments of the calls in its place."""
    if change.rule == BY_REGISTER:
        return [word for word in _ARGUMENT.findall(change.replacement) if word in bound]
    return [_word(change)] if change.rule in MOVES else []


def _calls_of_flows(plan: migration.MigrationPlan) -> list[ccode.Call]:
    """The calls that a program makes with pins, each once, but for those that take the number of an interrupt."""
    found = {id(call): call for flow in plan.portFlows for call in flow.calls}
    return [call for call in found.values() if not call.viaMacro]


def _pins_of(use: migration.AdapterUse) -> list[PinPlace]:
    """The parameters of a function of the source platform that are pins, by the platform or by the adapter's markers."""
    known = [] if use.function is None else list(enumerate(use.function.parameters))
    found = [
        PinPlace(at, p.rangeWith >= 0 or p.span != 1, tuple(str(each) for each in p.none))
        for at, p in known
        if p.isPort and p.meaning is platform.Meaning.pin
    ]
    if found or use.adapter is None:
        return found
    names = parameters_of(str(use.adapter.text), str(use.adapter.targetName or use.adapter.name))
    return [PinPlace(names.index(str(pin.name))) for pin in use.adapter.pins if pin.name in names]


def _concerned(
    calls: Mapping[str, Sequence[ccode.Call]], functions: Collection[str]
) -> Callable[[str, Location | None], Sequence[ccode.Call]]:
    """The function from a function and a place of the source to the calls that are not ready, if a pin there is wrong.

    They are those of the line. Where none is in it, they are all: the first time, which says it of each.

    Args:
        calls: the calls of each function.
        functions: those with pins; what looks up pins may be called for each of them.
    """
    lines: dict[str, dict[tuple[str, int], list[ccode.Call]]] = {}
    told: set[str] = set()

    def concerned(function: str, place: Location | None) -> Sequence[ccode.Call]:
        takers = [function] if function in calls else [name for name in calls if name in functions]
        if function not in lines:
            lines[function] = {}
            for call in (call for name in takers for call in calls[name]):
                lines[function].setdefault((_path(call), int(call.line)), []).append(call)
        here = lines[function].get((place.path, place.line or 0), []) if place is not None else []
        every = [call for found in lines[function].values() for call in found] if not here and function not in told else []
        told.update([function] if every else [])
        return here or every

    return concerned


def _path(element: ccode.Located) -> str:
    unit = ancestor_of_kind(element, ccode.SourceUnit)
    return str(unit.path) if unit is not None else ""


def _missing_changes(
    plan: migration.MigrationPlan, program: GeneratedProgram, sources: Mapping[str, bytes]
) -> Iterator[tuple[Finding, Sequence[ccode.Call]]]:
    """Ports that the plan calls moved or looked up, whose change is not in the text as often as it was decided."""
    wanted: dict[str, list[migration.TextChange]] = {}
    dropped = _dropped(plan)
    for change in effective(all_changes(plan)):
        gone = change.unit is not None and dropped(str(change.unit.path), int(change.startOffset))
        if change.rule in (*MOVES, LOOK_UP) and not gone and (word := _word(change)):
            wanted.setdefault(word, []).append(change)
    texts = [data for name, data in program.files.items() if name != program.adapters]
    counts = Counter(token for data in texts for token in _TOKENS.findall(_COMMENT.sub(" ", data.decode("utf-8", "replace"))))
    constants = Counter(str(c.name) for c in plan.connections)
    for word, changes in wanted.items():
        there = counts[word] - constants[word] * len(program.units)
        if there < len(changes):
            first = changes[0]
            owner = decision_of(first)
            flows = [f for f in plan.portFlows if f is owner or owner in f.bindings]
            line = sources[first.unit.path].count(b"\n", 0, first.startOffset) + 1 if first.unit is not None else None
            path = str(first.unit.path) if first.unit is not None else ""
            found, expected = quantity(max(there, 0), "time"), quantity(len(changes), "time")
            message = f"'{word}' is {found} in the sketch, and the plan has put it there {expected}"
            yield _finding(message, Location(path, line)), [call for flow in flows for call in flow.calls]
    for flow in plan.portFlows:
        for binding in flow.bindings if flow.choice == "target" else ():
            if not any(change.rule in MOVES for change in binding.changes):
                message = f"the port '{binding.name}' is to be moved with '{flow.name}', and no number of the text changes"
                yield _finding(message, _place_of(binding.element)), list(flow.calls)


def _dropped(plan: migration.MigrationPlan) -> Callable[[str, int], bool]:
    """The function from a unit's path and an offset to whether the plan leaves out what stands there."""
    elements = [d.element for d in plan.dispositions if d.action is migration.Action.drop and d.element is not None]
    ranges: dict[str, list[tuple[int, int]]] = {}
    for element in elements:
        ranges.setdefault(_path(element), []).append((int(element.startOffset), int(element.endOffset)))
    starts, reach = {}, {}
    for path, found in ranges.items():
        found.sort()
        starts[path] = [start for start, _ in found]
        reach[path] = list(accumulate((end for _, end in found), max))

    def dropped(path: str, offset: int) -> bool:
        last = bisect_right(starts.get(path, []), offset) - 1
        return last >= 0 and offset < reach[path][last]

    return dropped


def _word(change: migration.TextChange) -> str:
    """The word by which a change is found in the text: its last one, such as the name of a constant; empty for a bracket."""
    found = _TOKENS.findall(_COMMENT.sub(" ", change.replacement))
    return str(found[0] if change.rule == LOOK_UP else found[-1]) if found and not change.replacement.startswith(")") else ""


def _place_of(element: ccode.Located | None) -> Location | None:
    return Location(_path(element), int(element.line)) if element is not None else None


def _unseen_calls(
    calls: Mapping[str, Sequence[ccode.Call]], pointed: Sequence[ccode.Call], checked: PinCheck
) -> Iterator[tuple[Finding, Sequence[ccode.Call]]]:
    """Functions with pins of which the finished text has fewer calls than the source, so that some were not followed.

    Args:
        calls: the calls of each function in the source.
        pointed: its calls through pointers that may reach such a function.
        checked: what was found in the finished text.
    """
    for name, known in calls.items():
        if name in checked.functions and checked.seen[name] < len(known):
            some = f"{len(known) - checked.seen[name]} of {quantity(len(known), 'call')}"
            message = f"{some} of '{name}' could not be followed in the sketch"
            yield _finding(message, _place_of(known[0])), known
    if checked.pointed < len(pointed):
        some = f"{len(pointed) - checked.pointed} of {quantity(len(pointed), 'call')}"
        yield _finding(f"{some} through pointers could not be followed in the sketch", _place_of(pointed[0])), pointed


def _ports_of_one_name(plan: migration.MigrationPlan) -> Iterator[tuple[Finding, Sequence[ccode.Call]]]:
    """Ports of the source that have one name and one pin, so that a choice for one of them has moved another."""
    bound = [b for b in plan.portBindings if b.sourcePin >= 0 and b.pin is not None]
    for name, count in Counter(str(b.name) for b in bound).items():
        same = [b for b in bound if b.name == name]
        if count > 1 and len({id(b.pin) for b in same}) < count:
            numbers = ", ".join(map(source_name, same))
            calls = [c for flow in plan.portFlows if any(b in same for b in flow.bindings) for c in flow.calls]
            yield (
                _finding(f"the ports {numbers} are all called '{name}', and one pin serves them", _place_of(same[0].element)),
                calls,
            )
