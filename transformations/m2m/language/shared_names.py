"""Variables declared several times or in several files: one object in C, a definition each in C++.

C merges tentative definitions of a variable (C11 6.9.2), and older compilers merge common symbols of several files. Each rule
finds declarations and names the rule of `m2m.partition.text_changes` that changes their text.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping

from robosmi.metamodels import ccode
from robosmi.transformations.m2m.language.declared_lists import declarators
from robosmi.transformations.m2m.language.text_change import Change, Rule
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import FunctionType, declared_with_others
from robosmi.transformations.queries.own_headers import included
from robosmi.transformations.queries.source_text import is_header


def shared(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Variables declared in a header without extern: shared by all files in C, defined once in each file in C++."""
    unit = view.unit
    units = [u for u in unit.program.units if not is_header(u)] if is_header(unit) and unit.program is not None else []
    defined = {
        d.name
        for u in units
        for d in u.declarations
        if isinstance(d, ccode.Variable) and d.storage.name == "unspecified" and d.name
    }
    wanted = (
        d
        for d in (unit.declarations if units else ())
        if isinstance(d, ccode.Variable) and d.storage.name == "unspecified" and not d.initialised
    )
    reason = "a file of the program defines it"
    for variables in _declared_together(wanted):
        others = [v for v in variables if v.name not in defined]
        if len(others) < len(variables):
            for number, variable in enumerate(v for v in variables if v.name in defined):
                yield Change(variable, "out-of-list" if number else "declare-only", "", reason)
            if others:  # the whole declaration is none of definitions any more
                yield Change(others[0], "shared-behind", " ".join(v.name for v in others), "all files share it")
            continue
        for variable in variables if len(units) > 1 else ():
            if not (variable.valueType is not None and variable.valueType.constant):
                yield Change(variable, "share", "", "all files that include the header share it")


