"""Platform dependence: what happens to each element of the program (paper 3.1), and which names need an adapter (3.4).

Platform-agnostic constructs are retained, platform-dependent ones are adapted or dropped, `main` is divided. Each gets
a disposition with the rule that decided and the reason; nothing is left without one. What a name means is data of the
platforms; no rule knows a function by its name.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from robosmi.metamodels import ccode, migration, platform
from robosmi.query import all_of_kind
from robosmi.transform import Trace
from robosmi.transformations.m2m.adapter_uses import adapter, called_functions, handed_on, own_prototypes
from robosmi.transformations.m2m.edit_rules import AND, joined
from robosmi.transformations.m2m.language_gap import TEXT_RULES as LANGUAGE_RULES
from robosmi.transformations.m2m.language_gap import changes
from robosmi.transformations.m2m.placeholders import (
    implied_headers,
    size_names,
    symbol_use,
    type_uses,
    used_symbols,
    wanted_types,
)
from robosmi.transformations.m2m.renaming import REDEFINE, RENAME, redefined, renamings
from robosmi.transformations.m2m.target_names import TargetNames, target_names
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import FunctionType
from robosmi.transformations.queries.main_function import Division, divide
from robosmi.transformations.queries.signature_text import OWN_PROTOTYPE, function_type
from robosmi.transformations.queries.source_text import is_header
from robosmi.transformations.t2m.platform_api import ApiIndex
from robosmi.transformations.t2m.target_platform import TargetFacts

_WORD = re.compile(r"\b[A-Za-z_]\w*")
STEP = "code"
TEXT_RULES = LANGUAGE_RULES | {RENAME}
"""Rules that each change a little of an element's text, so that several of them can apply to it."""


@dataclass
class Dependence:
    """The result of the partition, to become part of the plan."""

    dispositions: list[migration.Disposition] = field(default_factory=list)
    adapters: list[migration.AdapterUse] = field(default_factory=list)
    symbols: list[migration.SymbolUse] = field(default_factory=list)
    source: platform.Platform | None = None
    divisions: list[Division] = field(default_factory=list)


def partition(views: Sequence[CodeView], target: TargetFacts, sources: Mapping[str, bytes], trace: Trace) -> Dependence:
    """Judge every element of the program.

    Args:
        views: a view of each unit of the program.
        target: the target.
        sources: path of a unit -> its bytes.
        trace: where links are recorded.
    """
    result = Dependence()
    program, api = views[0].program, views[0].api
    names = target_names(target.platform)
    called = called_functions(views, target, names)
    used = used_symbols(views, called, target, names)
    includes = [i.header for u in program.units for i in u.includes]
    result.source = api.to_model([*called, *used], includes)
    known = {f.name: f for h in result.source.headers for f in h.functions}
    prototypes = own_prototypes(views)
    values = handed_on(views)
    result.adapters = [
        adapter(c, known.get(name), prototypes.get(name), api.name, target, names, handed=name in values)
        for name, c in called.items()
    ]
    functions = {a.name: function_type(a.targetSignature) for a in result.adapters}
    result.symbols = _symbols(result, views, used, functions, sources, api, target, names)
    for unit in program.units:
        _judge_unit(unit, api, target, result, names)
    result.dispositions += _judge_externals(program, result)
    _change_unit_texts(views, sources, functions, prototypes, names, result)
    for disposition in result.dispositions:
        trace.link("platform dependence", STEP, [disposition.element], [disposition])
    for made in result.adapters:
        trace.link("adapter", STEP, [*made.calls, made.function], [made])
    for use in result.symbols:
        trace.link("placeholder", STEP, [*use.uses, use.symbol], [use])
    return result


def _symbols(
    result: Dependence,
    views: Sequence[CodeView],
    used: Mapping[str, list[ccode.NameReference]],
    functions: Mapping[str, FunctionType],
    sources: Mapping[str, bytes],
    api: ApiIndex,
    target: TargetFacts,
    names: TargetNames,
) -> list[migration.SymbolUse]:
    """Placeholders: headers, then types, then values."""
    assert result.source is not None
    known = {s.name: s for h in result.source.headers for s in h.symbols}
    wanted = wanted_types(views, functions)
    attributes = set(api.settings["parser"].get("attribute_macros", ()))
    several = sum(not is_header(v.unit) for v in views) > 1
    sizes = size_names(views)
    values = []
    for number, (name, uses) in enumerate(used.items(), 1):
        symbol = known.get(name)
        attribute = name in attributes or (symbol is None and not uses and name not in sizes)
        values.append(
            symbol_use(name, uses, symbol, number, attribute, wanted.get(name, ""), api.name, target, names, several=several)
        )
    written = [
        p
        for a in result.adapters
        if a.signatureSource != OWN_PROTOTYPE
        for p in (functions[a.name].returns, *functions[a.name].parameters)
    ]
    written += [known[n].typeName for n in used if n in known and known[n].typeName]
    types = type_uses(views, sources, written, target, names)
    headers = implied_headers(views, target, names)
    done = {t.placeholder for t in types}
    return [*(h for h in headers if h.placeholder not in done), *types, *values]


