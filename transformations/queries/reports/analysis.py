"""The result of `analyse`: one JSON object a unit, as the contract has it.

Only form: what is a platform's is decided in `code`, pins in `pin_uses`, main in `main_program`. The keys are fixed for
users' scripts; new ones may be added, none renamed.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from robosmi.base.data_text import Json
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.queries import code
from robosmi.transformations.queries.flows import cores, pin_uses
from robosmi.transformations.queries.programs import main_program

_STORAGE = {"externStorage": "extern", "staticStorage": "static", "registerStorage": "register", "autoStorage": "auto"}
UNKNOWN = ("RS103", "RS109")
"""The rules for a header that is not found, and for a function that nobody knows."""
_RECORDS = {"structType": "struct", "unionType": "union", "classType": "class"}


def analysis(program: ccode.Program, findings: list[Finding], api: ApiIndex) -> dict[str, Any]:
    """The contract's `{"units": [...]}`. Findings of the analysis itself (RS108, RS109) are appended to `findings`."""
    units = []
    calls = code.user_calls(program)
    views = code.views(program, api)
    for view in views:
        units.append(_unit(view, views, calls))
        findings.extend(library_cogs(view))
        findings.extend(unknown_functions(view))
    return {"units": units}


def library_cogs(view: code.CodeView) -> list[Finding]:
    """RS108: functions of the platform that start code of their library on another core; one a header, at the first call."""
    by_header: dict[str, list[code.CalledFunction]] = {}
    for function in cores.library_starts(view):
        by_header.setdefault(function.header, []).append(function)
    found = []
    for header, functions in by_header.items():
        call = min((f.calls[0] for f in functions), key=lambda c: int(c.startOffset))
        names = ", ".join(f.name for f in functions)
        runs = "run on their own core" if len(functions) > 1 else "runs on its own core"
        evidence = {"functions": [f.name for f in functions]}
        found.append(_finding(view, "RS108", Severity.info, call, f"{names} ({header}) {runs}", evidence=evidence))
    return found


def unknown_functions(view: code.CodeView) -> list[Finding]:
    """RS109: functions that are called and that neither the program nor the repository knows."""
    found = []
    for function in view.unknown():
        place: ccode.Located = function.calls[0]
        if function.header:
            message = f"the function {function.name} is declared in {function.header}, but no file of the program defines it"
        elif function.callee is not None and code.unit_of(function.callee) is not None:
            message = f"the program declares the function {function.name} as {function.signature}, but no file defines it"
            place = function.callee
        else:
            message = f"the function {function.name} is declared nowhere; inferred signature: {function.signature}"
        evidence = {"function": function.name}
        found.append(_finding(view, "RS109", Severity.warning, place, message, "add the file that defines it", evidence))
    return found


def _finding(
    view: code.CodeView,
    rule: str,
    severity: Severity,
    about: ccode.Located,
    message: str,
    fix: str | None = None,
    evidence: dict[str, Any] | None = None,
) -> Finding:
    unit = code.unit_of(about) or view.unit
    place = Location(str(unit.path), int(about.line), int(about.column), int(about.endLine), int(about.endColumn))
    return Finding(rule, severity, message, place, fix=fix, evidence=evidence or {})


