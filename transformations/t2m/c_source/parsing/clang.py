"""A thin binding of the functions of libclang that the reader needs, and nothing else.

`clang.cindex` costs an import of its own, has no binding for operators, and reads a cursor's place by five calls. Here
places are plain offsets, cursors are ctypes structures, and `Any` ends at this module's border. The wheel `libclang`
gives the shared library; this module says how to call it (Index.h of LLVM 18). What cursors mean is in `tree` and the
builders.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from ctypes import CDLL, CFUNCTYPE, POINTER, Structure, byref, c_char_p, c_int, c_longlong, c_uint, c_ulong, c_void_p
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING, Any

from robosmi import inputs
from robosmi.errors import MissingToolError
from robosmi.transformations.t2m.c_source.parsing import cursor_kinds

WHOLE = 0x01 | 0x200
"""Options of a parse: record the preprocessor's work, and go on after a missing header."""
FOR_SERIALIZATION = 0x02 | 0x10
"""Options of a header that is to be precompiled: it is no whole program, and is saved."""
MACRO_DEFINITION, MACRO_EXPANSION, INCLUSION = (
    cursor_kinds.MACRO_DEFINITION,
    cursor_kinds.MACRO_INSTANTIATION,
    cursor_kinds.INCLUSION_DIRECTIVE,
)
"""Kinds of the preprocessor's cursors."""
VERSION = 18
"""The version whose numbers of cursors and operators the reader knows."""
ERROR, FATAL = 3, 4
"""Severities of complaints."""
MOST_MEMORY = 1 << 30
"""Bytes that libclang may take for one text, and lose in all by crashes, after which it frees nothing."""
_FOR_SMALL, _FOR_BYTE = 352 << 20, 64
"""Bytes that libclang may take for a small text, and further ones for each byte of the text and its headers."""


class Cursor(Structure):
    """CXCursor."""

    if TYPE_CHECKING:

        def __init__(self) -> None: ...

        kind: int
        xdata: int
        data: Sequence[int | None]

    _fields_ = [("kind", c_int), ("xdata", c_int), ("data", c_void_p * 3)]


class SourceLocation(Structure):
    """CXSourceLocation."""

    if TYPE_CHECKING:

        def __init__(self) -> None: ...

        ptr_data: Sequence[int | None]
        int_data: int

    _fields_ = [("ptr_data", c_void_p * 2), ("int_data", c_uint)]


class SourceRange(Structure):
    """CXSourceRange."""

    if TYPE_CHECKING:

        def __init__(self) -> None: ...

        ptr_data: Sequence[int | None]
        begin: int
        end: int

    _fields_ = [("ptr_data", c_void_p * 2), ("begin", c_uint), ("end", c_uint)]


class RangeList(Structure):
    """CXSourceRangeList."""

    if TYPE_CHECKING:

        def __init__(self) -> None: ...

    _fields_ = [("count", c_uint), ("ranges", POINTER(SourceRange))]


class String(Structure):
    """CXString."""

    if TYPE_CHECKING:

        def __init__(self) -> None: ...

    _fields_ = [("data", c_void_p), ("flags", c_uint)]


class Type(Structure):
    """CXType."""

    if TYPE_CHECKING:

        def __init__(self) -> None: ...

        kind: int
        data: Sequence[int | None]

    _fields_ = [("kind", c_int), ("data", c_void_p * 2)]


class UnsavedFile(Structure):
    """CXUnsavedFile."""

    _fields_ = [("name", c_char_p), ("contents", c_char_p), ("length", c_ulong)]


VISITOR = CFUNCTYPE(c_int, Cursor, Cursor, c_void_p)
INCLUSION_VISITOR = CFUNCTYPE(None, c_void_p, POINTER(SourceLocation), c_uint, c_void_p)

