"""Converts attribute values to text and back like Eclipse EMF (EcoreFactoryImpl and Java's number formats).

There is a pair of functions for each Ecore data type, selected by its name or by the Java class of a user's data type. Reading
refuses what EMF refuses; writing refuses what EMF could not read again. The Python types are those that pyecore requires. This
module handles neither elements nor files.
"""

from __future__ import annotations

import re
import struct
from collections.abc import Callable
from datetime import UTC, datetime
from decimal import Decimal, InvalidOperation
from typing import Any, TypeVar

from robosmi.errors import ModelError, did_you_mean
from robosmi.model.elements.ecore import EDataType, EEnum, EEnumLiteral, EProxy, EStructuralFeature, Scalar
from robosmi.model.elements.pyecore_internals import proxied, proxy_place

FromText = Callable[[str], Any]
ToText = Callable[[Any], str]

T = TypeVar("T")

ECORE_URI = "http://www.eclipse.org/emf/2002/Ecore"
XML_TYPE_URI = "http://www.eclipse.org/emf/2003/XMLType"
XML_NAMESPACE_URI = "http://www.w3.org/XML/1998/namespace"

_WHOLE = re.compile(r"[+-]?[0-9]+")
_REAL = re.compile(r"[+-]?(NaN|Infinity|([0-9]+(?:\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]+)?[fFdD]?)")
_HEX = re.compile("([0-9A-Fa-f]{2})*")
_DATE = re.compile(
    r"(\d{4})-(\d\d?)-(\d\d?)(?:[T ](\d\d?):(\d\d?)(?::(\d\d?)(?:\.(\d{1,9}))?)?)?\s*(Z|[+-]\d\d:?\d\d)?", re.ASCII
)


class _Remembered(dict[str, Any]):
    """A cache from text to converted value; refused texts are not cached."""

    LIMIT = 1 << 16

    def __init__(self, convert: FromText) -> None:
        super().__init__()
        self.convert = convert

    def __missing__(self, text: str) -> Any:
        value = self.convert(text)
        if len(self) < self.LIMIT:
            self[text] = value
        return value


def _whole(low: int | None, high: int | None) -> tuple[FromText, ToText]:
    def read(text: str) -> int:
        if not _WHOLE.fullmatch(text) or len(text) > 4000:
            raise ValueError(f"'{text}' is no whole number")
        return inside(int(text))

    def inside(value: int) -> int:
        if (low is not None and value < low) or (high is not None and value > high):
            raise ValueError(f"{value} is not between {low} and {high}")
        return value

    def write(value: Any) -> str:
        if not isinstance(value, int):
            raise ValueError(f"{value!r} is no whole number")
        return str(inside(int(value)))

    return read, write


def _bits(count: int) -> tuple[FromText, ToText]:
    return _whole(-(1 << (count - 1)), (1 << (count - 1)) - 1)


def _read_real(text: str) -> float:
    if not (match := _REAL.fullmatch(text.strip())):
        raise ValueError(f"'{text}' is no number")
    return float(match.group().rstrip("fFdD") if match[2] else match.group().replace("Infinity", "inf"))


def java_double(value: float) -> str:
    """As Java's `Double.toString` prints it: 1.0E7, Infinity, NaN, and 4.9E-324, as it takes two digits (JDK 19)."""
    shortest, two = repr(float(value)), f"{value:.1e}"
    return _java(float(value), two if float(two) == value else shortest)


def java_float(value: float) -> str:
    """As Java's `Float.toString` prints it: the fewest digits, two at least, that give the same 32-bit number."""
    try:
        single = struct.unpack("f", struct.pack("f", value))[0]
    except OverflowError:
        raise ValueError(f"{value!r} is too big for 32 bits") from None
    if single != single or single in (float("inf"), float("-inf")):
        return _java(single, repr(single))
    digits = next(d for n in range(1, 9) if struct.unpack("f", struct.pack("f", float(d := f"{single:.{n}e}")))[0] == single)
    return _java(single, repr(float(digits)))


