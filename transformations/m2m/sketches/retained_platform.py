"""Gives each element of a program whose platform stays its disposition: all is retained but for the edits of the rules.

Nothing is divided, and no name needs an adapter: the same name means the same. What behaves differently all the same is found
by `queries.portability`; the rules of `sketch_rules` change it, and what none of them changes becomes a finding.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence
from fnmatch import fnmatchcase

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.metamodels import ccode, migration
from robosmi.query import ancestor_of_kind
from robosmi.transform import ETL, Trace
from robosmi.transformations.knowledge.platforms.platform_model import platform_part
from robosmi.transformations.knowledge.platforms.portability_facts import portability_facts
from robosmi.transformations.m2m.partition.dispositions import STEP, Disposition, decide, retain, rewrite
from robosmi.transformations.m2m.partition.platform_dependence import Dependence
from robosmi.transformations.m2m.sketches.sketch_edits import MovedSketch, SketchEdit
from robosmi.transformations.m2m.sketches.sketch_rules import RULES
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_text import expression_text
from robosmi.transformations.queries.macros.tokens import name_tokens
from robosmi.transformations.queries.own_headers import own_header
from robosmi.transformations.queries.portability.analysed_program import DIFFERS, PortabilityPlace
from robosmi.transformations.queries.program_model import ProgramModel
from robosmi.transformations.queries.source_text import words_of
from robosmi.transformations.queries.text_changes import all_changes


def retain_platform(sketch: MovedSketch, trace: Trace) -> tuple[Dependence, list[PortabilityPlace]]:
    """Decide what happens to each element of a program.

    Args:
        sketch: the program.
        trace: where links from sources to decisions are recorded.

    Returns:
        The partition, and the places that no edit cures.
    """
    made = Dependence()
    views = sketch.views
    called = {name for view in views for name in view.called()}
    symbols = {symbol.name for view in views for symbol in view.symbols()}
    includes = [include.header for view in views for include in view.unit.includes]
    words = words_of(sketch.sources[view.unit.path] for view in views)
    made.source = platform_part(views[0].api, [*called, *symbols], includes, words, [view.includes for view in views])
    made.source.boardMappings.extend(sketch.board)
    code = ProgramModel(views)
    judged = _dispositions(code, views)
    judged.run()
    made.dispositions = [d for element in code.all_contents() for d in judged.trace.equivalents(element, Disposition)]
    found = [each for rule in RULES for each in rule(sketch)]
    edits = [each for each in found if isinstance(each, SketchEdit)]
    for edit in edits:
        _rewrite(edit, judged, made.dispositions)
    trace.take(judged.trace)
    left = [*_left(sketch, edits), *(each for each in found if isinstance(each, PortabilityPlace))]
    order = {str(view.unit.path): number for number, view in enumerate(views)}
    return made, sorted(left, key=lambda place: (order.get(place.path, 0), place.line))


def _dispositions(code: ProgramModel, views: Sequence[CodeView]) -> ETL:
    """The transformation from a program to dispositions; its rule `Rewritten` takes elements that no other matches."""
    t = ETL(code, step=STEP)
    program, api = views[0].program, views[0].api

    def at_top(element: ccode.Located) -> bool:
        return isinstance(element.eContainer(), ccode.SourceUnit)

    def known(include: ccode.Include) -> bool:
        return api.header_kind(str(include.header)) is not None

    @t.rule(guard=lambda i: bool(own_header(i)))
    def OwnHeader(i: ccode.Include, d: Disposition) -> None:
        decide(d, i, retain, "own-header", "the program's own header, copied with it")

    @t.rule(guard=lambda i: not own_header(i) and known(i))
    def KeptInclude(i: ccode.Include, d: Disposition) -> None:
        decide(d, i, retain, "kept-include", "the target has the header, too")

    @t.rule(guard=lambda i: not own_header(i) and not known(i))
    def LibraryInclude(i: ccode.Include, d: Disposition) -> None:
        decide(d, i, retain, "library-include", "a library that is installed for the target, too")

    @t.rule
    def OwnMacro(m: ccode.Macro, d: Disposition) -> None:
        decide(d, m, retain, "own-macro", "the program's own macro")

    @t.rule(guard=at_top)
    def OwnFunction(f: ccode.Function, d: Disposition) -> None:
        decide(d, f, retain, "own-function", "the program's own function")

    @t.rule(greedy=True, guard=lambda x: at_top(x) and not isinstance(x, ccode.Function))
    def OwnDeclaration(x: ccode.Declaration, d: Disposition) -> None:
        decide(d, x, retain, "own-declaration", "the program's own declaration")

    @t.rule(greedy=True, guard=lambda x: x.eContainer() is program)
    def KeptName(x: ccode.Declaration, d: Disposition) -> None:
        decide(d, x, retain, "target-name", "it means the same on the target")

    @t.rule(lazy=True, greedy=True)
    def Rewritten(e: ccode.Located, d: Disposition) -> None:
        decide(d, e, rewrite, "", "")

    return t


def _rewrite(edit: SketchEdit, judged: ETL, dispositions: list[migration.Disposition]) -> None:
    """Add an edit to the disposition of its element, which may have those of other rules; one without changes has none."""
    if not edit.replacements:
        return
    unit = _unit(edit.element)
    old = next(iter(judged.trace.equivalents(edit.element, Disposition)), None)
    made = old if old is not None else judged.equivalent(edit.element, "Rewritten", kind=Disposition)
    assert made is not None
    if old is None:
        dispositions.append(made)
    if old is None or old.action is retain:
        made.action, made.choice = rewrite, rewrite.name
        made.rules[:], made.reasons[:] = [], []
    made.rules.append(edit.rule)
    made.reasons.append(edit.reason)
    made.changes.extend(
        migration.TextChange(
            unit=unit, startOffset=start, endOffset=end, replacement=text, rule=edit.rule, reason=edit.reason,
            step=migration.Step.code,
        )
        for start, end, text in edit.replacements
    )  # fmt: skip


def _unit(element: ccode.Located | ccode.SourceUnit) -> ccode.SourceUnit | None:
    return element if isinstance(element, ccode.SourceUnit) else ancestor_of_kind(element, ccode.SourceUnit)


def _left(sketch: MovedSketch, edits: Sequence[SketchEdit]) -> Iterator[PortabilityPlace]:
    cured = {
        (edit.kind, str(unit.path), line) for edit in edits if (unit := _unit(edit.element)) is not None for line in edit.lines
    }
    for place in sketch.places:
        same = place.kind in sketch.facts.same and not any(fnmatchcase(place.name, but) for but in sketch.facts.same_but)
        of_register = bool(sketch.kinds[place.kind].registers) if place.kind in sketch.kinds else False
        if not same and (of_register or (place.kind, place.path, place.line) not in cured):
            yield place


def place_findings(
    places: Sequence[PortabilityPlace], plan: migration.MigrationPlan, sources: Mapping[str, bytes]
) -> list[Finding]:
    """The findings about places that nothing cures: no edit, and no pin of the plan that is written there.

    A line may use several registers. It is cured if no name of one is left in it.
    """
    facts = portability_facts(str(plan.source.name)) if plan.source is not None else None
    registers: dict[str, frozenset[str]] = {}
    if facts is not None:
        known = facts.registers
        registers = {kind: frozenset(known.get(told.registers, ())) for kind, told in facts.kinds.items() if told.registers}
    left = _names_left(plan, sources) if any(place.kind in (*registers, OF_NAMES) for place in places) else {}
    bound = {
        (str(change.unit.path), sources[str(change.unit.path)].count(b"\n", 0, change.startOffset) + 1)
        for binding in plan.portBindings
        if binding.pin is not None
        for change in binding.changes
        if change.unit is not None
    }
    moved = {
        (str(unit.path), int(call.line), expression_text(call.arguments[0]))
        for flow in plan.portFlows
        if flow.choice == "target"
        for call in flow.calls
        if call.arguments and str(call.calleeName) in _INTERRUPTS
        if (unit := ancestor_of_kind(call, ccode.SourceUnit)) is not None
    }
    elsewhere = {
        str(name)
        for binding in plan.portBindings
        for name in (binding.name, *binding.names)
        if binding.pin is None or name not in (binding.pin.label, *binding.pin.aliases)
    }
    found = []
    for place in places:
        at, what = (place.path, place.line), place.what
        if place.kind in registers:
            names = [name for name in left.get(at, ()) if name in registers[place.kind]]
            told = [f"{name}: {text}." for name in dict.fromkeys(names) if facts is not None and (text := facts.meaning(name))]
            what = " ".join([what.replace(place.name, names[0]), *told]) if names else ""
        elif place.kind == OF_NAMES and place.name not in left.get(at, [place.name]):
            continue  # a change for pins has replaced it
        elif place.kind == BY_CALL and (*at, place.name) in moved:
            continue
        elif place.kind == OF_PORT:
            given, _, labels = place.name.rpartition(": ")
            if (*at, given) in moved or elsewhere.isdisjoint(labels.split(", ")):
                continue
        elif place.kind in OF_PINS and at in bound:
            continue
        if what:
            fix = f"write what it means there: {_text(sources, *at)}"
            found.append(Finding(DIFFERS, Severity.warning, f"{place.kind}: {what}", Location(*at), fix=fix))
    return found


def _names_left(plan: migration.MigrationPlan, sources: Mapping[str, bytes]) -> dict[tuple[str, int], list[str]]:
    """Path and number of each line with names -> those of them that no change of the plan replaces.

    The definition of a macro has none if no use of the macro is left: it stands for nothing any more.
    """
    changed: dict[str, set[int]] = {}
    for change in all_changes(plan):
        if change.unit is not None:
            changed.setdefault(str(change.unit.path), set()).update(range(change.startOffset, change.endOffset))
    found: dict[tuple[str, int], list[str]] = defaultdict(list)
    for path, data in sources.items():
        line, last = 1, 0
        for start, _, name in name_tokens(data):
            line, last = line + data.count(b"\n", last, start), start
            names = found[path, line]
            if start not in changed.get(path, ()):
                names.append(name)
    defined, counts = _macro_lines(plan), Counter(name for names in found.values() for name in names)
    while gone := [name for name, lines in defined.items() if counts[name] == sum(found[at].count(name) for at in lines)]:
        for at in {at for name in gone for at in defined.pop(name)}:
            counts.subtract(found[at])
            found[at] = []
    return found


def _macro_lines(plan: migration.MigrationPlan) -> dict[str, set[tuple[str, int]]]:
    """Name of a macro of the program -> the lines of its definitions."""
    found: dict[str, set[tuple[str, int]]] = {}
    for unit in plan.program.units if plan.program is not None else ():
        for macro in unit.macros:
            lines = range(int(macro.line), int(macro.endLine or macro.line) + 1)
            found.setdefault(str(macro.name), set()).update((str(unit.path), line) for line in lines)
    return found


OF_NAMES = "avr_libc_call"
"""The kind of places that are names of avr-libc; some take a register."""
BY_CALL = "attach_interrupt_number"
"""The kind of places that their call gives away: a flow of pins cures them."""
OF_PORT = "interrupt_of_port"
"""The kind of places that are right as long as their port keeps its pin."""
_INTERRUPTS = frozenset(["attachInterrupt", "detachInterrupt"])
OF_PINS = frozenset(
    {
        "analog_pin_number",
        "analog_pin_as_14_to_19",
        "analog_pin_above_A3",
        "pin_13",
    }
)
"""Kinds of places that are numbers and names of pins: the pins of the plan cure them. """


def _text(sources: Mapping[str, bytes], path: str, line: int) -> str:
    lines = sources[path].decode("utf-8", "replace").splitlines() if path in sources else []
    return " ".join(lines[line - 1].split()) if 0 < line <= len(lines) else ""
