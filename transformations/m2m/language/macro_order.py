"""Whether a cast in a macro's body keeps the order of evaluation of every use of the macro.

`#define SCALE(v, k) v * k` used as `SCALE(a + 1, 2)` is `a + 1 * 2`. A cast of `v` needs parentheses, which would make it `(a +
1) * 2`. So a cast is written there only if, as far as the text tells, every use passes a single operand for `v`.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import cached_property

from msgspec import Struct

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.lexer import Token, closing
from robosmi.transformations.queries.macros.argument_places import TokenText
from robosmi.transformations.queries.macros.macro_definitions import Definition, TextPlace, macros_of
from robosmi.transformations.queries.macros.tokens import name_tokens

_SIGNS = frozenset("-+!~*&")
_BEFORE = frozenset(["(", "[", "{", "}", ",", ";", "=", "return"])
_BEHIND = frozenset([")", "]", "}", ",", ";"])


class _Use(Struct, frozen=True):
    """A use of a macro: its arguments, the tokens before and after it, and the parameters of the macro whose body contains it."""

    given: Sequence[Sequence[Token]]
    before: str
    behind: str
    names: Collection[str]


class MacroOrder(Struct, dict=True):
    """The macros of a program and their uses, for judging where parentheses may be inserted.

    Attributes:
        units: the program's units.
        texts: path of a unit -> its bytes.
    """

    units: Sequence[ccode.SourceUnit]
    texts: Mapping[str, bytes]

    def __post_init__(self) -> None:
        self._stays: dict[TextPlace, bool] = {}
        self._loose: dict[str, bool] = {}

    def stays(self, place: TextPlace) -> bool:
        """Whether parentheses around a part of a macro's body keep the meaning of every use."""
        if place not in self._stays:
            self._stays[place] = self._judged(place)
        return self._stays[place]

    def computed_before(self, place: TextPlace) -> bool:
        """Whether a place is in a macro that a preprocessor condition evaluates (`#if PIN(3) > 12`), where no casts are
        allowed.
        """
        return place.body and any(
            m.unit == place.unit and m.name in self._in_conditions and _within(m.body, place) for m in self._macros
        )

    @cached_property
    def _in_conditions(self) -> set[str]:
        """The macros that preprocessor conditions use, directly or through other macros."""
        conditions = " ".join(str(each.condition or "") for unit in self.units for each in unit.conditionals)
        waiting = [name for _, _, name in name_tokens(conditions.encode())]
        found: set[str] = set()
        while waiting:
            name = waiting.pop()
            if name in self._by_name and name not in found:
                found.add(name)
                waiting += [word[3] for macro in self._macros if macro.name == name for word in macro.body if word[0] == "name"]
        return found

    def _judged(self, place: TextPlace) -> bool:
        macro = next((each for each in self._macros if each.unit == place.unit and _within(each.body, place)), None)
        if macro is None:
            return True
        inside = _within(macro.body, place)
        known = macro.parameters or ()
        open_ = {
            known.index(word[3]) for at, word in enumerate(macro.body)
            if word in inside and word[3] in known and not self._alone(macro.body, at)
        }  # fmt: skip
        whole = len(inside) == len(macro.body) and not _operand(inside)[0]
        return all(
            all(number < len(use.given) and self._one_operand(use.given[number], use.names) for number in open_)
            and not (whole and not (use.before in _BEFORE and use.behind in _BEHIND))
            for use in self._uses.get(macro.name, ())
        )

    def _alone(self, words: Sequence[Token], at: int) -> bool:
        """Whether a token is enclosed by parentheses that are not those of a macro call."""
        inside = 0 < at < len(words) - 1 and words[at - 1][3] == "(" and words[at + 1][3] == ")"
        return inside and (at < 2 or words[at - 2][3] not in self._by_name)

    def _one_operand(self, words: Sequence[Token], names: Collection[str]) -> bool:
        """Whether an argument is a single operand in any context; false for a parameter of another macro (unknown)."""
        whole, first = _operand(words)
        return whole and first not in names and not self._is_loose(first)

    def _is_loose(self, name: str) -> bool:
        """Whether a name is a macro that expands to more than one operand, directly or through the macro its body begins with."""
        chain: list[str] = []
        loose = False
        while name in self._by_name and name not in self._loose and name not in chain:
            chain.append(name)
            macro = self._by_name[name]
            whole, name = _operand(macro.body)
            loose = not whole or name in (macro.parameters or ())
            if loose:
                break
        loose = loose or self._loose.get(name, False)
        self._loose.update(dict.fromkeys(chain, loose))
        return loose

    @cached_property
    def _macros(self) -> list[Definition]:
        return [each for same in macros_of(self.units, self.texts).values() for each in same]

    @cached_property
    def _by_name(self) -> dict[str, Definition]:
        return {each.name: each for each in self._macros}

    @cached_property
    def _uses(self) -> dict[str, list[_Use]]:
        """The uses of each macro by its name, in the text of the units and in bodies of macros."""
        found: dict[str, list[_Use]] = {}
        for unit in self.units:
            for name, use in self._uses_in(TokenText(self.texts[unit.path]), ()):
                found.setdefault(name, []).append(use)
        for macro in self._macros:
            if macro.body:
                start = macro.body[0][1]
                text = TokenText(self.texts[macro.unit][start : macro.body[-1][2]], start)
                for name, use in self._uses_in(text, macro.parameters or ()):
                    found.setdefault(name, []).append(use)
        return found

    def _uses_in(self, text: TokenText, names: Collection[str]) -> Iterator[tuple[str, _Use]]:
        words = text.tokens
        for at, (kind, _, _, name) in enumerate(words):
            if kind != "name" or name not in self._by_name:
                continue
            given = text.arguments(at) if self._by_name[name].parameters is not None else []
            if given is None:
                continue
            last = closing(words, at + 1) if self._by_name[name].parameters is not None else at
            behind = words[last + 1][3] if last + 1 < len(words) else ")"
            yield name, _Use(given, words[at - 1][3] if at else "(", behind, names)


def _within(words: Sequence[Token], place: TextPlace) -> list[Token]:
    return [word for word in words if place.start <= word[1] and word[2] <= place.end]


def _operand(words: Sequence[Token]) -> tuple[bool, str]:
    """Whether tokens form a single operand (prefix signs and postfix operators included), and its first token after the signs."""
    at = 0
    while at < len(words) - 1 and words[at][3] in _SIGNS:
        at += 1
    if at >= len(words):
        return True, ""
    first = words[at][3]
    at = closing(words, at) + 1 if first == "(" else at + 1
    while at < len(words):
        if words[at][3] in ("(", "["):
            at = closing(words, at) + 1
        elif words[at][3] in (".", "->"):
            at += 2
        else:
            return False, first
    return True, first