def _java(value: float, shortest: str) -> str:
    if value != value:
        return "NaN"
    if value in (float("inf"), float("-inf")):
        return "Infinity" if value > 0 else "-Infinity"
    decimal = Decimal(shortest)
    sign, digits, _ = decimal.as_tuple()
    figures = "".join(str(digit) for digit in digits).rstrip("0") or "0"
    power = decimal.adjusted()
    minus = "-" if sign else ""
    if value == 0 or -3 <= power < 7:
        if power < 0 and value != 0:
            return f"{minus}0.{'0' * (-power - 1)}{figures}"
        whole = figures[: power + 1].ljust(power + 1, "0") if value else "0"
        return f"{minus}{whole}.{figures[power + 1 :] or '0' if value else '0'}"
    return f"{minus}{figures[0]}.{figures[1:] or '0'}E{power}"


def _write_real(form: Callable[[float], str]) -> ToText:
    def write(value: Scalar) -> str:
        if not isinstance(value, (int, float)):
            raise ValueError(f"{value!r} is no number")
        return form(float(value))

    return write


def _read_boolean(text: str) -> bool:
    lowered = text.lower()
    if lowered not in ("true", "false"):
        raise ValueError(f"'{text}' is neither true nor false")
    return lowered == "true"


def _write_boolean(value: Scalar) -> str:
    if not isinstance(value, bool):
        raise ValueError(f"{value!r} is neither True nor False")
    return "true" if value else "false"


def _read_decimal(text: str) -> Decimal:
    try:
        if _REAL.fullmatch(text) and text[-1] not in "fFdDyN":
            return Decimal(text)
    except InvalidOperation:
        pass
    raise ValueError(f"'{text}' is no decimal number")


def _write_decimal(value: Scalar) -> str:
    if not isinstance(value, Decimal) or not value.is_finite():
        raise ValueError(f"{value!r} is no decimal number")
    return str(value)


def _read_character(text: str) -> str:
    if _WHOLE.fullmatch(text):
        return chr(int(text) & 0xFFFF)  # EMF writes the character's number
    if not text:
        raise ValueError("there is no character")
    return text[0]


def _write_character(value: Scalar) -> str:
    if not isinstance(value, str) or len(value) != 1 or ord(value) > 0xFFFF:
        raise ValueError(f"{value!r} is not one character of 16 bits")
    return str(ord(value))


def _read_byte(text: str) -> bytes:
    return bytes([_bits(8)[0](text) & 0xFF])


def _write_byte(value: Scalar) -> str:
    if isinstance(value, (bytes, bytearray)) and len(value) == 1:
        return str(value[0] - 256 if value[0] > 127 else value[0])
    if isinstance(value, int):
        return _bits(8)[1](value)
    raise ValueError(f"{value!r} is not one byte")


def _read_bytes(text: str) -> bytearray:
    if not _HEX.fullmatch(text):
        raise ValueError(f"'{text}' is no sequence of bytes in hexadecimal")
    return bytearray.fromhex(text)


def _write_bytes(value: Scalar) -> str:
    if not isinstance(value, (bytes, bytearray)):
        raise ValueError(f"{value!r} is no sequence of bytes")
    return value.hex().upper()


def _read_date(text: str) -> datetime:
    match = _DATE.fullmatch(text)
    if not match:
        raise ValueError(f"'{text}' is no date (as in 2024-01-02T03:04:05.678+0000)")
    year, month, day, hour, minute, second = (int(part or 0) for part in match.groups()[:6])
    # EMF reads the digits after the point as milliseconds, however many there are: .5 is 5 ms.
    millisecond = int(match[7] or 0) if len(match[7] or "") <= 3 else int(match[7][:3])
    zone = None
    if match[8]:
        offset = match[8].replace(":", "").replace("Z", "+0000")
        zone = datetime.strptime(offset, "%z").tzinfo
    return datetime(year, month, day, hour, minute, second, millisecond * 1000, zone)


def _write_date(value: Scalar) -> str:
    if not isinstance(value, datetime):
        raise ValueError(f"{value!r} is no date")
    moment = value if value.tzinfo else value.replace(tzinfo=UTC)
    if moment.microsecond % 1000:
        raise ValueError(f"{value.isoformat()} is finer than the milliseconds that EMF keeps")
    return f"{moment:%Y-%m-%dT%H:%M:%S}.{moment.microsecond // 1000:03d}{moment:%z}"


