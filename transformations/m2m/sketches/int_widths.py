"""Numbers wrap around as on a board whose int is narrower: the types of variables and casts keep the width that they had there.

Only what may leave that width is changed (`WrappedValues`): a variable gets a type of its width on the source, and a result
that is looked at is cut to it. What points or refers to a variable changes with it (`linked_types`). A variable that a function
of a library takes as an int keeps its type, and is a task.

Where char has no sign on the target, variables and casts of type char that take negative values become `signed char`.

Formats of printf and scanf print and read what they do on a board with a narrower int. `%u` of a negative int, and `%d` of an
unsigned one, show other digits where int is wider, so the argument is cut. `%d` of scanf writes as many bytes as an int has, so
a variable of 16 bits is read by `%hd`. A conversion of another width than its argument, and one of a float, which avr-libc
prints as `?`, are places. Source: ISO/IEC 9899:1999, 7.19.6; avr-libc, vfprintf().

The least and the greatest value that functions and methods of a platform return are data (`values.toml`).
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping
from functools import cache

from robosmi import resources
from robosmi.base.data_tables import DataTable
from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.project import read_data
from robosmi.query import all_contents
from robosmi.transformations.knowledge.replacements import Replacement, inserted
from robosmi.transformations.m2m.sketches.argument_values import stored_values, taken_values
from robosmi.transformations.m2m.sketches.linked_types import TypeLinks, declarations
from robosmi.transformations.m2m.sketches.sketch_edits import MovedSketch, SketchEdit, is_written
from robosmi.transformations.m2m.widths.width_formats import conversions
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.constants.declared_uses import Declared
from robosmi.transformations.queries.constants.negative_chars import as_characters, negative_chars
from robosmi.transformations.queries.constants.wrapped_values import WrappedValues
from robosmi.transformations.queries.expression_text import expression_text
from robosmi.transformations.queries.expression_type import of_use
from robosmi.transformations.queries.numbers import COMPARISONS, Machine
from robosmi.transformations.queries.own_headers import unit_of
from robosmi.transformations.queries.portability.analysed_program import PortabilityPlace
from robosmi.transformations.queries.portability.kinds import is_of_bytes
from robosmi.transformations.queries.width_types import retyped_words

TIME, KEPT, KEPT_CHAR, BYTES = "int_time", "int_kept", "char_kept", "bytes_of_object"
_TYPE = re.compile(
    rb"(?:\s*\b(?:static|const|volatile|register|extern|inline|constexpr|unsigned|signed|int|char|double|PROGMEM)\b)+"
)
"""The words in front of a declared name, as far as a type is written with them."""
_FUNCTIONAL = re.compile(rb"(?:static_cast\s*<\s*)?(unsigned\s+int|unsigned|word|int)\b")
_TEMPLATE = re.compile(r"<(.*)>", re.DOTALL)
_GROWING = frozenset(["+", "-", "*", "<<", "~", "++", "--"])
_LIMITS = frozenset(["UINT16_MAX", "INT16_MAX", "INT16_MIN"])

_KIND = "format_width"
_RULE = "format-width"
_FORMATS: Mapping[str, int] = {"printf": 0, "sprintf": 1, "fprintf": 1, "snprintf": 2, "sscanf": 1, "scanf": 0}
"""Function -> the position of its format; their relatives for formats in program memory end with `_P`."""
_INTEGERS = frozenset("diuxXo")
_REALS = frozenset("aAeEfFgG")
_BITS = {"hh": 8, "h": 16, "": 16, "l": 32, "ll": 64}
"""Length of a conversion -> the bits that it takes where int has 16."""


def wrapped_values(sketch: MovedSketch) -> WrappedValues | None:
    """Where the numbers of a program leave its int; None if the int of the target is not wider."""
    here, there = sketch.move.source, sketch.move.target
    if here.int_bits >= there.int_bits:
        return None
    own, other = (Machine(each.int_bits, 32, each.int_bits, each.char_signed) for each in (here, there))
    platform = sketch.views[0].api.name
    results, of_operands, of_bits = _returned_values(platform), _macros_of_operands(platform), _macros_of_bits(platform)
    return WrappedValues(sketch.views, own, other, results, of_operands, of_bits)


def int_widths(sketch: MovedSketch) -> Iterator[SketchEdit | PortabilityPlace]:
    """The edits of types of variables, and the casts of results; the variables that have to keep their type."""
    values = wrapped_values(sketch)
    if values is None:
        return
    bits, done = sketch.move.source.int_bits, set[tuple[str, int]]()
    links = TypeLinks(sketch.views, values.uses, lambda each: _written_at(sketch, each, bits), of_bytes(sketch))
    for holder in values.variables:
        group = links.of(holder)
        if group.obstacle is not None:
            yield sketch.place(KEPT, holder, str(holder.name))
            continue
        for each in group.declarations:
            words = retyped_here(sketch, each, bits)
            unit = unit_of(each)
            place = (str(unit.path), words[0].start) if words and unit is not None else None
            if place is None or place in done:
                continue
            done.add(place)
            reason = f"'{each.name}' may leave the {bits} bits that an int has on its own board, and wraps there"
            yield SketchEdit(each, "int-wraps", reason, words)
        yield from _cured_times(sketch, values, holder)
    cuts = [*_format_widths(sketch, values), *stored_values(sketch, values), *taken_values(sketch, values)]
    cuts += _widths_left(sketch, values)
    yield from cuts
    cut_there = {id(each.element) for each in cuts if isinstance(each, SketchEdit)}
    for view in sketch.views:
        given = _given_to_macros(view, values)
        for expression, number in (*values.exceeding(view), *values.returned(view)):
            if not (is_written(view, expression) or id(expression) in given) or id(expression) in cut_there:
                continue
            cut = f"{'' if number.signed else 'u'}int{bits}_t"
            start, end = int(expression.startOffset), int(expression.endOffset)
            reason = f"the result is cut to the {bits} bits that it has on its own board"
            yield SketchEdit(expression, "int-cut", reason, (inserted(start, f"({cut})("), inserted(end, ")")))


def _given_to_macros(view: CodeView, values: WrappedValues) -> set[int]:
    """The uses in the text of macros of the platform like `abs`, and what is in their arguments, by `id`: they may be cut.

    What another macro makes is not in the text; only its name is.
    """
    others = [use for use in view.unit.macroUses if str(use.name) not in values.of_operands]
    found: set[int] = set()
    for call in view.of_kind(ccode.Call):
        if call.viaMacro or not values.joins_operands(call) or any(_is_inside(call, use) for use in others):
            continue
        inner = [use for use in others if _is_inside(use, call)]
        for each in (call, *all_contents(call)):
            if isinstance(each, ccode.Located) and not any(_is_made_by(each, use) for use in inner):
                found.add(id(each))
    return found


def _is_inside(inner: ccode.Located, outer: ccode.Located) -> bool:
    return bool(outer.startOffset <= inner.startOffset and inner.endOffset <= outer.endOffset)


def _is_made_by(element: ccode.Located, use: ccode.MacroUse) -> bool:
    """Whether an expression is in the text of a macro's use, and is not the macro's name alone."""
    named = isinstance(element, ccode.NameReference) and _is_inside(use, element)
    return _is_inside(element, use) and not named


def _widths_left(sketch: MovedSketch, values: WrappedValues) -> Iterator[SketchEdit | PortabilityPlace]:
    """The edits of casts that look like calls, and of numbers that are compared without a sign; the limits and sizes left."""
    bits = values.here.int_bits
    for view in sketch.views:
        data = sketch.sources[str(view.unit.path)]
        for cast in view.of_kind(ccode.Cast):
            start = int(cast.startOffset)
            found = _FUNCTIONAL.match(data, start) if cast.target is None and is_written(view, cast) else None
            if found is None:
                continue
            spelling = f"{'u' if found[1].startswith((b'unsigned', b'word')) else ''}int{bits}_t"
            number = values.here.number(spelling)
            if number is not None and values.cuts(cast.operand, number):
                change = Replacement(found.start(1), found.end(1), spelling)
                yield SketchEdit(cast, "int-cut", f"the result is cut to the {bits} bits that it has on its own board", (change,))
        for each in view.of_kind(ccode.Binary):
            if (each.operator in COMPARISONS or each.operator in ("/", "%")) and is_written(view, each):
                yield from _unsigned_side(each, each.left, each.right, values)
            limits = [side for side in (each.left, each.right) if isinstance(side, ccode.NameReference)]
            if each.operator in ("+", "-", "*", "<<"):
                yield from (sketch.place("int_limit", each, str(side.name)) for side in limits if side.name in _LIMITS)
        for call in view.of_kind(ccode.Call):
            if values.joins_operands(call) and is_written(view, call):
                for other in call.arguments[1:]:  # with which the macro compares its first argument
                    yield from _unsigned_side(call, call.arguments[0], other, values)
        yield from (sketch.place("int_template", each, name) for each, name in _template_ints(view, data, values))
        for size in view.of_kind(ccode.SizeOf):
            if not isinstance(size.operand, ccode.NameReference):
                continue
            held = size.operand.target
            known = isinstance(held, (ccode.Variable, ccode.Field)) and values.is_int(held.valueType) and not values.wraps(held)
            outer = size.eContainer()
            if isinstance(held, (ccode.Variable, ccode.Field)) and _is_stored(sketch, held, values):
                continue  # it gets the bytes that it has on its own board (`object_bytes`)
            if known and not (isinstance(outer, ccode.Binary) and outer.operator == "/" and outer.left is size):
                yield sketch.place("sizeof_int", size, f"each int in sizeof({size.operand.name})")


def _is_stored(sketch: MovedSketch, held: Declared, values: WrappedValues) -> bool:
    """Whether a variable itself is given to a call or cast that takes its bytes."""
    view_of = {id(view.unit): view for view in sketch.views}
    return is_free(held, of_bytes(sketch)) and any(
        isinstance(_around(use), (ccode.Call, ccode.Cast)) and int(use.line) in sketch.lines(BYTES, view_of[id(unit_of(use))])
        for use in values.uses.of(held)
    )


def _around(use: ccode.Expression) -> Element | None:
    """What takes a variable, or its address."""
    outer = use.eContainer()
    return outer.eContainer() if isinstance(outer, ccode.Unary) and outer.operator == "&" else outer


def _template_ints(view: CodeView, data: bytes, values: WrappedValues) -> Iterator[tuple[ccode.Located, str]]:
    """The uses of the program's templates for an int with which they calculate: its width is not in their text."""
    for call in view.of_kind(ccode.Call):
        function = call.callee
        if function is None or not _calculates(function, function, values):
            continue
        given = data[int(call.startOffset) : min((int(a.startOffset) for a in call.arguments), default=int(call.endOffset))]
        written = _TEMPLATE.search(given.decode("utf-8", "replace"))
        names = _type_names(function)
        for argument, parameter in zip(call.arguments, function.parameters, strict=False):
            kind, number = of_use(parameter.valueType), values.number(argument)
            of_int = number is not None and not number.real and not number.fixed and number.bits == values.here.int_bits
            if kind is not None and kind.base.rstrip("& ") in names and (_has_int(written[1]) if written else of_int):
                yield call, f"{function.name}({', '.join(map(expression_text, call.arguments))})"
                break
    objects: list[ccode.Variable | ccode.Field] = [*view.of_kind(ccode.Variable), *view.of_kind(ccode.Field)]
    for each in objects:
        kind = of_use(each.valueType)
        record = kind.declaration if kind is not None else None
        written = _TEMPLATE.search(kind.base) if kind is not None and isinstance(record, ccode.Record) else None
        if written is None or not _has_int(written[1]) or not isinstance(record, ccode.Record):
            continue
        if any(_calculates(method, record, values) for method in record.methods):
            yield each, f"{kind.base if kind is not None else ''} {each.name}"


