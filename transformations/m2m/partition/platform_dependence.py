"""Platform dependence: what happens to each element of the program (paper 3.1), and which names need an adapter (3.4).

Platform-agnostic constructs are retained, platform-dependent ones are adapted or dropped, and `main` is divided. Every element
gets a disposition with the rule that decided and the reason. What a name means is data of the platforms; no rule knows a
function by its name. A name that adapter pieces and their libraries declare at file scope cannot be declared by the program
too.

Code that a program starts on other cores runs on a target with one core as coroutines (`_concurrency`). A program that starts
no such code, or only through functions without an adapter, has no such decision. The only changes of its text are calls of
`yield` where it would otherwise starve the other coroutines: in loops, at backward jumps, in macros that are loops. Which loops
have to yield, and how much stack is needed, is computed by `queries.resources.cooperation`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set as AbstractSet
from typing import TypeVar

from robosmi.diagnostics import Finding
from robosmi.errors import RobosmiError
from robosmi.metamodels import ccode, migration, platform
from robosmi.query import ancestor_of_kind
from robosmi.transform import ETL, Trace
from robosmi.transformations.knowledge.api_facts import COMPILER
from robosmi.transformations.knowledge.lexer import KEYWORDS, closing, tokens
from robosmi.transformations.knowledge.libraries.library_ranking import library_api
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.knowledge.platforms.platform_model import platform_part
from robosmi.transformations.knowledge.platforms.target_names import TargetNames
from robosmi.transformations.knowledge.platforms.target_platform import CPLUSPLUS, TargetFacts
from robosmi.transformations.m2m.adapters.adapter_choice import HELPERS, TYPES, VALUES, AdapterChoice, UnservedHeader, serve
from robosmi.transformations.m2m.adapters.adapter_uses import (
    adapter,
    called_functions,
    declared_in_lists,
    handed_on,
    hide_types,
    own_prototypes,
    own_types,
)
from robosmi.transformations.m2m.adapters.placeholders import (
    expected_types,
    implied_headers,
    size_names,
    standard_values,
    symbol_use,
    type_uses,
    used_symbols,
)
from robosmi.transformations.m2m.language.decided_conditions import decided_conditions
from robosmi.transformations.m2m.language.language_gap import TEXT_RULES as LANGUAGE_RULES, changes
from robosmi.transformations.m2m.language.source_assembler import LEFT_OUT
from robosmi.transformations.m2m.partition.dispositions import STEP, Known, dispositions
from robosmi.transformations.m2m.partition.hoisting import hoist
from robosmi.transformations.m2m.partition.renaming import RENAME, RENAME_HERE, hidden_adapters, renamings
from robosmi.transformations.m2m.partition.text_changes import change_texts
from robosmi.transformations.queries.adapter_signature import target_signature, target_types
from robosmi.transformations.queries.block_braces import inside
from robosmi.transformations.queries.code import CodeView, CogStart, cogs_of
from robosmi.transformations.queries.expression_type import FunctionType
from robosmi.transformations.queries.plans.plan_adapters import closure
from robosmi.transformations.queries.program_model import ProgramModel
from robosmi.transformations.queries.programs.live_code import live_in
from robosmi.transformations.queries.programs.main_function import Division, divide, main_of
from robosmi.transformations.queries.resources.cooperation import (
    Waiting,
    gives_way,
    giving_way,
    loops_of,
    main_loop,
    stack_bytes,
    starts_at_once,
)
from robosmi.transformations.queries.resources.stack_depth import CORE_INTERRUPT, IDLE, interrupt_bytes, measured_stacks
from robosmi.transformations.queries.source_text import SourceText, is_header, words_of

T = TypeVar("T")
_WORD = re.compile(r"\b[A-Za-z_]\w*")
rewrite, OWN = migration.Action.rewrite, migration.SignatureSource.program
TEXT_RULES = LANGUAGE_RULES | {RENAME, RENAME_HERE}
"""Rules that each change a small part of an element's text, so that several of them can apply to one element."""

