"""Placeholder declarations for source platform names other than functions: constants, registers, variables, types, attributes.

Each placeholder lets the retained code compile and comes with a task that says what it has to mean. A type that nothing declares
is inferred from its uses: members, pointers, initializer lists and arithmetic tell a record from a number. A name that the target
already has is hidden for the program only (see `target_names`).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence

from robosmi.metamodels import ccode, migration, platform
from robosmi.query import ancestor_of_kind
from robosmi.transformations.knowledge.platforms.target_names import TargetNames
from robosmi.transformations.knowledge.platforms.target_platform import PLAIN_C, TargetFacts
from robosmi.transformations.knowledge.standard_names import STANDARD_NAMES
from robosmi.transformations.m2m.adapters.signatures import Signature, for_target
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import ARITHMETIC, FunctionType, expectations, type_of
from robosmi.transformations.queries.macros.tokens import names_in
from robosmi.transformations.queries.own_headers import included
from robosmi.transformations.queries.record_members import members
from robosmi.transformations.queries.signature_text import declare, type_names

_WORD = re.compile(r"[A-Za-z_]\w*")
_NO_TYPES = ARITHMETIC | {
    "void",
    "const",
    "volatile",
    "struct",
    "union",
    "enum",
    "restrict",
    "register",
    "static",
    "extern",
    "inline",
    "va_list",
}

_PREDEFINED = frozenset({"__LINE__", "__FILE__", "__DATE__", "__TIME__", "__func__", "__FUNCTION__", "__COUNTER__"})
"""Macros that every compiler predefines but does not list."""


def used_symbols(
    views: Sequence[CodeView], adapted: Iterable[str], target: TargetFacts, names: TargetNames
) -> dict[str, list[ccode.NameReference]]:
    """The platform's values and unknown values that need a placeholder, with their uses.

    Args:
        views: a view of each unit.
        adapted: functions that have an adapter.
        target: the target.
        names: its names.
    """
    outside = set(adapted) | _PREDEFINED | names.same | names.keywords | names.absent
    own = {id(view.unit): _own(views) - _macros_of_others(view, views) | outside for view in views}
    found: dict[str, list[ccode.NameReference]] = {
        s.name: [] for view in views for s in view.symbols() if s.name not in own[id(view.unit)]
    }
    for view in views:
        there = own[id(view.unit)]
        asked = [(int(c.startOffset), int(c.endOffset)) for c in view.unit.conditionals]  # what is asked there is decided
        for use in view.unit.macroUses:
            if any(start <= use.startOffset < end for start, end in asked):
                continue
            entry = view.resolve(use.name)
            known = use.name in there or use.name in names.macros or use.name in STANDARD_NAMES or use.functionLike
            if use.macro is None and not known and (entry is None or entry.header not in target.standard_headers):
                found.setdefault(use.name, [])
        for reference in view.of_kind(ccode.NameReference):
            symbol = reference.target
            if (
                not isinstance(symbol, ccode.ExternalSymbol)
                or symbol.header in target.standard_headers
                or reference.name in there
                or "<" in str(reference.name)  # a member of a template, which no declaration can stand for
            ):
                continue
            entry = view.resolve(reference.name)
            if (entry is None or entry.header not in target.standard_headers) and reference.name not in STANDARD_NAMES:
                found.setdefault(reference.name, []).append(reference)
    for name in size_names(views) - _own(views) - outside - names.macros - STANDARD_NAMES.keys():
        if not any((entry := view.resolve(name)) is not None and entry.header in target.standard_headers for view in views):
            found.setdefault(name, [])
    return dict(sorted(found.items()))


def standard_values(views: Sequence[CodeView], target: TargetFacts) -> Iterable[tuple[str, str, list[ccode.NameReference]]]:
    """Values of standard headers that the program uses, as (name, header, uses); the target may give them other values.

    Args:
        views: a view of each unit.
        target: the target.
    """
    own = _own(views)
    for view in views:
        uses: dict[str, list[ccode.NameReference]] = {m.name: [] for m in view.unit.macroUses if m.macro is None}
        for reference in view.of_kind(ccode.NameReference):
            if isinstance(reference.target, ccode.ExternalSymbol):
                uses.setdefault(str(reference.name), []).append(reference)
        for macro in view.own_macros.values():
            uses |= {word: uses.get(word, []) for word in _WORD.findall(str(macro.body or ""))}
        for name, references in uses.items():
            entry = view.resolve(name) if name not in own else None
            if entry is not None and entry.kind != "function" and entry.header in target.standard_headers:
                yield name, str(entry.header), references


def size_names(views: Sequence[CodeView]) -> set[str]:
    """Names in array sizes that nothing in the program declares; the model keeps sizes as text only."""
    written = {w for v in views for t in v.of_kind(ccode.TypeUse) for w in names_in(t.arrayDims or "")}
    declared = {d.name for v in views for d in v.of_kind(ccode.Declaration)} if written else set()
    return written - declared - _own(views) - _NO_TYPES - {"sizeof"}


def _own(views: Sequence[CodeView]) -> set[str]:
    """Names that some file of the program declares or defines at file scope."""
    own = {m.name for v in views for m in v.unit.macros}
    for view in views:
        own.update(d.name for d in view.unit.declarations)
        for kind in (ccode.Record, ccode.Enumeration, ccode.EnumerationLiteral):
            own.update(d.name for d in view.of_kind(kind) if ancestor_of_kind(d, ccode.Function) is None)
    return own - {""}


def _macros_of_others(view: CodeView, views: Sequence[CodeView]) -> set[str]:
    """Platform macros that a file uses and that the program also defines, but only in files it does not include."""
    seen = {id(u) for u in (view.unit, *included(view.unit))}
    macros = {m.name for u in (view.unit, *included(view.unit)) for m in u.macros}
    others = {m.name for v in views if id(v.unit) not in seen for m in v.unit.macros} - macros
    used = {str(r.name) for r in view.of_kind(ccode.NameReference) if isinstance(r.target, ccode.ExternalSymbol)}
    return {name for name in used & others if view.kind(name) == "platform"}


def implied_headers(views: Iterable[CodeView], target: TargetFacts, names: TargetNames) -> list[migration.SymbolUse]:
    """Standard headers that the program gets only through platform headers and that the target's main header does not include."""
    there = names.declared | names.macros | names.keywords
    missing: set[str] = set()
    for view in views:
        outside = (e for e in view.of_kind(ccode.NameReference) if e.target is None or isinstance(e.target, ccode.ExternalSymbol))
        used = {str(e.name) for e in outside} | {str(e.name) for e in view.of_kind(ccode.MacroUse) if e.macro is None}
        used |= set(view.called()) | {t.declaration.name for t in view.of_kind(ccode.TypeUse) if t.declaration is not None}
        for name in used - there:
            entry = view.resolve(name)
            if entry is not None and entry.header in target.standard_headers and not view.defined(name):
                missing.add(entry.header)
        missing -= {i.header for i in view.unit.includes}
    return [
        migration.SymbolUse(name=header, placeholder=f"#include <{header}>", status=migration.AdapterStatus.filled)
        for header in sorted(missing)
    ]


