"""Random programs of the Propeller, in C and C++, whose pins are computed; the same seed gives the same program.

A program is a few globals, types and functions and a `main` that changes variables and passes numbers to functions of pins. Not
every program has a meaning: what overflows, reads past an array or uses a port that the chip lacks is for the judge
(`tests.fuzz.pins`) to leave out.
"""

from __future__ import annotations

import random
from collections.abc import Callable

_TYPES = ("int", "int", "int", "char", "unsigned char", "short", "unsigned", "signed char", "long", "unsigned short", "uint8_t", "int8_t")
_PLAIN = ("high", "low", "toggle", "set_output({}, 1);", "set_direction({}, 1);", "freqout({}, 10, 1000);", "pulse_out({}, 100);", "input")


class Program:
    """One random program."""

    def __init__(self, seed: int) -> None:
        self._random = random.Random(seed)
        self.cpp = self._random.random() < 0.5
        self._top: list[str] = []
        self._count = 0
        self._scopes: list[list[str]] = [[]]  # variables that may be read and written
        self._functions: list[tuple[str, str]] = []  # with the text of a call, {} for each argument
        self._values: list[str] = []  # expressions of constants
        self._calm = self._random.random() < 0.6  # variables change by loops and calls alone

    def text(self) -> str:
        """The program."""
        pick = self._random
        parts = [*_COMMON, *(_ONLY_CPP * 2 if self.cpp else ())]
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

    def _name(self, prefix: str) -> str:
        self._count += 1
        return f"{prefix}{self._count}"

    def _number(self, most: int = 15) -> int:
        return self._random.randint(0, most)

    def _variables(self) -> list[str]:
        return [each for scope in self._scopes for each in scope]

    def _declared(self) -> str:
        pick, name = self._random, self._name("v")
        kind = pick.choice(_TYPES)
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
            f"({pick.choice(_TYPES)})({a} + {pick.choice((0, 256, 65536, 3))})", f"{a} * {pick.randint(1, 3)}",
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
        name, arguments = self._random.choice(self._functions)
        del name
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
            [f"{register} |= {mask};", f"{register} = {mask};", f"set_outputs({(a := self._number()) + 2}, {a}, 5);", f"{register} ^= {mask};"]
        )

    def _pointer(self, depth: int) -> str:
        known = [each for each in self._variables() if each[0] == "g" and "[" not in each and "." not in each]
        if not known:
            return self._call()
        name = self._name("p")
        target = self._random.choice(known)
        self._scopes[-1].append(f"*{name}")
        return f"__typeof__({target}) *{name} = &{target};"

    # What stands before main

    def global_variable(self) -> None:
        name = self._name("g")
        kind = self._random.choice(_TYPES)
        self._top.append(f"{self._random.choice(('', '', 'static ', 'volatile '))}{kind} {name} = {self._number()};")
        self._scopes[0].append(name)

    def array(self) -> None:
        name, kind = self._name("a"), self._random.choice(_TYPES)
        values = ", ".join(str(self._number(27)) for _ in range(4))
        constant = self._random.random() < 0.5
        self._top.append(f"{'const ' if constant else ''}{kind} {name}[4] = {{{values}}};")
        self._functions.append((name, f"{name}[{{}} & 3]"))
        if not constant:
            self._scopes[0].append(f"{name}[{self._number(3)}]")

    def table(self) -> None:
        name = self._name("t")
        rows = ", ".join(f"{{{self._number(27)}, {self._number(27)}}}" for _ in range(3))
        self._top.append(f"static const int {name}[3][2] = {{{rows}}};")
        self._functions.append((name, f"{name}[{{}} % 3][{{}} & 1]"))

    def structure(self) -> None:
        name, pick = self._name("S"), self._random
        members = pick.choice(["int a; char b;", "unsigned a : 5; unsigned b : 4;", "int a : 6; unsigned char b;", "short a; int b;"])
        if pick.random() < 0.5:
            self._top.append(f"struct {name} {{ {members} }} s{name} = {{{self._number()}, {self._number()}}};")
        else:
            self._top.append(f"typedef struct {{ {members} }} {name}; {name} s{name} = {{.a = {self._number()}, .b = {self._number()}}};")
        self._scopes[0] += [f"s{name}.a", f"s{name}.b"]

    def union(self) -> None:
        name = self._name("u")
        self._top.append(f"union {{ int whole; unsigned char low; short part; }} {name} = {{{self._number()}}};")
        self._scopes[0] += [f"{name}.whole", f"{name}.low", f"{name}.part"]

    def enumeration(self) -> None:
        first, second = self._name("E"), self._name("E")
        self._top.append(f"enum {{ {first} = {self._number()}, {second} }};")
        self._values += [first, second]

    def macro(self) -> None:
        pick, name, n = self._random, self._name("M"), self._number()
        form = pick.choice(
            [
                f"#define {name} {n}", f"#define {name} ({n} + 1)", f"#define {name} {n} + 1", f"#define {name}(x) x + {n}",
                f"#define {name}(x) ((x) * 2)", f"#define {name}(x, y) ((x) > (y) ? (x) : (y))",
                f"#define {name}_pin {n}\n#define {name}(x) {name}_##x", f"#define {name}(x) high(x)",
                f"#define {name}(x) do {{ low(x); high((x) + 1); }} while (0)", f"#define {name}(f, x) f(x)",
            ]
        )  # fmt: skip
        self._top.append(form)
        if "##" in form:
            self._values.append(f"{name}(pin)")
        elif "high" in form or "f(x)" in form:
            use = "high, " if "(f," in form else ""
            self._top.append(f"void w{name}(int pin) {{ {name}({use}pin); }}")
            self._functions.append((name, f"(w{name}({{}}), {n})"))
        elif "(x, y)" in form:
            self._functions.append((name, f"{name}({{}}, {{}})"))
        elif "(x)" in form:
            self._functions.append((name, f"{name}({{}})"))
        else:
            self._values.append(name)

    def function(self) -> None:
        pick, name, n = self._random, self._name("f"), self._number(6)
        kind, argument = pick.choice(_TYPES), pick.choice(_TYPES)
        read = [*self._scopes[0], "x"]
        other = pick.choice(read)
        form = pick.choice(
            [
                f"return x + {n};", f"static int count = {n}; return count++ + x;", f"x += {n}; return x;",
                f"if (x > {n}) return {n}; return x;", f"return x > 1 ? {name}(x - 1) + 1 : {n};",
                f"while (x > 12) x -= 5; return x;", f"int r = 0; for (int i = 0; i < x; i++) r += 2; return r;",
                f"switch (x & 3) {{ case 0: return {n}; case 1: x++; case 2: return x; }} return {n} + 2;",
                f"high(x); return x + 1;", f"low(x + {n}); return {n};", f"{other} = x; return {n};", f"return {other} + {n};",
                f"{other}++; high({other}); return {n};", f"int *p = &({'int){0}' if not self.cpp else 'r'}; return {n};"
                if False else f"int r = {n}; int *p = &r; *p += x; return r;",
                f"int t[3] = {{{n}, x, {n + 2}}}; return t[x % 3];",
            ]
        )  # fmt: skip
        self._top.append(f"{pick.choice(('', 'static ', ''))}{kind} {name}({argument} x) {{ {form} }}")
        self._functions.append((name, f"{name}({{}})"))

    def out_parameter(self) -> None:
        name = self._name("o")
        n = self._number()
        form = self._random.choice([f"*x = {n};", f"*x += {n % 4};", f"if (*x > {n}) *x = 3;", f"x[0] = {n}; high(*x);", "high(*x); ++*x;"])
        self._top.append(f"int {name}(int *x) {{ {form} return {n}; }}")
        variable = self._name("g")
        self._top.append(f"int {variable} = {self._number()};")
        self._scopes[0].append(variable)
        self._functions.append((name, f"{name}(&{variable})"))

    def function_pointer(self) -> None:
        name, n = self._name("q"), self._number(5)
        self._top.append(f"int a{name}(int x) {{ return x + {n}; }}\nint b{name}(int x) {{ high(x); return {n}; }}")
        if self._random.random() < 0.5:
            self._top.append(f"int (*{name})(int) = {self._random.choice('ab')}{name};")
            self._functions.append((name, f"{name}({{}})"))
        else:
            self._top.append(f"int (*const {name}[2])(int) = {{a{name}, b{name}}};")
            self._functions.append((name, f"{name}[{{}} & 1]({{}})"))

    def structure_parameter(self) -> None:
        name, n = self._name("R"), self._number()
        self._top.append(f"struct {name} {{ int pin; short more[2]; }};")
        self._top.append(f"int f{name}(struct {name} *r) {{ high(r->pin); r->pin++; low(r->more[{n & 1}]); return r->more[0]; }}")
        self._top.append(f"struct {name} r{name} = {{{n}, {{{self._number()}, {self._number()}}}}};")
        self._functions.append((name, f"f{name}(&r{name})"))
        self._top.append(f"struct {name} m{name}(int x) {{ struct {name} r = {{x, {{x + 1, {n}}}}}; return r; }}")
        self._functions.append((name, f"m{name}({{}}).{self._random.choice(('pin', 'more[0]', 'more[1]'))}"))
        self._scopes[0].append(f"r{name}.pin")

    # Only in C++

    def reference(self) -> None:
        name, variable, n = self._name("x"), self._name("g"), self._number(4)
        self._top.append(f"int {variable} = {self._number()};")
        self._scopes[0].append(variable)
        form = self._random.choice([f"x += {n}; return x;", "high(x); x++; return x;", f"int &y = x; y = {n}; return y;"])
        self._top.append(f"int {name}(int &x) {{ {form} }}")
        self._functions.append((name, f"{name}({variable})"))
        if self._random.random() < 0.4:
            self._top.append(f"int &r{name} = {variable};")
            self._scopes[0].append(f"r{name}")

    def default_argument(self) -> None:
        name, n = self._name("da"), self._number()
        self._top.append(f"int {name}(int x, int y = {n}) {{ high(y); return x + (y > {n}); }}")
        self._functions += [(name, f"{name}({{}})"), (name, f"{name}({{}}, {{}})")]

    def template(self) -> None:
        name, n = self._name("te"), self._number()
        form = self._random.randrange(3)
        if form == 0:
            self._top.append(f"template <int N> int {name}(int x) {{ high(N); return x + N; }}")
            self._functions.append((name, f"{name}<{n}>({{}})"))
        elif form == 1:
            self._top.append(f"template <class T> T {name}(T x) {{ low(x); return x + {n % 3}; }}")
            self._functions += [(name, f"{name}({{}})"), (name, f"{name}<char>({{}})")]
        else:
            self._top.append(f"template <int A, int B = A + 2> struct {name} {{ static const int value = A ^ B; static int on() {{ high(B); return A; }} }};")
            self._functions.append((name, f"{name}<{n}>::on()"))
            self._values.append(f"{name}<{n}, {self._number()}>::value")

    def class_(self) -> None:
        pick, name, n = self._random, self._name("C"), self._number()
        start = pick.choice([f"{name}(int x) : pin(x) {{}}", f"{name}(int x) {{ pin = x + 1; }}", f"{name}(int x = {n}) : pin(x), next(x + 1) {{}}"])
        member = pick.choice(["int", "char", "unsigned char"])
        method = pick.choice(["high(pin); return pin;", "low(pin++); return next;", "high(next); return count++;", "this->pin = next; high(pin); return 4;"])
        static = "static int count;"
        virtual = pick.choice(("", "", "virtual "))
        self._top.append(f"class {name} {{ public: {member} pin; int next = {self._number()}; {static} {start} {virtual}int on() {{ {method} }} int get() const {{ return pin; }} {name} &set(int x) {{ pin = x; return *this; }} }};")
        self._top.append(f"int {name}::count = {self._number()};")
        self._top.append(f"{name} o{name}({self._number()});")
        self._functions += [(name, f"o{name}.on()"), (name, f"{name}({{}}).on()"), (name, f"o{name}.set({{}}).get()")]
        self._scopes[0] += [f"o{name}.pin", f"{name}::count"]
        if pick.random() < 0.4:
            own = "int on() { low(next); return pin; }" if pick.random() < 0.6 else "int two() { return on() + 1; }"
            self._top.append(f"struct D{name} : {name} {{ D{name}(int y) : {name}(y) {{}} {own} }};\nD{name} d{name}({self._number()});")
            self._functions += [(name, f"d{name}.on()"), (name, f"static_cast<{name} &>(d{name}).on()")]

    def lambda_(self) -> None:
        name, n = self._name("la"), self._number(5)
        form = self._random.choice([f"auto {name} = [](int x) {{ high(x); return x + {n}; }};", f"auto {name} = [](auto x) {{ return x + {n}; }};", f"static int k{name} = {n}; auto {name} = [](int x) {{ return k{name}++ + x; }};"])
        self._top.append(form)
        self._functions.append((name, f"{name}({{}})"))

    def namespace(self) -> None:
        name, n = self._name("ns"), self._number()
        self._top.append(f"namespace {name} {{ int pin = {n}; int on(int x) {{ high(pin); return x; }} namespace in {{ const int deep = {self._number()}; }} }}")
        self._scopes[0].append(f"{name}::pin")
        self._functions.append((name, f"{name}::on({{}})"))
        self._values.append(f"{name}::in::deep")

    def overload(self) -> None:
        name = self._name("ov")
        self._top.append(f"int {name}(int x) {{ high(x); return x; }}\nint {name}(char x) {{ low(x + 1); return x + 1; }}\nint {name}(int x, int y) {{ return x ^ y; }}")
        self._functions += [(name, f"{name}({{}})"), (name, f"{name}((char)({{}}))"), (name, f"{name}({{}}, {{}})")]

    def constant(self) -> None:
        name, n = self._name("k"), self._number()
        self._top.append(f"constexpr int f{name}(int x) {{ return x > 3 ? x - 2 : x + {n}; }}\nconstexpr int {name} = f{name}({self._number()});")
        self._values += [name, f"f{name}({n})"]

    def scoped(self) -> None:
        name = self._name("ec")
        self._top.append(f"enum class {name} : char {{ a = {self._number()}, b }};")
        self._values += [f"(int){name}::a", f"static_cast<int>({name}::b)"]

    def list_of_values(self) -> None:
        name = self._name("rl")
        self._top.append(f"int {name}[] = {{{self._number()}, {self._number()}, {self._number()}}};")
        self._top.append(f"int f{name}(int x) {{ for (auto{self._random.choice(('', ' &'))} each : {name}) {{ high(each); each += x & 1; }} return {name}[1]; }}")
        self._functions.append((name, f"f{name}({{}})"))

    def conversion(self) -> None:
        name, n = self._name("Op"), self._number()
        form = self._random.choice([f"operator int() const {{ return p; }}", f"int operator()(int x) {{ return p + x; }}", "int operator+(int x) { return p ^ x; }"])
        self._top.append(f"struct {name} {{ int p; {form} }} o{name} = {{{n}}};")
        self._functions.append((name, f"(int)o{name}" if "operator int" in form else f"o{name}({{}})" if "()(" in form else f"(o{name} + {{}})"))


_COMMON = (
    Program.global_variable, Program.array, Program.table, Program.structure, Program.union, Program.enumeration, Program.macro,
    Program.macro, Program.function, Program.function, Program.function, Program.out_parameter, Program.function_pointer,
    Program.structure_parameter,
)  # fmt: skip
_ONLY_CPP = (
    Program.reference, Program.default_argument, Program.template, Program.class_, Program.class_, Program.lambda_, Program.namespace,
    Program.overload, Program.constant, Program.scoped, Program.list_of_values, Program.conversion,
)  # fmt: skip


def program(seed: int) -> tuple[str, str]:
    """A program and the ending of its file."""
    made = Program(seed)
    return made.text(), ".cpp" if made.cpp else ".c"
