"""Objects have the bytes that they have on a board with a narrower int: records and variables that are stored or sent as bytes.

Members of type int get 16 bits, enumerations too, double is a float, and a record is packed where the target would align its
members otherwise. So are the members of unions, and the types in `sizeof(int)`. Source: the ABI of avr-gcc (no alignment, double
of 4 bytes).
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator

from robosmi.metamodels import ccode
from robosmi.query import ancestor_of_kind
from robosmi.transformations.knowledge.replacements import Replacement, inserted
from robosmi.transformations.m2m.sketches.int_widths import BYTES, is_free, of_bytes, retyped_here
from robosmi.transformations.m2m.sketches.linked_types import declarations
from robosmi.transformations.m2m.sketches.sketch_edits import MovedSketch, SketchEdit
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import field_of, of_use
from robosmi.transformations.queries.own_headers import unit_of
from robosmi.transformations.queries.portability.analysed_program import PortabilityPlace

SIZE = "sizeof_int"
_RULE = "object-bytes"
_INT = re.compile(r"\b(?:int|unsigned|word)\b")
_SIZES = {
    "char": 1, "signed char": 1, "unsigned char": 1, "bool": 1, "int8_t": 1, "uint8_t": 1, "short": 2, "unsigned short": 2,
    "int": 2, "unsigned int": 2, "int16_t": 2, "uint16_t": 2, "long": 4, "unsigned long": 4, "int32_t": 4, "uint32_t": 4,
    "float": 4, "double": 4, "long long": 8, "unsigned long long": 8, "int64_t": 8, "uint64_t": 8,
}  # fmt: skip
"""Bytes of the types that the rule knows, as they are once its edits are made: so are their alignments on the target."""
_KEYWORD = re.compile(rb"\b(?:struct|class|union)\b")
_HEAD = re.compile(rb"enum\b(?:\s+(?:class|struct)\b)?(?:\s+\w+)?(?=\s*\{)")
"""An enumeration up to its braces; one that says its type has more in front of them."""
_UNNAMED = re.compile(rb"\b(?:struct|class)\s*\{([^}]*)\}")
_WIDE = re.compile(rb"\b(?:int|unsigned(?!\s+char)|word|long|short|float|double|u?int(?:16|32|64)_t)\b")
"""A type in a record that has another size on the target, or is aligned there."""
_MEASURED = re.compile(rb"\b(unsigned\s+int|unsigned|int|double)\b")
_OF_WIDTH = {b"double": b"float", b"int": b"int16_t"}


def object_bytes(sketch: MovedSketch) -> Iterator[SketchEdit | PortabilityPlace]:
    """The edits of records, variables, enumerations and sizes; each element has one, however many objects are of its type."""
    yield from _unnamed_records(sketch)
    edits = list(_edits(sketch))
    once = {id(each.element): each for each in reversed(edits) if each.replacements}
    yield from (each for each in edits if not each.replacements or once[id(each.element)] is each)


def _unnamed_records(sketch: MovedSketch) -> Iterator[PortabilityPlace]:
    """The unions with a record without a name whose layout may differ: the model does not have its members."""
    if sketch.move.source.int_bits >= sketch.move.target.int_bits:
        return
    for view in sketch.views:
        data, told = sketch.sources[str(view.unit.path)], sketch.lines(BYTES, view)
        for record in view.of_kind(ccode.Record):
            if record.recordKind is not ccode.RecordKind.unionType or int(record.line) in told:
                continue
            inner = _UNNAMED.findall(data, int(record.startOffset), int(record.endOffset))
            if any(map(_WIDE.search, inner)):
                yield sketch.place(BYTES, record, f"union {record.name}".rstrip())


def _edits(sketch: MovedSketch) -> Iterator[SketchEdit]:
    if sketch.move.source.int_bits >= sketch.move.target.int_bits:
        return
    records, variables, cured = [], [], dict[int, tuple[CodeView, set[int]]]()
    for view in sketch.views:
        lines = sketch.lines(BYTES, view)
        for element in view.of_kind(ccode.Expression):
            holder = _holder(element) if int(element.line) in lines and _takes_bytes(element) else None
            if holder is None or not _is_of_known(element, sketch.kinds[BYTES].functions):
                continue
            record = _record(sketch, holder)
            if record is not None and record not in records:
                records.append(record)
            free = record is not None or _is_free(holder, of_bytes(sketch))
            if record is None and free and holder not in variables:
                variables.append(holder)
            if free and (record is None or _is_known(sketch, record)):
                cured.setdefault(id(view), (view, set()))[1].add(int(element.line))
    unions = [r for view in sketch.views for r in view.of_kind(ccode.Record) if r.recordKind is ccode.RecordKind.unionType]
    for record in [*records, *(union for union in unions if union not in records)]:
        yield from _of_record(sketch, record)
    for variable in variables:
        for each in declarations(sketch.views, variable):
            yield from _of_holder(sketch, each)
    told = "the objects have the bytes that they have on their own board"
    for view, found in cured.values():
        yield SketchEdit(view.unit, _RULE, told, (), BYTES, tuple(sorted(found)))
    yield from _sizes(sketch)


def _is_free(holder: ccode.Variable | ccode.Field | ccode.Parameter, taking: Collection[str]) -> bool:
    """Whether the type of a variable may change; that of a pointer only with what it points to."""
    use = holder.valueType
    points = use is not None and (use.pointerDepth or (isinstance(holder, ccode.Parameter) and use.arrayDims))
    return not points and (isinstance(holder, ccode.Field) or is_free(holder, taking))


def _takes_bytes(element: ccode.Expression) -> bool:
    """Whether an expression names an object in a call or a cast that takes its bytes."""
    outer = element.eContainer()
    while isinstance(outer, (ccode.Unary, ccode.Index)):
        outer = outer.eContainer()
    return isinstance(element, (ccode.NameReference, ccode.Member)) and isinstance(outer, (ccode.Call, ccode.Cast))


def _is_of_known(element: ccode.Expression, copying: Collection[str]) -> bool:
    """Whether the text tells both objects of a copy that one of them is part of: one alone may not get another size."""
    call = ancestor_of_kind(element, ccode.Call)
    if call is None or str(call.calleeName) not in copying:
        return True
    return all(_object(argument) is not None for argument in list(call.arguments)[:2])


def _object(argument: ccode.Expression | None) -> ccode.Declaration | None:
    """What an argument is, or points to or into."""
    while isinstance(argument, (ccode.Cast, ccode.Unary, ccode.Index, ccode.Binary)):
        inner = argument.array if isinstance(argument, ccode.Index) else None
        argument = inner or (argument.left if isinstance(argument, ccode.Binary) else getattr(argument, "operand", None))
    return _holder(argument) if argument is not None else None


def _holder(element: ccode.Expression) -> ccode.Variable | ccode.Parameter | ccode.Field | None:
    if isinstance(element, ccode.Member):
        return field_of(element, {})
    target = element.target if isinstance(element, ccode.NameReference) else None
    return target if isinstance(target, (ccode.Variable, ccode.Parameter, ccode.Field)) else None


def _of_holder(sketch: MovedSketch, each: ccode.Declaration) -> Iterator[SketchEdit]:
    """The edits of a variable or member, or of the enumeration that it has the type of."""
    if words := _words(sketch, each):
        yield SketchEdit(each, _RULE, f"the bytes of '{each.name}' are those that it has on its own board", words)
    kind = of_use(each.valueType) if isinstance(each, (ccode.Variable, ccode.Parameter, ccode.Field)) else None
    declared = kind.declaration if kind is not None else None
    unit = unit_of(declared) if isinstance(declared, ccode.Enumeration) else None
    if unit is None or not isinstance(declared, ccode.Enumeration):
        return
    data = sketch.sources[str(unit.path)]
    if found := _HEAD.search(data, int(declared.startOffset), int(declared.endOffset)):
        width = inserted(found.end(), f" : int{sketch.move.source.int_bits}_t")
        yield SketchEdit(declared, _RULE, "an enumeration has the size of int on its own board", (width,))


def _record(sketch: MovedSketch, holder: ccode.Variable | ccode.Parameter | ccode.Field) -> ccode.Record | None:
    """The program's record that a variable is, or an array of which it is."""
    use = holder.valueType
    kind = of_use(use)
    if kind is not None and isinstance(kind.declaration, ccode.Record):
        return kind.declaration
    words = re.findall(r"\w+", str(use.spelling)) if use is not None else []
    return next((r for view in sketch.views for r in view.of_kind(ccode.Record) if r.name and r.name in words), None)


