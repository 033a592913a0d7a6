"""The chain `generate`: a stored plan, perhaps edited, to the sketch. It reads the plan and the models beside it only."""

from __future__ import annotations

import os
from contextlib import nullcontext
from pathlib import Path

from robosmi.files.recovery import at_work, look_only
from robosmi.files.run_lock import alone
from robosmi.generate.output_paths import Places
from robosmi.transformations.chains.stages.models import FOLDER, PLAN, MigrationModels, load_models
from robosmi.transformations.chains.stages.output import Generated, produce
from robosmi.transformations.chains.stages.refresh_findings import refresh_findings
from robosmi.transformations.constraints.plan_edits import refuse_nonsense
from robosmi.transformations.m2m.plan_tasks import settle


def generate(
    plan: str | Path,
    output: str | Path,
    *,
    dry_run: bool = False,
    strict: bool = False,
    bench: bool = False,
    report_only: bool = False,
) -> Generated:
    """Make the sketch of a stored plan.

    Args:
        plan: a plan.xmi.
        output: the output folder; it may be the one the plan lies in.
        dry_run: write nothing.
        strict: stop when a choice is open.
        bench: make a sketch that tries one component at a time, too, also where the plan does not ask for it.
        report_only: as for `produce`.

    Raises:
        SourceError: the plan or a file beside it cannot be read, or does not match its digest.
        ModelError: a model contradicts its metamodel, or the plan itself.
        StoppedError: a choice is open under `strict`, or the user's edit would be lost.
    """
    own = os.path.realpath(plan) == os.path.realpath(Path(output) / FOLDER / PLAN)
    if not own:
        models = _loaded(Path(plan), dry_run)
        models.plan.bench = models.plan.bench or bench
        return produce(models, Path(output), dry_run=dry_run, strict=strict)
    if dry_run:
        look_only(Path(output))
    with nullcontext() if dry_run else at_work(Path(output)):
        seen = {f"{FOLDER}/{PLAN}": Places(Path(output)).read(f"{FOLDER}/{PLAN}")}
        models = load_models(Path(plan))
        models.plan.bench = models.plan.bench or bench
        _bring_in_line(models)
        return produce(models, Path(output), inputs=seen, dry_run=dry_run, strict=strict, report_only=report_only)


def _loaded(plan: Path, dry_run: bool) -> MigrationModels:
    """Load a plan from its folder while no other run is writing there; that folder is not changed."""
    place = Path(os.path.realpath(plan)).parent.parent  # which no link that leads to itself stops
    with nullcontext() if dry_run else alone(place):
        look_only(place)
        models = load_models(plan)
    _bring_in_line(models)
    return models


def _bring_in_line(models: MigrationModels) -> None:
    """Refuse an inconsistent plan, and derive its tasks and findings anew from its decisions."""
    refuse_nonsense(models.plan)
    settle(models.plan, models.files)
    refresh_findings(models.plan, words=False)