_SIGNATURES: dict[str, tuple[list[Any], Any]] = {
    "createIndex": ([c_int, c_int], c_void_p),
    "parseTranslationUnit2": (
        [c_void_p, c_char_p, POINTER(c_char_p), c_int, POINTER(UnsavedFile), c_uint, c_uint, POINTER(c_void_p)], c_int,
    ),
    "disposeTranslationUnit": ([c_void_p], None),
    "saveTranslationUnit": ([c_void_p, c_char_p, c_uint], c_int),
    "getTranslationUnitCursor": ([c_void_p], Cursor),
    "visitChildren": ([Cursor, VISITOR, c_void_p], c_uint),
    "getCursorExtent": ([Cursor], SourceRange),
    "getCursorLocation": ([Cursor], SourceLocation),
    "getCursorReferenced": ([Cursor], Cursor),
    "getCanonicalCursor": ([Cursor], Cursor),
    "getCursorUSR": ([Cursor], String),
    "getCursorLinkage": ([Cursor], c_int),
    "getOverriddenCursors": ([Cursor, POINTER(POINTER(Cursor)), POINTER(c_uint)], None),
    "disposeOverriddenCursors": ([POINTER(Cursor)], None),
    "Cursor_getVarDeclInitializer": ([Cursor], Cursor),
    "getSpecializedCursorTemplate": ([Cursor], Cursor),
    "getCursorSpelling": ([Cursor], String),
    "getCursorType": ([Cursor], Type),
    "getCursorResultType": ([Cursor], Type),
    "getCanonicalType": ([Type], Type),
    "getTypeDeclaration": ([Type], Cursor),
    "getTypedefDeclUnderlyingType": ([Cursor], Type),
    "getEnumDeclIntegerType": ([Cursor], Type),
    "Type_getNamedType": ([Type], Type),
    "getCursorSemanticParent": ([Cursor], Cursor),
    "getTypeSpelling": ([Type], String),
    "getArrayElementType": ([Type], Type),
    "getPointeeType": ([Type], Type),
    "getCursorPrettyPrinted": ([Cursor, c_void_p], String),
    "Type_getSizeOf": ([Type], c_longlong),
    "getNumArgTypes": ([Type], c_int),
    "getArgType": ([Type, c_uint], Type),
    "isFunctionTypeVariadic": ([Type], c_uint),
    "isCursorDefinition": ([Cursor], c_uint),
    "Cursor_getStorageClass": ([Cursor], c_int),
    "getEnumConstantDeclValue": ([Cursor], c_longlong),
    "getFieldDeclBitWidth": ([Cursor], c_int),
    "getCursorBinaryOperatorKind": ([Cursor], c_int),
    "getCursorUnaryOperatorKind": ([Cursor], c_int),
    "Cursor_Evaluate": ([Cursor], c_void_p),
    "EvalResult_getKind": ([c_void_p], c_int),
    "EvalResult_getAsLongLong": ([c_void_p], c_longlong),
    "EvalResult_dispose": ([c_void_p], None),
    "getFileLocation": ([SourceLocation, POINTER(c_void_p), POINTER(c_uint), POINTER(c_uint), POINTER(c_uint)], None),
    "getFile": ([c_void_p, c_char_p], c_void_p),
    "getFileName": ([c_void_p], String),
    "getLocationForOffset": ([c_void_p, c_void_p, c_uint], SourceLocation),
    "getSkippedRanges": ([c_void_p, c_void_p], POINTER(RangeList)),
    "disposeSourceRangeList": ([POINTER(RangeList)], None),
    "getInclusions": ([c_void_p, INCLUSION_VISITOR, c_void_p], None),
    "getNumDiagnostics": ([c_void_p], c_uint),
    "getDiagnostic": ([c_void_p, c_uint], c_void_p),
    "disposeDiagnostic": ([c_void_p], None),
    "getDiagnosticSpelling": ([c_void_p], String),
    "getDiagnosticSeverity": ([c_void_p], c_int),
    "getDiagnosticLocation": ([c_void_p], SourceLocation),
    "getDiagnosticNumFixIts": ([c_void_p], c_uint),
    "getDiagnosticFixIt": ([c_void_p, c_uint, POINTER(SourceRange)], String),
    "getClangVersion": ([], String),
    "getCString": ([String], c_char_p),
    "disposeString": ([String], None),
}  # fmt: skip


