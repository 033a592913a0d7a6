"""The auto-prelude: declarations for the names that a program uses and nothing declares.

In C a statement with one undeclared name vanishes from the parser's tree, calls and all. So the names are taken from the
diagnostics and declared by how the text uses them, and the text is parsed again. What the platform's repository knows of
a name decides the form first; the use in the text decides for the rest. Which parse comes when is in `parsing`.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable

from robosmi.transformations.knowledge.lexer import QUALIFIERS, STORAGE_WORDS, TYPE_WORDS, Token, tokens as tokenise
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.knowledge.standard_names import STANDARD_NAMES

_UNKNOWN = [
    re.compile(r"^unknown type name '(?P<name>\w+)'"),
    re.compile(r"^use of undeclared identifier '(?P<name>\w+)'"),
    re.compile(r"^use of unknown builtin '(?P<name>\w+)'"),
]
_IN_STD = re.compile(r"^no (?P<what>member|type|template) named '(?P<name>\w+)' in namespace 'std'")
_NOT_RECORD = re.compile(r"^member reference (?:base )?type '(?:const |volatile )*(?P<name>\w+)[ *']")
_NOT_SCALAR = re.compile(r"'(?P<name>\w+)' \(aka 'struct (?P=name)__'\)")
_DEFINE = re.compile(r"#\s*define")
_ASSIGNMENTS = frozenset(["=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>=", "++", "--"])


MEMBERS, STREAM = "robosmi_members", "robosmi_stream"
"""Made-up record types for objects that nothing declares."""


class Prelude:
    """The declarations that are put before a text because it lacks them.

    Attributes:
        platform: the API of the source platform.
        cxx: whether the text is C++, where empty parentheses mean no parameters and functions must be declared too.
        types: type name -> True when it must be a record.
        values: value name -> its declaration.
        macros: attribute macros to define empty.
        standard: name of the standard library -> its include or declaration.
        functions: platform function -> the type of its value.
        members: member that the text uses of any record -> its declarator.
        always: lines that are needed from the first parse on.
        in_std: name of the namespace std -> its declaration.
    """

    def __init__(self, platform: ApiIndex, cxx: bool = False) -> None:
        self.platform = platform
        self.cxx = cxx
        self.types: dict[str, bool] = {}
        self.values: dict[str, str] = {}
        self.macros: set[str] = set()
        self.standard: dict[str, str] = {}
        self.functions: dict[str, str] = {}
        self.members: dict[str, str] = {}
        self.always: list[str] = []
        self.in_std: dict[str, str] = {}
        self._fixed: set[str] = set()

    def collect(self, messages: Iterable[str], tokens: list[Token], own_names: Callable[[], dict[str, str]]) -> bool:
        """Declare the names that diagnostics report as undeclared.

        Args:
            messages: diagnostics of the last parse.
            tokens: tokens of the text.
            own_names: gives the names that the text itself declares at file scope, with `function`, `variable` or `type`.

        Returns:
            Whether anything is new, so that another parse is worth while.
        """
        new = False
        names: dict[str, bool] = {}
        scalar: set[str] = set()
        for message in messages:
            for number, pattern in enumerate(_UNKNOWN):
                if match := pattern.match(message):
                    names.setdefault(match["name"], number == 0)
            if (match := _NOT_RECORD.match(message)) and (wrong := self._behind(match["name"])):
                self.types |= dict.fromkeys(wrong, True)
                self._fixed |= wrong
                new = True
            for name in _NOT_SCALAR.findall(message):
                scalar.add(name)
        library = (
            [m for message in messages if (m := _IN_STD.match(message)) and m["name"] not in self.in_std] if self.cxx else []
        )
        if not names and not new and not scalar and not library:
            return False
        uses, own = _Uses(tokens), own_names()
        for match in library:
            name, new = match["name"], True
            if match["what"] == "type" or uses.as_type(name):
                self.in_std[name] = f"struct {name} {{ template<class... A> {name}(A...); }};"
            elif name in uses.called:
                self.in_std[name] = f"int {name}(...);"
            else:
                self.in_std[name] = f"extern {STREAM} {name};"
        for name in scalar - self._fixed:
            if self.types.get(name) and not uses.record_values(name):  # calculated with: no record after all
                self.types[name] = False
                self._fixed.add(name)
                new = True
        for name, is_type in names.items():
            if not self._known(name):
                new = self._declare(name, is_type, uses, own) or new
        if new:
            self.members |= {m: form for m, form in uses.members.items() if m not in self.macros}
            self._add_functions(uses, own)
        return new

    def _behind(self, name: str) -> set[str]:
        """The types declared as int so far that an error about a record may mean: the named one, else any of the platform."""
        if name in self.types:
            return {name} if not self.types[name] else set()
        candidates = {each for each, record in self.types.items() if not record} - self._fixed
        return {each for each in candidates if any(entry.kind == "type" for entry in self.platform.entries(each))}

    def _known(self, name: str) -> bool:
        return name in self.types or name in self.values or name in self.macros or name in self.standard

    def _declare(self, name: str, is_type: bool, uses: _Uses, own: dict[str, str]) -> bool:
        if name == "std" and self.cxx:
            self.standard[name] = "namespace std {}"
        elif own.get(name) == "function":  # used as a value before it is declared
            self.values[name] = f"int {name}({self._any});"
        elif self.cxx and name in uses.called and name not in uses.scopes and not uses.as_type(name):
            self.values[name] = self._function_of_cxx(name, uses)
        elif name in ("va_start", "va_arg", "va_end", "va_copy"):
            self.standard[name] = "#include <stdarg.h>"
        elif name in STANDARD_NAMES:
            self.standard[name] = STANDARD_NAMES[name]
        elif form := self._from_platform(name, uses):
            self.values[name] = form
        elif name in self.types:
            pass
        elif is_type and uses.attribute(name):
            self.macros.add(name)
        elif is_type or uses.as_type(name):
            self.types[name] = self.cxx or uses.as_pointer(name) or uses.record_values(name)
        elif access := uses.member_access(name):
            self.values[name] = f"extern struct {MEMBERS} {'*' if access == '->' else ''}{name};"
        elif dimensions := uses.dimensions(name):
            access = uses.element_access(name)
            kind = f"struct {MEMBERS} {'*' if access == '->' else ''}" if access else "int "
            self.values[name] = f"extern {kind}{name}{'[64]' * dimensions};"
        elif uses.dereferenced(name):
            self.values[name] = f"extern int *{name};"
        elif uses.written(name):
            self.values[name] = f"extern int {name};"
        else:
            self.values[name] = f"enum {{ {name} = {self._number()} }};"
        return True

    @property
    def _any(self) -> str:
        """The parameter list of a function that accepts any arguments."""
        return "..." if self.cxx else ""

    def _function_of_cxx(self, name: str, uses: _Uses) -> str:
        found = self.platform.entries(name)
        if found and found[0].kind == "function" and uses.as_value(name) and _plain_parameters(found[0].parameters):
            return f"{self.platform.signature(name, found[0])};"  # a pointer takes no function of another type
        result = found[0].detail if found and found[0].kind == "function" else "int"
        plain = all(w in TYPE_WORDS or w in QUALIFIERS for w in re.findall(r"\w+", result))
        return f"{result if plain and result else 'int'} {name}(...);"

    def _from_platform(self, name: str, uses: _Uses) -> str | None:
        """The declaration of a value that the repository knows, else None; a type is added to `types`."""
        found = self.platform.entries(name)
        if not found:
            return None
        entry = found[0]
        if entry.kind == "type":
            self.types[name] = uses.as_pointer(name) or uses.record_values(name)
            return None
        if self.platform.symbol_kind(name, entry) == "register":
            return f"extern volatile unsigned int {name};"
        if entry.kind == "variable":
            base = entry.detail.rstrip("[]")
            plain = all(w in TYPE_WORDS or w in QUALIFIERS for w in base.replace("*", " ").split())
            if not plain and (access := uses.member_access(name)):
                return f"extern struct {MEMBERS} {'*' if access == '->' else ''}{name};"
            return f"extern {base if plain else 'int'} {name}{'[]' if entry.detail.endswith('[]') else ''};"
        if entry.callable:
            return self._function_of_cxx(name, uses) if self.cxx else f"int {name}();"
        if uses.written(name):
            return None
        return f"enum {{ {name} = {self._number()} }};"

    def _add_functions(self, uses: _Uses, own: dict[str, str]) -> None:
        """Declare called platform functions that return a pointer, record or real number, whose uses would else not parse."""
        for name in uses.called - own.keys() - self.functions.keys():
            found = self.platform.entries(name)
            if not found or found[0].kind != "function" or self.platform.kind_of(found[0]) != "platform":
                continue
            result = found[0].detail
            words = re.findall(r"\w+", result)
            base = next((w for w in words if w not in QUALIFIERS and w not in TYPE_WORDS), None)
            if base in self.types or (base is None and ("*" in result or {"float", "double"} & set(words))):
                self.functions[name] = result

    def _number(self) -> int:
        return 1000003 + 7919 * len(self.values)  # different values, so that case labels differ

    def text(self) -> str:
        """The prelude as C text."""
        settings = self.platform.settings["parser"]
        lines = [f"{kind} {name}({self._any});" for name, kind in sorted(settings.get("builtins", {}).items())]
        macros = {*settings.get("attribute_macros", []), *self.macros}
        lines += [f"#ifndef {macro}\n#define {macro}\n#endif" for macro in sorted(macros)]
        lines += sorted(self.standard.values())
        lines += self.always
        fields = "".join(f" int {form.format(m)};" for m, form in sorted(self.members.items()))
        if self.cxx:  # of any class one may be made, with any arguments
            fields = fields.replace("()", "(...)")
        for name, record in self.types.items():
            if record and self.cxx:
                made = f"template<class... A> {name}(A...); operator int() const;"
                lines.append(f"struct {name} {{ int _;{fields} {name}(); {made} }};")
            else:
                lines.append(f"typedef struct {name}__ {{ int _;{fields} }} {name};" if record else f"typedef int {name};")
        if any(MEMBERS in form for form in self.values.values()):
            lines.append(f"struct {MEMBERS} {{ int _;{fields} }};")
        if self.in_std:
            passes = f"template<class T> {STREAM} &operator<<(const T &); template<class T> {STREAM} &operator>>(T &);"
            lines.append(f"struct {STREAM} {{ {passes} }};")
            lines.append(f"namespace std {{ {' '.join(self.in_std.values())} }}")
        lines += self.values.values()
        lines += [f"{kind} {name}({self._any});" for name, kind in sorted(self.functions.items())]
        return "\n".join(lines) + "\n"

    def declares(self, name: str) -> bool:
        """Whether this prelude made up the declaration of a name; standard names do not count."""
        return name in self.types or name in self.values


class _Uses:
    """How a text uses its names, judged by its tokens alone, bodies of macros included."""

    def __init__(self, tokens: list[Token]) -> None:
        plain: list[tuple[str, str]] = []
        bodies: list[str] = []
        for kind, _, _, text in tokens:
            if kind == "directive":
                bodies.append(text)
            elif kind != "comment":
                plain.append((kind, text))
        for body in bodies:
            if _DEFINE.match(body):
                inner = tokenise(body[1:].encode("latin-1"))[1:]
                plain += [("punct", ";"), *((k, t) for k, _, _, t in inner if k != "comment"), ("punct", ";")]
        self._texts = [text for _, text in plain] + ["", "", ""]
        self._places: dict[str, list[int]] = {}
        self.called: set[str] = set()
        self.members: dict[str, str] = {}
        self.scopes: set[str] = set()
        for i, (kind, text) in enumerate(plain):
            if kind == "name":
                self._places.setdefault(text, []).append(i)
                if self._texts[i + 1] == "(":
                    self.called.add(text)
                elif self._texts[i + 1] == ":" == self._texts[i + 2]:
                    self.scopes.add(text)
                if i and self._texts[i - 1] in (".", "->"):
                    form = {"[": "*{}", "(": "(*{})()"}.get(self._texts[i + 1], "{}")
                    if self.members.get(text, "{}") == "{}":
                        self.members[text] = form

    def _any(self, name: str, test: Callable[[list[str], int], bool]) -> bool:
        return any(test(self._texts, i) for i in self._places.get(name, ()))

    def as_pointer(self, name: str) -> bool:
        """Whether the name is followed by `*` where a type may stand, as in `T *x` or `(T *)`."""
        return self._any(name, lambda t, i: t[i + 1] == "*" and (i == 0 or t[i - 1] in _BEFORE_TYPE))

    def as_type(self, name: str) -> bool:
        """Whether the name is used as the type of a local variable, a parameter or a cast."""

        def test(t: list[str], i: int) -> bool:
            before = t[i - 1] if i else ";"
            if before not in _BEFORE_TYPE:
                return False
            j = i + 1
            while t[j] in ("*", "const", "volatile"):
                j += 1
            if t[j] == ")" and before == "(":
                return j > i + 1 or _word(t[j + 1]) or t[j + 1] in ("&", "*")
            return (
                _word(t[j])
                and t[j] not in QUALIFIERS
                and t[j + 1] in ("=", ";", ",", "[", ")", "(")
                and (j == i + 1 or before != "(" or t[j + 1] == ",")
            )

        return self._any(name, test)

    def record_values(self, name: str) -> bool:
        """Whether a member of some variable of the type is used."""
        variables = {self._texts[i + 1] for i in self._places.get(name, ()) if _word(self._texts[i + 1])}
        return any(self._any(v, lambda t, i: t[i + 1] in (".", "->")) for v in variables)

    def written(self, name: str) -> bool:
        """Whether the name is assigned, incremented, decremented, indexed, or its address is taken."""

        def test(t: list[str], i: int) -> bool:
            before = t[i - 1] if i else ""
            if t[i + 1] in _ASSIGNMENTS or before in ("++", "--"):
                return True
            return before == "&" and i > 1 and (t[i - 2] in _BEFORE_OPERAND)

        return self._any(name, test) or self.dimensions(name) > 0

    def member_access(self, name: str) -> str:
        """The operator by which a member of the name is used, `.` or `->`; empty if none is."""
        for access in ("->", "."):
            if self._any(name, lambda t, i, a=access: t[i + 1] == a):  # type: ignore[misc]
                return access
        return ""

    def dimensions(self, name: str) -> int:
        """How many indices stand behind the name at most."""
        return max((self._indices(i)[0] for i in self._places.get(name, ())), default=0)

    def element_access(self, name: str) -> str:
        """The operator by which a member of an indexed name is used, `.` or `->`; empty if none is."""
        behind = [self._texts[place] for i in self._places.get(name, ()) for count, place in [self._indices(i)] if count]
        return next((access for access in ("->", ".") if access in behind), "")

    def _indices(self, place: int) -> tuple[int, int]:
        """The number of indices behind a place, and the place behind them."""
        count, place = 0, place + 1
        while self._texts[place] == "[":
            depth = 0
            while place < len(self._texts) - 3:
                depth += (self._texts[place] == "[") - (self._texts[place] == "]")
                place += 1
                if depth == 0:
                    break
            else:
                break
            count += 1
        return count, place

    def as_value(self, name: str) -> bool:
        """Whether the name is used without a call, as a function is that a pointer gets."""
        return self._any(name, lambda t, i: t[i + 1] not in ("(", ":") and t[i - 1] not in (".", "->"))

    def dereferenced(self, name: str) -> bool:
        """Whether the value that the name points to is used."""
        return self._any(name, lambda t, i: i > 1 and t[i - 1] == "*" and t[i - 2] in _BEFORE_DEREFERENCE)

    def attribute(self, name: str) -> bool:
        """Whether the name directly precedes a type, as a macro does that stands for an attribute."""
        words = TYPE_WORDS | STORAGE_WORDS | {"struct", "union", "enum"}
        return self._any(
            name, lambda t, i: t[i + 1] in words or (_word(t[i + 1]) and _word(t[i + 2]) and t[i + 1] not in QUALIFIERS)
        )


_BEFORE_TYPE = frozenset(
    {"", ";", "{", "}", "(", ",", "const", "volatile", "static", "extern", "register", "unsigned", "sizeof", ")", ":", "typedef"}
)
_BEFORE_OPERAND = frozenset(
    ["(", ",", "=", "{", ";", "return", "+", "-", "*", "/", "%", "&", "|", "^", "!", "~", "<", ">", "<=", ">=", "==", "!=", "&&",
     "||", "?", ":"]
)  # fmt: skip


_BEFORE_DEREFERENCE = (_BEFORE_OPERAND - {")", "*", "&"}) | {"}", "+=", "-="}
"""What stands before a `*` that is no multiplication and belongs to no declaration."""


def _plain_parameters(parameters: str) -> bool:
    """Whether the types in a list of parameters are those of the language, so that nothing else has to be declared."""
    types = [each.replace("*", " * ").split() for each in parameters.strip("()").split(",")]
    named = ((each[:-1] if len(each) > 1 and _word(each[-1]) and each[-1] not in TYPE_WORDS else each) for each in types)
    return all(word in TYPE_WORDS or word in QUALIFIERS or word in ("*", "...") for each in named for word in each)


def _word(text: str) -> bool:
    return bool(text) and (text[0].isalpha() or text[0] == "_")
