"""Invariants of a regenerated file, checked by its lines alone: nothing of the merge is used here.

`Round` contains the five texts of one file: generated last, generated now (both into empty folders), the file with the user's
edits before the run and after it, and the old file kept beside it; and the rules of the run's findings.
"""

from __future__ import annotations

import difflib
import re
from collections import Counter
from collections.abc import Iterable, Iterator

from msgspec import Struct

BOM = b"\xef\xbb\xbf"
LEFT = {"RS516", "RS522"}
"""Rules of findings about files that were left unchanged."""
OLD_KEPT = {"RS511", "RS518"}
"""Rules of findings about files whose old text is kept beside them."""
TOLD = {"RS510", "RS513", "RS519", "RS520", *OLD_KEPT, *LEFT}
"""Rules of findings that ask the user to look at the file."""
_MARKS = ("<<<<<<< yours", "||||||| last generated", "=======", ">>>>>>> generated")
_WORD = re.compile(r"\w+|[^\w\s]")
_REGION = re.compile(r"protected region (\S+) (on begin|off begin|end)\b")


class Round(Struct):
    """The texts of one file in one run; None where there is no such file."""

    name: str
    base: bytes | None
    edited: bytes | None
    made: bytes | None
    after: bytes | None
    rules: set[str] = set()
    old: list[bytes] = []


def lines(data: bytes) -> list[str]:
    """The lines of a file without their ends, whatever these are."""
    return re.split("\r\n|\r|\n", data.removeprefix(BOM).decode(errors="surrogateescape"))


def ends(data: bytes) -> set[bytes]:
    """The line ends of a file."""
    return set(re.findall(rb"\r\n|\r|\n", data))


def outside(found: list[str]) -> Iterator[str]:
    """The lines that are in no region and are no markers."""
    inside = False
    for line in found:
        marker = _REGION.search(line)
        if marker is not None:
            inside = marker[2] != "end"
        elif not inside:
            yield line


def faults(one: Round) -> Iterator[str]:
    """The faults: an edit that is neither in the file nor reported and kept beside it, or generated text that is missing."""
    if one.edited is None:
        if one.after is None and one.made is not None:
            yield "the deleted file was not made again"
        if one.after is not None and one.base is not None and "RS517" not in one.rules:
            yield "the deleted file was made again without a word"
        return
    if one.base is None:
        return  # nobody can have edited what was not there
    untouched = lines(one.edited) == lines(one.base)
    if one.made is None:
        if untouched and one.after is not None and ends(one.edited) == ends(one.base):
            yield "a file that is no longer made stays though nobody changed it"
        if not untouched and (one.after != one.edited or "RS514" not in one.rules):
            yield "an edited file that is no longer made is gone, or nothing is said of it"
        return
    if one.after is None:
        yield "the file is gone"
        return
    if one.rules & LEFT:
        if one.after != one.edited:
            yield "a file that was said to be left was changed"
        return
    if one.rules & {"RS511"} and one.edited not in one.old:
        yield "a conflict, and no old file beside it"
    if one.edited not in one.old:
        yield from _lost(one)
    yield from _form(one)
    yield from _new(one)
    if "RS511" not in one.rules and any(mark in lines(one.after) for mark in (_MARKS[0], _MARKS[3])):
        yield "a conflict is marked and not reported"


def _lost(one: Round) -> Iterator[str]:
    assert one.base is not None
    assert one.edited is not None
    assert one.made is not None
    assert one.after is not None
    base, edited, made, after = (Counter(lines(data)) for data in (one.base, one.edited, one.made, one.after))
    said = _switched_off(one) if "RS518" in one.rules else set()
    for line in edited:
        if line in said:
            continue
        if edited[line] > base[line] and after[line] < edited[line] - max(0, base[line] - made[line]) and not _merged(line, one):
            yield f"lost: {line!r}"
    if one.rules & TOLD:
        return
    for line in base:
        if edited[line] < base[line] and line.strip() and after[line] > edited[line] + max(0, made[line] - base[line]):
            yield f"back: {line!r}"
    yield from _misplaced(one)


def _merged(line: str, one: Round, *, made: bool = False) -> bool:
    """Whether the words that an edit added to a line are found, in order, in a line that merges it with another.

    Args:
        line: a line of the edited file, or of the generated one.
        one: the round.
        made: whether it is a line of the generated file.
    """
    base, edited, new, after = (lines(data or b"") for data in (one.base, one.edited, one.made, one.after))
    gone = [each for each in base if each not in (new if made else edited)]
    before = difflib.get_close_matches(line, gone, n=1, cutoff=0.3)
    added = [word for word in _WORD.findall(line) if word not in _WORD.findall(before[0])] if before else []
    candidates = [_WORD.findall(each) for each in after if each not in {*base, *edited, *new}]
    if before and not added:  # only blanks were changed: they are in a line with the other one's words
        return any(_WORD.findall(each) in candidates for each in (edited if made else new))
    return any([word for word in words if word in added] == added for words in candidates)


