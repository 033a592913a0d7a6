"""Finds which functions need an adapter, and the signature of each (paper 3.4).

A function needs an adapter if it is called, defined nowhere in the program and not available on the target. Its signature comes
from the program's own prototype, else from the repository or a header; where none is known, or the calls contradict it, it is
inferred from the calls. No function is known by its name.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence

from msgspec.structs import replace

from robosmi.metamodels import ccode, migration, platform
from robosmi.query import ancestor_of_kind
from robosmi.transformations.knowledge.platforms.target_names import TargetNames
from robosmi.transformations.knowledge.platforms.target_platform import CPLUSPLUS, PLAIN_C, TargetFacts
from robosmi.transformations.m2m.adapters.signatures import Signature, for_target
from robosmi.transformations.queries.code import CalledFunction, CodeView
from robosmi.transformations.queries.own_headers import included
from robosmi.transformations.queries.signature_text import declare, nothing, parameter_type, type_names

Source = migration.SignatureSource
_RESERVED = re.compile(r"__(?!builtin_)|_[A-Z]")
"""Names that C reserves for the implementation (C11 7.1.3): no header promises them, whichever header declares them."""
_BUILTIN = "__builtin_"
"""Prefix of functions built into the compiler, which need no header: the target's compiler may have one of the same name."""


def called_functions(
    views: Sequence[CodeView], target: TargetFacts, names: TargetNames, adapts: Callable[[str, str], bool]
) -> dict[str, CalledFunction]:
    """The functions that need an adapter, by name.

    Args:
        views: a view of each unit.
        target: the target platform.
        names: the names that the target declares.
        adapts: (name, header) -> whether an adapter replaces this function although the target's library has one, since that one
            behaves differently there.
    """
    own = _own_names(views)
    found: dict[str, CalledFunction] = {}
    for view in views:
        macros = {str(macro.name) for unit in (view.unit, *included(view.unit)) for macro in unit.macros}
        for function in [*view.called().values(), *_referenced(view)]:
            there = function.header in target.standard_headers and function.name not in names.absent
            there = there and not _RESERVED.match(function.name) and not adapts(function.name, function.header)
            there = there or (function.entry is None and function.name in names.same)
            if there or function.name in macros or view.defined(function.name) or (function.entry is None and not function.calls):
                continue
            known = found.get(function.name)
            if known is None:
                found[function.name] = replace(function, calls=list(function.calls))  # the views keep theirs
            else:
                known.calls += [c for c in function.calls if c not in known.calls]
                known.callee = known.callee or function.callee
    for name, prototype in own_prototypes(views).items():
        if name not in found and name not in own and any(name in _handed_on(view) for view in views):
            found[name] = CalledFunction(name, callee=prototype)
    return dict(sorted(found.items()))


def _handed_on(view: CodeView) -> set[str]:
    """The names that a unit uses as values, and those called in bodies of its macros."""
    named = {str(r.name) for r in view.of_kind(ccode.NameReference)}
    return named.union(*(_CALLED.findall(str(macro.body or "")) for macro in view.unit.macros))


_CALLED = re.compile(r"([A-Za-z_]\w*)\s*\(")


def _own_names(views: Iterable[CodeView]) -> set[str]:
    """Functions and macros that the program defines in any of its files."""
    defined = {d.name for v in views for d in v.unit.declarations if isinstance(d, ccode.Function) and d.definition}
    return defined | {m.name for v in views for m in v.unit.macros}


def _referenced(view: CodeView) -> Iterable[CalledFunction]:
    """Platform functions that are used without a direct call: as values, or through a macro that is another name for one."""
    for reference in view.of_kind(ccode.NameReference):
        if isinstance(reference.target, ccode.ExternalSymbol) or (
            isinstance(reference.target, ccode.Function) and not reference.target.definition
        ):
            entry = view.resolve(reference.name)
            if reference.name in view.called():
                continue
            if entry is not None and entry.callable:
                yield CalledFunction(reference.name, entry=entry, header=entry.header)
    for macro in view.unit.macros:  # another name for a function
        other = macro.body.strip()
        if macro.functionLike or not other.isidentifier() or other in view.called():
            continue
        entry = view.resolve(other)
        calls = [c for c in view.calls if c.calleeName == macro.name]
        if calls or (entry is not None and entry.callable):
            known = entry if entry is not None and entry.callable else None
            yield CalledFunction(other, calls, known, known.header if known else "", callee=calls[0].callee if calls else None)