def _read_unlimited(text: str) -> int:
    return -1 if text == "*" else _bits(32)[0](text)


def _write_unlimited(value: Scalar) -> str:
    return "*" if value == -1 else _bits(32)[1](value)


def _text(value: Scalar) -> str:
    if isinstance(value, str):
        return value
    raise ValueError(f"{value!r} is no text")


def _as_is(text: str) -> str:
    return text


def _no_text(value: Scalar) -> Any:
    raise ValueError(f"an object of the type EJavaObject has no text form: {value!r}")


_REAL_DOUBLE = (_read_real, _write_real(java_double))
_REAL_SINGLE = (_read_real, _write_real(java_float))
_CONVERTERS: dict[str, tuple[FromText, ToText]] = {
    "EString": (_as_is, _text), "java.lang.String": (_as_is, _text),
    "EInt": _bits(32), "EIntegerObject": _bits(32), "EInteger": _bits(32), "int": _bits(32), "java.lang.Integer": _bits(32),
    "ELong": _bits(64), "ELongObject": _bits(64), "long": _bits(64), "java.lang.Long": _bits(64),
    "EShort": _bits(16), "EShortObject": _bits(16), "short": _bits(16), "java.lang.Short": _bits(16),
    "byte": _bits(8), "java.lang.Byte": _bits(8), "EByte": (_read_byte, _write_byte), "EByteObject": (_read_byte, _write_byte),
    "EBigInteger": _whole(None, None), "java.math.BigInteger": _whole(None, None),
    "EBigDecimal": (_read_decimal, _write_decimal), "java.math.BigDecimal": (_read_decimal, _write_decimal),
    "EDouble": _REAL_DOUBLE, "EDoubleObject": _REAL_DOUBLE, "double": _REAL_DOUBLE, "java.lang.Double": _REAL_DOUBLE,
    "EFloat": _REAL_SINGLE, "EFloatObject": _REAL_SINGLE, "float": _REAL_SINGLE, "java.lang.Float": _REAL_SINGLE,
    "EBoolean": (_read_boolean, _write_boolean), "EBooleanObject": (_read_boolean, _write_boolean),
    "boolean": (_read_boolean, _write_boolean), "java.lang.Boolean": (_read_boolean, _write_boolean),
    "EChar": (_read_character, _write_character), "ECharacterObject": (_read_character, _write_character),
    "char": (_read_character, _write_character), "java.lang.Character": (_read_character, _write_character),
    "EByteArray": (_read_bytes, _write_bytes), "byte[]": (_read_bytes, _write_bytes),
    "EDate": (_read_date, _write_date), "java.util.Date": (_read_date, _write_date),
    "EJavaObject": (_no_text, _no_text), "UnlimitedNatural": (_read_unlimited, _write_unlimited),
}  # fmt: skip
_DEFAULTS: dict[str, Any] = {
    "UnlimitedNatural": 0,
    "EShort": 0, "EByte": b"\0", "EChar": "\0", "EInt": 0, "ELong": 0, "EDouble": 0.0, "EFloat": 0.0, "EBoolean": False,
    "int": 0, "long": 0, "short": 0, "byte": 0, "double": 0.0, "float": 0.0, "boolean": False, "char": "\0",
}  # fmt: skip
_TYPES_OF_UML = re.compile(r"http://www\.eclipse\.org/uml2/[0-9.]+/Types")
FEATURE_MAP = "EFeatureMapEntry"


def real(value: T) -> T:
    """The element that a pyecore proxy resolves to; any other value, and an unresolvable proxy, unchanged."""
    if not isinstance(value, EProxy):
        return value
    path, resource = proxy_place(value)
    if (
        not value.resolved
        and "://" in path
        and not (resource is not None and any(d.can_resolve(path, resource) for d in resource.decoders))
    ):
        return value
    try:
        value.force_resolve()
    except AttributeError:  # pyecore on a reference that leads to nothing
        return value
    found: T = proxied(value)
    return found


