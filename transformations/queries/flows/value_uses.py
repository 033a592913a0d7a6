"""What the values of a program are used for: whether each use is followed, or the numbers of its flow must not be changed.

A number may be changed where it is written only if nothing else reads it on its way: it must not be printed, calculated with,
compared, tested, used as an index or passed to an unknown function.
"""

from __future__ import annotations

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import all_contents, all_of_kind, ancestor_of_kind
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.flows.class_pins import follows_argument, method_pins
from robosmi.transformations.queries.flows.cores import handed_over
from robosmi.transformations.queries.flows.flow_reader import FlowReader
from robosmi.transformations.queries.flows.listed_values import gone_through
from robosmi.transformations.queries.flows.pointers import gives_access
from robosmi.transformations.queries.member_records import records_as_bytes
from robosmi.transformations.queries.numbers import COMPARISONS

_LOGICAL = frozenset(["&&", "||"])
_HARMLESS = frozenset(["Cast", "Variable", "Return", "ExpressionStatement", "SizeOf", "Member"])
_TESTS = frozenset(["If", "While", "DoWhile", "For", "Switch", "Case"])
_VALUES = (
    ccode.NameReference, ccode.Index, ccode.Call, ccode.Cast, ccode.Assignment, ccode.Member, ccode.ConditionalExpression,
    ccode.Unary,
)  # fmt: skip


