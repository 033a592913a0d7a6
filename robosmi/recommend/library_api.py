"""What a library offers to a program: the classes, functions, constants and enumerations that its headers declare.

Plain values, their JSON form, and the compact form in which an index keeps them. All of it is text as declared, in one
spelling; nothing is compiled, so of a condition in a header all branches are there. Reading headers is the content's affair.
"""

from __future__ import annotations

import zlib
from collections.abc import Iterable, Mapping
from typing import Any

from msgspec import Struct

from robosmi.base.data_text import Json, as_list, as_table, as_text, as_texts, json_of, json_written

_LARGEST = 1 << 26  # bytes; the largest library of the shipped index has 0.4 MB


class ApiFunction(Struct, frozen=True):
    """A free function or a method.

    Attributes:
        name: without its class; with the namespace around it where it is free.
        parameters: in brackets, with default values; behind them `const` where it is said.
        returns: type of its value; empty for a conversion operator.
        static: it is called without an object.
    """

    name: str
    parameters: str
    returns: str = ""
    static: bool = False

    @property
    def signature(self) -> str:
        """As a header writes it: `float readHumidity(bool force=false)`."""
        blank = "" if not self.returns or self.returns.endswith(("*", "&")) else " "
        return f"{'static ' if self.static else ''}{self.returns}{blank}{self.name}{self.parameters}"


class ApiClass(Struct, frozen=True):
    """A class or structure with what is public in it; what it inherits is in its bases.

    Attributes:
        name: with the namespaces and classes around it: `SDLib::File`.
        kind: class or struct.
        bases: as declared.
        constructors: the parameters of each; empty where none is declared.
        methods: in the order of the header, each overload by itself.
    """

    name: str
    kind: str = "class"
    bases: tuple[str, ...] = ()
    constructors: tuple[str, ...] = ()
    methods: tuple[ApiFunction, ...] = ()


class HeaderApi(Struct, frozen=True):
    """What one header declares.

    Attributes:
        file: its bare name.
        include: the main header that leads to it; itself for a main one.
        constants: name -> value of each `#define` that is a literal.
        enums: name -> names of its values; "" for those of enumerations without a name.
    """

    file: str
    include: str
    classes: tuple[ApiClass, ...] = ()
    functions: tuple[ApiFunction, ...] = ()
    constants: Mapping[str, str] = {}
    enums: Mapping[str, tuple[str, ...]] = {}

    def __bool__(self) -> bool:
        """Whether it declares anything."""
        return bool(self.classes or self.functions or self.constants or self.enums)

    def to_json(self) -> dict[str, Any]:
        """As JSON shows it: a function with its signature in one piece."""
        return {
            "header": self.file,
            "include": self.include,
            "classes": [
                {
                    "name": c.name,
                    "kind": c.kind,
                    "bases": list(c.bases),
                    "constructors": [f"{c.name.rpartition('::')[2]}{parameters}" for parameters in c.constructors],
                    "methods": [_shown(method) for method in c.methods],
                }
                for c in self.classes
            ],
            "functions": [_shown(function) for function in self.functions],
            "constants": dict(self.constants),
            "enums": {name: list(values) for name, values in self.enums.items()},
        }

    @staticmethod
    def from_facts(row: Mapping[str, Json]) -> HeaderApi:
        """Of a row of facts: `header`, `main`, `classes` (`name`, `kind`, `bases`, `constructors`, `methods`), `functions`,
        `constants`, `enums`; a function is a list of name, parameters, type and perhaps "static".

        Raises:
            ValueError: it has not this form.
        """
        try:
            classes = tuple(
                ApiClass(
                    as_text(c["name"]),
                    as_text(c["kind"]),
                    tuple(as_texts(c["bases"])),
                    tuple(as_texts(c["constructors"])),
                    tuple(_function(method) for method in as_list(c["methods"])),
                )
                for c in (as_table(each) for each in as_list(row["classes"]))
            )
            return HeaderApi(
                as_text(row["header"]),
                as_text(row["main"]),
                classes,
                tuple(_function(function) for function in as_list(row["functions"])),
                {name: as_text(value) for name, value in as_table(row["constants"]).items()},
                {name: tuple(as_texts(values)) for name, values in as_table(row["enums"]).items()},
            )
        except (KeyError, TypeError, AttributeError, IndexError) as error:
            raise ValueError(f"it lacks or misuses {error}") from error


