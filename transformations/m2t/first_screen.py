"""The first screen of a report: what works, what to decide, to write and to check on the bench, each with its total.

The report (`task_list`) and the terminal show the same lines; the numbers come from `queries.reports.work`. A task is in one
list only, and lines that do not fit on the first screen follow after it.

Behind it the terminal has the pins, the libraries, and where the rest is (`terminal_lines`).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from msgspec import Struct
from msgspec.structs import replace

from robosmi.base.quantities import quantity
from robosmi.generate.merge_edits import CONFLICT
from robosmi.metamodels import ccode, migration
from robosmi.query import ancestor_of_kind
from robosmi.transformations.m2t.move_text import move_lines
from robosmi.transformations.queries.plans.answers import answer
from robosmi.transformations.queries.plans.plan import called, open_choices
from robosmi.transformations.queries.plans.retained_pins import ignores_unwired, retained_calls, retains_platform
from robosmi.transformations.queries.plans.verdicts import EFFORTS, Construct, constructs
from robosmi.transformations.queries.plans.waiting_calls import NO_SUPPORT, NOT_WIRED_CALL, TO_WRITE, WAITS, WITH_CARE
from robosmi.transformations.queries.portability.analysed_program import DIFFERS
from robosmi.transformations.queries.reports.board_needs import BoardNeeds, board_needs, needs_in_words, shortages
from robosmi.transformations.queries.reports.work import Work

LINES = 40
"""Greatest number of lines of the first screen."""
_SHARES = (9, 6, 5)
"""Number of lines for each of the three lists if all are long."""
_OPTIONS = 4
_SNIPPET = 44

_INDENT = "  "


class Item(Struct, frozen=True):
    """A line of a list.

    Attributes:
        text: its text.
        source: the line of the source that it is about.
        typed: what the user can type to settle it.
        more: further information, such as the candidates.
        rule: the task's rule; empty for a line that gives the common reason of those below it.
        effort: the task's effort.
        done: whether the user has ticked it.
    """

    text: str
    source: str = ""
    typed: str = ""
    more: str = ""
    rule: str = ""
    effort: str = ""
    done: bool = False

    @property
    def tick(self) -> str:
        """The character between the brackets of a Markdown task: `x` or a blank."""
        return "x" if self.done else " "


class Listed(Struct, frozen=True):
    """One of the three lists.

    Attributes:
        title: its heading.
        total: its sum in words.
        first: its lines on the first screen.
        hint: how its tasks are done.
        rest: the lines that follow after the first screen.
    """

    title: str
    total: str
    first: tuple[Item, ...]
    hint: str = ""
    rest: tuple[Item, ...] = ()


class FirstScreen(Struct, frozen=True):
    """The contents of the first screen.

    Attributes:
        works: how many calls work, in words.
        needs: what the program needs of its board, in words; empty where it needs nothing that is counted.
        shortages: what the board cannot give.
        decide, write, check: the three lists.
    """

    works: str
    needs: str
    shortages: tuple[str, ...]
    decide: Listed
    write: Listed
    check: Listed


class Counted(Struct, frozen=True):
    """Results about a plan that take long to compute and are shown in several places.

    Attributes:
        needs: what the program needs of its board.
        judged: its constructs with their verdicts.
        calls: how many calls of platform functions are in each state.
    """

    needs: BoardNeeds
    judged: Sequence[Construct]
    calls: dict[str, int]


def counted(plan: migration.MigrationPlan, sources: Mapping[str, bytes]) -> Counted:
    """Compute the results; they are valid until the plan is changed."""
    return Counted(board_needs(plan), constructs(plan, sources), Work(plan).calls)


def first_screen(
    plan: migration.MigrationPlan, sources: Mapping[str, bytes], taken: int = 0, known: Counted | None = None
) -> FirstScreen:
    """The first screen of a plan.

    Args:
        plan: the plan, complete.
        sources: path of a unit -> its bytes.
        taken: number of lines of the first screen that are used otherwise.
        known: the results for the plan, if they are known already.
    """
    work = Work(plan, known.calls if known is not None else None)
    lists = (
        Listed("Decide", decided(work), tuple(_choice(plan, task, sources) for task in work.decide), _decide_hint(plan, work)),
        Listed("Write", written(work), tuple(_bodies(work)), _write_hint(plan, work)),
        Listed("Check on the bench", checked(work), tuple(_checks(work))),
    )
    needs = known.needs if known is not None else board_needs(plan)
    short = tuple(shortages(needs))
    room = _shared([len(each.first) for each in lists], sum(_SHARES) - taken - 2 * bool(short))
    return FirstScreen(
        works(plan, work), needs_in_words(needs), short, *(_cut(each, lines) for each, lines in zip(lists, room, strict=True))
    )


def _shared(wanted: Sequence[int], lines: int) -> list[int]:
    """The number of lines for each list: its share, and what the others leave."""
    given = [min(want, share) for want, share in zip(wanted, _SHARES, strict=True)]
    while sum(given) < min(lines, sum(wanted)):
        hungry = [n for n, want in enumerate(wanted) if given[n] < want]
        given[hungry[0]] += 1
    while sum(given) > lines:
        given[given.index(max(given))] -= 1
    return given


def _cut(whole: Listed, lines: int) -> Listed:
    if len(whole.first) <= lines:
        return whole
    at = max(lines - 1, 0)  # a line says how many follow
    while at and not whole.first[at - 1].rule:
        at -= 1  # nothing stands under a reason that was the last line
    return replace(whole, first=whole.first[:at], rest=whole.first[at:])


# ---- sums in words


def result_in_words(plan: migration.MigrationPlan, screen: FirstScreen, errors: int) -> tuple[str, str]:
    """The state of a migration (needs-you, works or not-verified), and the same in words.

    Args:
        plan: the plan.
        screen: its first screen.
        errors: number of errors among its findings, without the verdict.
    """
    waiting = [task for task in Work(plan).write if not task.done]
    conflicts = sum(task.rule == CONFLICT for task in waiting)
    to_write = len(waiting) - conflicts
    left = [
        (conflicts, "conflict", "to solve"), (len(open_choices(plan)), "choice", "to make"), (to_write, "task", "to write"),
        (errors, "error", "to correct"), (len(screen.shortages), "shortage", "on the board"),
        (_unbound(plan), "call", "of ports without a pin"),
    ]  # fmt: skip
    if needs := [f"{quantity(count, what)} {why}" for count, what, why in left if count]:
        return "needs-you", f"Needs you: {', '.join(needs)}"
    verdict = next((str(finding.rule) for finding in plan.findings if finding.rule in _RESULTS), "")
    return _RESULTS.get(verdict, ("not-verified", "Not verified: not compared with the original yet"))


def _unbound(plan: migration.MigrationPlan) -> int:
    """How many calls of a program whose platform stays do nothing, as no port that they may reach has a pin."""
    return Work(plan).calls[WAITS] if retains_platform(plan) and not open_choices(plan) else 0


_RESULTS = {
    "RS850": ("works", "Works: no difference found between the original and the sketch"),
    "RS851": ("needs-you", "Needs you: the sketch behaves differently from the original"),
    "RS852": ("not-verified", "Not verified: the comparison with the original could not decide"),
    "RS853": ("needs-you", "Needs you: the sketch does not compile"),
}
"""Rule of a verdict -> the state of a migration in which nothing is left to do, and the same in words."""


def works(plan: migration.MigrationPlan, work: Work) -> str:
    """A sentence on how many calls work, and what the others lack."""
    calls = work.calls
    lost = f"{quantity(work.unread, 'call')} in unreadable text not counted"
    if retains_platform(plan):
        count = retained_calls(plan)
        said = f"{count} calls of the platform stay as they are" if count != 1 else "1 call of the platform stays as it is"
        left = sum(not task.done for task in plan.tasks if task.rule == DIFFERS)
        differ = f"{quantity(left, 'place')} behave{'s' * (left == 1)} differently, see Write"
        return "; ".join([said, *[differ] * bool(left), *[lost] * bool(work.unread)])
    if not calls["total"]:
        return lost if work.unread else "the program calls no platform function"
    parts = [
        (calls[WAITS], f"need{'s' * (calls[WAITS] == 1)} a pin"), (calls[TO_WRITE], f"need{'s' * (calls[TO_WRITE] == 1)} a body"),
        (calls[NO_SUPPORT], "not possible on the target"),
    ]  # fmt: skip
    others = [", ".join(f"{count} {said}" for count, said in parts if count)] if any(n for n, _ in parts) else []
    others += [f"{calls[NOT_WIRED_CALL]} not connected by your choice"] * bool(calls[NOT_WIRED_CALL])
    care = (
        f" ({calls[WITH_CARE]} behave{'s' * (calls[WITH_CARE] == 1)} slightly differently, see Known differences)"
        if calls[WITH_CARE]
        else ""
    )
    functions = len(plan.adapterUses)
    some = f"{work.working} of {calls['total']} calls of {quantity(functions, 'platform function')} are ready{care}"
    return "; ".join([some, *others, *[lost] * bool(work.unread)])


def decided(work: Work) -> str:
    """A phrase on how many choices are open."""
    choices, left = work.choices()
    total = len(choices)
    waiting = work.calls[WAITS]
    if not total and not waiting:
        return "no choices"
    if not left:
        made = "no choices" if not total else f"all {total} decided" if total != 1 else "1 decided"
        calls = quantity(waiting, "call")
        return f"{made}; {calls} may reach ports that have no pin: bind them by number (RS326, RS327)" if waiting else made
    return f"{len(left)} of {quantity(total, 'choice')} open"


def written(work: Work) -> str:
    """A phrase on how much is to be written, by effort."""
    if not work.write:
        return "nothing"
    left = [task for task in work.write if not task.done]
    if not left:
        return f"all {len(work.write)} done"
    by: list[str] = []
    for group in work.groups():
        open_ = [task for task in group.tasks if not task.done]
        if group.title:
            by += [f"{len(open_)} of {group.title}, not possible on the target"] * bool(open_)
        else:
            by += [f"{count} {effort}" for effort in EFFORTS if (count := sum(task.effort == effort for task in open_))]
    return f"{len(left)} of {len(work.write)} left: {', '.join(by)}"


def checked(work: Work) -> str:
    """A phrase on how much is to be checked."""
    done = sum(task.done for task in work.check)
    return f"{done} of {len(work.check)} done" if work.check else "no port has a pin yet" if work.decide else "nothing"


# ---- lines


def _decide_hint(plan: migration.MigrationPlan, work: Work) -> str:
    """A hint on where to type answers, for the kinds of choices that are open."""
    ports = any(task.rule == "RS330" for task in work.decide)
    libraries = any(task.rule == "RS401" for task in work.decide)
    said = ["ports under [bind] (or --bind NAME=PIN)"] * ports
    said += ["libraries under [libraries] (or --library COMPONENT=LIBRARY)"] * libraries
    none = "not connected" if not libraries else "no library" if not ports else "not connected or no library"
    drawing = " With a drawing or a pin table (--hardware), RoboSMi proposes pins." * (plan.circuit is None and ports)
    waits = "do nothing" if ignores_unwired(plan) else "change any register: do not run the sketch"
    silent = f" Until a port has a pin, its calls {waits}." * (ports and bool(plan.portFlows))
    typed = f'Write into robosmi.toml next to the program: {" and ".join(said)}; "none" means {none}.'
    return f"{typed} Then migrate again.{silent}{drawing}"


def _write_hint(plan: migration.MigrationPlan, work: Work) -> str:
    """A hint on where to write bodies; empty if there are none."""
    bodies = any(task.rule == "RS501" or (task.rule == "RS502" and "in adapters.h" in task.fix) for task in work.write)
    beside = any("in adapters.h" not in task.fix for task in work.write if task.rule in ("RS501", "RS502"))
    own = f", or in the {called(plan)} for its own declarations" * beside
    unknown = any(isinstance(e, migration.AdapterUse) and e.function is None for task in work.write for e in task.elements)
    given = " If another file defines the function, also give that file to migrate." * unknown
    return f"Find each TODO in adapters.h{own}. Later runs preserve what you write there.{given}" if bodies else ""


def _choice(plan: migration.MigrationPlan, task: migration.PlanTask, sources: Mapping[str, bytes]) -> Item:
    """The line of an open choice."""
    decision = next((e for e in task.elements if isinstance(e, migration.Decision)), None)
    if decision is None:
        return _task(plan, task)
    how = answer(plan, decision)
    more = " or ".join(how.candidates[:_OPTIONS]) + (" ..." if len(how.candidates) > _OPTIONS else "")
    if isinstance(decision, migration.PortBinding):
        what = f", {decision.what}" if decision.what else ""
        place = f", {where}" if (where := task_place(plan, task)) else ""
        source = "" if decision.conventionalPort is not None else _line(decision.element, sources)
        return Item(f"port '{decision.name}'{what}{place}", source, how.line, more, str(task.rule), "", bool(task.done))
    more = f"{more} or none" if more else "none, or the name of a library"
    return Item(f"library for '{how.subject}'", "", how.line, more, str(task.rule), "", bool(task.done))


def _line(element: ccode.Located | None, sources: Mapping[str, bytes]) -> str:
    """The line of the source with an element, without comment, shortened."""
    unit = ancestor_of_kind(element, ccode.SourceUnit) if element is not None else None
    if element is None or unit is None or unit.path not in sources:
        return ""
    lines = sources[unit.path].decode("utf-8", "replace").splitlines()
    text = " ".join(lines[element.line - 1].partition("//")[0].split()) if 0 < element.line <= len(lines) else ""
    return text if len(text) <= _SNIPPET else f"{text[: _SNIPPET - 4].rstrip()} ..."


def _bodies(work: Work) -> Iterable[Item]:
    """The lines of what is to be written; tasks of one cause follow a line that gives it."""
    for group in work.groups():
        if group.title:
            yield Item(f"{group.title} is not possible on the target: {group.reason}")
        for task in group.tasks:
            yield replace(_task(work.plan, task, short=True), effort="") if group.title else _task(work.plan, task)


def _checks(work: Work) -> Iterable[Item]:
    return (_task(work.plan, task) for task in work.check)


def _task(plan: migration.MigrationPlan, task: migration.PlanTask, *, short: bool = False) -> Item:
    """The line of a task; a short one omits the reason, which the line above the group gives."""
    place = f" ({where})" if (where := task_place(plan, task)) else ""
    message = str(task.message).partition(";")[0] if short else str(task.message)
    more = str(task.fix) if task.rule in _SAYS_HOW else ""
    return Item(f"{message}{place}", more=more, rule=str(task.rule), effort=str(task.effort), done=bool(task.done))


_SAYS_HOW = frozenset({"RS503", "RS504", CONFLICT})
"""Rules of tasks that are each done differently, so that their lines say how."""


def task_place(plan: migration.MigrationPlan, task: migration.PlanTask) -> str:
    """The place of a task or finding: its line, with the file's name if there are several files; empty if it has none."""
    path, line = str(task.path), task.line
    if not path or not line:
        return path.rpartition("/")[2]
    alone = plan.program is not None and len(plan.program.units) == 1 and path == plan.program.units[0].path
    return f"line {line}" if alone else f"{path.rpartition('/')[2]}:{line}"