def _has_int(arguments: str) -> bool:
    return any(each.strip() in ("int", "unsigned", "unsigned int") for each in arguments.split(","))


def _type_names(template: ccode.Function | ccode.Record) -> set[str]:
    """The names of a template's parameters that are types."""
    return {str(each.name) for each in template.templateParameters if each.valueType is None}


def _calculates(function: ccode.Function, template: ccode.Function | ccode.Record, values: WrappedValues) -> bool:
    """Whether a function calculates with what has the type of a parameter of its template, so that it may wrap."""
    names = _type_names(template)
    for each in all_contents(function) if names else ():
        if isinstance(each, (ccode.Binary, ccode.Assignment, ccode.Unary)) and str(each.operator).rstrip("=") in _GROWING:
            kinds = (of_use(holder.valueType) for inner in (each, *all_contents(each)) for holder in values.uses.holders(inner))
            if any(kind is not None and kind.base.rstrip("& ") in names for kind in kinds):
                return True
    return False


def _unsigned_side(
    each: ccode.Binary | ccode.Call, left: ccode.Expression | None, right: ccode.Expression | None, values: WrappedValues
) -> Iterator[SketchEdit]:
    """The edit of a number that may be negative where it meets an unsigned one, which the source's int cannot hold.

    An unsigned int of the target holds it, other than a `uint16_t`: that becomes an int there, with a sign.
    """
    bits = values.here.int_bits
    for one, other in ((left, right), (right, left)):
        number, found = values.number(one), values.range_of(other)
        if number is None or number.real or number.signed or number.bits != bits or other is None:
            continue
        of = values.number(other)
        if of is None or of.real or not of.signed or of.bits > bits or (found is not None and found.low >= 0):
            continue
        single = isinstance(each, ccode.Binary) and each.operator in COMPARISONS and found is not None and found.single
        if single or values.is_narrow_there(one):
            start, end = int(other.startOffset), int(other.endOffset)
            reason = "it has no sign beside an unsigned number on its own board"
            yield SketchEdit(other, "int-cut", reason, (inserted(start, f"(uint{bits}_t)("), inserted(end, ")")))