def _switched_off(one: Round) -> set[str]:
    """The marker lines of regions that the user switched off and that have their default text again, as RS518 reports.

    What the user wrote before or after such a marker in its line must still be there.
    """
    assert one.edited is not None
    assert one.after is not None
    markers = [(line, found) for line in lines(one.edited) if (found := _REGION.search(line)) is not None]
    off = {found[1] for _, found in markers if found[2] == "off begin"}
    after = lines(one.after)
    off &= {found[1] for line in after if (found := _REGION.search(line)) is not None}
    return {
        line
        for line, found in markers
        if found[1] in off
        and all(any(word in now for now in after) for word in (line[: found.start()] + line[found.end() :]).split())
    }


def _misplaced(one: Round) -> Iterator[str]:
    """The user's lines that are in another region or function than they were written into.

    A region follows its id: where the function around it was renamed, its text is right there. Functions with the same head are
    told apart by their order only, so their heads say nothing about the place.
    """
    assert one.base is not None
    assert one.edited is not None
    assert one.after is not None
    there, then = _functions(lines(one.edited)), _functions(lines(one.after))
    known = set(lines(one.base))
    often = {line for data in (one.base, one.edited) for line, count in Counter(lines(data)).items() if count > 1}
    for line, heads in there.items():
        if line in known or len(heads) != 1 or len(then.get(line, ())) != 1:
            continue
        (head,), (now,) = heads, then[line]
        if head and head in often:
            continue
        if head != now and _stands(head, known) and _stands(head, lines(one.after)):
            yield f"misplaced: {line!r} stood in {head!r} and stands in {now!r}"


def _stands(place: str, found: Iterable[str]) -> bool:
    """Whether a text contains a place: a region by its id, a function by its head."""
    ids = {f"region {marker[1]}" for line in found if (marker := _REGION.search(line)) is not None}
    return place in ids or place in found


def _functions(found: Iterable[str]) -> dict[str, list[str]]:
    """Line -> the places that contain it: `region ID`, or the head of the function.

    The head of a function is a line that begins at the margin and ends with a brace.
    """
    head, region, heads = "", "", dict[str, list[str]]()
    for line in found:
        marker = _REGION.search(line)
        if marker is not None:
            region = "" if marker[2] == "end" else f"region {marker[1]}"
        elif region:
            if "EDIT" in line:
                heads.setdefault(line, []).append(region)
        elif line[:1].strip() and line.rstrip().endswith("{"):
            head = line
        elif line.startswith("}"):
            head = ""
        elif "EDIT" in line:
            heads.setdefault(line, []).append(head)
    return heads


def _form(one: Round) -> Iterator[str]:
    assert one.base is not None
    assert one.edited is not None
    assert one.after is not None
    if one.edited.startswith(BOM) != one.after.startswith(BOM):
        yield "the byte order mark came or went"
    kinds = ends(one.edited)
    if kinds and not ends(one.after) <= kinds:
        yield f"line ends: {kinds} before, {ends(one.after)} after"
    whole, was, now = (data.endswith((b"\n", b"\r")) for data in (one.edited, one.base, one.after))
    marked = "RS511" in one.rules and one.edited in one.old  # the last line is one of the conflict then
    if one.edited and whole != was and now != whole and not marked:
        yield "the last line break came or went"
    places = {line: end for line, end in _own_ends(one.edited).items() if len(kinds) > 1}
    for line, end in _own_ends(one.after).items():
        if places.get(line, end) != end and line not in _MARKS:
            yield f"the line end of {line!r} was {places[line]!r} and is {end!r}"


def _own_ends(data: bytes) -> dict[str, bytes]:
    """The line ends of the lines that occur once in a file."""
    parts = re.split(rb"(\r\n|\r|\n)", data.removeprefix(BOM))
    count = Counter(parts[::2])
    return {
        line.decode(errors="surrogateescape"): end for line, end in zip(parts[::2], parts[1::2], strict=False) if count[line] == 1
    }


def _new(one: Round) -> Iterator[str]:
    """Newly generated lines outside of regions that are missing after the run."""
    assert one.base is not None
    assert one.edited is not None
    assert one.made is not None
    assert one.after is not None
    if one.rules & TOLD:
        return
    base, edited, made = (Counter(outside(lines(data))) for data in (one.base, one.edited, one.made))
    after = Counter(lines(one.after))
    for line in made:
        gone = made[line] > base[line] and after[line] < made[line] - max(0, base[line] - edited[line])
        if gone and not _merged(line, one, made=True):
            yield f"not made: {line!r}"