class ValueUses:
    """Finds the uses of values that forbid changing the numbers of a flow.

    Args:
        reader: the flows of the program.
    """

    def __init__(self, reader: FlowReader) -> None:
        self.reader = reader
        self._has_macros = any(macro.functionLike for view in reader.views for macro in view.unit.macros)
        self._has_records = any(view.of_kind(ccode.Record) for view in reader.views)

    def follow(self, view: CodeView) -> None:
        """Keep the numbers of all flows of a unit that have a value used in a way that is not followed."""
        for element in view.elements:
            if isinstance(element, _VALUES):
                self._use(element, view)
        if self._has_macros:
            self._repeated(view)
        for each in view.of_kind(ccode.UnknownExpression):
            self._given_back(each)
        if view.unit.language == "C++":
            self._template_arguments(view)
        for record, element in records_as_bytes(view, self.reader.classes.around, handed_over) if self._has_records else ():
            why = f"line {element.line} accesses its bytes"
            self.reader.loosen(record, why)
            self.reader.flows.freeze(self.reader.value(element), why, computed=True)

    def _repeated(self, view: CodeView) -> None:
        """Keep the numbers that a macro uses several times (`MAX(18, 17)`), once in a way that is not followed."""
        places: dict[int, list[ccode.IntegerLiteral]] = {}
        for literal in view.of_kind(ccode.IntegerLiteral):
            places.setdefault(int(literal.startOffset), []).append(literal)
        flows, path = self.reader.flows, str(view.unit.path)
        for start, same in places.items():
            followed = [each for each in same if flows.has(self.reader.key(each), path, start)]
            others = [each for each in same if each not in followed] if followed and len(same) > 1 else []
            whys = [self._why_kept(each, each.eContainer(), view) for each in others if _expansion(each) is None]
            for each in followed if any(whys) else ():
                self.reader.flows.freeze(self.reader.value(each), next(filter(None, whys)))

    def _given_back(self, made: ccode.UnknownExpression) -> None:
        """Keep the numbers that a lambda returns or a statement expression ends with: what becomes of them is not followed."""
        if isinstance(made, ccode.Lambda):
            values = [statement.value for statement in all_of_kind(made, ccode.Return)]
        else:
            last = made.body.statements[-1:] if made.body is not None else []
            values = [statement.expression for statement in last if isinstance(statement, ccode.ExpressionStatement)]
        for value in values:
            if value is not None:
                self.reader.flows.freeze(self.reader.value(value), f"a lambda or block gives it back (line {value.line})")

    def _template_arguments(self, view: CodeView) -> None:
        """Keep the numbers of names in arguments of templates (`step<LED>()`), which the code model does not have."""
        known = {int(reference.startOffset) for reference in view.of_kind(ccode.NameReference)}
        tokens = self.reader.texts[view.unit.path].tokens
        opened: list[bool] = []  # of each bracket around a token, whether it may be that of a template
        for before, (kind, start, _, text) in zip([("", 0, 0, ""), *tokens], tokens, strict=False):
            if text in (";", "{", "}"):
                opened = []
            elif text in ("(", "<"):
                opened.append(text == "<" and before[0] == "name")
            elif text in (")", ">") and opened:
                opened.pop()
            elif kind == "name" and any(opened) and start not in known:
                for key in self.reader.named(text):
                    self.reader.flows.freeze(key, f"'{text}' is an argument of a template")

    def _use(self, expression: ccode.Expression, view: CodeView) -> None:
        """Keep the numbers of a value's flow if its use is not followed."""
        if isinstance(expression, ccode.Unary) and str(expression.operator) not in ("*", "&"):
            return
        expanded = _expansion(expression)
        if expanded is not None:
            place = (view.unit.path, int(expression.startOffset), int(expression.endOffset))
            takers = self.reader.given.get(place)
            if takers is not None:
                self.reader.followed.add(place)
                for taker in takers:
                    self.reader.flows.join(taker, self.reader.value(expression))
                return
            if place[1:] == (int(expanded.startOffset), int(expanded.endOffset)):
                return  # of the macro's own body
        why = self._why_kept(expression, expression.eContainer(), view)
        if why:
            self.reader.flows.freeze(self.reader.value(expression), why, computed=gives_access(expression))

    def _why_kept(self, expression: ccode.Expression, parent: Element | None, view: CodeView) -> str:
        kind = type(parent).__name__
        if kind in _HARMLESS or (isinstance(parent, ccode.Index) and parent.array is expression):
            return ""
        if isinstance(parent, ccode.For) and parent.range is expression and gone_through(parent) is not None:
            return ""
        name = f"'{expression.name}'" if isinstance(expression, ccode.NameReference) else "it"
        line = f"(line {expression.line})"
        if isinstance(parent, ccode.ConditionalExpression):
            return "" if parent.condition is not expression else f"{name} is tested {line}"
        if isinstance(parent, ccode.Unary):
            if str(parent.operator) in ("++", "--"):
                self.reader.calculated(self.reader.value(expression), parent)
                return ""
            return "" if str(parent.operator) in ("*", "&") else f"{name} is calculated with {line}"
        if isinstance(parent, ccode.Assignment):
            return "" if str(parent.operator) == "=" else f"{name} is calculated with {line}"
        if isinstance(parent, ccode.Binary):
            operator = str(parent.operator)
            if operator == ",":
                return self._why_kept(parent, parent.eContainer(), view) if parent.right is expression else ""
            if operator in COMPARISONS:
                return f"{name} is compared {line}"
            return f"{name} is {'tested' if operator in _LOGICAL else 'calculated with'} {line}"
        if isinstance(parent, ccode.Call):
            return self._passed(expression, parent, view, name, line)
        if isinstance(parent, ccode.InitializerList):
            return ""
        if isinstance(parent, (ccode.ConstructorCall, ccode.MemberInitializer)):
            position = next((i for i, a in enumerate(parent.arguments) if a is expression), -1)
            made = parent.className if isinstance(parent, ccode.ConstructorCall) else parent.name
            return "" if follows_argument(self.reader.classes, parent, position, view) else f"{name} goes to '{made}' {line}"
        return f"{name} is {'an index' if kind == 'Index' else 'tested' if kind in _TESTS else 'used in another way'} {line}"

    def _passed(self, expression: ccode.Expression, call: ccode.Call, view: CodeView, name: str, line: str) -> str:
        arguments = list(call.arguments)
        position = next((i for i, a in enumerate(arguments) if a is expression), None)
        if position is None or call.viaMacro:
            return "" if position is None else f"{name} goes through a macro {line}"
        if own := self.reader.called(call):
            taken = all(position < len(function.parameters) for function in own)
            return "" if taken else f"{name} goes to '{call.calleeName}' {line}"
        method = method_pins(self.reader.classes, call, view)
        if method is not None and any(p.position == position for p in method[1]):
            return ""
        if any(p.position == position for p in self.reader.pins(str(call.calleeName or ""), view)):
            return ""
        return f"{name} goes to '{call.calleeName or 'a function'}' {line}"


def _expansion(expression: ccode.Expression) -> ccode.Call | None:
    """The call in a macro's expansion that an expression is part of; None for an expression in the text itself."""
    call = expression if isinstance(expression, ccode.Call) else ancestor_of_kind(expression, ccode.Call)
    while call is not None and not call.viaMacro:
        call = ancestor_of_kind(call, ccode.Call)
    return call if isinstance(call, ccode.Call) else None


def changes_nothing(value: ccode.Expression) -> bool:
    """Whether an expression has no side effects, so that it may be evaluated twice or not at all; calls count as effects."""
    return not any(
        isinstance(each, (ccode.Call, ccode.Assignment)) or (isinstance(each, ccode.Unary) and each.operator in ("++", "--"))
        for each in (value, *all_contents(value))
    )
