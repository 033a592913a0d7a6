"""Flows of port numbers through macros: bodies that hold a number, a call of a platform function, or pass a parameter on.

Bodies are no syntax, so their tokens are read: a single number, name or parameter is followed, anything else is a calculation
that keeps its numbers.
"""

from __future__ import annotations

import re
from collections.abc import Hashable, Mapping, Sequence

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.lexer import Token
from robosmi.transformations.queries.argument_places import TokenText, bare
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.constant_text import c_integer
from robosmi.transformations.queries.flow_reader import FlowReader
from robosmi.transformations.queries.macro_definitions import REST
from robosmi.transformations.queries.pin_uses import pin_number
from robosmi.transformations.queries.tokens import names_in
from robosmi.transformations.queries.value_flows import PinArgument

_DIRECTIVE = re.compile(r"#\s*(define|if|elif)\b(.*)", re.DOTALL)
_INTEGER = re.compile(r"(0[xX][0-9a-fA-F]+|0[bB][01]+|[0-9]+)[uUlL]*\Z")
MOST_FOR_DOTS = 16
"""Number of arguments for a macro's `...` that are followed separately."""


def follow_macros(reader: FlowReader) -> None:
    """Add the exchanges of values in the bodies of all macros of a program to its flows."""
    bodies: dict[str, set[str]] = {}
    for view in reader.views:
        for macro in view.unit.macros:
            bodies.setdefault(str(macro.name), set()).add(str(macro.body).strip())
        for token in reader.texts[view.unit.path].tokens:
            if token[0] == "directive":
                _directive(token[3], reader, bodies)
        for use in view.unit.macroUses:
            _plain_arguments(reader, view, use)
    for view in reader.views:
        for macro in view.unit.macros:
            _MacroBody(reader, view, macro).follow()
    for name, different in bodies.items():
        if len(different) > 1:
            reader.flows.keep(("macro", name), f"'{name}' is defined in more than one way")


def _directive(text: str, reader: FlowReader, bodies: dict[str, set[str]]) -> None:
    """Read other definitions of a macro, also in text that is not compiled, and keep the flows of macros that `#if` tests."""
    match = _DIRECTIVE.match(text)
    if match is None:
        return
    if match[1] == "define":
        found = re.match(r"\s*(\w+)(.*)", match[2], re.DOTALL)
        if found is not None and found[1] in reader.macros and not found[2].startswith("("):
            body = TokenText(found[2].encode("latin-1"))
            known = TokenText(str(reader.macros[found[1]].body).encode("latin-1", errors="replace"))
            if [t[3] for t in body.tokens] != [t[3] for t in known.tokens]:
                bodies.setdefault(found[1], set()).add(found[2])
        return
    for name in sorted(names_in(re.sub(r"\bdefined\s*\(?\s*\w+\s*\)?", " ", match[2]))):
        if name in reader.macros:
            reader.flows.keep(("macro", name), f"'{name}' is tested by #{match[1]}")


def _plain_arguments(reader: FlowReader, view: CodeView, use: ccode.MacroUse) -> None:
    """Follow the arguments of a macro use that the code model has no expressions for."""
    macro = use.macro or reader.macros.get(str(use.name))
    if macro is None or not macro.functionLike:
        return
    text = reader.texts[view.unit.path]
    for i, argument in enumerate(text.arguments(text.at(int(use.startOffset))) or []):
        tokens = bare(argument)
        known = argument and (view.unit.path, argument[0][1], argument[-1][2]) in reader.followed
        if not known and tokens:
            follow_argument(reader, view.unit, argument, ("macro parameter", str(macro.name), i), [])


