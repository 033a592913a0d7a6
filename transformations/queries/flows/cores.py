"""What a program does on other cores, and what waits: code that it starts there, what that code changes, calls that block.

Which functions start code or block is data of the platform. What a library starts is `library_starts`; whether any of it is a
fault is decided by constraints.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import all_contents
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.queries.code import CalledFunction, CodeView, CogStart, cogs_of


def library_starts(view: CodeView) -> list[CalledFunction]:
    """The platform's functions that a unit calls and that start code of their library on another core."""
    return [
        f
        for f in view.functions_of("platform")
        if f.calls and view.api.code_argument(f.name) is None and view.api.starts_cog(f.name, f.header)
    ]


def reached(bodies: Iterable[Element | None]) -> list[Element]:
    """Everything in these statements and in the functions of the program that they call, each function once."""
    found: list[Element] = []
    pending, seen = [b for b in bodies if b is not None], set[int]()
    while pending:
        statement = pending.pop()
        for element in (statement, *all_contents(statement)):
            found.append(element)
            callee = element.callee if isinstance(element, ccode.Call) else None
            if callee is not None and callee.body is not None and id(callee) not in seen:
                seen.add(id(callee))
                pending.append(callee.body)
    return found


def written(elements: Iterable[Element]) -> dict[int, ccode.Variable]:
    """The variables that these elements may change: assigned, counted, or whose address is taken; by identity."""
    found: dict[int, ccode.Variable] = {}
    for element in elements:
        changed = None
        if isinstance(element, ccode.Assignment):
            changed = element.left
        elif isinstance(element, ccode.Unary) and element.operator in ("++", "--", "&"):
            changed = element.operand
        while isinstance(changed, (ccode.Index, ccode.Member, ccode.Cast)):
            changed = (
                changed.array if isinstance(changed, ccode.Index)
                else changed.object if isinstance(changed, ccode.Member) else changed.operand
            )  # fmt: skip
        if isinstance(changed, ccode.NameReference) and isinstance(changed.target, ccode.Variable):
            found[id(changed.target)] = changed.target
    return found


class Cores:
    """What a program does on other cores.

    Args:
        views: a view of each unit.

    Attributes:
        starts: identity of a call -> how it starts code of the program on another core.
        by_libraries: names of the functions that it calls and that start code of their library there.
        elsewhere: the variables that the code on other cores may change, by identity.
        blocking: names of the functions that are called and that wait.
    """

    def __init__(self, views: Sequence[CodeView]) -> None:
        self.starts: dict[int, CogStart] = {id(s.call): s for v in views for s in cogs_of(v)}
        self.by_libraries = {f.name for v in views for f in library_starts(v)}
        functions = {str(d.name): d for v in views for d in v.unit.declarations if isinstance(d, ccode.Function) and d.definition}
        codes = [functions[s.function].body for s in self.starts.values() if s.function in functions]
        self.elsewhere = written(reached(codes)) if codes else {}
        self._functions = functions
        self.blocking = {
            f.name for v in views for f in v.called().values() if f.entry is not None and v.api.meaning(f.name).get("blocking")
        }

    def way_to(self, variable: ccode.Variable) -> list[ccode.Located]:
        """The call that first starts code which may change a variable, and the element that changes it; else empty."""
        for start in self.starts.values():
            body = self._functions[start.function].body if start.function in self._functions else None
            change = next((e for e in reached([body]) if id(variable) in written([e])), None)
            if isinstance(change, ccode.Located):
                return [start.call, change]
        return []


def handed_over(call: ccode.Call, api: ApiIndex) -> tuple[ccode.Expression | None, ccode.Function | None]:
    """The argument that a platform function passes to the code it starts on another core, and that code; else (None, None).

    Args:
        call: the call of the platform function.
        api: the platform's API.
    """
    name, arguments = str(call.calleeName or ""), list(call.arguments)
    own = call.callee is not None and call.callee.definition
    position = None if own else api.code_argument(name)
    meanings = list(api.meaning(name).get("parameters", [])) if position is not None else []
    handed = meanings.index("handed") if "handed" in meanings else None
    if position is None or handed is None or max(position, handed) >= len(arguments):
        return None, None
    code: ccode.Expression | None = arguments[position]
    while isinstance(code, (ccode.Cast, ccode.Unary)):
        code = code.operand
    target = code.target if isinstance(code, ccode.NameReference) else None
    return (arguments[handed], target) if isinstance(target, ccode.Function) else (None, None)