def symbol_use(
    name: str,
    uses: list[ccode.NameReference],
    symbol: platform.ApiSymbol | None,
    number: int,
    attribute: bool,
    wanted: str,
    source: str,
    target: TargetFacts,
    names: TargetNames,
    *,
    several: bool,
) -> migration.SymbolUse:
    """The placeholder of a value.

    Args:
        name: the name.
        uses: its uses.
        symbol: how the repository knows it, None where it does not.
        number: a number that no other placeholder has.
        attribute: it is a macro that stands for an attribute.
        wanted: the type that a use expects, empty where none says one.
        source: name of the source platform.
        target: the target.
        names: its names.
        several: the sketch has several files, which must share a variable.
    """
    if attribute:
        text = f"#define {name}"
    else:
        declared = uses[0].target if uses else None
        use = declared.use if isinstance(declared, ccode.ExternalSymbol) else ccode.SymbolUse.constantUse
        written = use in (ccode.SymbolUse.writtenUse, ccode.SymbolUse.indexedUse)
        kind = (
            symbol.symbolKind if symbol is not None else platform.SymbolKind.variable if written else platform.SymbolKind.constant
        )
        spelled = (symbol.typeName if symbol is not None else "") or wanted or "int"
        mutable = written or kind in (platform.SymbolKind.register, platform.SymbolKind.variable) or "*" in spelled
        shown = f"{source}_{name}" if name in names.declared else name
        dimensions = max((_dimensions(each) for each in uses), default=0) if use is ccode.SymbolUse.indexedUse else 0
        text = _value(shown, spelled, dimensions, mutable, number, target, several=several)
        if shown != name:
            text += f"\n#define {name} {shown}"
        elif name in names.macros:
            text = f"#undef {name}\n{text}"
    return migration.SymbolUse(name=name, placeholder=text, status=migration.AdapterStatus.todo, symbol=symbol, uses=uses)


def _dimensions(use: ccode.NameReference) -> int:
    """How many indices stand behind a name, at least one."""
    count: int = 0
    element: ccode.Expression = use
    while isinstance(outer := element.eContainer(), ccode.Index) and outer.array is element:
        count, element = count + 1, outer
    return max(count, 1)