def follow_argument(
    reader: FlowReader, unit: ccode.SourceUnit, argument: Sequence[Token], taker: Hashable, own: Sequence[str], macro: str = ""
) -> None:
    """Join the flow of an argument, given as tokens, with that of what it is passed to.

    Args:
        reader: the program's flows.
        unit: the unit that contains the tokens.
        argument: the tokens.
        taker: the key of what the argument is passed to.
        own: parameters of the macro whose body contains the tokens, `__VA_ARGS__` last if it is variadic.
        macro: the name of that macro; empty for tokens in the program's text.
    """
    tokens = bare(argument)
    if len(tokens) == 1 and tokens[0][0] == "number" and (number := _INTEGER.match(tokens[0][3])):
        place = ("place", unit.path, tokens[0][1])
        if not reader.flows.has(taker, str(unit.path), tokens[0][1]):
            reader.put(
                place, unit, tokens[0][1], tokens[0][2], pin_number(c_integer(number[1])), _element(reader, unit, tokens[0]), ""
            )
            reader.flows.join(taker, place)
        return
    if len(tokens) == 1 and tokens[0][0] == "name":
        keys = keys_of(reader, tokens[0][3], own, macro)
        for key in keys:
            reader.flows.join(taker, key)
        if not keys:  # declared in the body itself, or nowhere
            reader.flows.keep(taker, f"'{tokens[0][3]}' is not the program's own", computed=True)
        return
    for token in tokens:
        if token[0] == "name":
            for key in keys_of(reader, token[3], own, macro):
                reader.flows.keep(key, f"'{token[3]}' is calculated with")
    if tokens:
        reader.flows.keep(taker, "a macro calculates it", computed=True)


def _element(reader: FlowReader, unit: ccode.SourceUnit, token: Token) -> ccode.Located:
    """The element of the code model that contains a number in a macro: the macro's definition or a use of it."""
    return reader.holders[unit.path].at(token[1]) or unit.macroUses[0]


def body_names(macro: ccode.Macro) -> list[str]:
    """The names of a macro's parameters in its body; the last one stands for all arguments passed for `...`."""
    return [str(p).removesuffix("...").strip() or REST for p in macro.parameters]


def keys_of(reader: FlowReader, name: str, own: Sequence[str], macro: str) -> list[Hashable]:
    """The keys of what a name in a macro's body denotes: a parameter of the macro, another macro, any declaration."""
    return [("macro parameter", macro, list(own).index(name))] if name in own else reader.named(name)


