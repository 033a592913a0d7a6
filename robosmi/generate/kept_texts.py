"""`keep` for texts that `Gen.make` gave, or that were made some other way: they are merged with the files that are there.

The caller writes them, with whatever else it makes, in one commit. The record of last texts is a folder of its output.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from robosmi import inputs
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import StoppedError
from robosmi.generate.keep import keep
from robosmi.generate.record import Record
from robosmi.generate.regions import styles_in
from robosmi.model.files import digest


@dataclass
class KeptTexts:
    """What becomes of the files.

    Attributes:
        files: the texts as they are to be written, relative path -> bytes.
        records: the texts that were made, under their paths in the record.
        old: old files that are kept beside conflicts.
        merged: the files whose edits, if any, are in `files`; any other file that is there must be guarded.
        obsolete: files (and their records) that an earlier run made, this one does not, and nobody changed.
        orphans: the same, but changed: they stay, with their records.
        findings: what was kept, and what a person has to look at.
    """

    files: dict[str, bytes] = field(default_factory=dict)
    records: dict[str, bytes] = field(default_factory=dict)
    old: dict[str, bytes] = field(default_factory=dict)
    merged: set[str] = field(default_factory=set)
    obsolete: set[str] = field(default_factory=set)
    orphans: set[str] = field(default_factory=set)
    findings: list[Finding] = field(default_factory=list)


def keep_texts(folder: Path, place: str, made: Mapping[str, str], known: Mapping[str, str]) -> KeptTexts:
    """Merge newly made texts with the files that are there.

    Args:
        folder: the output folder.
        place: the folder of the last texts, relative to it.
        made: relative path -> text.
        known: relative path -> digest, of the files as the last run wrote them.

    Raises:
        StoppedError: an edit would be lost; all such files are named.
    """
    record = Record(folder, place)
    kept = KeptTexts()
    refused: list[Finding] = []
    for name, text in made.items():
        kept.files[name] = text.encode()
        kept.records[record.path(name)] = text.encode()
        _merge(folder, record, name, text, known.get(name), kept, refused)
    if refused:
        told = "; ".join(f"{f.location}: {f.message}" if len(refused) > 1 else f.message for f in refused)
        raise StoppedError(f"{told}; nothing was written", location=refused[0].location, fix=refused[0].fix)
    for name in record.names():
        if name not in made:
            _no_longer_made(folder, record, name, kept)
    return kept


def _merge(
    folder: Path, record: Record, name: str, text: str, known: str | None, kept: KeptTexts, refused: list[Finding]
) -> None:
    path = folder / name
    there = inputs.read_bytes(path, inputs.OUTPUT) if path.is_file() else None
    last = record.read(name)
    if last is None and there is not None and digest(there) == known:
        last = there  # made before there was a record, and nobody has changed it
    if there is not None and last is None:
        return
    try:
        base = last.decode("utf-8") if last is not None else None
        existing = there.decode("utf-8").replace("\r\n", "\n") if there is not None else None
    except UnicodeDecodeError:
        return
    result = keep(str(path), base, existing, text, styles_in(text))
    if result.refused is not None:
        refused.append(result.refused)
        return
    kept.merged.add(name)
    kept.findings += result.findings
    same = there is not None and result.text == existing
    kept.files[name] = there if there is not None and same else result.text.encode()
    if result.save_old and there is not None:
        number, old = 1, f"{name}.orig"
        while (folder / old).exists():
            number += 1
            old = f"{name}.orig.{number}"
        kept.old[old] = there


def _no_longer_made(folder: Path, record: Record, name: str, kept: KeptTexts) -> None:
    path = folder / name
    there = inputs.read_bytes(path, inputs.OUTPUT) if path.is_file() else None
    if there is None or there == record.read(name):
        kept.obsolete |= {record.path(name)} | ({name} if there is not None else set())
        return
    kept.orphans |= {name, record.path(name)}
    message = "it is no longer made, and was changed since it was; it is kept"
    kept.findings.append(
        Finding("RS514", Severity.warning, message, Location(str(path)), fix="remove it when you do not need it")
    )