class LibraryApi(Struct, frozen=True):
    """What a library offers; no headers where nothing is known of it.

    Attributes:
        library: its name.
        version: its version, or empty.
        headers: main headers and those of the library that they include.
    """

    library: str
    version: str
    headers: tuple[HeaderApi, ...]

    @property
    def classes(self) -> list[ApiClass]:
        """Its classes, in the order of the headers."""
        return [each for header in self.headers for each in header.classes]

    @property
    def functions(self) -> list[ApiFunction]:
        """Its free functions, in the order of the headers."""
        return [each for header in self.headers for each in header.functions]

    def class_named(self, name: str) -> ApiClass | None:
        """The class of that name, with or without what stands around it; None if there is none."""
        found = [each for each in self.classes if each.name == name]
        return next(iter(found or [each for each in self.classes if each.name.rpartition("::")[2] == name]), None)

    def methods(self, name: str) -> list[ApiFunction]:
        """The methods of a class, its own first, then those of its bases in this library that it does not declare itself."""
        found: list[ApiFunction] = []
        seen: set[str] = set()
        waiting = [name]
        for each in waiting:  # grows while it is walked
            declared = self.class_named(each)
            if declared is None or declared.name in seen:
                continue
            known = {method.name for method in found}
            found += [method for method in declared.methods if method.name not in known]
            seen.add(declared.name)
            waiting += [base.partition("<")[0] for base in declared.bases]
        return found


def packed(headers: Iterable[HeaderApi]) -> bytes:
    """The compact form."""
    rows: list[Json] = [
        [
            h.file, h.include,
            [[c.name, c.kind, c.bases, c.constructors, [_row(method) for method in c.methods]] for c in h.classes],
            [_row(function) for function in h.functions], dict(h.constants), dict(h.enums),
        ]
        for h in headers
    ]  # fmt: skip
    return zlib.compress(json_written(rows, ensure_ascii=False, separators=(",", ":")).encode(), 9)


def unpacked(data: bytes) -> tuple[HeaderApi, ...]:
    """What the compact form says.

    Raises:
        ValueError: it is damaged.
    """
    try:
        text = zlib.decompressobj().decompress(data, _LARGEST)
        return tuple(_header(each) for each in as_list(json_of(text)))
    except (zlib.error, RecursionError, TypeError) as error:
        raise ValueError(str(error)) from error


def _header(row: Json) -> HeaderApi:
    file, include, classes, functions, constants, enums = as_list(row)
    return HeaderApi(
        as_text(file),
        as_text(include),
        tuple(_class(each) for each in as_list(classes)),
        tuple(_packed_function(each) for each in as_list(functions)),
        {name: as_text(value) for name, value in as_table(constants).items()},
        {name: tuple(as_texts(values)) for name, values in as_table(enums).items()},
    )


def _class(row: Json) -> ApiClass:
    name, kind, bases, constructors, methods = as_list(row)
    made = tuple(_packed_function(each) for each in as_list(methods))
    return ApiClass(as_text(name), as_text(kind), tuple(as_texts(bases)), tuple(as_texts(constructors)), made)


def _packed_function(row: Json) -> ApiFunction:
    name, parameters, returns, *static = as_list(row)
    return ApiFunction(as_text(name), as_text(parameters), as_text(returns), static == [True])


def _row(function: ApiFunction) -> list[str | bool]:
    return [function.name, function.parameters, function.returns, *([True] if function.static else [])]


def _shown(function: ApiFunction) -> dict[str, Json]:
    return {"name": function.name, "returns": function.returns, "static": function.static, "signature": function.signature}


def _function(row: Json) -> ApiFunction:
    name, parameters, returns, *static = as_list(row)
    return ApiFunction(as_text(name), as_text(parameters), as_text(returns), static == ["static"])
