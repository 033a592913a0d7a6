"""What stands before `main` in the random programs of `pin_programs`: variables, types, macros and functions."""

from __future__ import annotations

import random

TYPES = (
    "int",
    "int",
    "int",
    "char",
    "unsigned char",
    "short",
    "unsigned",
    "signed char",
    "long",
    "unsigned short",
    "uint8_t",
    "int8_t",
)


class Declarations:
    """The declarations of a random program, and what of them its statements may use."""

    def __init__(self, seed: int) -> None:
        self._random = random.Random(seed)
        self.cpp = self._random.random() < 0.5
        self._top: list[str] = []
        self._count = 0
        self._scopes: list[list[str]] = [[]]  # variables that may be read and written
        self._functions: list[str] = []  # calls and other uses, with {} for each argument
        self._values: list[str] = []  # expressions of constants
        self._calm = self._random.random() < 0.6  # variables change by loops and calls alone

    def _name(self, prefix: str) -> str:
        self._count += 1
        return f"{prefix}{self._count}"

    def _number(self, most: int = 15) -> int:
        return self._random.randint(0, most)

    def global_variable(self) -> None:
        name = self._name("g")
        kind = self._random.choice(TYPES)
        self._top.append(f"{self._random.choice(('', '', 'static ', 'volatile '))}{kind} {name} = {self._number()};")
        self._scopes[0].append(name)

    def array(self) -> None:
        name, kind = self._name("a"), self._random.choice(TYPES)
        values = ", ".join(str(self._number(27)) for _ in range(4))
        constant = self._random.random() < 0.5
        self._top.append(f"{'const ' if constant else ''}{kind} {name}[4] = {{{values}}};")
        self._functions.append(f"{name}[{{}} & 3]")
        if not constant:
            self._scopes[0].append(f"{name}[{self._number(3)}]")

    def table(self) -> None:
        name = self._name("t")
        rows = ", ".join(f"{{{self._number(27)}, {self._number(27)}}}" for _ in range(3))
        self._top.append(f"static const int {name}[3][2] = {{{rows}}};")
        self._functions.append(f"{name}[{{}} % 3][{{}} & 1]")

    def structure(self) -> None:
        name, pick = self._name("S"), self._random
        members = pick.choice(
            ["int a; char b;", "unsigned a : 5; unsigned b : 4;", "int a : 6; unsigned char b;", "short a; int b;"]
        )
        if pick.random() < 0.5:
            self._top.append(f"struct {name} {{ {members} }} s{name} = {{{self._number()}, {self._number()}}};")
        else:
            self._top.append(
                f"typedef struct {{ {members} }} {name}; {name} s{name} = {{.a = {self._number()}, .b = {self._number()}}};"
            )
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
            self._functions.append(f"(w{name}({{}}), {n})")
        elif "(x, y)" in form:
            self._functions.append(f"{name}({{}}, {{}})")
        elif "(x)" in form:
            self._functions.append(f"{name}({{}})")
        else:
            self._values.append(name)

    def function(self) -> None:
        pick, name, n = self._random, self._name("f"), self._number(6)
        kind, argument = pick.choice(TYPES), pick.choice(TYPES)
        read = [*self._scopes[0], "x"]
        other = pick.choice(read)
        form = pick.choice(
            [
                f"return x + {n};", f"static int count = {n}; return count++ + x;", f"x += {n}; return x;",
                f"if (x > {n}) return {n}; return x;", f"return x > 1 ? {name}(x - 1) + 1 : {n};",
                "while (x > 12) x -= 5; return x;", "int r = 0; for (int i = 0; i < x; i++) r += 2; return r;",
                f"switch (x & 3) {{ case 0: return {n}; case 1: x++; case 2: return x; }} return {n} + 2;",
                "high(x); return x + 1;", f"low(x + {n}); return {n};", f"{other} = x; return {n};", f"return {other} + {n};",
                f"{other}++; high({other}); return {n};", f"int r = {n}; int *p = &r; *p += x; return r;",
                f"int t[3] = {{{n}, x, {n + 2}}}; return t[x % 3];",
            ]
        )  # fmt: skip
        self._top.append(f"{pick.choice(('', 'static ', ''))}{kind} {name}({argument} x) {{ {form} }}")
        self._functions.append(f"{name}({{}})")

    def out_parameter(self) -> None:
        name = self._name("o")
        n = self._number()
        form = self._random.choice(
            [f"*x = {n};", f"*x += {n % 4};", f"if (*x > {n}) *x = 3;", f"x[0] = {n}; high(*x);", "high(*x); ++*x;"]
        )
        self._top.append(f"int {name}(int *x) {{ {form} return {n}; }}")
        variable = self._name("g")
        self._top.append(f"int {variable} = {self._number()};")
        self._scopes[0].append(variable)
        self._functions.append(f"{name}(&{variable})")

    def function_pointer(self) -> None:
        name, n = self._name("q"), self._number(5)
        self._top.append(f"int a{name}(int x) {{ return x + {n}; }}\nint b{name}(int x) {{ high(x); return {n}; }}")
        if self._random.random() < 0.5:
            self._top.append(f"int (*{name})(int) = {self._random.choice('ab')}{name};")
            self._functions.append(f"{name}({{}})")
        else:
            self._top.append(f"int (*const {name}[2])(int) = {{a{name}, b{name}}};")
            self._functions.append(f"{name}[{{}} & 1]({{}})")

    def structure_parameter(self) -> None:
        name, n = self._name("R"), self._number()
        self._top.append(f"struct {name} {{ int pin; short more[2]; }};")
        self._top.append(f"int f{name}(struct {name} *r) {{ high(r->pin); r->pin++; low(r->more[{n & 1}]); return r->more[0]; }}")
        self._top.append(f"struct {name} r{name} = {{{n}, {{{self._number()}, {self._number()}}}}};")
        self._functions.append(f"f{name}(&r{name})")
        self._top.append(f"struct {name} m{name}(int x) {{ struct {name} r = {{x, {{x + 1, {n}}}}}; return r; }}")
        self._functions.append(f"m{name}({{}}).{self._random.choice(('pin', 'more[0]', 'more[1]'))}")
        self._scopes[0].append(f"r{name}.pin")

    def mask(self) -> None:
        """A variable, a function, a table or a structure whose bits go to registers."""
        name, n, pick = self._name("k"), self._number(12), self._random
        use = pick.choice(("DIRA |= {};", "OUTA |= {};", "DIRA = {};", "OUTA ^= {};"))
        form = pick.choice(
            [
                f"unsigned m{name} = 1 << {n};\n"
                f"int {name}(int x) {{ m{name} |= 1u << (x & 15); {use.format('m' + name)} return x; }}",
                f"unsigned b{name}(int x) {{ return 1u << (x & 15); }}\n"
                f"int {name}(int x) {{ {use.format(f'b{name}(x) | b{name}({n})')} return x; }}",
                f"const unsigned char t{name}[4] = {{1, {n}, 2, 6}};\n"
                f"int {name}(int x) {{ {use.format(f't{name}[x & 3] << {n}')} return x + 1; }}",
                f"struct {name} {{ unsigned mask; int next; }} a{name} = {{1 << {n}, 4}}, b{name} = {{.mask = 2, .next = {n}}};\n"
                f"int {name}(int x) {{ struct {name} t = x & 1 ? a{name} : b{name}; t.mask <<= 1; "
                f"{use.format(f't.mask | a{name}.mask')} a{name} = t; return t.next; }}",
                f"int {name}(int x) {{ for (unsigned m = 1 << {n}; m < 1 << {n + 3}; m <<= 1) {use.format('m')} return x; }}",
            ]
        )
        self._top.append(form)
        self._functions.append(f"{name}({{}})")

    def bytes_(self) -> None:
        """A structure that is copied, cleared or walked through by its bytes."""
        name, n = self._name("B"), self._number()
        form = self._random.choice(
            [
                f"memset(&a{name}, 0, sizeof a{name});",
                f"memcpy(&a{name}, &b{name}, sizeof a{name});",
                f"memcpy(&a{name}, r{name}, sizeof a{name});",
                f"int *p = (int *)&a{name}; p[x & 1] = {n};",
                f"void *v = &a{name}; int *p = (int *)v; *p = {n};",
                f"int *p = &a{name}.pin; *++p = {n};",
                f"struct {name} t = a{name}; a{name} = b{name}; b{name} = t;",
                f"struct {name} *p = &a{name}; *p = b{name}; p->pin += 1;",
            ]
        )
        self._top += [
            "#include <string.h>",
            f"struct {name} {{ int pin, next; }} a{name} = {{{n}, 4}}, b{name} = {{{self._number()}, 5}};",
            f"int r{name}[2] = {{{self._number()}, {self._number()}}};",
            f"int f{name}(int x) {{ {form} high(a{name}.pin); low(a{name}.next); return x; }}",
        ]
        self._functions.append(f"f{name}({{}})")

    # Only in C++

    def capture(self) -> None:
        """A lambda within a function, which changes or copies a variable of the function."""
        name, n = self._name("cl"), self._number(6)
        form = self._random.choice(
            [
                f"auto f = [&own = a](int y) {{ own += y; }}; f({n}); high(a);",
                f"auto f = [own = a + {n}](int y) {{ high(own); return own + y; }}; low(f(1));",
                f"auto f = [a]() mutable {{ a += {n}; high(a); }}; f(); f(); low(a);",
                f"auto f = [&](auto y) {{ a = y + {n}; return a; }}; high(f(x & 3)); low(a);",
                f"[&] {{ a = {n}; }}(); high(a);",
                f"auto f = [=](int y) {{ return a + y; }}; a = {n}; high(f(2)); low(a);",
            ]
        )
        self._top.append(f"int {name}(int x) {{ int a = x & 7; {form} return a; }}")
        self._functions.append(f"{name}({{}})")

    def iterator(self) -> None:
        """A class with iterators of its own, or an operator that gives a reference."""
        name, n = self._name("It"), self._number(9)
        form = self._random.choice(
            [
                f"struct {name} {{ int t[3] = {{{n}, 4, 6}}; int *begin() {{ return t; }} int *end() {{ return t + 3; }} }};\n"
                f"int f{name}(int x) {{ {name} r; for (int &p : r) {{ high(p); p += x & 1; }} return r.t[1]; }}",
                f"struct {name} {{ int i; int operator*() const {{ return i; }} {name} &operator++() {{ i += 2; return *this; }} "
                f"bool operator!=(const {name} &o) const {{ return i < o.i; }} }};\n"
                f"int f{name}(int x) {{ for ({name} i = {{{n}}}; i != {name}{{{n + 5}}}; ++i) high(*i); return x; }}",
                f"struct {name} {{ int t[4]; int &operator[](int i) {{ return t[i]; }} }} o{name} = {{{{{n}, 1, 2, 3}}}};\n"
                f"int f{name}(int x) {{ o{name}[x & 3] = {n}; high(o{name}[1]); return o{name}.t[2]; }}",
                f"template <class T> void s{name}(T &a, T &b) {{ T t = a; a = b; b = t; }}\n"
                f"int f{name}(int x) {{ int a = {n}, b = x & 7; s{name}(a, b); high(a); low(b); return a; }}",
            ]
        )
        self._top.append(form)
        self._functions.append(f"f{name}({{}})")

    def reference(self) -> None:
        name, variable, n = self._name("x"), self._name("g"), self._number(4)
        self._top.append(f"int {variable} = {self._number()};")
        self._scopes[0].append(variable)
        form = self._random.choice([f"x += {n}; return x;", "high(x); x++; return x;", f"int &y = x; y = {n}; return y;"])
        self._top.append(f"int {name}(int &x) {{ {form} }}")
        self._functions.append(f"{name}({variable})")
        if self._random.random() < 0.4:
            self._top.append(f"int &r{name} = {variable};")
            self._scopes[0].append(f"r{name}")

    def default_argument(self) -> None:
        name, n = self._name("da"), self._number()
        self._top.append(f"int {name}(int x, int y = {n}) {{ high(y); return x + (y > {n}); }}")
        self._functions += [f"{name}({{}})", f"{name}({{}}, {{}})"]

    def template(self) -> None:
        name, n = self._name("te"), self._number()
        form = self._random.randrange(3)
        if form == 0:
            self._top.append(f"template <int N> int {name}(int x) {{ high(N); return x + N; }}")
            self._functions.append(f"{name}<{n}>({{}})")
        elif form == 1:
            self._top.append(f"template <class T> T {name}(T x) {{ low(x); return x + {n % 3}; }}")
            self._functions += [f"{name}({{}})", f"{name}<char>({{}})"]
        else:
            self._top.append(
                f"template <int A, int B = A + 2> struct {name} {{ "
                f"static const int value = A ^ B; static int on() {{ high(B); return A; }} }};"
            )
            self._functions.append(f"{name}<{n}>::on()")
            self._values.append(f"{name}<{n}, {self._number()}>::value")

    def class_(self) -> None:
        pick, name, n = self._random, self._name("C"), self._number()
        start = pick.choice(
            [
                f"{name}(int x) : pin(x) {{}}",
                f"{name}(int x) {{ pin = x + 1; }}",
                f"{name}(int x = {n}) : pin(x), next(x + 1) {{}}",
            ]
        )
        member = pick.choice(["int", "char", "unsigned char"])
        method = pick.choice(
            [
                "high(pin); return pin;",
                "low(pin++); return next;",
                "high(next); return count++;",
                "this->pin = next; high(pin); return 4;",
            ]
        )
        static = "static int count;"
        virtual = pick.choice(("", "", "virtual "))
        self._top.append(
            f"class {name} {{ public: {member} pin; int next = {self._number()}; "
            f"{static} {start} {virtual}int on() {{ {method} }} "
            f"int get() const {{ return pin; }} {name} &set(int x) {{ pin = x; return *this; }} }};"
        )
        self._top.append(f"int {name}::count = {self._number()};")
        self._top.append(f"{name} o{name}({self._number()});")
        self._functions += [f"o{name}.on()", f"{name}({{}}).on()", f"o{name}.set({{}}).get()"]
        self._scopes[0] += [f"o{name}.pin", f"{name}::count"]
        if pick.random() < 0.4:
            own = "int on() { low(next); return pin; }" if pick.random() < 0.6 else "int two() { return on() + 1; }"
            self._top.append(
                f"struct D{name} : {name} {{ D{name}(int y) : {name}(y) {{}} {own} }};\nD{name} d{name}({self._number()});"
            )
            self._functions += [f"d{name}.on()", f"static_cast<{name} &>(d{name}).on()"]

    def lambda_(self) -> None:
        name, n = self._name("la"), self._number(5)
        form = self._random.choice(
            [
                f"auto {name} = [](int x) {{ high(x); return x + {n}; }};",
                f"auto {name} = [](auto x) {{ return x + {n}; }};",
                f"static int k{name} = {n}; auto {name} = [](int x) {{ return k{name}++ + x; }};",
            ]
        )
        self._top.append(form)
        self._functions.append(f"{name}({{}})")

    def namespace(self) -> None:
        name, n = self._name("ns"), self._number()
        self._top.append(
            f"namespace {name} {{ int pin = {n}; int on(int x) {{ high(pin); return x; }} "
            f"namespace in {{ const int deep = {self._number()}; }} }}"
        )
        self._scopes[0].append(f"{name}::pin")
        self._functions.append(f"{name}::on({{}})")
        self._values.append(f"{name}::in::deep")

    def overload(self) -> None:
        name = self._name("ov")
        self._top.append(
            f"int {name}(int x) {{ high(x); return x; }}\nint {name}(char x) {{ low(x + 1); return x + 1; }}\n"
            f"int {name}(int x, int y) {{ return x ^ y; }}"
        )
        self._functions += [f"{name}({{}})", f"{name}((char)({{}}))", f"{name}({{}}, {{}})"]

    def constant(self) -> None:
        name, n = self._name("k"), self._number()
        self._top.append(
            f"constexpr int f{name}(int x) {{ return x > 3 ? x - 2 : x + {n}; }}\n"
            f"constexpr int {name} = f{name}({self._number()});"
        )
        self._values += [name, f"f{name}({n})"]

    def scoped(self) -> None:
        name = self._name("ec")
        self._top.append(f"enum class {name} : char {{ a = {self._number()}, b }};")
        self._values += [f"(int){name}::a", f"static_cast<int>({name}::b)"]

    def list_of_values(self) -> None:
        name = self._name("rl")
        self._top.append(f"int {name}[] = {{{self._number()}, {self._number()}, {self._number()}}};")
        self._top.append(
            f"int f{name}(int x) {{ for (auto{self._random.choice(('', ' &'))} "
            f"each : {name}) {{ high(each); each += x & 1; }} return {name}[1]; }}"
        )
        self._functions.append(f"f{name}({{}})")

    def conversion(self) -> None:
        name, n = self._name("Op"), self._number()
        form = self._random.choice(
            [
                "operator int() const { return p; }",
                "int operator()(int x) { return p + x; }",
                "int operator+(int x) { return p ^ x; }",
            ]
        )
        self._top.append(f"struct {name} {{ int p; {form} }} o{name} = {{{n}}};")
        self._functions.append(
            f"(int)o{name}" if "operator int" in form else f"o{name}({{}})" if "()(" in form else f"(o{name} + {{}})"
        )


COMMON = (
    Declarations.global_variable, Declarations.array, Declarations.table, Declarations.structure, Declarations.union,
    Declarations.enumeration, Declarations.macro, Declarations.macro, Declarations.function, Declarations.function,
    Declarations.function, Declarations.out_parameter, Declarations.function_pointer, Declarations.structure_parameter,
    Declarations.mask, Declarations.mask, Declarations.bytes_,
)  # fmt: skip
ONLY_CPP = (
    Declarations.reference, Declarations.default_argument, Declarations.template, Declarations.class_, Declarations.class_,
    Declarations.lambda_, Declarations.namespace, Declarations.overload, Declarations.constant, Declarations.scoped,
    Declarations.list_of_values, Declarations.conversion,
    Declarations.capture, Declarations.capture, Declarations.iterator,
)  # fmt: skip
