"""ETL rules that give each element of the program its disposition: what happens to it (paper 3.1).

Platform-agnostic constructs are retained, platform-dependent ones are adapted or dropped, and `main` is divided. Each rule
states for which elements it holds, what happens to them and why; every element gets exactly one verdict. What a name means is
data of the platforms; how main is divided is a query on the code model (`queries.programs.main_function`).
"""

from __future__ import annotations

from collections.abc import Collection

from msgspec import Struct

from robosmi.metamodels import ccode, migration
from robosmi.model.elements.strict import enum_literal
from robosmi.query import all_of_kind
from robosmi.transform import ETL
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.knowledge.platforms.target_platform import TargetFacts
from robosmi.transformations.m2m.partition.hoisting import BESIDE, HOIST, SPLIT
from robosmi.transformations.queries.own_headers import file_of, own_header
from robosmi.transformations.queries.program_model import ProgramModel
from robosmi.transformations.queries.programs.main_function import Division
from robosmi.transformations.queries.source_text import is_header

Disposition = migration.Disposition
retain, adapt, drop, hoist, rewrite, unsupported = (
    enum_literal(migration.Action, name) for name in ("retain", "adapt", "drop", "hoist", "rewrite", "unsupported")
)
STEP = "code"


class Known(Struct, frozen=True):
    """The facts that the rules use besides the code model.

    Attributes:
        api: the source platform's API.
        target: the target platform.
        divisions: how each definition of main is divided.
        adapted: names with an adapter outside of the program's text.
        placed: names with a placeholder declaration.
        served: headers for which there are adapters.
    """

    api: ApiIndex
    target: TargetFacts
    divisions: Collection[Division]
    adapted: Collection[str]
    placed: Collection[str]
    served: Collection[str] = ()


def decide(d: Disposition, element: ccode.Located, action: migration.Action, rule: str, reason: str) -> None:
    """Fill in a new disposition: the element, what happens to it, by which rule and why."""
    by, choice = migration.ChosenBy.rule, action.name  # all values at once: one after the other takes six times as long
    Disposition.__init__(
        d, element=element, action=action, rules=(rule,), reasons=(reason,), choice=choice, confidence=1.0, chosenBy=by
    )


def dispositions(code: ProgramModel, known: Known) -> ETL:
    """Build the transformation from a program to dispositions; its rule `Rewritten` takes elements that no other matches."""
    t = ETL(code, step=STEP)
    declared = declarations(known.target.preserves_main)
    for module in (includes(known), declared, mains(known.divisions), externals(code.program, known)):
        t.include(module)

    @t.rule(lazy=True, greedy=True)
    def Rewritten(e: ccode.Located, d: Disposition) -> None:
        decide(d, e, rewrite, "", "")

    return t


def includes(known: Known) -> ETL:
    """Rules for includes: whether a header stays, is dropped or is missing on the target."""
    t = ETL()

    def means(include: ccode.Include) -> str:
        kind = known.api.header_kind(include.header)
        if own_header(include):
            return "own"
        if kind is None and include.header in known.served:
            return "served"
        if kind not in ("platform", "standard", "posix"):
            return "unknown"
        if kind == "platform":
            return "platform"
        if kind == "posix" or include.header not in known.target.standard_headers:
            served = any(header in known.served for header in known.api.closure([include.header]))
            return "platform" if served else "missing"
        return "in header" if is_header(file_of(include)) else "conditional" if conditional(include) else "there"

    @t.rule(guard=lambda i: bool(own_header(i)))
    def OwnHeader(i: ccode.Include, d: Disposition) -> None:
        decide(d, i, retain, "own-header", "the program's own header, copied with it")

    @t.rule(guard=lambda i: means(i) == "platform")
    def PlatformInclude(i: ccode.Include, d: Disposition) -> None:
        decide(d, i, drop, "platform-include", "the header belongs to the source platform")

    @t.rule(guard=lambda i: means(i) == "served")
    def ServedInclude(i: ccode.Include, d: Disposition) -> None:
        decide(d, i, drop, "platform-include", "adapters replace the header's functions")

    @t.rule(guard=lambda i: means(i) == "missing")
    def MissingInclude(i: ccode.Include, d: Disposition) -> None:
        decide(d, i, unsupported, "posix-include", "the target has no such header")

    @t.rule(guard=lambda i: means(i) == "unknown")
    def UnknownInclude(i: ccode.Include, d: Disposition) -> None:
        decide(d, i, unsupported, "unknown-include", "the header is unknown")

    @t.rule(guard=lambda i: means(i) == "in header")
    def StandardIncludeInHeader(i: ccode.Include, d: Disposition) -> None:
        decide(d, i, retain, "standard-include-in-place", "a standard header that the target has")

    @t.rule(guard=lambda i: means(i) == "conditional")
    def ConditionalInclude(i: ccode.Include, d: Disposition) -> None:
        decide(d, i, retain, "conditional-include", "a standard header under a condition, which stays in place")

    @t.rule(guard=lambda i: means(i) == "there")
    def StandardInclude(i: ccode.Include, d: Disposition) -> None:
        decide(d, i, retain, "standard-include", "a standard header that the target has")

    return t