_SPARE = 1.25
"""Safety factor on the estimated stack size of a coroutine."""
_ENDS = re.compile(r"_end\b|stop\b|join\b|exit\b")


class Dependence:
    """The result of the partition, which becomes part of the plan.

    Attributes:
        dispositions: one for each element of the program.
        adapters: the platform functions that are used.
        symbols: other platform names that are used.
        pieces: the pieces of adapter text that these refer to and those they need, in order of dependency.
        helpers: pieces that only the changed text of the program calls.
        unserved: headers whose contents the target cannot provide.
        source: the part of the source platform that is used.
        divisions: how main is divided.
        concurrency: how code runs that the program starts on other cores; None if it starts none.
        findings: about the user's own adapters.
    """

    def __init__(self) -> None:
        self.dispositions: list[migration.Disposition] = []
        self.adapters: list[migration.AdapterUse] = []
        self.symbols: list[migration.SymbolUse] = []
        self.pieces: list[platform.Adapter] = []
        self.helpers: list[platform.Adapter] = []
        self.unserved: list[UnservedHeader] = []
        self.source: platform.Platform | None = None
        self.divisions: list[Division] = []
        self.concurrency: migration.Concurrency | None = None
        self.findings: list[Finding] = []


def partition(
    views: Sequence[CodeView],
    target: TargetFacts,
    choice: AdapterChoice,
    sources: Mapping[str, bytes],
    trace: Trace,
    look_up: Sequence[str] = (),
) -> Dependence:
    """Decide what happens to each element of the program.

    Args:
        views: a view of each unit of the program.
        target: the target platform.
        choice: the available adapters.
        sources: path of a unit -> its bytes.
        trace: where links from sources to decisions are recorded.
        look_up: (header and name) of the pieces by which calls in the changed text look up ports.
    """
    result = Dependence()
    program, api = views[0].program, views[0].api
    names = target.names
    called = called_functions(views, target, names, choice.adapts)
    used = used_symbols(views, called, target, names)
    used |= {
        name: uses for name, header, uses in standard_values(views, target) if choice.declare(name, header, VALUES) is not None
    }
    includes = [i.header for u in program.units for i in u.includes]
    words = words_of(sources[u.path] for u in program.units)
    result.source = platform_part(api, [*called, *used], includes, words, [v.includes for v in views])
    functions_there = {(h.name, f.name): f for h in result.source.headers for f in h.functions}
    known = _resolved(functions_there, api, called, includes)
    prototypes = own_prototypes(views)
    values = handed_on(views)
    own = own_types(program)
    result.adapters = [
        adapter(c, known.get(name), prototypes.get(name), api.name, target, names, own, handed=name in values)
        for name, c in called.items()
    ]
    for each in result.adapters:
        hide_types(each)
    serve(result.adapters, {name: c.header for name, c in called.items()}, choice, values)
    functions = {a.name: target_types(a) for a in result.adapters}
    result.symbols = _symbols(result, views, used, functions, sources, api, target, names, choice)
    for wanted in look_up:
        header, _, name = wanted.partition("/")
        if (piece := choice.declare(name, header, HELPERS)) is not None:
            result.helpers.append(piece)
    result.pieces, result.unserved = choice.elements, choice.unserved
    shared = _beside_adapters(names, views, result, target.libraries)
    reserved = shared.declared | shared.macros | shared.keywords | _standard_names(views, target, result.symbols)
    mains = [] if target.preserves_main else [main for unit in program.units if (main := main_of(unit)) is not None]
    result.divisions = [divide(main, reserved, words) for main in mains]
    if not target.model.platform or not target.model.platform.hasCogs:
        plain = [SourceText(view.unit, sources[view.unit.path], ()) for view in views]
        result.concurrency = _concurrency(views, result.adapters, result.divisions, plain)
    apart = {a.name for a in result.adapters if a.signatureSource is not OWN}
    code = ProgramModel(views)
    judged = dispositions(
        code, Known(api, target, result.divisions, apart, {s.name for s in result.symbols}, choice.index.headers)
    )
    judged.run()
    result.dispositions = [d for element in code.all_contents() for d in judged.trace.equivalents(element, migration.Disposition)]
    _change_unit_texts(views, sources, functions, prototypes, shared, result, judged, target.language == CPLUSPLUS)
    trace.take(judged.trace)
    for made in result.adapters:
        trace.link("adapter", STEP, [*made.calls, made.function], [made])
    if result.concurrency is not None:
        trace.link("concurrency", STEP, [*result.concurrency.starts, *result.concurrency.functions], [result.concurrency])
    for use in result.symbols:
        trace.link("placeholder", STEP, [*use.uses, use.symbol], [use])
    return result