def handed_on(views: Iterable[CodeView]) -> set[str]:
    """Names of functions that the program uses as values and does not define; their types must be those the program expects."""
    references = (r for view in views for r in view.of_kind(ccode.NameReference))
    return {
        r.name
        for r in references
        if isinstance(r.target, ccode.ExternalSymbol) or (isinstance(r.target, ccode.Function) and not r.target.definition)
    }


def own_prototypes(views: Sequence[CodeView]) -> dict[str, ccode.Function]:
    """The first prototype of each function that the program declares and does not define."""
    own = _own_names(views)
    found: dict[str, ccode.Function] = {}
    for view in views:
        for declaration in view.unit.declarations:
            if isinstance(declaration, ccode.Function) and declaration.name not in own:
                found.setdefault(declaration.name, declaration)
    return found


def declared_in_lists(views: Sequence[CodeView]) -> set[int]:
    """The `id()` of each function declared together with others in one declaration, such as `int f(int), g(int);`."""
    found: set[int] = set()
    for view in views:
        starts: dict[int, list[int]] = {}
        for declaration in view.unit.declarations:
            if isinstance(declaration, (ccode.Function, ccode.Variable)):
                starts.setdefault(int(declaration.startOffset), []).append(id(declaration))
        found.update(one for together in starts.values() if len(together) > 1 for one in together)
    return found


def adapter(
    called: CalledFunction,
    function: platform.ApiFunction | None,
    prototype: ccode.Function | None,
    source: str,
    target: TargetFacts,
    names: TargetNames,
    own: Mapping[str, ccode.Declaration],
    *,
    handed: bool = False,
) -> migration.AdapterUse:
    """The adapter of one function.

    Args:
        called: the function with its calls.
        function: how the repository knows it, None where it does not.
        prototype: the program's own declaration of it, if there is one.
        source: name of the source platform, for a name that the target has already.
        target: the target.
        names: the target's names.
        own: the types that the program declares, by name.
        handed: the function is also handed on as a value.
    """
    name = called.name
    signature, raw, origin = _signature(called, function, prototype)
    if raw.endswith("(...)"):  # a macro: nothing is declared, so the call sites say what it takes
        raw = signature.named().text()
    kept = handed or origin is Source.program or name in names.absent
    reserved = names.macros | names.keywords
    wide = for_target(signature, {} if kept else target.widths, reserved)
    if target.language == PLAIN_C:  # where a definition names its parameters, and "..." follows one
        wide = wide.named(reserved)
        wide = Signature(wide.name, wide.returns, wide.parameters, wide.variadic and bool(wide.parameters))
    of_the_compiler = function is None and name.startswith(_BUILTIN)
    if not kept and (of_the_compiler or name in names.declared | names.macros):
        wide = Signature(f"{source}_{name}", wide.returns, wide.parameters, wide.variadic)
    return migration.AdapterUse(
        name=name, signature=raw, targetName=wide.name, result=target_type(wide.returns, own, target.language),
        parameters=[
            migration.AdapterParameter(
                name=given, valueType=target_type(parameter_type(declare(kind, given)), own, target.language)
            )
            for kind, given in wide.parameters
        ],
        variadic=wide.variadic, signatureSource=origin, status=migration.AdapterStatus.todo,
        notes=_notes(called, function, origin, wide.name, handed), function=function, calls=called.calls,
    )  # fmt: skip


def hide_types(use: migration.AdapterUse) -> None:
    """Change pointers to a program type to `void *` where a file that calls the function does not see the type's declaration."""
    units = {id(unit): unit for call in use.calls if (unit := ancestor_of_kind(call, ccode.SourceUnit)) is not None}
    seen = [{id(each) for each in (unit, *included(unit))} for unit in units.values()]
    for parameter in use.parameters:
        kind = parameter.valueType
        places = {id(ancestor_of_kind(d, ccode.SourceUnit)) for d in kind.declarations} if kind is not None else set()
        if kind is not None and kind.spelling.endswith("*") and any(places - each for each in seen):
            kind.spelling = "const volatile void *"
            kind.declarations.clear()


def own_types(program: ccode.Program) -> dict[str, ccode.Declaration]:
    """The types that the files of a program declare, by name."""
    kinds = (ccode.Typedef, ccode.Record, ccode.Enumeration)
    return {d.name: d for unit in program.units for d in unit.declarations if isinstance(d, kinds) and d.name}


