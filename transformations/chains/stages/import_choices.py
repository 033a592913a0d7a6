"""Reads the user's choices from the plan that an output folder already contains, for the migration that makes it anew.

They rank after the command line and the project file. A plan in which the user has edited more than choices is not adopted: the
run stops before it would overwrite the plan.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from msgspec import Struct

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import RobosmiError
from robosmi.files.files import digest
from robosmi.files.run_lock import alone
from robosmi.generate.manifest import Manifest
from robosmi.generate.output_paths import Places
from robosmi.transformations.chains.stages.edited_plan import STORED, only_choices_differ
from robosmi.transformations.chains.stages.models import stored_models
from robosmi.transformations.m2m.choices.stored_choices import GONE, NOTHING, StoredChoices, choices_of_persons
from robosmi.transformations.m2m.plan_tasks import settle


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