class _MacroBody:
    """Follows the values that pass through the body of one macro.

    Args:
        reader: the program's flows.
        view: of the unit.
        macro: the macro.
    """

    def __init__(self, reader: FlowReader, view: CodeView, macro: ccode.Macro) -> None:
        self.reader, self.view, self.macro, self.name = reader, view, macro, str(macro.name)
        start = int(macro.startOffset) + 1
        self.text = TokenText(reader.sources[view.unit.path][start : int(macro.endOffset)], start)
        self.own = body_names(macro)
        self.rest = self.own[-1] if self.own and str(macro.parameters[-1]).endswith("...") else ""
        self.begin = self._begin()
        self.done: set[int] = set()

    def _begin(self) -> int:
        """Index of the first token of the body: behind `define`, the name and its parameters."""
        index = next((i for i, t in enumerate(self.text.tokens) if t[3] == self.name), len(self.text.tokens)) + 1
        if not self.macro.functionLike:
            return index
        closing = (i for i in range(index, len(self.text.tokens)) if self.text.tokens[i][3] == ")")
        return next(closing, len(self.text.tokens)) + 1

    def follow(self) -> None:
        """Join the flows of what the body passes on; keep the numbers of what it uses in any other way."""
        flows, key = self.reader.flows, ("macro", self.name)
        body = bare(self.text.tokens[self.begin :])
        if not self.macro.functionLike and len(body) == 1 and body[0][0] in ("number", "name"):
            self._single(body[0], key)
            return
        if not self.macro.functionLike:
            listed = bool(body) and body[0][3] == "{" and all(t[0] == "number" or t[3] in ("{", ",", "}") for t in body)
            flows.keep(key, f"'{self.name}' is {'a list' if listed else 'calculated'}", computed=not listed)
            flows.of(key).given.append((self.view.unit, self.macro))
            for token in body if body and body[0][3] == "{" else ():
                if token[0] == "number" and (number := _INTEGER.match(token[3])):
                    value = pin_number(c_integer(number[1]))
                    self.reader.put(key, self.view.unit, token[1], token[2], value, self.macro, self.name)
        for index in range(self.begin, len(self.text.tokens)):
            pasted = self.text.tokens[index - 1][3] == "##"  # its name is another one
            if self.text.tokens[index][0] == "name" and not pasted and (arguments := self.text.arguments(index)) is not None:
                self._call(self.text.tokens[index][3], arguments)
        for index in range(self.begin, len(self.text.tokens)):
            token = self.text.tokens[index]
            if token[0] == "name" and token[1] not in self.done:
                for other in keys_of(self.reader, token[3], self.own, self.name):
                    flows.keep(other, f"'{token[3]}' is used in the macro '{self.name}'")

    def _single(self, token: Token, key: Hashable) -> None:
        if token[0] == "name":
            for other in self.reader.named(token[3]) or [("name", token[3])]:
                if other[:1] == ("name",):  # type: ignore[index]
                    self.reader.flows.keep(other, f"'{token[3]}' is not the program's own", computed=True)
                self.reader.flows.join(key, other)
        elif number := _INTEGER.match(token[3]):
            value = pin_number(c_integer(number[1]))
            self.reader.put(key, self.view.unit, token[1], token[2], value, self.macro, self.name)
        else:
            self.reader.flows.keep(key, f"'{self.name}' is no whole number", computed=True)

    def _call(self, name: str, arguments: list[list[Token]]) -> None:
        """Follow the arguments of a call in the body."""
        reader = self.reader
        takers: dict[int, Hashable] = {}
        other = reader.macros.get(name)
        function = reader.functions.get(name)
        if other is not None and other.functionLike:
            takers = {i: ("macro parameter", name, i) for i in range(max(len(arguments), MOST_FOR_DOTS))}
        elif function is not None:
            takers = {i: reader.key(p) for i, p in enumerate(function.parameters)}
        else:
            listed = next((i for i, a in enumerate(arguments) if self._is_rest(a)), len(arguments))
            for parameter in reader.pins(name, self.view):
                if parameter.position < min(listed, len(arguments)) and arguments[parameter.position]:
                    first, last = arguments[parameter.position][0], arguments[parameter.position][-1]
                    key: Hashable = ("pin", self.view.unit.path, first[1])
                    takers[parameter.position] = key
                    reader.reach(key, PinArgument(self.view.unit, first[1], last[2], name, parameter))
                elif listed < len(arguments):  # its place is found where the macro is used (`made_pins`)
                    takers[parameter.position] = ("pin for dots", self.name, listed, name, parameter.position)
        for position, argument in enumerate(arguments):
            if self._is_rest(argument):
                self._pass_on(position, takers, name)
                self.done.add(argument[-1][1])
            elif position in takers:
                tokens = bare(argument)
                if len(tokens) == 1:
                    self.done.add(tokens[0][1])
                follow_argument(reader, self.view.unit, argument, takers[position], self.own, self.name)

    def _is_rest(self, argument: Sequence[Token]) -> bool:
        """Whether an argument is `__VA_ARGS__`, which stands for any number of arguments."""
        return bool(self.rest) and [token[3] for token in argument if token[3] != "##"] == [self.rest]

    def _pass_on(self, position: int, takers: Mapping[int, Hashable], name: str) -> None:
        """Join each argument passed for `...` with the parameter that takes it, from `position` on."""
        for behind in range(MOST_FOR_DOTS):
            given = ("macro parameter", self.name, len(self.own) - 1 + behind)
            if position + behind in takers:
                self.reader.flows.join(takers[position + behind], given)
            else:
                self.reader.flows.keep(given, f"it goes to '{name}' in the macro '{self.name}'")