def _unit(view: code.CodeView, views: list[code.CodeView], user_calls: dict[str, list[ccode.Call]]) -> dict[str, Json]:
    unit, api = view.unit, view.api
    functions = [d for d in unit.declarations if isinstance(d, ccode.Function)]
    variables = [d for d in unit.declarations if isinstance(d, ccode.Variable)]
    explicit = set(view.includes)
    own_calls: dict[str, Sequence[ccode.Located]] = {
        name: [c for c in calls if code.unit_of(c) is unit] for name, calls in user_calls.items()
    }
    own_calls.update({f.name: f.calls for f in view.header_macros()})
    own_calls.update(_uses_of_header_macros(view))
    return {
        "path": str(unit.path),
        "includes": [_include(i, api) for i in unit.includes],
        "functions": [_function(f) for f in functions if f.definition],
        "prototypes": [{"name": str(f.name), "line": int(f.line)} for f in functions if not f.definition],
        "globals": [
            {"name": str(v.name), "type": type_text(v.valueType), "line": int(v.line), "storage": _storage(v)} for v in variables
        ],
        "macros": [
            {"name": str(m.name), "line": int(m.line), "parameters": [str(p) for p in m.parameters] if m.functionLike else None}
            for m in unit.macros
        ],
        "types": [
            _type(d) for d in unit.declarations if isinstance(d, (ccode.Typedef, ccode.Record, ccode.Enumeration)) and d.name
        ],
        "platform_calls": [_platform_call(f) for f in view.functions_of("platform")],
        "unknown_calls": [
            {"name": f.name, "count": len(f.calls), "lines": f.lines, "signature": f.signature} for f in view.unknown()
        ],
        "standard_calls": [
            {"name": f.name, "header": f.header, "explicit_include": f.header in explicit}
            for f in view.functions_of("standard", "posix")
            if f.calls
        ],
        "platform_symbols": [{"name": s.name, "kind": s.kind, "lines": s.lines} for s in view.symbols()],
        "platform_types": [{"name": t.name, "header": t.header, "lines": t.lines} for t in view.types()],
        "user_calls": [
            {"name": name, "count": len(calls), "lines": sorted(int(c.line) for c in calls)}
            for name, calls in sorted(own_calls.items())
            if calls
        ],
        "main": _main(unit),
        "cogs": [{"via": c.via, "function": c.function, "line": int(c.call.line)} for c in code.cogs_of(view)],
        "pin_uses": [use.to_json() for use in pin_uses.pin_uses_of(view, views)],
        "coverage": {
            "calls_in_text": int(unit.callsInText),
            "calls_in_model": int(unit.callsInModel),
            "unresolved": [{"name": str(u.name), "line": int(u.line), "column": int(u.column)} for u in unit.unresolved],
        },
    }


def _include(include: ccode.Include, api: ApiIndex) -> dict[str, Any]:
    name = str(include.header)
    kind = api.header_kind(name)
    return {
        "name": name,
        "form": "<" if include.system else '"',
        "line": int(include.line),
        "kind": {"platform": "platform", None: "local"}.get(kind, "standard"),
        "found": bool(include.resolvedPath),
    }


def _function(function: ccode.Function) -> dict[str, Json]:
    return {
        "name": str(function.name),
        "line": int(function.line),
        "end_line": int(function.endLine),
        "returns": type_text(function.returnType),
        "parameters": [f"{type_text(p.valueType)} {p.name or ''}".strip() for p in function.parameters]
        + (["..."] if function.variadic else []),
        "storage": _storage(function),
    }


def _storage(declaration: ccode.Function | ccode.Variable) -> list[str]:
    word = _STORAGE.get(declaration.storage.name)
    return [word] if word else []


def type_text(use: ccode.TypeUse | None) -> str:
    """A type as written, with its array dimensions."""
    return f"{use.spelling}{use.arrayDims or ''}" if use is not None else ""


def _type(declaration: ccode.Declaration) -> dict[str, Json]:
    if isinstance(declaration, ccode.Record):
        kind = _RECORDS[declaration.recordKind.name]
    else:
        kind = "typedef" if isinstance(declaration, ccode.Typedef) else "enum"
    return {"name": str(declaration.name), "kind": kind, "line": int(declaration.line)}


def _uses_of_header_macros(view: code.CodeView) -> dict[str, Sequence[ccode.Located]]:
    """The uses of macros with arguments that headers of the program define."""
    found: dict[str, list[ccode.Located]] = {}
    for use in view.unit.macroUses:
        if use.functionLike and use.header and view.api.header_kind(str(use.header)) is None:
            found.setdefault(str(use.name), []).append(use)
    return {**found}


def _platform_call(function: code.CalledFunction) -> dict[str, Json]:
    return {
        "name": function.name,
        "count": len(function.calls),
        "lines": function.lines,
        "header": function.header or None,
        "signature": function.signature,
        "signature_source": function.signature_source,
        "macro": function.entry is not None and function.entry.kind == "function_macro",
        "in_macro": function.in_macro,
        "macro_count": len(function.made),
        "macro_lines": sorted(int(call.line) for call in function.made),
    }


def _main(unit: ccode.SourceUnit) -> dict[str, Json] | None:
    main = main_program.main_structure(unit)
    if main is None:
        return None
    return {
        "line": int(main.function.line),
        "loop_kind": main.loop_kind,
        "loop_line": int(main.loop.line) if main.loop is not None else None,
        "statements_before": len(main.before),
        "statements_after": len(main.after),
        "hoisted_locals": [str(v.name) for v in main.hoisted],
        "loop_exits": [{"kind": e.kind, "line": e.line} for e in main.exits],
    }