def _change_unit_texts(
    views: Sequence[CodeView],
    sources: Mapping[str, bytes],
    functions: Mapping[str, FunctionType],
    prototypes: Mapping[str, ccode.Function],
    names: TargetNames,
    result: Dependence,
) -> None:
    """Dispositions for what the target's names and language want otherwise; an element keeps its one disposition."""
    by_element = {id(d.element): d for d in result.dispositions}

    def change(element: ccode.Located, rule: str, choice: str, reason: str) -> None:
        old = by_element.get(id(element))
        if old is not None and old.action is migration.Action.rewrite and set(old.rule.split(AND)) <= TEXT_RULES - {rule}:
            old.rule, old.choice, old.reason = joined((old.rule, rule), (old.choice, choice), (old.reason, reason))
            return
        if old is not None and old.action is not migration.Action.retain:
            return  # it does not stay as it is anyway
        made = old if old is not None else _disposition(element, migration.Action.rewrite, rule, reason)
        made.action, made.rule, made.reason, made.choice = migration.Action.rewrite, rule, reason, choice
        if old is None:
            result.dispositions.append(made)
            by_element[id(element)] = made

    renamed = {r.name: r for r in renamings(views, sources, names)}
    for renaming in renamed.values():
        change(renaming.element, RENAME, renaming.new, renaming.reason)
    adapted = {a.name for a in result.adapters if a.signatureSource == OWN_PROTOTYPE}
    for name, prototype in prototypes.items():
        if name in adapted:
            change(
                prototype,
                "adapter-in-place",
                name,
                "the program declares it and defines it nowhere: its body is to be written here",
            )
            by_element[id(prototype)].action = migration.Action.adapt
    for view in views:
        for macro in redefined(view.unit, names):
            change(macro, REDEFINE, macro.name, f"the target has a macro '{macro.name}' of its own, which gives way")
        for found in changes(view, sources[view.unit.path], functions):
            text = _WORD.sub(lambda word: renamed[word[0]].new if word[0] in renamed else word[0], found.text)
            change(found.element, found.rule, text, found.reason)


def _judge_unit(unit: ccode.SourceUnit, api: ApiIndex, target: TargetFacts, result: Dependence, names: TargetNames) -> None:
    made = result.dispositions
    made += [_include(i, unit, api, target) for i in unit.includes]
    made += [_plain(m, "own-macro", "a macro of the program's own") for m in unit.macros]
    for declaration in unit.declarations:
        if isinstance(declaration, ccode.Function) and declaration.definition and declaration.name == "main":
            division = divide(declaration, names.declared | names.macros | names.keywords)
            result.divisions.append(division)
            made += _main(division)
        elif isinstance(declaration, ccode.Function) and declaration.name == "main":
            made.append(_disposition(declaration, migration.Action.drop, "main-prototype", "the sketch has no main"))
        elif isinstance(declaration, ccode.Function):
            kind = "function" if declaration.definition else "prototype"
            made.append(_plain(declaration, f"own-{kind}", f"a {kind} of the program's own"))
        else:
            made.append(_plain(declaration, "own-declaration", "a declaration of the program's own"))


def _judge_externals(program: ccode.Program, result: Dependence) -> Iterable[migration.Disposition]:
    """What the program uses and does not declare: adapted, given a placeholder, or there on the target as it is."""
    adapted = {a.name for a in result.adapters if a.signatureSource != OWN_PROTOTYPE}
    placed = {s.name for s in result.symbols}
    own = {m.name for u in program.units for m in u.macros} | {d.name for u in program.units for d in u.declarations}
    for external in program.externals:
        if external.name in adapted:
            yield _disposition(
                external, migration.Action.adapt, "platform-function", "an adapter with its signature takes its place"
            )
        elif external.name in placed:
            yield _disposition(external, migration.Action.adapt, "platform-symbol", "a placeholder takes its place")
        elif external.name in own:
            yield _plain(external, "own-name", "another file of the program has it")
        else:
            yield _plain(external, "target-name", "the target has it")