def _kind(field: ccode.Declaration) -> str:
    use = field.valueType if isinstance(field, (ccode.Field, ccode.Variable, ccode.Parameter)) else None
    canonical = str(use.canonical or use.spelling) if use is not None else ""
    return " ".join(word for word in canonical.partition("[")[0].split() if word not in ("const", "volatile"))


def _is_known(sketch: MovedSketch, record: ccode.Record) -> bool:
    """Whether all members of a record are numbers, or records of such."""
    for field in record.fields:
        inner = _record(sketch, field)
        kind = of_use(field.valueType)
        if kind is not None and isinstance(kind.declaration, ccode.Enumeration) and not kind.depth:
            continue
        if _kind(field) not in _SIZES and (inner is None or inner is record or not _is_known(sketch, inner)):
            return False
    return not record.bases


def _of_record(sketch: MovedSketch, record: ccode.Record) -> Iterator[SketchEdit]:
    """The edits of a record: of its members and those of its members' records, and that it is packed."""
    for field in record.fields:
        inner = _record(sketch, field)
        if inner is not None and inner is not record:
            yield from _of_record(sketch, inner)
        else:
            yield from _of_holder(sketch, field)
    unit = unit_of(record)
    if unit is None or record.recordKind is ccode.RecordKind.unionType or not _is_aligned_otherwise(sketch, record):
        return
    data = sketch.sources[str(unit.path)]
    if found := _KEYWORD.search(data, int(record.startOffset), int(record.endOffset)):
        packed = inserted(found.end(), " __attribute__((packed))")
        yield SketchEdit(record, _RULE, "its members lie as on its own board, where none is aligned", (packed,))


