"""Expands the program's own macros in a text, and keeps where each resulting token is written.

So what a macro computes can be typed like any other expression, and a change of it can be placed at the use, in the macro's
body, or in the argument. Macros of headers that are not the program's stay as they are. Source: ISO/IEC 9899:1999, 6.10.3; a
use whose arguments reach across a directive is left alone.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Mapping, Sequence

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.lexer import Token, tokens
from robosmi.transformations.queries.macros.macro_definitions import Definition, Frame, MacroToken, Path, TextPlace, definition_of

MOST_TOKENS = 400_000
"""Tokens of an expanded text; what would become longer is left as it is."""
MOST_TOKENS_OF_A_NUMBER = 2_000
"""Tokens of a short text, such as what a macro gives for a number."""
DEEPEST = 400
"""Macros within macros; a use that needs more is left as it is."""
_DEEP = 100
"""Path length above which an expanded token counts more than once against `MOST_TOKENS`, since its path takes memory."""


class MacroTexts:
    """The expanded texts of macros, for short texts that need no places in the source.

    Args:
        macros: the program's macros by name.
    """

    def __init__(self, macros: Mapping[str, ccode.Macro]) -> None:
        self._macros = macros
        self._known: dict[str, list[Definition]] = {}

    def expanded(self, text: str) -> str | None:
        """A text with all macros in it expanded; None where that is too much."""
        data = text.encode("latin-1", "replace")
        found = list(tokens(data))
        pending = [word for kind, _, _, word in found if kind == "name"]
        while pending:
            name = pending.pop()
            if name in self._macros and name not in self._known:
                self._known[name] = [made] if (made := definition_of(self._macros[name])) is not None else []
                words = [token[3] for each in self._known[name] for token in each.body]
                pending += self._macros if "##" in words else words  # it may make the name of any
        starts = (start for kind, start, _, word in found if kind == "name" and word in self._macros)
        whole = Expanded("", data, found, starts, self._known, MOST_TOKENS_OF_A_NUMBER)
        return whole.data.decode("latin-1").strip() if whole.whole else None


class Expanded:
    """A unit's text with its macros expanded, and where each of its tokens is written in the source.

    Attributes:
        data: the expanded text.
        changed: whether it differs from the file's text.
        whole: whether every use was expanded; False where one would have become too long or too deep.
        stayed: the places of the uses that were not expanded.
    """

    def __init__(
        self, unit: str, data: bytes, found: Sequence[Token], uses: Iterable[int], macros: Mapping[str, list[Definition]],
        most: int = MOST_TOKENS,
    ):  # fmt: skip
        self.unit = unit
        self._macros = macros
        self._left = most
        self._starts: list[int] = []
        self._ends: list[int] = []
        self._paths: list[Path] = []
        self.changed = False
        self.whole = True
        self.stayed: list[TextPlace] = []
        self.data = self._expand_file(data, found, set(uses))

    def _expand_file(self, data: bytes, found: Sequence[Token], uses: set[int]) -> bytes:
        out = bytearray()
        done = 0
        plain = [t for t in found if t[0] != "comment"]
        number = 0
        while number < len(plain):
            kind, start, end, _ = plain[number]
            out += data[done:start]
            done = start
            if start in uses and kind == "name" and (used := self._use(plain, number)) is not None:
                made, number, end = used
                self.changed = True
                for one in made:
                    self._add(len(out) + 1, one.text, one.path)
                    out += b" " + one.text.encode("latin-1", "replace")
                out += b" "
                done = end
                continue
            out += data[start:end]
            if kind != "directive":
                self._starts.append(len(out) - (end - start))
                self._ends.append(len(out))
                self._paths.append((Frame(self.unit, start, end, False),))
            done = end
            number += 1
        out += data[done:]
        return bytes(out)

    def _add(self, start: int, text: str, path: Path) -> None:
        self._starts.append(start)
        self._ends.append(start + len(text))
        self._paths.append(path)

    def _use(self, plain: Sequence[Token], number: int) -> tuple[list[MacroToken], int, int] | None:
        """The expansion of a macro use in the file, the index of the token after it, and its end; None if it stays as it is."""
        macro = self._meant(plain[number][3], plain[number][1])
        if macro is None:
            return None
        pieces = [MacroToken(plain[number][0], plain[number][3], (Frame(self.unit, plain[number][1], plain[number][2], False),))]
        at, behind = plain[number][1], number + 1
        if macro.parameters is not None and (behind := self._arguments(plain, behind, pieces)) == number + 1:
            return None
        made = self._expanded(pieces, frozenset(), at)
        while made and self._takes_more(made[-1], frozenset(), at) and (end := self._arguments(plain, behind, pieces)) > behind:
            behind, made = end, self._expanded(pieces, frozenset(), at)
        if made is None:
            self.whole = False
            self.stayed.append(TextPlace(self.unit, plain[number][1], plain[number][2]))
        return (made, behind, pieces[-1].path[-1].end) if made is not None else None

    def _arguments(self, plain: Sequence[Token], number: int, pieces: list[MacroToken]) -> int:
        """Append the parenthesised tokens at `number` to `pieces`; the index after them, `number` itself if there are none."""
        if number >= len(plain) or plain[number][3] != "(":
            return number
        found: list[MacroToken] = []
        depth = 0
        for kind, start, end, text in plain[number:]:
            if kind == "directive":
                return number
            found.append(MacroToken(kind, text, (Frame(self.unit, start, end, False),)))
            depth += {"(": 1, ")": -1}.get(text, 0) if kind == "punct" else 0
            if depth == 0:
                pieces += found
                return number + len(found)
        return number

    def _takes_more(self, piece: MacroToken, hidden: frozenset[str], offset: int) -> bool:
        """Whether a token of an expansion is a function-like macro, whose arguments may follow after the use."""
        macro = self._meant(piece.text, offset) if piece.kind == "name" and piece.text not in hidden else None
        return macro is not None and macro.parameters is not None

    def _meant(self, name: str, offset: int) -> Definition | None:
        """The definition of a macro that applies at an offset of the file: the last one before it, else one of another file."""
        given = self._macros.get(name, ())
        here = [d for d in given if d.unit == self.unit and d.offset < offset]
        return here[-1] if here else next((d for d in given if d.unit != self.unit), None)

    def _expanded(self, pieces: Sequence[MacroToken], hidden: frozenset[str], offset: int) -> list[MacroToken] | None:
        """Tokens with all macros expanded; None if they become too many or the macros nest too deeply."""
        if len(hidden) > DEEPEST:
            return None
        out: list[MacroToken] = []
        number = 0
        while number < len(pieces):
            piece = pieces[number]
            macro = self._meant(piece.text, offset) if piece.kind == "name" and piece.text not in hidden else None
            used = self._call(pieces, number, macro) if macro is not None else None
            self._left -= 1 + len(piece.path) // _DEEP
            if self._left < 0:
                return None
            if macro is None or used is None:
                out.append(piece)
                number += 1
                continue
            arguments, behind = used
            level, last = len(piece.path) - 1, pieces[behind - 1].path
            while level and (last[:level] != piece.path[:level] or len(last) <= level):
                level -= 1  # its arguments stand behind the use that made its name
            frame = Frame(piece.path[level].unit, piece.path[level].start, last[level].end, piece.path[level].body)
            made = self._substituted(macro, arguments, (*piece.path[:level], frame), level, hidden, offset)
            again = self._expanded(made, hidden | {macro.name}, offset) if made is not None else None
            if again is None:
                return None
            if again and behind < len(pieces) and pieces[behind].text == "(" and self._takes_more(again[-1], hidden, offset):
                pieces, number = [again.pop(), *pieces[behind:]], 0
            else:
                number = behind
            out += again
        return out

    @staticmethod
    def _call(pieces: Sequence[MacroToken], number: int, macro: Definition) -> tuple[list[list[MacroToken]], int] | None:
        """The arguments of a macro use and the index of the token after it; None where the name is not used as a macro."""
        if macro.parameters is None:
            return [], number + 1
        if number + 1 >= len(pieces) or pieces[number + 1].text != "(":
            return None
        arguments: list[list[MacroToken]] = [[]]
        depth, behind = 1, number + 2
        while behind < len(pieces):
            piece = pieces[behind]
            behind += 1
            if piece.kind == "punct":
                if piece.text in "([{":
                    depth += piece.text == "("
                elif piece.text == ")":
                    depth -= 1
                    if depth == 0:
                        break
                elif piece.text == "," and depth == 1 and not (macro.variadic and len(arguments) == len(macro.parameters)):
                    arguments.append([])
                    continue
            arguments[-1].append(piece)
        if depth:
            return None
        if len(macro.parameters) == 0 and arguments == [[]]:
            arguments = []
        if macro.variadic and len(arguments) == len(macro.parameters) - 1:
            arguments.append([])
        return (arguments, behind) if len(arguments) == len(macro.parameters) else None

    def _substituted(
        self, macro: Definition, arguments: list[list[MacroToken]], prefix: Path, level: int, hidden: frozenset[str], offset: int
    ) -> list[MacroToken] | None:
        """A macro's body with its arguments substituted (ISO C 6.10.3.1 to 6.10.3.3); None if it becomes too long."""
        given = dict(zip(macro.parameters or (), arguments, strict=True))
        out: list[MacroToken] = []
        body = macro.body
        number = 0
        joins = blank = False
        while number < len(body):
            kind, start, end, text = body[number]
            here = (*prefix, Frame(macro.unit, start, end, True))
            following = body[number + 1][3] if number + 1 < len(body) else ""
            if text == "#" and macro.parameters is not None and following in given:
                shown = " ".join(p.text for p in given[following]).replace("\\", "\\\\").replace('"', '\\"')
                out.append(MacroToken("string", f'"{shown}"', (*prefix, Frame(macro.unit, start, body[number + 1][2], True))))
                number += 2
                continue
            if text == "##":
                joins = True
                number += 1
                continue
            if text in given and kind == "name":
                raw = joins or following == "##"
                inner = given[text] if raw else self._expanded(given[text], hidden, offset)
                if inner is None:
                    return None
                made = [MacroToken(p.kind, p.text, (*here, *p.path[level:])) for p in inner]
            else:
                made = [MacroToken(kind, text, here)]
            rest = macro.variadic and text == (macro.parameters or [""])[-1]
            if joins and rest and out and out[-1].text == ",":  # GNU: no arguments, no comma before them
                del out[len(out) - (not made) :]
            elif joins and out and made and not blank:
                last = out.pop()
                whole = Frame(macro.unit, last.path[len(prefix)].start, end, True)  # both sides: neither alone is the token
                made[0] = MacroToken(last.kind, last.text + made[0].text, (*prefix, whole))
            blank = not made and (blank or not joins)
            joins = False
            out += made
            number += 1
        return out

    def places(self, start: int, end: int) -> tuple[TextPlace, ...]:
        """The source ranges that a range of the expanded text can be changed by, outermost first.

        Empty if the range is no whole tokens, or if no source range stands for exactly it.
        """
        first = bisect_right(self._starts, start) - 1
        last = bisect_right(self._starts, end - 1) - 1
        if first < 0 or last < first or self._starts[first] != start or self._ends[last] != end:
            return ()
        paths = self._paths
        one, other = paths[first], paths[last]
        if len(one) == 1 and len(other) == 1:
            return (TextPlace(self.unit, one[0].start, other[0].end),)
        before = paths[first - 1] if first else ()
        behind = paths[last + 1] if last + 1 < len(paths) else ()
        found = []
        for level in range(min(len(one), len(other))):
            if one[:level] != other[:level]:
                break
            if one[level].unit != other[level].unit or one[level].body != other[level].body:
                break
            if before[: level + 1] == one[: level + 1] or behind[: level + 1] == other[: level + 1]:
                continue
            found.append(TextPlace(one[level].unit, one[level].start, other[level].end, one[level].body))
        return tuple(found)

    def path(self, start: int) -> Path:
        """The expansion path of the token that begins at an offset of the expanded text; empty where none begins."""
        at = bisect_left(self._starts, start)
        return self._paths[at] if at < len(self._starts) and self._starts[at] == start else ()


def expanded_unit(unit: ccode.SourceUnit, data: bytes, macros: Mapping[str, list[Definition]]) -> Expanded:
    """The text of a unit with the macros expanded that are used in it where it is compiled.

    Args:
        unit: the unit.
        data: its bytes; those that are not ASCII become question marks.
        macros: the program's, by name.
    """
    plain = data if data.isascii() else bytes(b if b < 128 else 63 for b in data)
    return Expanded(unit.path, plain, tokens(plain), {int(u.startOffset) for u in unit.macroUses if u.name in macros}, macros)