def _disposition(
    element: ccode.Located, action: migration.Action, rule: str, reason: str, *, in_loop: bool = False
) -> migration.Disposition:
    return migration.Disposition(
        element=element,
        action=action,
        rule=rule,
        reason=reason,
        inLoop=in_loop,
        confidence=1.0,
        chosenBy=migration.ChosenBy.rule,
        choice=action.name,
    )


def _plain(element: ccode.Located, rule: str, reason: str) -> migration.Disposition:
    return _disposition(element, migration.Action.retain, rule, reason)


def _include(include: ccode.Include, unit: ccode.SourceUnit, api: ApiIndex, target: TargetFacts) -> migration.Disposition:
    kind = api.header_kind(include.header)
    carried = _carried(include, unit)
    if carried:
        made = _disposition(include, migration.Action.retain, "own-header", "a header of the program's own, carried over with it")
        made.choice = carried
        return made
    if kind == "platform":
        return _disposition(include, migration.Action.drop, "platform-include", "the header belongs to the source platform")
    if kind == "posix" or (kind == "standard" and include.header not in target.standard_headers):
        return _disposition(include, migration.Action.unsupported, "posix-include", "the target has no such header")
    if kind == "standard":
        if is_header(unit):
            return _plain(include, "standard-include-in-place", "a standard header that the target has")
        if _conditional(include, unit):
            return _plain(include, "conditional-include", "a standard header, kept where it is under a condition")
        return _plain(include, "standard-include", "a standard header that the target has")
    return _disposition(include, migration.Action.unsupported, "unknown-include", "nothing is known of this header")


def _carried(include: ccode.Include, unit: ccode.SourceUnit) -> str:
    """File name of the program's own header that an include means, empty where it was not carried over."""
    wanted = include.header.replace("\\", "/").rpartition("/")[2]
    units = [u for u in unit.program.units if is_header(u)] if unit.program is not None else []
    return next((wanted for u in units if u.path.rpartition("/")[2] == wanted), "")


def _conditional(include: ccode.Include, unit: ccode.SourceUnit) -> bool:
    depth = 0
    for directive in unit.conditionals:
        if directive.startOffset > include.startOffset:
            break
        depth += directive.directive in ("if", "ifdef", "ifndef")
        depth -= directive.directive == "endif"
    return depth > 0


def _main(division: Division) -> list[migration.Disposition]:
    """main itself, its statements, what leaves it and what moves out of it."""
    rewrite, retain = migration.Action.rewrite, migration.Action.retain
    made = [_disposition(division.main, rewrite, "main", division.reason)]
    hoisted = {id(v.eContainer()): v for v in division.hoisted}
    leaving = {id(s) for s in (*division.returns, *division.continues)}
    for statement in division.before:
        if id(statement) in leaving:
            continue
        variable = hoisted.get(id(statement))
        if variable is None:
            made.append(_disposition(statement, retain, "main-once", "runs once, in setup"))
        else:
            rule = "hoist-local-split" if variable in division.split else "hoist-local"
            made.append(_disposition(variable, migration.Action.hoist, rule, "declared before the loop and used in it"))
    if division.loop is not None:
        made.append(_disposition(division.loop, rewrite, "main-loop", "its body is repeated, in loop"))
        body = division.loop.body
        inner = list(body.statements) if isinstance(body, ccode.Block) else [body] if body is not None else []
        made += [
            _disposition(s, retain, "main-repeated", "repeated, in loop", in_loop=True) for s in inner if id(s) not in leaving
        ]
    made += [
        _disposition(s, migration.Action.drop, "unreachable", "nothing leads behind the endless loop")
        for s in division.unreachable
    ]
    gone = {id(s) for s in division.unreachable}
    for leave in division.returns:
        if not any(id(x) in gone for x in _self_and_containers(leave)):
            rule = (
                "return-value-from-setup"
                if leave.value is not None and all_of_kind(leave.value, ccode.Call)
                else "return-from-setup"
            )
            made.append(_disposition(leave, rewrite, rule, "setup has no value"))
    made += [_disposition(c, rewrite, "continue-main-loop", "the loop is a function now") for c in division.continues]
    return made


def _self_and_containers(element: ccode.Located) -> Iterable[object]:
    current: object = element
    while isinstance(current, ccode.Located):
        yield current
        current = current.eContainer()