def _written_at(sketch: MovedSketch, each: ccode.Declaration, bits: int) -> tuple[str, int] | None:
    """Where the type of a declaration is written; None for one that cannot get a width there, or has none."""
    unit = unit_of(each)
    words = retyped_here(sketch, each, bits)
    if words and unit is not None:
        return str(unit.path), words[0].start
    use = each.valueType if isinstance(each, (ccode.Variable, ccode.Parameter, ccode.Field)) else None
    kind = of_use(use)
    fixed = unit is not None and kind is not None and kind.base.rstrip("& ") in (f"int{bits}_t", f"uint{bits}_t")
    return (str(unit.path), int(each.startOffset)) if fixed and unit is not None else None


def _cured_times(sketch: MovedSketch, values: WrappedValues, holder: Declared) -> Iterator[SketchEdit]:
    """Edits without changes that cure the places where a variable with its own width takes a time."""
    for view in sketch.views:
        at = {int(each.line) for each in (holder, *values.uses.of(holder)) if unit_of(each) is view.unit}
        if lines := tuple(sorted(at & sketch.lines(TIME, view))):
            yield SketchEdit(view.unit, "int-wraps", "the variable wraps as on its own board", (), TIME, lines)


def char_signs(sketch: MovedSketch) -> Iterator[SketchEdit | PortabilityPlace]:
    """The edits of variables, parameters and functions of type char that have negative values, where char has no sign.

    Those to which something points or refers keep their type, and are places.
    """
    if not sketch.move.source.char_signed or sketch.move.target.char_signed:
        return
    yield from _char_casts(sketch)
    done = set[tuple[str, int]]()
    cast = set[int]()
    view_of = {id(view.unit): view for view in sketch.views}
    for holder in negative_chars(sketch.views, _returned_values(sketch.views[0].api.name)):
        group = declarations(sketch.views, holder)
        if not all(is_free(each) for each in group):
            yield sketch.place(KEPT_CHAR, holder, str(holder.name))
            continue
        for use in (use for each in group for use in as_characters(each)):
            start = int(use.startOffset)
            if start not in cast and is_written(view_of[id(unit_of(use))], use):
                cast.add(start)
                yield SketchEdit(use, "char-sign", "it is a character here, and no number", (inserted(start, "(char)"),))
        for each in group:
            data, start = _source(sketch, each)
            found = _TYPE.match(data, start)
            word = re.search(rb"\bchar\b", found[0]) if found else None
            unit = unit_of(each)
            if found is None or word is None or unit is None or (str(unit.path), start + word.start()) in done:
                continue
            done.add((str(unit.path), start + word.start()))
            at = start + word.start()
            yield SketchEdit(
                each, "char-sign", f"'{each.name}' takes negative values, and char has no sign there", (inserted(at, "signed "),)
            )