def _value(name: str, spelled: str, dimensions: int, mutable: bool, number: int, target: TargetFacts, *, several: bool) -> str:
    base, bracket, _ = spelled.partition("[")
    kind = for_target(Signature(name, base.strip()), target.widths).returns
    if not mutable:
        # Constants of unknown value must differ, even after adding small numbers, or a switch over them would not compile;
        # none is 0, since they may be sizes of arrays.
        bare = kind.removeprefix("const ")
        if target.language == PLAIN_C and set(bare.split()) <= ARITHMETIC - {"float", "double"}:
            return f"enum {{ {name} = {number} }};"  # a constant of C is no constant expression
        return f"const {bare} {name} = {number};"
    storage = "__attribute__((weak)) " if several else "static "  # weak: the one variable of all files
    kind = kind.removeprefix("const ") if "*" not in kind else kind
    if dimensions or bracket:
        return f"{storage}{declare(kind, name)}{'[16]' if dimensions < 2 else '[4]' * dimensions};"
    plain = "*" in kind or set(kind.replace("volatile", "").split()) <= ARITHMETIC
    return f"{storage}{declare(kind, name)}{' = 0' if plain else ''};"


def expected_types(views: Iterable[CodeView], functions: Mapping[str, FunctionType]) -> dict[str, str]:
    """For each undeclared name used where a pointer is expected, the type of that pointer."""
    found: dict[str, str] = {}
    for view in views:
        for expression, kind in expectations(view, functions):
            if isinstance(expression, ccode.NameReference) and isinstance(expression.target, ccode.ExternalSymbol) and kind.depth:
                found.setdefault(expression.name, kind.spelling)
    return found


def type_uses(
    views: Sequence[CodeView],
    sources: Mapping[str, bytes],
    signatures: Iterable[str],
    target: TargetFacts,
    names: TargetNames,
    declare: Callable[[str, str], platform.Adapter | None],
) -> list[migration.SymbolUse]:
    """Declarations for the types that nobody declares, in the program and in the generated signatures.

    Args:
        views: a view of each unit.
        sources: path of a unit -> its bytes.
        signatures: types as written in what is generated.
        target: the target.
        names: its names.
        declare: name, header -> the piece of adapter text that declares the type.
    """
    there = _NO_TYPES | names.declared | names.keywords | _own(views)
    # A tag or typedef inside a function hides nothing here: the model links its uses to it.
    in_program = {
        t.declaration.name for v in views for t in v.of_kind(ccode.TypeUse) if isinstance(t.declaration, ccode.ExternalSymbol)
    }
    pointed = {word for text in signatures if "*" in text for word in type_names(text.partition("*")[0])}
    found = (in_program | {word for text in signatures for word in type_names(text)}) - there
    meant = {name: other for name in found if (other := _meant(name, views))}
    found |= set(meant.values()) - there
    made = []
    for name in sorted(found):
        standard = (e for v in views for e in v.api.entries(name) if e.header in target.standard_headers)
        entry = next((e for e in (*standard, *(v.resolve(name) for v in views)) if e is not None), None)
        piece = declare(name, entry.header if entry is not None else "")
        if piece is not None:
            text, status = "", migration.AdapterStatus.filled
        elif entry is not None and entry.header in target.standard_headers:
            text, status = f"#include <{entry.header}>", migration.AdapterStatus.filled
        elif name in meant:
            text, status = f"typedef {meant[name]} {name};", migration.AdapterStatus.filled
        else:
            names_of_it = {name, *(other for other, one in meant.items() if one == name)}
            text = _type(name, names_of_it, views, sources, target, pointed=not pointed.isdisjoint(names_of_it))
            status = migration.AdapterStatus.todo
            if target.language == PLAIN_C and text.startswith("struct "):  # in C the tag alone names no type
                text = f"typedef {text.removesuffix(';')} {name};"
        made.append(migration.SymbolUse(name=name, placeholder=text, status=status, adapter=piece))
    made = _inner_first(made)
    if any(f"{ANY_VALUE} " in str(each.placeholder) for each in made):
        filled = migration.AdapterStatus.filled
        made.insert(0, migration.SymbolUse(name=ANY_VALUE, placeholder=_ANY_VALUE, status=filled))
    return made


def _inner_first(types: Iterable[migration.SymbolUse]) -> list[migration.SymbolUse]:
    """Sort types so that each follows the types of its members."""
    left = {str(each.name): each for each in types}
    ordered: list[migration.SymbolUse] = []

    def place(name: str) -> None:
        if (each := left.pop(name, None)) is not None:
            for word in _WORD.findall(str(each.placeholder or "")):
                place(word)
            ordered.append(each)

    for name in list(left):
        place(name)
    return ordered


