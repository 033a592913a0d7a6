"""Platform dependence: what happens to each element of the program (paper 3.1), and which functions need an adapter (3.4).

Platform-agnostic constructs are retained, platform-dependent ones are adapted or dropped, `main` is divided. Each gets
a disposition with the rule that decided and the reason; nothing is left without one. What a name means is data of the
platform; no rule knows a function by its name.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from robosmi.metamodels import ccode, migration, platform
from robosmi.query import all_of_kind
from robosmi.transform import TraceRecorder
from robosmi.transformations.m2m.signatures import Signature, for_target
from robosmi.transformations.queries.code import CalledFunction, CodeView
from robosmi.transformations.queries.main_function import Division, divide
from robosmi.transformations.t2m.platform_api import ApiIndex
from robosmi.transformations.t2m.target_platform import TargetFacts

STEP = "code"


@dataclass
class Dependence:
    """The result of the partition, to become part of the plan."""

    dispositions: list[migration.Disposition] = field(default_factory=list)
    adapters: list[migration.AdapterUse] = field(default_factory=list)
    symbols: list[migration.SymbolUse] = field(default_factory=list)
    source: platform.Platform | None = None
    divisions: list[Division] = field(default_factory=list)


def partition(program: ccode.Program, api: ApiIndex, target: TargetFacts, trace: TraceRecorder) -> Dependence:
    """Judge every element of the program.

    Args:
        program: the code model.
        api: what is known of its platform.
        target: the target.
        trace: where links are recorded.
    """
    result = Dependence()
    views = [CodeView(unit, program, api) for unit in program.units]
    called = _called(views, target)
    used = _used(program, views, target)
    includes = [i.header for u in program.units for i in u.includes]
    result.source = api.to_model([*called, *used], includes)
    functions = {f.name: f for h in result.source.headers for f in h.functions}
    symbols = {s.name: s for h in result.source.headers for s in h.symbols}
    for unit in program.units:
        _judge_unit(unit, api, target, result)
    result.adapters = [_adapter(found, functions.get(name), target) for name, found in called.items()]
    result.symbols = [_symbol(name, uses, symbols.get(name), number, target) for number, (name, uses) in enumerate(used.items())]
    for disposition in result.dispositions:
        trace.link("platform dependence", STEP, [disposition.element], [disposition])
    for adapter in result.adapters:
        trace.link("adapter", STEP, [*adapter.calls, adapter.function], [adapter])
    for use in result.symbols:
        trace.link("placeholder", STEP, [*use.uses, use.symbol], [use])
    return result


def _called(views: list[CodeView], target: TargetFacts) -> dict[str, CalledFunction]:
    """The functions that need an adapter, by name: everything that is called, not defined in the program and not on the target."""
    found: dict[str, CalledFunction] = {}
    for view in views:
        for function in view.called().values():
            if function.header in target.standard_headers or (function.entry is None and not function.calls):
                continue
            known = found.setdefault(function.name, function)
            if known is not function:
                known.calls += function.calls
    return dict(sorted(found.items()))


def _used(program: ccode.Program, views: list[CodeView], target: TargetFacts) -> dict[str, list[ccode.NameReference]]:
    """The names that need a placeholder, with their uses: the platform's, and those that nobody knows."""
    found: dict[str, list[ccode.NameReference]] = {name.name: [] for view in views for name in view.symbols()}
    for reference in all_of_kind(program, ccode.NameReference):
        if isinstance(reference.target, ccode.ExternalSymbol) and reference.target.header not in target.standard_headers:
            entry = views[0].resolve(reference.name)
            if entry is None or entry.header not in target.standard_headers:
                found.setdefault(reference.name, []).append(reference)
    return dict(sorted(found.items()))


def _judge_unit(unit: ccode.SourceUnit, api: ApiIndex, target: TargetFacts, result: Dependence) -> None:
    made = result.dispositions
    made += [_include(i, unit, api, target) for i in unit.includes]
    made += [_plain(m, "own-macro", "a macro of the program's own") for m in unit.macros]
    for declaration in unit.declarations:
        if isinstance(declaration, ccode.Function) and declaration.definition and declaration.name == "main":
            division = divide(declaration)
            result.divisions.append(division)
            made += _main(division)
        elif isinstance(declaration, ccode.Function):
            kind = "function" if declaration.definition else "prototype"
            made.append(_plain(declaration, f"own-{kind}", f"a {kind} of the program's own"))
        else:
            made.append(_plain(declaration, "own-declaration", "a declaration of the program's own"))


def _disposition(element: ccode.Located, action: migration.Action, rule: str, reason: str, *, in_loop: bool = False) -> migration.Disposition:
    return migration.Disposition(
        element=element, action=action, rule=rule, reason=reason, inLoop=in_loop, confidence=1.0, chosenBy=migration.ChosenBy.rule,
        choice=action.name,
    )  # fmt: skip


