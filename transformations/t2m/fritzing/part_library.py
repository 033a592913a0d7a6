"""Reads a folder of Fritzing part definitions (`.fzp`) as parts with roles, for `robosmi parts import`.

Only facts are taken, no artwork and no prose: of a description only how often each word occurs in it. A damaged definition is
left out with a finding and affects no other. If two files define one id, the first counts.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

from lxml import etree
from msgspec.structs import replace

from robosmi import inputs
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import SourceError
from robosmi.transformations.knowledge.part import Part
from robosmi.transformations.knowledge.part_names import names
from robosmi.transformations.knowledge.part_roles import classify
from robosmi.transformations.t2m.fritzing.part_file import part_of
from robosmi.transformations.t2m.guarded_xml import parse_xml

DEFINITION = inputs.Kind("part definition", 16 * 1024 * 1024)
"""The largest public one has under one megabyte."""

_TAG = re.compile(r"<[^<>]*>")
_WORD = re.compile(r"[^\W_]{2,30}")


class PartLibrary:
    """Each part that was read with the word counts of its description, and findings about what was left out."""

    def __init__(self) -> None:
        self.parts: list[tuple[Part, Counter[str]]] = []
        self.findings: list[Finding] = []
        self.repeated = 0


def read_library(folders: Sequence[Path], project: Path | None = None) -> PartLibrary:
    """All part definitions below some folders, with roles.

    Args:
        folders: folders, or single definitions; the first that has an id counts.
        project: the project folder, whose own rules take precedence; the current folder if None.

    Raises:
        SourceError: a folder is not there, or there is no definition at all.
        PlatformDataError: the rules for roles are damaged.
    """
    known = names(project)
    library = PartLibrary()
    seen: set[str] = set()
    for path, shown in _files(folders):
        try:
            root = parse_xml(inputs.read_bytes(path, DEFINITION), str(path), path.name)
            part = part_of(root, shown, known)
        except (SourceError, OSError) as error:
            cause = error.message if isinstance(error, SourceError) else error.strerror
            library.findings.append(_left_out(path, f"it cannot be read: {cause}"))
            continue
        if part is None:
            library.findings.append(_left_out(path, "it is not a part definition"))
        elif part.id in seen:
            library.repeated += 1
        else:
            seen.add(part.id)
            role = classify(part, project)
            library.parts.append((role if role.role != "Unknown" else replace(part, evidence="no rule fits"), _words(root)))
    if not library.parts:
        raise SourceError(
            "it contains no Fritzing part definition (.fzp)",
            location=Location(str(folders[0])),
            fix="give a folder of parts, such as the one that Fritzing installs",
        )
    return library


def _files(folders: Sequence[Path]) -> Iterator[tuple[Path, str]]:
    """The definitions in search order, each with the name that results show: its folder and name, never a full path."""
    for folder in folders:
        if folder.is_file():
            yield folder, folder.name
            continue
        if not folder.is_dir():
            raise SourceError("no such folder", location=Location(str(folder)), fix="give a folder with .fzp files")
        for path in sorted(folder.rglob("*.fzp")):
            if path.is_file():
                yield path, f"{path.parent.name}/{path.name}"


def _words(root: etree._Element) -> Counter[str]:
    """How often each word occurs in the description, in lower case; HTML is often escaped in it as text."""
    from html import unescape  # slow to load, and wanted only while parts are added

    text = str(root.xpath("string(description)"))
    return Counter(word.lower() for word in _WORD.findall(_TAG.sub(" ", unescape(unescape(text)))))


def _left_out(path: Path, cause: str) -> Finding:
    return Finding("RS204", Severity.warning, f"'{path.name}' was left out: {cause}", Location(str(path)))