def _resolved(
    declared: Mapping[tuple[str, str], T], api: ApiIndex, names: Iterable[str], includes: Sequence[str]
) -> dict[str, T]:
    """Resolve names with all of the program's includes: for each name the declared element with its header and name."""
    entries = ((name, api.resolve(name, includes)) for name in names)
    keys = {name: (entry.header or COMPILER, name) for name, entry in entries if entry is not None}
    return {name: declared[key] for name, key in keys.items() if key in declared}


def _symbols(
    result: Dependence,
    views: Sequence[CodeView],
    used: Mapping[str, list[ccode.NameReference]],
    functions: Mapping[str, FunctionType],
    sources: Mapping[str, bytes],
    api: ApiIndex,
    target: TargetFacts,
    names: TargetNames,
    choice: AdapterChoice,
) -> list[migration.SymbolUse]:
    """The declarations of names other than functions, by adapter pieces or placeholders: first headers, then types, then
    values.
    """
    assert result.source is not None
    there = {(h.name, s.name): s for h in result.source.headers for s in h.symbols}
    known = _resolved(there, api, used, [i.header for v in views for i in v.unit.includes])
    wanted = expected_types(views, functions)
    attributes = set(api.settings["parser"].get("attribute_macros", []))
    several = sum(not is_header(v.unit) for v in views) > 1
    sizes = size_names(views)
    values = []
    for place, (name, uses) in enumerate(used.items()):
        number = 3 * place + 1  # so that what a switch adds to a constant is no other one
        symbol = known.get(name)
        header = ancestor_of_kind(symbol, platform.Header) if symbol is not None else None
        if (piece := choice.declare(name, header.name if header is not None else "", VALUES)) is not None:
            if symbol is not None:
                piece.symbols.append(symbol)
            filled = migration.AdapterStatus.filled
            values.append(migration.SymbolUse(name=name, status=filled, symbol=symbol, adapter=piece, uses=uses))
            continue
        attribute = name in attributes or (symbol is None and not uses and name not in sizes)
        values.append(
            symbol_use(name, uses, symbol, number, attribute, wanted.get(name, ""), api.name, target, names, several=several)
        )
    written = [
        p
        for a in result.adapters
        if a.signatureSource is not OWN and a.adapter is None
        for p in (functions[a.name].returns, *functions[a.name].parameters)
    ]
    placed = {v.name for v in values if v.adapter is None}
    written += [known[n].typeName for n in used if n in placed and n in known and known[n].typeName]
    types = type_uses(views, sources, written, target, names, lambda name, header: choice.declare(name, header, TYPES))
    headers = implied_headers(views, target, names)
    done = {t.placeholder for t in types}
    return [*(h for h in headers if h.placeholder not in done), *types, *values]