def conditional(include: ccode.Include) -> bool:
    """Whether an include is inside a preprocessor condition."""
    depth = 0
    for directive in file_of(include).conditionals:
        if directive.startOffset > include.startOffset:
            break
        depth += directive.directive in ("if", "ifdef", "ifndef")
        depth -= directive.directive == "endif"
    return depth > 0


def at_top(element: ccode.Located) -> bool:
    """Whether an element is directly at file scope."""
    return isinstance(element.eContainer(), ccode.SourceUnit)


def declarations(keeps_main: bool) -> ETL:
    """Rules for macros and declarations at file scope.

    Args:
        keeps_main: whether main is a function like any other on the target.
    """
    t = ETL()

    @t.rule
    def OwnMacro(m: ccode.Macro, d: Disposition) -> None:
        decide(d, m, retain, "own-macro", "the program's own macro")

    @t.rule(guard=lambda f: at_top(f) and f.definition and (keeps_main or f.name != "main"))
    def OwnFunction(f: ccode.Function, d: Disposition) -> None:
        decide(d, f, retain, "own-function", "the program's own function")

    @t.rule(guard=lambda f: at_top(f) and not f.definition and (keeps_main or f.name != "main"))
    def OwnPrototype(f: ccode.Function, d: Disposition) -> None:
        decide(d, f, retain, "own-prototype", "the program's own prototype")

    @t.rule(guard=lambda f: at_top(f) and not f.definition and not keeps_main and f.name == "main")
    def MainPrototype(f: ccode.Function, d: Disposition) -> None:
        decide(d, f, drop, "main-prototype", "the sketch has no main")

    @t.rule(greedy=True, guard=lambda x: at_top(x) and not isinstance(x, ccode.Function))
    def OwnDeclaration(x: ccode.Declaration, d: Disposition) -> None:
        decide(d, x, retain, "own-declaration", "the program's own declaration")

    return t