ANY_VALUE = "AnyValue"
_ANY_VALUE = f"""// Holds a member of a type that is to be written: a pointer, a function or a number
struct {ANY_VALUE} {{
  intptr_t value;
  {ANY_VALUE}(int32_t number = 0) : value(number) {{}}
  template <class T> {ANY_VALUE}(T *pointer) : value((intptr_t)pointer) {{}}
  template <class T> operator T *() const {{ return (T *)value; }}
  uint8_t &operator[](int32_t place) const {{ return ((uint8_t *)value)[place]; }}
  explicit operator bool() const {{ return value != 0; }}
  template <class... T> int32_t operator()(T... given) const {{ return ((int32_t (*)(T...))value)(given...); }}
}};"""


def _meant(name: str, views: Sequence[CodeView]) -> str:
    """The platform type that another type is a typedef of; empty if it is none."""
    entry = next((e for e in (v.resolve(name) for v in views) if e is not None), None)
    other = entry.detail.removeprefix("typedef ") if entry is not None and entry.kind == "type" else ""
    return other if other != "typedef" and other != name and any(v.resolve(other) is not None for v in views) else ""


def _type(
    name: str,
    names: Collection[str],
    views: Sequence[CodeView],
    sources: Mapping[str, bytes],
    target: TargetFacts,
    *,
    pointed: bool,
) -> str:
    uses = [t for v in views for t in v.of_kind(ccode.TypeUse) if t.declaration is not None and t.declaration.name in names]
    fields = members(names, views, sources)
    listed = max((listed_values(each, views) for each in names), key=len)
    anything = target.language != PLAIN_C
    if anything:
        pointers = pointers_in(views)
        fields = [f"{ANY_VALUE} {word}" if (word := _member_name(field)) in pointers else field for field in fields]
    kind = ANY_VALUE if anything and any(is_pointer(each) for each in listed) else "int32_t"
    values = [f"{kind} value{number}" for number in range(1, len(listed) + 1)]
    fields += values[len(fields) :]
    tag = any(t.spelling.replace("const ", "").startswith(("struct ", "union ")) for t in uses)
    if fields or tag or ((pointed or any(t.pointerDepth for t in uses)) and not any(is_computed(n, views) for n in names)):
        return f"struct {name} {{{''.join(f' {f};' for f in fields)}{' ' * bool(fields)}}};"
    return f"typedef int32_t {name};"


def _member_name(declarator: str) -> str:
    """The name in a member's declarator, as `record_members` writes it."""
    words: list[str] = re.findall(r"[A-Za-z_]\w*", declarator.partition(")")[0].partition("[")[0])
    return words[-1] if words else ""


# ---- what a type must support


def pointers_in(views: Iterable[CodeView]) -> set[str]:
    """The names of members to which the program assigns a pointer or a function."""
    assigned = (a for view in views for a in view.of_kind(ccode.Assignment) if isinstance(a.left, ccode.Member))
    return {str(a.left.name) for a in assigned if isinstance(a.left, ccode.Member) and is_pointer(a.right)}


def is_pointer(value: ccode.Expression | None) -> bool:
    """Whether a value is a pointer: a string literal, a function, or an expression of pointer type."""
    if isinstance(value, ccode.StringLiteral) or (
        isinstance(value, ccode.NameReference) and isinstance(value.target, ccode.Function)
    ):
        return True
    kind = type_of(value, {})
    return kind is not None and (kind.depth > 0 or kind.function)


def listed_values(name: str, views: Iterable[CodeView]) -> list[ccode.Expression]:
    """The longest initializer list of a variable of the type."""
    variables = (v for view in views for v in view.of_kind(ccode.Variable) if isinstance(v.initializer, ccode.InitializerList))
    kinds = [(v.valueType, v.initializer) for v in variables if v.valueType is not None]
    lists = [
        list(value.elements)
        for kind, value in kinds
        if isinstance(value, ccode.InitializerList)
        and kind.declaration is not None
        and kind.declaration.name == name
        and not kind.arrayDims
    ]
    return max(lists, key=len, default=[])


def is_computed(name: str, views: Iterable[CodeView]) -> bool:
    """Whether a value of the type is used in arithmetic or is assigned a number."""
    for view in views:
        variables: tuple[ccode.Variable | ccode.Parameter, ...] = (
            *view.of_kind(ccode.Variable),
            *view.of_kind(ccode.Parameter),
        )
        for variable in variables:
            use = variable.valueType
            if use is None or use.declaration is None or use.declaration.name != name or use.pointerDepth or use.arrayDims:
                continue
            if isinstance(variable, ccode.Variable) and isinstance(variable.initializer, (ccode.IntegerLiteral, ccode.Binary)):
                return True
            if any(_calculates(r) for r in variable.references):
                return True
    return False


def _calculates(reference: ccode.NameReference) -> bool:
    container = reference.eContainer()
    if isinstance(container, ccode.Assignment):
        return isinstance(container.right, (ccode.IntegerLiteral, ccode.Binary)) or container.operator != "="
    return isinstance(container, ccode.Binary) or (isinstance(container, ccode.Unary) and container.operator not in ("&", "*"))