def _standard_names(views: Sequence[CodeView], target: TargetFacts, symbols: Iterable[migration.SymbolUse]) -> frozenset[str]:
    """The program's variables whose names are also declared by standard headers that the sketch includes."""
    there = {str(include.header) for view in views for include in view.unit.includes} | {str(use.name) for use in symbols}
    there &= set(target.standard_headers)
    own = {str(d.name) for view in views for d in view.of_kind(ccode.Variable)} if there else set()
    return frozenset(name for name in own if any(entry.header in there for entry in views[0].api.entries(name)))


def _beside_adapters(names: TargetNames, views: Sequence[CodeView], result: Dependence, index: str) -> TargetNames:
    """The target's names extended by those of the adapters and their libraries, which the program's names must not clash with.

    A function that the program declares and an adapter defines counts as the adapter's. A name that only the changed text calls
    must not be hidden by a local either.
    """
    served = {str(use.name) for use in result.adapters if use.adapter is not None}
    own = {str(d.name) for view in views for d in view.of_kind(ccode.Declaration)}
    own |= {str(macro.name) for view in views for macro in view.unit.macros}
    own -= served | {""}
    declared, macros = declared_names(result.pieces, own)
    declared |= library_names(result.pieces, index, own)
    within = {word for piece in result.pieces for statement in piece.setup for word in _WORD.findall(str(statement))}
    return names.extended(declared, macros | {str(helper.name) for helper in result.helpers}, frozenset(within))


def _change_unit_texts(
    views: Sequence[CodeView],
    sources: Mapping[str, bytes],
    functions: Mapping[str, FunctionType],
    prototypes: Mapping[str, ccode.Function],
    names: TargetNames,
    result: Dependence,
    judged: ETL,
    cplusplus: bool,
) -> None:
    """Add dispositions for what the target's names and language require, and set the text changes of all dispositions.

    An element keeps a single disposition, which may combine several rules.
    """

    wanted: dict[migration.Disposition, list[tuple[str, str, str]]] = {}

    def change(element: ccode.Located, rule: str, word: str, reason: str) -> None:
        old = next(iter(judged.trace.equivalents(element, migration.Disposition)), None)
        if old is not None and old.action is rewrite and (TEXT_RULES - {rule}).issuperset(old.rules):
            old.rules.append(rule)
            old.reasons.append(reason)
            wanted[old].append((rule, word, reason))
            return
        if old is not None and old.action is not migration.Action.retain:
            return  # it does not stay as it is anyway
        made = old if old is not None else judged.equivalent(element, "Rewritten", kind=migration.Disposition)
        assert made is not None
        made.action, made.choice = rewrite, rewrite.name
        made.rules[:], made.reasons[:] = [rule], [reason]
        wanted[made] = [(rule, word, reason)]
        if old is None:
            result.dispositions.append(made)

    renamed = {r.name: r for r in renamings(views, sources, names)}
    for renaming in renamed.values():
        change(renaming.element, RENAME, renaming.new, renaming.reason)
    for renaming in hidden_adapters(views, sources, names, {str(a.name) for a in result.adapters if a.adapter is not None}):
        change(renaming.element, RENAME_HERE, renaming.new, renaming.reason)
    adapted = {a.name for a in result.adapters if a.signatureSource is OWN and a.adapter is None}
    served = {a.name for a in result.adapters if a.signatureSource is OWN and a.adapter is not None}
    for view in views if served else ():
        for declared in view.of_kind(ccode.Function):
            if declared.name in served and not declared.definition:
                change(declared, "adapter-declared", declared.name, "the adapter of that name is declared with the others")
                verdict = judged.trace.equivalents(declared, migration.Disposition)[0]
                verdict.action, verdict.choice = migration.Action.drop, migration.Action.drop.name
    in_lists = declared_in_lists(views)
    for name, prototype in prototypes.items():
        if name in adapted:
            word = target_signature(next(a for a in result.adapters if a.name == name)) if id(prototype) in in_lists else ""
            reason = "the program declares it, but no file defines it: write its body here"
            change(prototype, "adapter-in-place", word, reason)
            verdict = judged.trace.equivalents(prototype, migration.Disposition)[0]
            verdict.action, verdict.choice = migration.Action.adapt, migration.Action.adapt.name
    for condition in decided_conditions(views, sources, names):
        change(condition.element, condition.rule, condition.text, condition.reason)
    for view in views:
        for found in changes(view, sources[view.unit.path], functions, cplusplus=cplusplus):
            text = _WORD.sub(lambda word: renamed[word[0]].new if word[0] in renamed else word[0], found.text)
            change(found.element, found.rule, text, found.reason)
            if found.rule != LEFT_OUT:
                continue
            verdict = judged.trace.equivalents(found.element, migration.Disposition)[0]
            if verdict.rules[:] == [LEFT_OUT]:
                verdict.action, verdict.choice = migration.Action.unsupported, migration.Action.unsupported.name
    texts = [SourceText(view.unit, sources[view.unit.path], ()) for view in views]
    for disposition in result.dispositions:
        rules = zip(disposition.rules, disposition.reasons, strict=True)
        word = disposition.goesOnIn
        change_texts(disposition, wanted.get(disposition) or [(rule, word, reason) for rule, reason in rules], texts)
    verdicts = {d.element: d for d in result.dispositions if isinstance(d.element, ccode.Variable)}
    for division in result.divisions:
        own = next(text for text in texts if text.unit is ancestor_of_kind(division.main, ccode.SourceUnit))
        for moved in division.moved:
            hoist(moved, verdicts, own)