def mains(divisions: Collection[Division]) -> ETL:
    """Rules for main: the function itself, its statements, what is dropped from it and what moves out of it."""
    t = ETL()
    reasons = {v.main: v.reason for v in divisions}
    leaving = {s for v in divisions for s in (*v.returns, *v.continues, *v.breaks)}
    ends = {s: v.end_name for v in divisions for s in v.returns}
    ways = {s: v.after_name or v.end_name for v in divisions for s in v.breaks}
    moved = {m.statement for v in divisions for m in v.moved}
    first = {m.variables[0]: m for v in divisions for m in v.moved}
    others = {x: m.variables[0] for v in divisions for m in v.moved for x in m.variables[1:]}
    once = {s for v in divisions for s in v.before} - leaving - moved
    loops = {v.loop for v in divisions}
    repeated = {s for v in divisions for s in statements_of(v.loop)} - leaving
    direct = {s: v.after_name for v in divisions for s in v.after}
    unreachable = {s for v in divisions for s in v.unreachable}

    @t.rule(guard=lambda f: f in reasons)
    def Main(f: ccode.Function, d: Disposition) -> None:
        decide(d, f, rewrite, "main", reasons[f])

    @t.rule(greedy=True, guard=lambda s: s in once)
    def MainOnce(s: ccode.Statement, d: Disposition) -> None:
        decide(d, s, retain, "main-once", "runs once, in setup")

    @t.rule(guard=lambda v: v in first and not first[v].assigned)
    def HoistedLocal(v: ccode.Variable, d: Disposition) -> None:
        decide(d, v, hoist, HOIST, "declared before the loop and used in it")

    @t.rule(guard=lambda v: v in first and bool(first[v].assigned))
    def SplitLocal(v: ccode.Variable, d: Disposition) -> None:
        decide(d, v, hoist, SPLIT, "declared before the loop and used in it")

    @t.rule(guard=lambda v: v in others)
    def LocalBeside(v: ccode.Variable, d: Disposition) -> None:
        decide(d, v, hoist, BESIDE, f"declared together with '{others[v].name}', which the loop needs")

    @t.rule(greedy=True, guard=lambda s: s in loops)
    def MainLoop(s: ccode.Loop, d: Disposition) -> None:
        decide(d, s, rewrite, "main-loop", "loop repeats its body")

    @t.rule(greedy=True, guard=lambda s: s in repeated)
    def MainRepeated(s: ccode.Statement, d: Disposition) -> None:
        decide(d, s, retain, "main-repeated", "loop repeats it")
        d.inLoop = True

    @t.rule(greedy=True, guard=lambda s: s in direct and s not in leaving)
    def MainAfter(s: ccode.Statement, d: Disposition) -> None:
        decide(d, s, retain, "main-after", f"runs once the loop is left, in {direct[s]}")
        d.runsIn = direct[s]

    @t.rule(greedy=True, guard=lambda s: s in unreachable)
    def Unreachable(s: ccode.Statement, d: Disposition) -> None:
        decide(d, s, drop, "unreachable", "unreachable after the endless loop")

    @t.rule(guard=lambda s: s in ends and not ends[s])
    def ReturnFromSetup(s: ccode.Return, d: Disposition) -> None:
        called = s.value is not None and all_of_kind(s.value, ccode.Call)
        decide(d, s, rewrite, "return-value-from-setup" if called else "return-from-setup", "setup returns no value")

    @t.rule(guard=lambda s: bool(ends.get(s)))
    def EndOfMain(s: ccode.Return, d: Disposition) -> None:
        called = s.value is not None and all_of_kind(s.value, ccode.Call)
        decide(d, s, rewrite, "value-and-end-of-main" if called else "end-of-main", "main ends here, so loop is empty")
        d.goesOnIn, d.runsIn = ends[s], direct.get(s, "")

    @t.rule(guard=lambda s: s in ways)
    def LeaveMainLoop(s: ccode.Break, d: Disposition) -> None:
        decide(d, s, rewrite, "leave-main-loop", "the loop ends here, and the code after it runs once")
        d.goesOnIn = ways[s]

    @t.rule(guard=lambda s: s in leaving)
    def ContinueMainLoop(s: ccode.Continue, d: Disposition) -> None:
        decide(d, s, rewrite, "continue-main-loop", "the loop is now a function")

    return t


def statements_of(loop: ccode.Loop | None) -> list[ccode.Statement]:
    """The statements of a loop's body."""
    body = loop.body if loop is not None else None
    return list(body.statements) if isinstance(body, ccode.Block) else [body] if body is not None else []


def externals(program: ccode.Program, known: Known) -> ETL:
    """Rules for names that the program uses and does not declare: adapted, given a placeholder, or available on the target."""
    t = ETL()
    own = {m.name for u in program.units for m in u.macros} | {d.name for u in program.units for d in u.declarations}

    def means(x: ccode.Declaration) -> str:
        if x.eContainer() is not program:
            return ""
        if x.name in known.adapted:
            return "function"
        return "symbol" if x.name in known.placed else "own" if x.name in own else "target"

    @t.rule(greedy=True, guard=lambda x: means(x) == "function")
    def PlatformFunction(x: ccode.Declaration, d: Disposition) -> None:
        decide(d, x, adapt, "platform-function", "an adapter with its signature replaces it")

    @t.rule(greedy=True, guard=lambda x: means(x) == "symbol")
    def PlatformSymbol(x: ccode.Declaration, d: Disposition) -> None:
        decide(d, x, adapt, "platform-symbol", "a placeholder replaces it")

    @t.rule(greedy=True, guard=lambda x: means(x) == "own")
    def OwnName(x: ccode.Declaration, d: Disposition) -> None:
        decide(d, x, retain, "own-name", "another file of the program defines it")

    @t.rule(greedy=True, guard=lambda x: means(x) == "target")
    def TargetName(x: ccode.Declaration, d: Disposition) -> None:
        decide(d, x, retain, "target-name", "the target has it")

    return t
