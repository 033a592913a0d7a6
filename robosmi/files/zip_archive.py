"""Unpacks ZIP archives of unknown origin in memory, with limits that are enforced during decompression for every method.

The sizes in an archive's header are never trusted: each method's decompressor is asked for at most the allowed number of bytes.
Names in an archive are treated as texts, never as paths, and an archive inside an archive is an ordinary file. The caller
interprets the entries.
"""

from __future__ import annotations

import bz2
import io
import lzma
import struct
import zipfile
import zlib

from robosmi.diagnostics import Location
from robosmi.errors import SourceError

MOST_RATIO = 200
"""Limit on the compression ratio of an entry above `FREE_BYTES`; programs and drawings reach 40."""
FREE_BYTES = 1024 * 1024
"""Uncompressed size in bytes up to which the compression ratio of an entry does not matter."""

_METHODS = {zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED, zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA}
_CENTRAL, _LOCAL = b"PK\x01\x02", b"PK\x03\x04"  # what an entry of the list and the head of an entry begin with
_LOCAL_HEAD = struct.Struct("<4s22xHH")  # 30 bytes (APPNOTE 4.3.7)
_ENCRYPTED = 0x1
_BLOCK = 1 << 16


def entries(data: bytes, place: str, most: int) -> list[zipfile.ZipInfo]:
    """The entries of an archive, in its order.

    Args:
        data: the archive.
        place: its path, for messages.
        most: how many entries it may have.

    Raises:
        SourceError: it has more, or its list is damaged.
    """
    listed = data.count(_CENTRAL)  # before the list is read, which takes memory for each entry
    if listed > most:
        raise _error(place, f"the archive has {listed} entries, more than {most}", "check that it has the right file type")
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            return archive.infolist()
    except (zipfile.BadZipFile, zlib.error, EOFError, ValueError, NotImplementedError, OSError) as error:
        raise _error(place, f"the archive is damaged: {error}", "create it again with its tool") from error


def unpacked(data: bytes, entry: zipfile.ZipInfo, place: str, most: int) -> bytes:
    """The bytes of an entry.

    Args:
        data: the archive.
        entry: one of its `entries`.
        place: its path, for messages.
        most: how many bytes the entry may have.

    Raises:
        SourceError: it has more, is packed more than `MOST_RATIO` times, is encrypted, or is packed in a way not known here.
        BadZipFile: it is damaged.
    """
    named = f"'{entry.filename}' in the archive"
    if entry.flag_bits & _ENCRYPTED:
        raise _error(place, f"{named} is encrypted", "save it without a password")
    if entry.compress_type not in _METHODS:
        raise _error(place, f"{named} is packed by the method {entry.compress_type}", "pack it with deflate, as usual")
    packed = _packed(data, entry)
    most_by_ratio = max(FREE_BYTES, len(packed) * MOST_RATIO)
    try:
        result = _unpack(packed, entry.compress_type, min(most, most_by_ratio) + 1)
    except (zlib.error, lzma.LZMAError, OSError, EOFError, ValueError) as error:
        raise zipfile.BadZipFile(f"{named} cannot be unpacked: {error}") from error
    if len(result) > most:
        raise _error(place, f"{named} has more than {most // 1024 // 1024} MB", "check that it has the right file type")
    if len(result) > most_by_ratio:
        cause = f"{named} is compressed more than {MOST_RATIO} times"
        raise _error(place, cause, "check where the archive comes from")
    if zlib.crc32(result) != entry.CRC:
        raise zipfile.BadZipFile(f"{named} has a wrong checksum")
    return result


def _packed(data: bytes, entry: zipfile.ZipInfo) -> bytes:
    """The packed bytes of an entry.

    Raises:
        BadZipFile: the archive does not have them where its list says.
    """
    start = entry.header_offset
    if start < 0 or len(data) - start < _LOCAL_HEAD.size:
        raise zipfile.BadZipFile(f"'{entry.filename}' is outside the archive")
    magic, name, extra = _LOCAL_HEAD.unpack_from(data, start)
    if magic != _LOCAL:
        raise zipfile.BadZipFile(f"'{entry.filename}' has no head of its own")
    start += _LOCAL_HEAD.size + name + extra
    if len(data) - start < entry.compress_size:
        raise zipfile.BadZipFile(f"'{entry.filename}' is cut off")
    return data[start : start + entry.compress_size]


def _unpack(packed: bytes, method: int, most: int) -> bytes:
    """At most the given number of decompressed bytes."""
    if method == zipfile.ZIP_STORED:
        return packed[:most]
    if method == zipfile.ZIP_DEFLATED:
        return zlib.decompressobj(-zlib.MAX_WBITS).decompress(packed, most)
    if method == zipfile.ZIP_BZIP2:
        return _in_blocks(bz2.BZ2Decompressor(), packed, most)
    decompressor, packed = _lzma(packed, most)
    return _in_blocks(decompressor, packed, most)


def _lzma(packed: bytes, most: int) -> tuple[lzma.LZMADecompressor, bytes]:
    """The decompressor for the LZMA properties at the beginning (APPNOTE 5.8.8), and the data after them.

    The dictionary, which is allocated at once, is limited to the allowed uncompressed size: no byte refers further back.
    """
    if len(packed) < 9 or struct.unpack_from("<H", packed, 2)[0] != 5:
        raise ValueError("the head of LZMA is damaged")
    settings, dictionary = struct.unpack_from("<BI", packed, 4)
    if settings >= 9 * 5 * 5:
        raise ValueError("the settings of LZMA are damaged")
    chosen = {
        "id": lzma.FILTER_LZMA1, "dict_size": max(4096, min(dictionary, most)), "lc": settings % 9, "lp": settings // 9 % 5,
        "pb": settings // 45,
    }  # fmt: skip
    return lzma.LZMADecompressor(lzma.FORMAT_RAW, filters=[chosen]), packed[9:]


def _in_blocks(decompressor: bz2.BZ2Decompressor | lzma.LZMADecompressor, packed: bytes, most: int) -> bytes:
    found = bytearray()
    data = packed
    while len(found) < most and not decompressor.eof:
        more = decompressor.decompress(data, min(_BLOCK, most - len(found)))
        data = b""
        if not more and decompressor.needs_input:
            break
        found += more
    return bytes(found)


def _error(place: str, cause: str, fix: str) -> SourceError:
    return SourceError(cause, location=Location(place), fix=fix)