# ---- names that adapters declare

_WORDS = re.compile(r"[A-Za-z_]\w*")
_DEFINED = re.compile(r"#\s*define\s+([A-Za-z_]\w*)")
_OPENING, _CLOSING = frozenset("([{"), frozenset(")]}")


def declared_names(pieces: Iterable[platform.Adapter], among: AbstractSet[str]) -> tuple[frozenset[str], frozenset[str]]:
    """The names of `among` that pieces declare at file scope, and those that they define as macros.

    Args:
        pieces: the pieces.
        among: the names in question, such as a program's; texts without any of them are skipped.
    """
    declared: set[str] = set()
    macros: set[str] = set()
    for piece in pieces:
        declared.update(str(port.constant) for port in piece.ports)
        declared.update(str(table.name) for table in piece.tables)
        text = str(piece.text)
        if among.isdisjoint(_WORDS.findall(text)):
            continue
        depth = 0
        for kind, _, _, word in tokens(text.encode()):
            if kind == "directive" and (found := _DEFINED.match(word)) is not None:
                macros.add(found[1])
            elif kind == "name" and depth == 0 and word not in KEYWORDS:
                declared.add(word)
            elif kind == "punct":
                depth += (word in _OPENING) - (word in _CLOSING)
    return frozenset(declared & among), frozenset(macros & among)


def library_names(pieces: Iterable[platform.Adapter], index: str, among: AbstractSet[str]) -> frozenset[str]:
    """The names of `among` that the libraries which pieces include declare.

    Args:
        pieces: the pieces.
        index: the platform whose index of libraries the target uses, empty for none.
        among: the names in question, such as a program's.
    """
    found: set[str] = set()
    for library in sorted({str(name) for piece in pieces for name in piece.libraries}) if index else ():
        try:
            api = library_api(library, index)
        except RobosmiError:
            continue  # a library that comes with the target's tools, which the index does not have
        for header in api.headers:
            found |= {each.name.rpartition("::")[2] for each in header.classes}
            found |= {each.name.rpartition("::")[2] for each in header.functions}
            found |= {*header.constants, *header.enums, *(name for names in header.enums.values() for name in names)}
    return frozenset(found & among)