def _char_casts(sketch: MovedSketch) -> Iterator[SketchEdit]:
    """The edits of casts to char of numbers that get negative there, where their value is calculated or compared with."""
    for view in sketch.views:
        for cast in view.of_kind(ccode.Cast):
            plain = cast.target is not None and str(cast.target.spelling).strip() == "char" and is_written(view, cast)
            numbers = {value.number for value in view.values.of(cast.operand)} if plain else set()
            if isinstance(cast.eContainer(), ccode.Binary) and any(each is not None and not 0 <= each < 128 for each in numbers):
                start = int(cast.startOffset)
                at = sketch.sources[str(view.unit.path)].find(b"char", start, int(cast.endOffset))
                if at >= 0:
                    yield SketchEdit(
                        cast, "char-sign", "the number is negative as a char of its own board", (inserted(at, "signed "),)
                    )


def retyped_here(sketch: MovedSketch, each: ccode.Declaration, bits: int) -> tuple[Replacement, ...]:
    """The replacements in front of a declared name that give its int a width; none where its type is written otherwise."""
    data, start = _source(sketch, each)
    found = _TYPE.match(data, start)
    return tuple(
        Replacement(word.start + start, word.end + start, word.text) for word in retyped_words(found[0], bits)
    ) if found else ()  # fmt: skip