def constants_of_others(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Constants used by other files: in C++ they have internal linkage unless declared extern."""
    unit = view.unit
    if is_header(unit) or unit.program is None:
        return
    seen = {id(u) for u in (unit, *included(unit))}
    wanted: dict[str, bool] = {}
    for other in unit.program.units:
        for declared in other.declarations:
            if isinstance(declared, ccode.Variable) and declared.storage.name == "externStorage":
                wanted[declared.name] = wanted.get(declared.name, False) or id(other) in seen
    for variable in unit.declarations:
        use = variable.valueType if isinstance(variable, ccode.Variable) else None
        if use is None or not isinstance(variable, ccode.Variable) or variable.storage.name != "unspecified":
            continue
        if use.constant and not use.pointerDepth and wanted.get(variable.name) is False:
            yield Change(variable, "declare-only", "", "another file uses the constant")


def tentative(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Globals with several tentative definitions in a file: all but one become declarations."""
    by_name: dict[str, list[ccode.Variable]] = {}
    for declaration in view.unit.declarations:
        if (
            isinstance(declaration, ccode.Variable)
            and declaration.storage.name in ("unspecified", "staticStorage")
            and declaration.name
        ):
            by_name.setdefault(declaration.name, []).append(declaration)
    listed: dict[ccode.Variable, bool] = {}
    for variables in by_name.values():
        sized = next((v for v in variables if not _open_array(v)), variables[0])
        kept = next((v for v in variables if v.initialised), sized)
        if _open_array(kept) and not kept.initialised and not is_header(view.unit) and not _elsewhere(view.unit, kept):
            yield Change(kept, "one-element", "", "an array that nothing gives a size has one element in C")
        needed = [v for v in variables if _used_before(kept, v)]
        shown = False
        for variable in variables if len(variables) > 1 else ():
            if variable is kept:
                continue
            if declared_with_others(variable):
                listed[variable] = _used_before(kept, variable)
            elif variable.storage.name == "unspecified":
                yield Change(variable, "declare-only", "", "the variable is declared a second time")
            elif needed and variable is needed[0] and not declared_with_others(kept) and not _elsewhere(view.unit, kept):
                shown = True
                yield Change(variable, "declare-static", "", "it is used before it is defined")
            else:
                yield Change(variable, "take-out", "", "the variable is declared a second time")
        if shown:
            yield Change(kept, "no-static", "", "it is declared as extern where it is first used")
    yield from _repeated_in_lists(view, data, listed)


def _repeated_in_lists(view: CodeView, data: bytes, repeated: Mapping[ccode.Variable, bool]) -> Iterator[Change]:
    """Variables to remove from a declaration of several, because another declaration defines them.

    Args:
        view: the unit.
        data: its bytes.
        repeated: the variables, each with whether it is used before the other declaration.
    """
    reason = "the variable is declared a second time"
    declared = (d for d in view.unit.declarations if isinstance(d, ccode.Variable))
    for variables in _declared_together(declared) if repeated else ():
        gone = [number for number, variable in enumerate(variables) if variable in repeated]
        names = [each.name for each in declarators(data, int(variables[0].startOffset))]
        if not gone or names != [variable.name for variable in variables]:
            continue
        others = [variable for variable in variables if variable not in repeated]
        early = any(repeated[variables[number]] for number in gone)
        if not others or (early and not any(v.initialised or v.storage.name == "staticStorage" for v in others)):
            outside = variables[0].storage.name == "unspecified"
            yield Change(variables[0], "declare-only" if outside else "take-out", "", reason)
            if others:
                yield Change(others[0], "shared-behind", " ".join(v.name for v in others), "it is declared beside others")
        else:
            yield Change(variables[gone[0]], "out-of-list", " ".join(str(number) for number in gone), reason)


def _open_array(variable: ccode.Variable) -> bool:
    """Whether a declaration leaves an array's size open (`int a[];`)."""
    use = variable.valueType
    return use is not None and not use.pointerDepth and bool(_OPEN.match((use.arrayDims or "").strip()))


def _used_before(kept: ccode.Variable, declared: ccode.Variable) -> bool:
    """Whether a variable is used between one of its declarations and the kept one after it."""
    uses = (use for variable in (kept, declared) for use in variable.references)
    return declared.startOffset < kept.startOffset and any(declared.startOffset < u.startOffset < kept.startOffset for u in uses)


def _elsewhere(unit: ccode.SourceUnit, variable: ccode.Variable) -> bool:
    """Whether another file of the program declares the same name."""
    others = (u for u in unit.program.units if u is not unit) if unit.program is not None else ()
    return any(d.name == variable.name for u in others for d in u.declarations)


def extern(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Variables that the program declares extern and never defines: the declaration becomes the definition.

    If several files declare one, the first defines it. If the declaration also names defined variables, the definitions follow
    it.
    """
    program = view.unit.program
    units = list(program.units) if program is not None else []
    defined = {
        d.name
        for u in units
        for d in u.declarations
        if isinstance(d, ccode.Variable) and (d.storage.name != "externStorage" or d.initialised)
    }
    before = units[: units.index(view.unit)] if view.unit in units else []
    before = [] if is_header(view.unit) else [u for u in before if not is_header(u)] + [u for u in units if is_header(u)]
    seen = {d.name for u in before for d in u.declarations if isinstance(d, ccode.Variable)}
    for variables in _declared_together(v for v in view.of_kind(ccode.Variable) if v.storage.name == "externStorage"):
        local = not isinstance(variables[0].eContainer(), ccode.SourceUnit)
        wanted = [v for v in variables if v.name not in defined and v.name not in seen and not v.initialised]
        if not local:
            seen |= {v.name for v in wanted}
        whole = len(wanted) == len(variables)
        rule = ("define-local" if whole else "left-undefined") if local else "define-extern" if whole else "define-behind"
        for number, variable in enumerate(wanted):
            first = " ".join(v.name for v in wanted) if rule == "define-behind" else variable.name
            names = first if number == 0 else "" if rule == "define-behind" else variable.name
            yield Change(variable, rule if number == 0 else "define-in-list", names, "the program defines it nowhere")


def _extern_in_c(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """The same in C, where a definition is written without extern: compilers warn of an initialized extern variable."""
    for change in extern(view, data, functions):
        yield change._replace(rule="define-without-extern") if change.rule == "define-extern" else change


def _declared_together(variables: Iterable[ccode.Variable]) -> list[list[ccode.Variable]]:
    """Group variables by the declaration that declares them, in text order."""
    found: dict[tuple[int, int], list[ccode.Variable]] = {}
    for variable in variables:
        around = variable.eContainer()
        statement = isinstance(around, ccode.DeclarationStatement)
        found.setdefault((id(around), -1 if statement else int(variable.startOffset)), []).append(variable)
    return list(found.values())


def common(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Variables that several files define tentatively: the initialized definition counts, or else the first."""
    unit = view.unit
    units = [u for u in unit.program.units if not is_header(u)] if unit.program is not None and not is_header(unit) else []
    valued = {d.name for d in unit.declarations if _plain(d) and not _common(d)}
    for variable in unit.declarations if len(units) > 1 else ():
        if variable.name in valued or not _common(variable) or not isinstance(variable, ccode.Variable):
            continue
        others = [d for u in units if u is not unit for d in u.declarations if d.name == variable.name and _plain(d)]
        kept = next((u for u in units for d in u.declarations if d.name == variable.name and _common(d)), unit)
        if any(not _common(d) for d in others) or kept is not unit:
            rule = "share-one" if declared_with_others(variable) else "declare-only"
            yield Change(variable, rule, variable.name, "another file of the program defines it")


def linkage(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """`extern "C"` under `#ifdef __cplusplus`, which is removed: all files of the sketch are C++, and some declare without it."""
    for opening, closing in _branches(view.unit):
        body = data[opening.endOffset : closing.startOffset]
        if _FOR_CPLUSPLUS.fullmatch(opening.condition or "") and _LINKAGE.fullmatch(_COMMENTS.sub(b"", body)):
            yield Change(opening, "linkage-of-c", "", "all files of the program are C++ in the sketch")


_FOR_CPLUSPLUS = re.compile(r"__cplusplus|defined\s*+\(?\s*+__cplusplus\s*+\)?")
_OPEN = re.compile(r"\[\s*\]")
_LINKAGE = re.compile(rb'\s*+(?:#?\s*+extern\s*"C"\s*+\{?|\})\s*')
_COMMENTS = re.compile(rb"/\*.*?(?:\*/|\Z)|//[^\n]*", re.DOTALL)


def _branches(unit: ccode.SourceUnit) -> Iterator[tuple[ccode.PreprocessorConditional, ccode.PreprocessorConditional]]:
    """The first branch of each preprocessor condition: its directive and the next directive of the same condition."""
    opened: list[ccode.PreprocessorConditional | None] = []
    for directive in unit.conditionals:
        if directive.directive in ("if", "ifdef", "ifndef"):
            opened.append(directive if directive.directive != "ifndef" else None)
            continue
        first = opened.pop() if opened else None
        if first is not None:
            yield first, directive
        if directive.directive != "endif":
            opened.append(None)


def _plain(declaration: ccode.Declaration) -> bool:
    """Whether a declaration defines a variable with external linkage, tentatively or not."""
    if not isinstance(declaration, ccode.Variable) or not declaration.name:
        return False
    return declaration.storage.name == "unspecified" or (declaration.storage.name == "externStorage" and declaration.initialised)


def _common(declaration: ccode.Declaration) -> bool:
    """Whether a declaration is a tentative definition of a non-constant variable with external linkage."""
    if not isinstance(declaration, ccode.Variable) or not _plain(declaration) or declaration.initialised:
        return False
    return not (declaration.valueType is not None and declaration.valueType.constant)


RULES: tuple[Rule, ...] = (tentative, common, shared, extern, constants_of_others, linkage)
IN_C: tuple[Rule, ...] = (_extern_in_c, common)
"""The rules that C needs, too: current C compilers no longer merge common symbols by default."""