def _concurrency(
    views: Sequence[CodeView],
    uses: Sequence[migration.AdapterUse],
    divisions: Sequence[Division],
    texts: Sequence[SourceText],
) -> migration.Concurrency | None:
    """The decision how code started on other cores runs; None if the program starts none that an adapter supports.

    Args:
        views: a view of each unit.
        uses: the adapters of the plan.
        divisions: how each main is divided.
        texts: the text of each unit.
    """
    filled = {str(use.name): closure([use.adapter]) for use in uses if use.adapter is not None}
    starts = [s for view in views for s in cogs_of(view) if any(p.name == _YIELD for p in filled.get(s.via, ()))]
    if not starts:
        return None
    functions = _functions(views, starts)
    waiting = Waiting(giving_way(views, uses))
    stacks = measured_stacks(filled.items())
    handled = interrupt_bytes([p for pieces in filled.values() for p in pieces]) - CORE_INTERRUPT  # which is in IDLE
    needs = [(f, IDLE + stack_bytes(f, stacks)) for f in functions]
    most = max((need for _, need in needs), default=2 * IDLE)
    live = {id(each) for each in live_in([view.unit for view in views])}
    slots, why = starts_at_once([s.call for s in starts if id(s.call) in live], {name for name in filled if _ENDS.search(name)})
    made = migration.Concurrency(
        slots=slots,
        stackBytes=-int((-most * _SPARE - handled) // 8) * 8,
        starts=[s.call for s in starts],
        functions=functions,
        choice="coroutines",
        chosenBy=migration.ChosenBy.rule,
        confidence=1.0,
        evidence=[
            *why,
            *(f"'{f.name}' needs about {need} bytes of stack" for f, need in needs),
            *([f"interrupts use up to {handled} bytes of each stack"] if handled else []),
        ],
    )
    divided = {id(d.loop) for d in divisions if d.loop is not None}
    for view, text in zip(views, texts, strict=True):
        made.changes.extend(_yields(view, text, waiting, divided))
    made.loopGivesWay = any(
        gives_way(each, waiting) for view in views if (each := main_loop(view)) is not None and id(each) in divided
    )
    return made


def _functions(views: Sequence[CodeView], starts: Sequence[CogStart]) -> list[ccode.Function]:
    """The program's functions that are started on other cores, without duplicates."""
    own = {str(d.name): d for v in views for d in v.unit.declarations if isinstance(d, ccode.Function) and d.definition}
    return [own[name] for name in dict.fromkeys(s.function for s in starts) if name in own]


# ---- calls of `yield`

_GIVE_WAY = "give-way"
"""Rule of text changes: a loop yields to the other coroutines."""
_YIELD = "yield"
"""The target's function that yields to the other coroutines, and the adapter piece that switches between them."""
_REASON = "the others continue only when this loop waits"
_HEAD = re.compile(rb"[ \t]*#[ \t]*define[ \t]+\w+(?:\([^)]*\))?")


def _yields(view: CodeView, text: SourceText, waiting: Waiting, divided: set[int]) -> Iterator[migration.TextChange]:
    """The changes that make those loops of a unit yield that may otherwise starve the other coroutines.

    Args:
        view: the unit.
        text: its text.
        waiting: which statements certainly wait, and so yield.
        divided: `id()` of loops that became functions, which are called repeatedly.
    """
    macros: dict[int, ccode.Macro] = {}
    for loop in loops_of(view):
        if id(loop) in divided or gives_way(loop, waiting):
            continue
        use = _use_around(loop, view)
        if use is None or _stands_behind(loop, use):
            yield from _in_loop(loop, text)
        elif use.macro is not None and use.macro in view.unit.macros:
            macros[id(use.macro)] = use.macro
    for macro in macros.values():
        yield from _in_macro(macro, text)
    for goto in view.of_kind(ccode.Goto):
        if _use_around(goto, view) is None and _goes_back(goto, view, waiting):
            start, end = int(goto.startOffset), text.statement_end(goto)
            yield from (_change(text, start, start, f"{{ {_YIELD}(); "), _change(text, end, end, " }"))


def _use_around(element: ccode.Located, view: CodeView) -> ccode.MacroUse | None:
    """The macro use that an element begins in, so that its text is in the macro; None if it is in the unit's text."""
    uses = (use for use in view.unit.macroUses if use.startOffset <= element.startOffset < use.endOffset)
    return next(uses, None)


def _stands_behind(loop: ccode.Loop, use: ccode.MacroUse) -> bool:
    """Whether only the head of a loop comes from the macro and its body is in the text (`FOR_EVER { ... }`, `UNTIL(x);`)."""
    return loop.body is not None and loop.body.startOffset >= use.endOffset


def _goes_back(goto: ccode.Goto, view: CodeView, waiting: Waiting) -> bool:
    """Whether a goto jumps backwards over statements none of which certainly waits."""
    function = ancestor_of_kind(goto, ccode.Function)
    labels = (each for each in view.of_kind(ccode.Label) if each.name == goto.labelName)
    label = next((each for each in labels if ancestor_of_kind(each, ccode.Function) is function), None)
    if label is None or label.startOffset > goto.startOffset:
        return False
    block = ancestor_of_kind(label, ccode.Block)
    between = (
        (s for s in block.statements if label.startOffset <= s.startOffset and s.endOffset <= goto.startOffset) if block else ()
    )
    return not any(waiting.waits(s.statement if isinstance(s, ccode.Label) else s) for s in between)


def _in_loop(loop: ccode.Loop, text: SourceText) -> list[migration.TextChange]:
    """The shortest change that makes a loop yield in each iteration."""
    body = loop.body
    if isinstance(body, ccode.Block):
        start = inside(text.data, body)[0]
        return [_change(text, start, start, f" {_YIELD}();")]
    if body is None or isinstance(body, ccode.EmptyStatement):
        end = text.data.find(b";", int(body.startOffset) if body is not None else int(loop.endOffset))
        return [_change(text, end, end + 1, f" {_YIELD}();")] if end >= 0 else []
    start, end = int(body.startOffset), text.statement_end(body)
    return [_change(text, start, start, f"{{ {_YIELD}(); "), _change(text, end, end, " }")]


def _in_macro(macro: ccode.Macro, text: SourceText) -> Iterator[migration.TextChange]:
    """The same for loops in a macro's definition: `while (x);`, `for (;;) { ... }`, `do { ... } while (x)`."""
    head = _HEAD.match(text.data, int(macro.startOffset), int(macro.endOffset))
    first = head.end() if head is not None else text.data.find(str(macro.name).encode(), int(macro.startOffset)) + len(macro.name)
    words = [t for t in tokens(text.data[first : macro.endOffset]) if t[0] != "comment" and t[3] != "\\"]
    opened: list[bool] = []  # of each brace that is open: whether it is the body of a do
    at, tail = 0, False
    while at < len(words):
        word = words[at][3]
        if word == "{":
            opened.append(at > 0 and words[at - 1][3] == "do")
            if opened[-1]:
                place = first + words[at][2]
                yield _change(text, place, place, f" {_YIELD}();")
        elif word == "}":
            tail = bool(opened and opened.pop())
        elif word in ("while", "for") and not tail:
            close = closing(words, at + 1)
            if close == len(words):
                return
            following = words[close + 1] if close + 1 < len(words) else None
            if following is not None and following[3] in ("{", ";"):
                block = following[3] == "{"
                place = first + (following[2] if block else following[1])
                yield _change(text, place, place, f" {_YIELD}()" + ";" * block)
        else:
            tail = False
        at += 1


def _change(text: SourceText, start: int, end: int, new: str) -> migration.TextChange:
    return migration.TextChange(
        unit=text.unit,
        startOffset=start,
        endOffset=end,
        replacement=new,
        rule=_GIVE_WAY,
        reason=_REASON,
        step=migration.Step.code,
    )