def _source(sketch: MovedSketch, each: ccode.Declaration) -> tuple[bytes, int]:
    unit = unit_of(each)
    return (sketch.sources[str(unit.path)], int(each.startOffset)) if unit is not None else (b"", 0)


def of_bytes(sketch: MovedSketch) -> frozenset[str]:
    """The functions that take the bytes of an object of any type."""
    kind = sketch.kinds[BYTES]
    return frozenset([*kind.functions, *kind.stores])


def is_free(holder: ccode.Declaration, taking: Collection[str] = ()) -> bool:
    """Whether a type may change: nothing points or refers to the variable as to one of its type.

    Args:
        holder: the variable.
        taking: the functions that take the bytes of an object of any type.
    """
    use = holder.valueType if isinstance(holder, (ccode.Variable, ccode.Parameter)) else None
    rows = str(use.arrayDims or "").count("[") if use is not None else 0
    for reference in holder.references:
        outer, indexed = reference.eContainer(), 0
        inner: ccode.Expression = reference
        while isinstance(outer, ccode.Index) and outer.array is inner:
            inner, outer, indexed = outer, outer.eContainer(), indexed + 1
        points = rows > indexed
        if isinstance(outer, ccode.Unary) and outer.operator == "&":
            points, outer = True, outer.eContainer()
        if points and not (isinstance(outer, ccode.SizeOf) or _takes_bytes(outer, taking)):
            return False
        if isinstance(outer, ccode.Call) and outer.callee is not None and reference in list(outer.arguments):
            at, parameters = list(outer.arguments).index(reference), list(outer.callee.parameters)
            kind = parameters[at].valueType if at < len(parameters) else None
            if outer.callee.definition and kind is not None and "&" in str(kind.spelling):
                return False
    return True


def _takes_bytes(outer: Element | None, taking: Collection[str]) -> bool:
    """Whether a cast or call takes an object as bytes, whatever its type."""
    if isinstance(outer, ccode.Cast):
        return outer.target is not None and (is_of_bytes(outer.target) or "void" in str(outer.target.spelling).split())
    return isinstance(outer, ccode.Call) and str(outer.calleeName) in taking