def _is_aligned_otherwise(sketch: MovedSketch, record: ccode.Record) -> bool:
    """Whether the target would leave room between the members of a record, or behind them."""
    at, widest = 0, 1
    for field in record.fields:
        size = _SIZES.get(_kind(field))
        if size is None:
            return True
        if at % size:
            return True
        use, widest = field.valueType, max(widest, size)
        count = 1
        for dimension in re.findall(r"\[(\d+)\]", str(use.arrayDims) if use is not None else ""):
            count *= int(dimension)
        at += size * count
    return bool(at % widest)


def _words(sketch: MovedSketch, each: ccode.Declaration) -> tuple[Replacement, ...]:
    """The replacements of the words of a declared type by those that have its bytes."""
    unit = unit_of(each)
    if unit is None or _kind(each) not in ("int", "unsigned int", "double"):
        return ()
    if _kind(each) != "double":
        return retyped_here(sketch, each, sketch.move.source.int_bits)
    data, start = sketch.sources[str(unit.path)], int(each.startOffset)
    found = re.compile(rb"\bdouble\b").search(data, start, int(each.endOffset))
    return (Replacement(found.start(), found.end(), "float"),) if found else ()


def _sizes(sketch: MovedSketch) -> Iterator[SketchEdit]:
    """The edits of `sizeof(int)`, but for one that divides the size of an array to count its elements."""
    for view in sketch.views:
        lines = sketch.lines(SIZE, view)
        for size in view.of_kind(ccode.SizeOf):
            if int(size.line) not in lines or _counts(size):
                continue
            data = sketch.sources[str(view.unit.path)]
            found = _MEASURED.search(data, int(size.startOffset), int(size.endOffset))
            if found is None:
                continue
            text = _OF_WIDTH.get(b" ".join(found[1].split()), b"uint16_t").decode()
            reason = "the size is that on its own board"
            yield SketchEdit(size, _RULE, reason, (Replacement(found.start(), found.end(), text),), SIZE, (int(size.line),))
        counting = sorted({int(s.line) for s in view.of_kind(ccode.SizeOf) if _counts(s)} & lines)
        if counting:
            yield SketchEdit(view.unit, _RULE, "the size divides that of an array of the same type", (), SIZE, tuple(counting))


def _counts(size: ccode.SizeOf) -> bool:
    """Whether a size divides that of an array, which gives the number of its elements on any board."""
    outer = size.eContainer()
    if not isinstance(outer, ccode.Binary) or outer.operator != "/" or not isinstance(outer.left, ccode.SizeOf):
        return False
    whole = outer.left.operand
    held = whole.target if isinstance(whole, ccode.NameReference) else None
    use = held.valueType if isinstance(held, (ccode.Variable, ccode.Field)) else None
    return use is None or size.measured is None or bool(_INT.search(str(use.spelling)))