def _plain(element: ccode.Located, rule: str, reason: str) -> migration.Disposition:
    return _disposition(element, migration.Action.retain, rule, reason)


def _include(include: ccode.Include, unit: ccode.SourceUnit, api: ApiIndex, target: TargetFacts) -> migration.Disposition:
    kind = api.header_kind(include.header)
    if kind == "platform":
        return _disposition(include, migration.Action.drop, "platform-include", "the header belongs to the source platform")
    if kind == "posix" or (kind == "standard" and include.header not in target.standard_headers):
        return _disposition(include, migration.Action.unsupported, "posix-include", "the target has no such header")
    if kind == "standard":
        if _conditional(include, unit):
            return _plain(include, "conditional-include", "a standard header, kept where it is under a condition")
        return _plain(include, "standard-include", "a standard header that the target has")
    return _disposition(include, migration.Action.unsupported, "unknown-include", "nothing is known of this header")


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
    for statement in division.before:
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
        made += [_disposition(s, retain, "main-repeated", "repeated, in loop", in_loop=True) for s in inner]
    made += [_disposition(s, migration.Action.drop, "unreachable", "nothing leads behind the endless loop") for s in division.unreachable]
    gone = {id(s) for s in division.unreachable}
    for leave in division.returns:
        if not any(id(x) in gone for x in _self_and_containers(leave)):
            rule = "return-value-from-setup" if leave.value is not None and all_of_kind(leave.value, ccode.Call) else "return-from-setup"
            made.append(_disposition(leave, rewrite, rule, "setup has no value"))
    made += [_disposition(c, rewrite, "continue-main-loop", "the loop is a function now") for c in division.continues]
    return made


def _self_and_containers(element: ccode.Located) -> Iterable[object]:
    current: object = element
    while isinstance(current, ccode.Located):
        yield current
        current = current.eContainer()


def _adapter(called: CalledFunction, function: platform.ApiFunction | None, target: TargetFacts) -> migration.AdapterUse:
    name, calls, inferred = called.name, called.calls, called.callee
    if function is not None and (function.returnType or not function.functionLikeMacro):
        signature = Signature(name, function.returnType, tuple((p.spelling, p.name) for p in function.parameters), function.variadic)
        raw, source = function.signature, "repository"
    elif inferred is not None:
        types = [(_spelling(p.valueType), p.name) for p in inferred.parameters]
        meanings = [p.meaning.name for p in function.parameters] if function is not None else []
        named = [(s, n or (meanings[i] if i < len(meanings) and meanings[i] != "plain" else "")) for i, (s, n) in enumerate(types)]
        signature = Signature(name, _spelling(inferred.returnType) or "int", tuple(named), inferred.variadic)
        raw, source = (function.signature if function is not None else inferred.signature or signature.text()), "inferred"
    else:
        count = max((len(c.arguments) for c in calls), default=0)
        signature, source = Signature(name, "int", tuple(("int", "") for _ in range(count))), "inferred"
        raw = signature.text()
    if raw.endswith("(...)"):  # a macro: nothing is declared, so the call sites say what it takes
        raw = signature.named().text()
    lines = ", ".join(str(line) for line in sorted(set(called.lines)))
    notes = [f"called in line{'s' if ',' in lines else ''} {lines}"] if lines else ["used in the body of a macro"]
    if function is None:
        notes.append("no header declares it: its signature is inferred from the calls")
    elif function.blocking:
        notes.append("it blocks")
    if function is not None and function.startsCog:
        notes.append("it starts code on another core there")
    return migration.AdapterUse(
        name=name, signature=raw, targetSignature=for_target(signature, target.widths).text(), signatureSource=source,
        status=migration.AdapterStatus.todo, notes=notes, function=function, calls=calls,
    )  # fmt: skip


def _spelling(use: ccode.TypeUse | None) -> str:
    return f"{use.spelling} {use.arrayDims}".strip() if use is not None else ""


def _symbol(
    name: str, uses: list[ccode.NameReference], symbol: platform.ApiSymbol | None, number: int, target: TargetFacts
) -> migration.SymbolUse:
    declared = uses[0].target if uses else None
    written = isinstance(declared, ccode.ExternalSymbol) and declared.use in (ccode.SymbolUse.writtenUse, ccode.SymbolUse.indexedUse)
    kind = symbol.symbolKind if symbol is not None else platform.SymbolKind.variable if written else platform.SymbolKind.constant
    spelled = (symbol.typeName if symbol is not None else "") or "int"
    mutable = written or kind in (platform.SymbolKind.register, platform.SymbolKind.variable)
    declaration = for_target(Signature(name, spelled), target.widths).returns
    # Constants of unknown value must differ, or a switch over them would not compile.
    text = f"static {declaration} {name} = 0;" if mutable else f"const {declaration.removeprefix('const ')} {name} = {number};"
    return migration.SymbolUse(name=name, placeholder=text, status=migration.AdapterStatus.todo, symbol=symbol, uses=uses)
