"""Random programs of the Propeller, in C and C++, whose pins are computed; the same seed gives the same program.

A program is a few globals, types and functions and a `main` that changes variables and passes numbers to functions of pins. Not
every program has a meaning: what overflows, reads past an array or uses a port that the chip lacks is for the judge
(`tests.fuzz.pins`) to leave out.
"""

from __future__ import annotations

from collections.abc import Callable

from tests.fuzz.pin_declarations import COMMON, ONLY_CPP, TYPES, Declarations

_PLAIN = (
    "high",
    "low",
    "toggle",
    "set_output({}, 1);",
    "set_direction({}, 1);",
    "freqout({}, 10, 1000);",
    "pulse_out({}, 100);",
    "input",
)


class Program(Declarations):
    """One random program."""

    def text(self) -> str:
        """The program."""
        pick = self._random
        parts = [*COMMON, *(ONLY_CPP * 2 if self.cpp else ())]
        deep = pick.choice((1, 1, 2))
        for _ in range(pick.randint(1, 4) if deep > 1 else pick.randint(1, 2)):
            pick.choice(parts)(self)
        self._scopes.append([])
        body = [self._declared() for _ in range(pick.randint(0, deep))]
        body += [self._statement(deep) for _ in range(pick.randint(1, 3 * deep))]
        body.append(self._call())
        end = ("return 0;", "while (1) { pause(10); }", "for (;;) { " + self._statement(1) + " pause(5); }")
        body.append(pick.choice(end))
        lines = ['#include "simpletools.h"', *self._top, "int main() {", *(f"  {line}" for line in body), "}"]
        return "\n".join(lines) + "\n"

    def _variables(self) -> list[str]:
        return [each for scope in self._scopes for each in scope]

    def _declared(self) -> str:
        pick, name = self._random, self._name("v")
        kind = pick.choice(TYPES)
        value = self._expression(1)
        if self.cpp and pick.random() < 0.2:
            kind = "auto"
        if pick.random() < 0.12:
            value, kind = str(self._number()), "static int"
        if self.cpp and pick.random() < 0.15 and self._variables():
            target = pick.choice(self._variables())
            if "." not in target and "[" not in target and "*" not in target:
                line = f"auto &{name} = {target};"
                self._scopes[-1].append(name)
                return line
        line = f"{kind} {name} = {value};"
        self._scopes[-1].append(name)
        return line

    def _expression(self, depth: int) -> str:
        pick, known = self._random, self._variables()
        if depth <= 0 or pick.random() < 0.25:
            if known and pick.random() < 0.6:
                return pick.choice(known)
            if self._values and pick.random() < 0.5:
                return pick.choice(self._values)
            return str(self._number(20))
        a = self._expression(depth - 1)
        forms = [
            f"{a} + {self._number(6)}", f"{a} - {self._number(3)}", f"({a} ^ {self._number(7)})", f"({a} | {self._number(7)})",
            f"({a} & {pick.choice((1, 3, 7, 15))})", f"({a} << 1)", f"({a} >> 1)", f"{a} % {pick.randint(2, 12)}",
            f"{self._number(10) + 18} - {a}", f"({a} > {self._number()} ? {self._expression(depth - 1)} : {self._number()})",
            f"({pick.choice(TYPES)})({a} + {pick.choice((0, 256, 65536, 3))})", f"{a} * {pick.randint(1, 3)}",
            f"(!{a} + {self._number()})", f"({a} == {self._number()}) + {self._number()}", f"(~{a} & 15)", f"-(-{a})",
            f"({self._effect()}, {a})", f"(int)sizeof({pick.choice(('int', 'char', 'short', a))}) + {self._number()}",
            f"\"{''.join(pick.choice('abcdefg') for _ in range(4))}\"[{a} & 3] - 'a' + {self._number()}",
        ]  # fmt: skip
        if self._calm:
            forms = [*forms[:6], *forms[8:10], forms[17]]
        elif known:
            name = pick.choice(known)
            forms += [f"{name}++", f"++{name}", f"{name}--", f"({name} += {self._number(3)})", f"({name} = {self._number()})"]
        if self._functions:
            forms += [self._called()] * 6
        return pick.choice(forms)

    def _called(self) -> str:
        arguments = self._random.choice(self._functions)
        while "{}" in arguments:
            arguments = arguments.replace("{}", self._expression(0), 1)
        return arguments

    def _effect(self) -> str:
        pick, known = self._random, self._variables()
        if not known or self._calm:
            return self._called() if self._functions else "0"
        name = pick.choice(known)
        return pick.choice(
            [
                f"{name} = {self._expression(1)}", f"{name} {pick.choice(('+=', '-=', '^=', '|='))} {self._number(4)}",
                f"{name}++", f"--{name}", f"{name} &= 15", f"{name} = {pick.choice(known)}", f"{name} >>= 1", f"{name} %= 9",
            ]
        )  # fmt: skip

    def _call(self) -> str:
        pick = self._random
        value = self._expression(pick.randint(0, 2))
        if pick.random() < 0.2:
            value = pick.choice([f"({value}) % 13 + 4", f"({value}) & 15", f"(({value}) & 7) + {self._number()}"])
        form = pick.choice(_PLAIN)
        return form.format(value) if "{" in form else f"{form}({value});"

    def _block(self, depth: int, more: str = "") -> str:
        self._scopes.append([])
        lines = [self._declared()] if self._random.random() < 0.25 else []
        lines += [self._statement(depth - 1) for _ in range(self._random.randint(1, 3))]
        self._scopes.pop()
        return "{ " + " ".join(lines) + more + " }"

    def _statement(self, depth: int) -> str:
        pick = self._random
        if depth <= 0:
            return self._call() if pick.random() < 0.5 else self._effect() + ";"
        forms: list[Callable[[int], str]] = [
            lambda _: self._call(), lambda _: self._call(), lambda _: self._effect() + ";", self._if, self._for, self._while,
            self._do, self._switch, self._goto, self._registers, self._pointer,
        ]  # fmt: skip
        return pick.choice(forms)(depth)

    def _if(self, depth: int) -> str:
        condition = self._random.choice([f"{self._expression(1)} > {self._number()}", "input(3)", self._expression(1)])
        other = f" else {self._block(depth)}" if self._random.random() < 0.5 else ""
        return f"if ({condition}) {self._block(depth)}{other}"

    def _leave(self) -> str:
        if self._random.random() < 0.7:
            return ""
        return f" if ({self._expression(1)} == {self._number()}) {self._random.choice(('break', 'continue'))};"

    def _for(self, depth: int) -> str:
        pick, name = self._random, self._name("i")
        first, count = self._number(), pick.randint(1, 4)
        kind = pick.choice(("int", "int", "char", "short", "unsigned"))
        step, last = pick.choice((1, 1, 2, 3)), first + count
        up = pick.random() < 0.7 or kind in ("char", "unsigned")
        self._scopes.append([] if pick.random() < 0.6 else [name])  # mostly read by the calls alone
        inside = self._block(depth) if pick.random() < 0.3 else self._block(1, f" {self._used(name)}{self._leave()}")
        self._scopes.pop()
        if pick.random() < 0.25:
            left = pick.choice((f" {self._used(name)}", f" if ({name} == {last}) {self._used(name)}", ""))
            head = f"for ({name} = {first}; {name} < {last}; {name} += {step}) {inside}"
            if up and pick.random() < 0.5:
                return f"{{ {kind} {name}; {head}{left} }}"
            return f"{{ {kind} {name} = {first - 1}; while (++{name} < {last}) {inside}{left} }}"
        outer = self._variables()
        if outer and pick.random() < 0.25:
            name = pick.choice(outer)
            return f"for ({name} = {first}; {name} < {last}; {name} += {step}) {{ {self._used(name)} }}"
        if up:
            return f"for ({kind} {name} = {first}; {name} < {last}; {name} += {step}) {inside}"
        return f"for ({kind} {name} = {last}; {name} >= {first}; {name}--) {inside}"

    def _used(self, name: str) -> str:
        pick = self._random
        value = pick.choice([name, name, f"{name} + {self._number(4)}", f"{name} * 2 & 31", f"({name} ^ 1)", f"31 - {name}"])
        return f"{pick.choice(('high', 'low', 'toggle'))}({value});"

    def _while(self, depth: int) -> str:
        name = self._name("w")
        first = self._number()
        self._scopes.append([name])
        inside = self._block(depth, f" {name}++;{self._leave()}")
        self._scopes.pop()
        if self._random.random() < 0.5:
            return f"int {name} = {first}; while ({name} < {first + self._random.randint(1, 4)}) {inside}"
        return f"{{ int {name} = {first}; while ({name}++ < {first + 3}) {inside} }}"

    def _do(self, depth: int) -> str:
        name = self._name("d")
        self._scopes.append([name])
        inside = self._block(depth)
        self._scopes.pop()
        return f"{{ int {name} = {self._number(4)}; do {inside} while (--{name} > 0); }}"

    def _switch(self, depth: int) -> str:
        cases = "".join(
            f" case {each}: {self._statement(depth - 1)}{self._random.choice((' break;', ''))}"
            for each in self._random.sample(range(8), self._random.randint(1, 3))
        )
        other = f" default: {self._statement(depth - 1)}" if self._random.random() < 0.6 else ""
        return f"switch ({self._expression(1)} & 7) {{{cases}{other} }}"

    def _goto(self, depth: int) -> str:
        label = self._name("label")
        if self.cpp:
            return self._call()
        if self._random.random() < 0.5:
            return f"if ({self._expression(1)} & 1) goto {label}; {self._effect()}; {label}: {self._call()}"
        name = self._name("n")
        return f"int {name} = 0; {label}: {self._call()} if (++{name} < 3) goto {label};"

    def _registers(self, depth: int) -> str:
        register = self._random.choice(("DIRA", "OUTA"))
        value = self._expression(1)
        mask = self._random.choice([f"1 << ({value} & 15)", f"{self._number(15)} << {self._number(12)}"])
        return self._random.choice(
            [
                f"{register} |= {mask};",
                f"{register} = {mask};",
                f"set_outputs({(a := self._number()) + 2}, {a}, 5);",
                f"{register} ^= {mask};",
            ]
        )

    def _pointer(self, depth: int) -> str:
        known = [each for each in self._variables() if each[0] == "g" and "[" not in each and "." not in each]
        if not known:
            return self._call()
        name = self._name("p")
        target = self._random.choice(known)
        self._scopes[-1].append(f"*{name}")
        return f"__typeof__({target}) *{name} = &{target};"


def program(seed: int) -> tuple[str, str]:
    """A program and the ending of its file."""
    made = Program(seed)
    return made.text(), ".cpp" if made.cpp else ".c"