class ClangLibrary:
    """libclang's functions without the prefix `clang_`, typed for ctypes.

    Handles are integers. What is not declared here takes places to write to, or is a callback's.
    """

    if TYPE_CHECKING:
        disposeTranslationUnit: Callable[[int | None], None]
        saveTranslationUnit: Callable[[int | None, bytes | None, int], int]
        getTranslationUnitCursor: Callable[[int | None], Cursor]
        getCursorExtent: Callable[[Cursor], SourceRange]
        getCursorLocation: Callable[[Cursor], SourceLocation]
        getCursorReferenced: Callable[[Cursor], Cursor]
        getCanonicalCursor: Callable[[Cursor], Cursor]
        getCursorUSR: Callable[[Cursor], String]
        getCursorLinkage: Callable[[Cursor], int]
        Cursor_getVarDeclInitializer: Callable[[Cursor], Cursor]
        getSpecializedCursorTemplate: Callable[[Cursor], Cursor]
        getCursorSpelling: Callable[[Cursor], String]
        getCursorType: Callable[[Cursor], Type]
        getCursorResultType: Callable[[Cursor], Type]
        getCanonicalType: Callable[[Type], Type]
        getTypeDeclaration: Callable[[Type], Cursor]
        getTypedefDeclUnderlyingType: Callable[[Cursor], Type]
        getEnumDeclIntegerType: Callable[[Cursor], Type]
        Type_getNamedType: Callable[[Type], Type]
        getCursorSemanticParent: Callable[[Cursor], Cursor]
        getTypeSpelling: Callable[[Type], String]
        getArrayElementType: Callable[[Type], Type]
        getPointeeType: Callable[[Type], Type]
        getCursorPrettyPrinted: Callable[[Cursor, int | None], String]
        Type_getSizeOf: Callable[[Type], int]
        getNumArgTypes: Callable[[Type], int]
        getArgType: Callable[[Type, int], Type]
        isFunctionTypeVariadic: Callable[[Type], int]
        isCursorDefinition: Callable[[Cursor], int]
        Cursor_getStorageClass: Callable[[Cursor], int]
        getEnumConstantDeclValue: Callable[[Cursor], int]
        getFieldDeclBitWidth: Callable[[Cursor], int]
        getCursorBinaryOperatorKind: Callable[[Cursor], int]
        getCursorUnaryOperatorKind: Callable[[Cursor], int]
        Cursor_Evaluate: Callable[[Cursor], int | None]
        EvalResult_getKind: Callable[[int | None], int]
        EvalResult_getAsLongLong: Callable[[int | None], int]
        EvalResult_dispose: Callable[[int | None], None]
        getFile: Callable[[int | None, bytes | None], int | None]
        getFileName: Callable[[int | None], String]
        getLocationForOffset: Callable[[int | None, int | None, int], SourceLocation]
        getNumDiagnostics: Callable[[int | None], int]
        getDiagnostic: Callable[[int | None, int], int | None]
        disposeDiagnostic: Callable[[int | None], None]
        getDiagnosticSpelling: Callable[[int | None], String]
        getDiagnosticSeverity: Callable[[int | None], int]
        getDiagnosticLocation: Callable[[int | None], SourceLocation]
        getDiagnosticNumFixIts: Callable[[int | None], int]
        getClangVersion: Callable[[], String]
        getCString: Callable[[String], bytes | None]
        disposeString: Callable[[String], None]
        createIndex: Callable[[int, int], int | None]

    def __init__(self, path: str) -> None:
        library = CDLL(path)
        for name, (arguments, result) in _SIGNATURES.items():
            function = library[f"clang_{name}"]
            function.argtypes = arguments
            function.restype = result
            setattr(self, name, function)
        self.version = self.text(self.getClangVersion())
        if f" {VERSION}." not in self.version:
            raise OSError(f"it is {self.version or 'of an unknown version'}, and this reader needs version {VERSION}")
        self.index = self.createIndex(0, 0)
        self.own_index = self.createIndex(1, 0)
        self.spare = MOST_MEMORY
        self.parsing = Lock()
        """Held while the whole process has the limit of memory and no standard error: of two overlapping parses the later one
        would put back what the earlier one has set."""

    def __getattr__(self, name: str) -> Any:
        raise AttributeError(name)

    def text(self, string: String) -> str:
        """The content of a CXString, which is given back."""
        content = self.getCString(string)
        self.disposeString(string)
        return content.decode("utf-8", "replace") if content else ""