def _format_widths(sketch: MovedSketch, values: WrappedValues) -> Iterator[SketchEdit | PortabilityPlace]:
    """The edits of arguments and formats, and the conversions that no edit mends."""
    for view in sketch.views:
        for call in view.of_kind(ccode.Call):
            name = str(call.calleeName).removesuffix("_P")
            at, arguments = _FORMATS.get(name), list(call.arguments)
            if at is None or at >= len(arguments) or call.viaMacro:
                continue
            literals = [each for each in all_contents(arguments[at]) if isinstance(each, ccode.StringLiteral)]
            if len(literals) == 1:
                yield from _of_call(sketch, values, view, literals[0], arguments[at + 1 :], reads=name.endswith("scanf"))


def _of_call(
    sketch: MovedSketch, values: WrappedValues, view: CodeView, literal: ccode.StringLiteral,
    arguments: list[ccode.Expression], *, reads: bool,
) -> Iterator[SketchEdit | PortabilityPlace]:  # fmt: skip
    start, end = int(literal.startOffset), int(literal.endOffset)
    text = sketch.sources[str(view.unit.path)][start:end].decode("latin-1")
    bits = sketch.move.source.int_bits
    for (length, letter, offset), argument in zip(conversions(text, reads), arguments, strict=False):
        shown = f"%{length}{letter}"
        if letter in _REALS and not reads:
            yield sketch.place(_KIND, argument, f"{shown} prints '?'")
        number = values.number(_pointed(argument) if reads else argument)
        if letter not in _INTEGERS or number is None or number.real:
            continue
        wanted, has = _BITS.get(length), number.bits if reads else max(number.bits, bits)
        if wanted is None:
            continue
        if max(wanted, bits) != has and (reads or length not in ("h", "hh")):
            yield sketch.place(_KIND, argument, f"{shown} takes {wanted} bits, and its argument has {has}")
        elif reads and not length and number.fixed and text.startswith('"'):
            why = f"{shown} writes an int, which is wider there than the variable"
            yield SketchEdit(literal, _RULE, why, (inserted(start + offset, "h"),))
        elif not reads and not length and number.bits == bits and number.signed != (letter in "di"):
            found = values.range_of(argument)
            if found is None or not found.within(0, (1 << (bits - 1)) - 1):
                cut = f"{'' if letter in 'di' else 'u'}int{bits}_t"
                first, last = int(argument.startOffset), int(argument.endOffset)
                why = f"{shown} shows the {bits} bits that the value has on its own board"
                yield SketchEdit(argument, _RULE, why, (inserted(first, f"({cut})("), inserted(last, ")")))


def _pointed(argument: ccode.Expression) -> ccode.Expression | None:
    return argument.operand if isinstance(argument, ccode.Unary) and argument.operator == "&" else None


@cache
def _returned_values(platform: str) -> Mapping[str, tuple[int, int]]:
    """Name of a function or method -> the least and the greatest value; empty for a platform without data.

    Raises:
        PlatformDataError: the data is damaged.
    """
    if not any((folder / platform / _FILE).is_file() for folder in resources.folders("platform_repo")):
        return {}
    path = resources.find("platform_repo", f"{platform}/{_FILE}")
    table = DataTable(path, read_data(path))
    found: dict[str, tuple[int, int]] = {}
    for kind in ("functions", "methods"):
        entries = table.table(kind, needed=False)
        for name in entries.values:
            ends = entries.numbers(name)
            if len(ends) != 2 or ends[0] > ends[1]:
                raise entries.error(name, "must be the least and the greatest value")
            found[name] = ends[0], ends[1]
    return found


@cache
def _macros_of_operands(platform: str) -> frozenset[str]:
    """Macros of a platform whose result has the type that their arguments have together; empty for a platform without data.

    Raises:
        PlatformDataError: the data is damaged.
    """
    return _macros(platform, "macros_of_operands")


@cache
def _macros_of_bits(platform: str) -> frozenset[str]:
    """Macros of a platform that write a bit of their first argument, whose number is the second; empty without data.

    Raises:
        PlatformDataError: the data is damaged.
    """
    return _macros(platform, "macros_of_bits")


def _macros(platform: str, key: str) -> frozenset[str]:
    if not any((folder / platform / _FILE).is_file() for folder in resources.folders("platform_repo")):
        return frozenset()
    path = resources.find("platform_repo", f"{platform}/{_FILE}")
    return frozenset(DataTable(path, read_data(path)).texts(key, ()))


_FILE = "values.toml"