def _key(datatype: EDataType) -> str:
    """The name of a data type in the tables: its own if it is Ecore's, else that of its Java class."""
    package = datatype.ePackage
    if package is None or package.nsURI == ECORE_URI:
        return str(datatype.name)
    if datatype.name == "UnlimitedNatural" and _TYPES_OF_UML.fullmatch(str(package.nsURI)):
        return "UnlimitedNatural"
    return str(datatype.instanceClassName or "")


def literal_text(literal: EEnumLiteral) -> str:
    """The text of an enumeration's literal in a file; its name if it has no other."""
    return str(literal.name if literal.literal is None else literal.literal)


def from_text(datatype: EDataType) -> FromText | None:
    """The function that turns a file's text into a value; None if the text is the value.

    The function raises ValueError with the cause.
    """
    if isinstance(datatype, EEnum):
        return _Remembered(_read_literal(datatype)).__getitem__
    if "from_string" in datatype.__dict__ and _key(datatype) not in _CONVERTERS:
        return _guarded(datatype.from_string)
    read = _CONVERTERS.get(_key(datatype), (_as_is, _text))[0]
    if read is _as_is:
        return None
    return read if read in (_read_bytes, _no_text) else _Remembered(read).__getitem__


def _guarded(convert: FromText) -> FromText:
    def read(text: str) -> Any:
        try:
            return convert(text)
        except (Exception, SystemExit) as error:  # a data type of the user's raises what it likes
            raise ValueError(f"'{text}' is refused by its data type: {error}") from error

    return read


def _read_literal(enum: EEnum) -> FromText:
    known = {literal_text(literal): literal for literal in enum.eLiterals}

    def read(text: str) -> Any:
        if text not in known:
            raise ValueError(f"'{text}' is no literal of {enum.name}{did_you_mean(text, known)}")
        return known[text]

    return read


def to_text(datatype: EDataType) -> ToText:
    """The function that turns a value into the text of a file; it raises ValueError with the cause."""
    if isinstance(datatype, EEnum):
        return _write_literal(datatype)
    key = _key(datatype)
    if key in _CONVERTERS:
        return _CONVERTERS[key][1]
    convert: ToText = datatype.to_string
    return convert


def _write_literal(enum: EEnum) -> ToText:
    texts = {literal: literal_text(literal) for literal in enum.eLiterals}

    def write(value: Any) -> str:
        try:
            return texts[value]
        except (KeyError, TypeError):
            raise ValueError(f"{value!r} is no literal of {enum.name}") from None

    return write


class DefaultError(ModelError, ValueError):
    """A default of a metamodel that is no value of its attribute's type."""


def default(feature: EStructuralFeature, datatype: EDataType) -> Any:
    """The value that an attribute has where a file says nothing, as EMF has it.

    An empty default that is no value of the type, as generators for CIM write it, is that of the type.

    Raises:
        DefaultError: the metamodel's default is no value of the type.
    """
    literal = feature.defaultValueLiteral
    if literal is not None:
        convert = from_text(datatype)
        try:
            return literal if convert is None else convert(literal)
        except ValueError as error:
            if not literal:
                return default_of_type(datatype)
            said = f"the default value '{literal}' of '{feature.name}' is no value of {datatype.name}"
            raise DefaultError(
                said, fix="correct its defaultValueLiteral in the .ecore file; robosmi check FILE.ecore"
            ) from error
    if feature.default_value is not None:
        return feature.default_value
    return default_of_type(datatype)


def default_of_type(datatype: EDataType) -> Any:
    """The value that attributes of a type have without a default of their own."""
    if isinstance(datatype, EEnum):
        return datatype.eLiterals[0] if len(datatype.eLiterals) else None
    return _DEFAULTS.get(_key(datatype))


def is_primitive(datatype: EDataType) -> bool:
    """Whether the type has no null value in EMF, like Java's int."""
    return _key(datatype) in _DEFAULTS


def is_data_type(kind: Any) -> bool:
    """Whether it is a data type, and no class."""
    return isinstance(kind, EDataType)