@cache
def library() -> ClangLibrary:
    """The library of this process, loaded at the first call, with its indexes.

    Raises:
        MissingToolError: the package `libclang` is not installed, is damaged, or has no library for this system.
    """
    fix = "run: pip install --force-reinstall libclang==18.1.1"
    spec = find_spec("clang")
    for root in (spec.submodule_search_locations or []) if spec else []:
        for name in ("libclang.so", "libclang.dylib", "libclang.dll"):
            path = Path(root) / "native" / name
            if path.is_file():
                try:
                    return ClangLibrary(str(path))
                except (OSError, AttributeError) as error:
                    raise MissingToolError(f"the C parser libclang cannot be loaded: {error}", fix=fix) from error
    raise MissingToolError("the C parser libclang is not installed", fix=fix)


def unsaved(files: dict[str, bytes]) -> list[UnsavedFile]:
    """Virtual files by absolute name, ready for `parse`."""
    return [UnsavedFile(os.fsencode(name), content, len(content)) for name, content in files.items()]


def parse(
    path: str, arguments: Sequence[str], files: Sequence[UnsavedFile], options: int = WHOLE, own_only: bool = False
) -> int | None:
    """A translation unit's handle, or None when the parser gave up. The caller gives it back with `disposeTranslationUnit`.

    libclang survives its own crashes, also for want of memory (`MOST_MEMORY`).

    Args:
        path: path of the main file.
        arguments: as for a compiler.
        files: virtual files.
        options: CXTranslationUnit_Flags.
        own_only: leave the declarations of a precompiled header out of the tree.
    """
    lib = library()
    flags = (c_char_p * len(arguments))(*[os.fsencode(a) for a in arguments])
    virtual = (UnsavedFile * len(files))(*files)
    unit = c_void_p()
    index = lib.own_index if own_only else lib.index
    with lib.parsing:
        if lib.spare <= 0:
            return None
        held = _held()
        wanted = _FOR_SMALL + _FOR_BYTE * sum(each.length for each in files)
        with _limited(held + min(lib.spare, wanted)), _silent():
            code = lib.parseTranslationUnit2(
                index, os.fsencode(path), flags, len(arguments), virtual, len(files), options, byref(unit)
            )
        if code != 0:
            lib.spare -= max(0, _held() - held)
    return unit.value if code == 0 and unit.value else None


def _held() -> int:
    """The bytes of this process's data; 0 where no limit of them is known."""
    if sys.platform != "linux":
        return 0
    with suppress(OSError, ValueError):
        return int(inputs.read_text("/proc/self/statm", inputs.SETTINGS).split()[5]) * os.sysconf("SC_PAGESIZE")
    return 0