def terminal_lines(
    plan: migration.MigrationPlan, sources: Mapping[str, bytes], sketch: Path, *, made: bool, known: Counted | None = None,
    compiles: bool | None = None,
) -> list[str]:  # fmt: skip
    """The lines of the output.

    Args:
        plan: the plan, complete.
        sources: path of a unit -> its bytes.
        sketch: the folder of the generated program.
        made: whether files were written.
        known: what was counted of the plan as it is; None where nothing was.
        compiles: whether this run has compiled the program with success; None if it has not compiled it.
    """
    board = plan.board.title if plan.board else "the target"
    screen = first_screen(plan, sources, known=known)
    lines = [f"{'generated' if made else 'would generate'} {sketch} for {board}"]
    lines += [_sum("too big", short) for short in screen.shortages]
    if moved := move_lines(plan):
        lines += [_sum("moved", moved[0]), *(f"{_INDENT}{line}" for line in moved[1:])]
    known_build = "" if plan.build is not None else "; not compiled yet"
    lines.append(_sum("works", screen.works + {None: known_build, True: "; compiles", False: "; does not compile"}[compiles]))
    for word, each in (("decide", screen.decide), ("write", screen.write), ("check", screen.check)):
        lines += _list(word, each)
    if screen.needs:
        lines.append(_sum("needs", screen.needs))
    for connection in plan.connections:
        ports = ", ".join(b.name for b in plan.portBindings if b.connection is connection or b.answer is connection)
        pin = connection.pin.label if connection.pin else "?"
        lines.append(f"{_INDENT}{pin:4} {connection.name:28} {('is ' + ports) if ports else ''}".rstrip())
    if plan.libraryChoices:
        included: dict[str, bool] = {}
        for choice in plan.libraryChoices:
            if choice.chosen is not None:
                included[choice.chosen.name] = included.get(choice.chosen.name, False) or choice.included
        named = [name + " (not used, not included)" * (not included[name]) for name in sorted(included)]
        lines.append(f"{_INDENT}libraries: {', '.join(named) or 'none chosen'}")
    return [*lines, f"{_INDENT}see {sketch / 'MIGRATION.md'}"] if made else lines


def _sum(word: str, total: str) -> str:
    return f"{_INDENT}{word:7} {total}"


def _list(word: str, listed: Listed) -> list[str]:
    """A list with its total; of what is to be checked on the bench only the total, since the report lists it."""
    lines = [_sum(word, listed.total)]
    if word == "check":
        return lines
    lines += [f"{_INDENT * 2}{_item(item)}" for item in listed.first]
    if listed.rest:
        lines.append(f"{_INDENT * 2}and {sum(bool(item.rule) for item in listed.rest)} more")
    if listed.hint and listed.first:
        lines.append(f"{_INDENT * 2}{listed.hint}")
    return lines


def _item(item: Item) -> str:
    text = f"{item.text} `{item.source}`" if item.source else item.text
    text = f"{text}: {item.typed}" if item.typed else text
    text = f"{text}, {item.more}" if item.more else text
    return f"{text} [{item.rule}]" if item.rule else text