def target_type(spelling: str, own: Mapping[str, ccode.Declaration], language: str = CPLUSPLUS) -> migration.TargetType:
    """Make a type of the target: its spelling, the program's own types in it, and its empty value in the target's language."""
    spelling = spelling.strip()
    empty = nothing(spelling)
    if empty == "{}" and language == PLAIN_C:
        empty = f"({spelling}){{0}}"
    named = list(dict.fromkeys(word for word in type_names(spelling) if word in own))
    return migration.TargetType(spelling=spelling, emptyValue=empty, declarations=[own[word] for word in named])


def _signature(
    called: CalledFunction, function: platform.ApiFunction | None, prototype: ccode.Function | None
) -> tuple[Signature, str, Source]:
    """The signature of a function in parts, the same as text for the report, and where it was found."""
    name, inferred = called.name, called.callee
    if prototype is not None:
        types = tuple((_spelling(p.valueType), p.name) for p in prototype.parameters)
        variadic = prototype.variadic or (not types and any(c.arguments for c in called.calls))
        return Signature(name, _spelling(prototype.returnType) or "int", types, variadic), prototype.signature, Source.program
    if function is not None and (function.returnType or not function.functionLikeMacro):
        declared = Signature(
            name, function.returnType, tuple((p.spelling, p.name) for p in function.parameters), function.variadic
        )
        if _fits(declared, called.calls):
            return declared, function.signature, Source.repository
    if inferred is not None and called.calls:
        meanings = [p.meaning.name for p in function.parameters] if function is not None else []
        types = tuple(
            (
                _handler(i, called.calls) or _spelling(p.valueType),
                p.name or (meanings[i] if i < len(meanings) and meanings[i] != "plain" else ""),
            )
            for i, p in enumerate(inferred.parameters)
        )
        signature = Signature(name, _spelling(inferred.returnType) or "int", types, inferred.variadic)
        return signature, function.signature if function is not None else inferred.signature or signature.text(), Source.inferred
    count = max((len(c.arguments) for c in called.calls), default=0)
    signature = Signature(name, "int", tuple(("int", "") for _ in range(count)))
    return signature, function.signature if function is not None else signature.text(), Source.inferred


def _handler(position: int, calls: Iterable[ccode.Call]) -> str:
    """The type of a function-pointer parameter if every call passes a function of the program of one type; else empty."""
    found: set[str] = set()
    for call in calls:
        value = call.arguments[position] if position < len(call.arguments) else None
        inner = value.operand if isinstance(value, ccode.Unary) and value.operator == "&" else value
        function = inner.target if isinstance(inner, ccode.NameReference) else None
        if not isinstance(function, ccode.Function) or not function.definition:
            return ""
        taken = ", ".join([_spelling(p.valueType) for p in function.parameters] + ["..."] * bool(function.variadic))
        found.add(f"{_spelling(function.returnType) or 'int'} (*)({taken or 'void'})")
    return found.pop() if len(found) == 1 else ""


def _fits(signature: Signature, calls: Iterable[ccode.Call]) -> bool:
    """Whether the number of arguments of every call fits the signature; old programs call old versions of an API."""
    count = len([p for p in signature.parameters if p[0] != "void" or p[1]])
    return all(len(c.arguments) >= count if signature.variadic else len(c.arguments) == count for c in calls)


def _notes(
    called: CalledFunction, function: platform.ApiFunction | None, origin: Source, generated: str, handed: bool
) -> list[str]:
    lines = ", ".join(str(line) for line in sorted(set(called.lines)))
    notes = (
        [f"called in line{'s' if ',' in lines else ''} {lines}"] if lines else ["used without a call, or in the body of a macro"]
    )
    if origin is Source.program:
        notes.append("the program declares it, but no file defines it")
    elif function is None:
        notes.append("no header declares it: its signature is inferred from the calls")
    elif function.blocking:
        notes.append("it blocks")
    if function is not None and function.startsCog:
        notes.append("it starts code on another core there")
    if handed and origin is not Source.program:
        notes.append("the program uses it as a value, so its types are unchanged")
    if generated != called.name:
        notes.append(f"the target has a {called.name} too, so this one has another name there")
    return notes


def _spelling(use: ccode.TypeUse | None) -> str:
    return f"{use.spelling} {use.arrayDims}".strip() if use is not None else ""