@contextmanager
def _limited(most: int) -> Iterator[None]:
    """Within it, this process gets no more bytes of data than that."""
    if sys.platform != "linux":
        yield
        return
    import resource

    limits = resource.getrlimit(resource.RLIMIT_DATA)
    wanted = min([most, *(each for each in limits if each != resource.RLIM_INFINITY)])
    resource.setrlimit(resource.RLIMIT_DATA, (wanted, limits[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_DATA, limits)


@contextmanager
def _silent() -> Iterator[None]:
    """Within it, nothing reaches the standard error: libclang writes there how it crashed."""
    try:
        own, nothing = os.dup(2), os.open(os.devnull, os.O_WRONLY)
    except OSError:  # there is no standard error, or too many files are open
        yield
        return
    try:
        os.dup2(nothing, 2)
        yield
    finally:
        os.dup2(own, 2)
        os.close(own)
        os.close(nothing)


def visit(cursor: Cursor, callback: Callable[[Cursor, Cursor, int | None], int]) -> None:
    """Visit the children of a cursor; the callback answers 0 to stop, 1 to go on, 2 to go into the child first.

    Raises:
        BaseException: what the callback raised; the visit ends with it.
    """

    def guarded(cursor: Cursor, parent: Cursor, data: int | None) -> int:
        try:
            return callback(cursor, parent, data)
        except BaseException as error:
            failed.append(error)
            return 0

    with raising() as failed:
        library().visitChildren(cursor, VISITOR(guarded), None)


@contextmanager
def raising() -> Iterator[list[BaseException]]:
    """A list for exceptions that a callback caught; the first is raised at the end, since none may propagate through C.

    Raises:
        BaseException: the first exception in the list.
    """
    failed: list[BaseException] = []
    yield failed
    if failed:
        raise failed[0]


def file_offset(location: SourceLocation) -> tuple[int | None, int]:
    """The file (a handle) and the byte offset of a location; for one in a macro's expansion, of the macro use."""
    file, offset = c_void_p(), c_uint()
    library().getFileLocation(location, byref(file), None, None, byref(offset))
    return file.value, offset.value


def overridden(method: Cursor) -> list[Cursor]:
    """The methods of base classes that a method overrides."""
    found, count = POINTER(Cursor)(), c_uint()
    library().getOverriddenCursors(method, byref(found), byref(count))
    methods = [Cursor.from_buffer_copy(bytes(found[number])) for number in range(count.value)]
    if found:
        library().disposeOverriddenCursors(found)
    return methods


def written_template(declaration: Cursor) -> Cursor:
    """The template as it is written that a declaration is made of; the declaration itself where there is none.

    A method template of a class template is made in two steps: first for the class, then for the call.
    """
    template = library().getSpecializedCursorTemplate(declaration)
    return written_template(template) if template.data[0] else declaration


def line_of(location: SourceLocation) -> tuple[int | None, int]:
    """The file (a handle) and the line, from 1, of a location; for one in a macro's expansion, of the macro use."""
    file, line = c_void_p(), c_uint()
    library().getFileLocation(location, byref(file), byref(line), None, None)
    return file.value, line.value


def fix_its(diagnostic: int | None) -> list[tuple[SourceLocation, SourceLocation, str]]:
    """The fix-its of a diagnostic: start, end and replacement text of each."""
    found = []
    for number in range(library().getDiagnosticNumFixIts(diagnostic)):
        place = SourceRange()
        text = library().text(library().getDiagnosticFixIt(diagnostic, number, byref(place)))
        ends = []
        for raw in (place.begin, place.end):
            location = SourceLocation()
            location.ptr_data = place.ptr_data
            location.int_data = raw
            ends.append(location)
        found.append((ends[0], ends[1], text))
    return found


def file_name(file: int | None) -> str:
    """The name of a file by its handle, empty for none."""
    return library().text(library().getFileName(file)) if file else ""


def macro_names(unit: int) -> set[str]:
    """The names of all macros that are defined anywhere in a unit."""
    found: set[str] = set()

    def visitor(cursor: Cursor, parent: Cursor, data: int | None) -> int:
        if cursor.kind == MACRO_DEFINITION:
            found.add(library().text(library().getCursorSpelling(cursor)))
        return 1

    visit(library().getTranslationUnitCursor(unit), visitor)
    return found


def severities(unit: int) -> list[int]:
    """The severity of each diagnostic of a unit."""
    found = []
    for number in range(library().getNumDiagnostics(unit)):
        handle = library().getDiagnostic(unit, number)
        found.append(library().getDiagnosticSeverity(handle))
        library().disposeDiagnostic(handle)
    return found


def inclusions(unit: int) -> list[str]:
    """The names of all files that the unit really read, itself first."""
    found: list[str] = []
    library().getInclusions(unit, INCLUSION_VISITOR(lambda file, stack, depth, data: found.append(file_name(file))), None)
    return found
