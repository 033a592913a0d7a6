"""What the user has edited in the plan that an output folder already contains: only choices, which the next run adopts, or more.

The texts are compared, so that this also works for a plan that cannot be loaded. A plan in which the user has edited more than
choices is not adopted: the run stops before it would overwrite the plan. The choices (`import_choices`) rank after the command
line and the project file; `m2m.choices.stored_choices` reads them.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import cast

from lxml import etree
from msgspec import Struct

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import RobosmiError, SourceError, StoppedError
from robosmi.files.files import digest
from robosmi.files.run_lock import alone
from robosmi.generate.manifest import Manifest
from robosmi.generate.output_paths import Places
from robosmi.transformations.chains.stages.models import FOLDER, PLAN, stored_models
from robosmi.transformations.m2m.choices.stored_choices import GONE, NOTHING, StoredChoices, choices_of_persons
from robosmi.transformations.m2m.plan_tasks import settle
from robosmi.transformations.t2m.guarded_xml import parse_xml

STORED = f"{FOLDER}/{PLAN}"
"""Path of the plan, relative to the output folder."""
_DECISIONS = ("portBindings", "libraryChoices")
_CHOSEN = ("choice", "chosenBy", "chosenAt", "confidence", "open", "connection", "pin", "chosen", "evidence")
"""The attributes of a decision that record what was chosen, by whom, when and why."""

_LOOSE = "//text()[preceding-sibling::* or normalize-space(.) != string(.)]"
"""Text between elements, and text that may have surrounding blanks."""


def refuse_unseen(output: Path, plan: bytes, seen: str | None) -> None:
    """Make sure that a stored plan is the one that the user has seen.

    Args:
        output: its output folder.
        plan: its bytes.
        seen: the digest of what the person saw; None to take the plan as it is.

    Raises:
        StoppedError: the plan has changed since.
    """
    if seen is not None and digest(plan) != seen:
        raise StoppedError(
            "the plan was changed elsewhere; nothing was decided", location=Location(str(output / STORED)),
            fix="check the updated plan, then choose again",
        )  # fmt: skip


def digest_without_choices(plan: bytes) -> str:
    """The digest of a stored plan without its choices of pins and libraries; empty if the plan has no canonical form."""
    try:
        root = parse_xml(plan, PLAN, PLAN, tool="EMF", blanks=False)
    except SourceError:
        return ""
    for decision in root.iter(*_DECISIONS):
        for name in _CHOSEN:
            if name in decision.attrib:
                del decision.attrib[name]
            for child in decision.findall(name):
                decision.remove(child)
    for text in cast("list[etree._ElementUnicodeResult]", root.xpath(_LOOSE)):
        parent = text.getparent()
        assert parent is not None
        if text.is_tail:
            parent.tail = None
        elif text != (bare := text.strip()):
            parent.text = bare
    try:
        canonical = etree.tostring(root, method="c14n")
    except etree.C14NError:  # a namespace that is no absolute URI has none (Canonical XML 1.0, section 1.3)
        return ""
    return digest(canonical + plan.rpartition(b">")[2])  # what stands behind it is an edit, too


def only_choices_differ(manifest: Manifest, name: str, data: bytes | None) -> bool:
    """Whether a file is unchanged since the last run, or is the stored plan with only its choices edited."""
    if data is None or manifest.files.get(name) == digest(data):
        return data is not None
    return name == STORED and bool(manifest.beside_choices) and manifest.beside_choices == digest_without_choices(data)


class ImportedChoices(Struct):
    """The data taken over from the plan of an output folder.

    Attributes:
        choices: the choices of persons.
        inputs: the plan as it was read, relative path -> bytes; empty if there was none.
        notes: findings about it.
    """

    choices: StoredChoices = NOTHING
    inputs: Mapping[str, bytes | None] = {}
    notes: list[Finding] = []


def import_choices(output: Path) -> ImportedChoices:
    """Read the choices of persons in the plan of an output folder.

    Raises:
        StoppedError: another run is at work there.
        SourceError: the record of the last run is damaged, or there is no place for the lock.
    """
    place = output / STORED
    if not place.is_file():
        return ImportedChoices()
    with alone(output):
        manifest, places = Manifest.load(output), Places(output)
        data = places.look(STORED)
        if data is None or not only_choices_differ(manifest, STORED, data):
            return ImportedChoices()
        read: Mapping[str, bytes | None] = {STORED: data}
        if manifest.files.get(STORED) == digest(data) and b'chosenBy="person"' not in data:
            return ImportedChoices(inputs=read)
        from robosmi.transformations.constraints.plan_edits import refuse_nonsense  # wanted only where there is an edited plan

        try:
            models = stored_models(output)
            refuse_nonsense(models.plan)
            settle(models.plan, models.files)
        except RobosmiError as error:
            message = f"the choices in the last run's plan are ignored: {error.message}"
            return ImportedChoices(
                notes=[Finding(GONE, Severity.warning, message, error.location or Location(str(place)), fix=error.fix)]
            )
    return ImportedChoices(choices_of_persons(models.plan, place), read)
