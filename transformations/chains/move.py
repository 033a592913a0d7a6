"""The chain `migrate` as it is registered: of source files, or of the output folder of an earlier migration for another board."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from robosmi.files.commit import again_when_changed
from robosmi.files.recovery import recover
from robosmi.project import Project, project_of
from robosmi.transformations.chains.migrate import migrate
from robosmi.transformations.chains.stages.moving import former_output, moving, settings_of
from robosmi.transformations.chains.stages.output import Generated


def migrate_or_move(
    files: Sequence[str | Path],
    output: str | Path,
    *,
    target: str | None = None,
    hardware: str | Path | None = None,
    project: Project | None = None,
    dry_run: bool = False,
    ask_pins: Callable[[Sequence[Mapping[str, str]]], bool] | None = None,
    **options: Any,
) -> Generated:
    """Migrate a program, or move an output folder on to another board.

    Args:
        files: source files of one program, or one output folder.
        output: the output folder; another one than that which is moved.
        target, hardware, project, dry_run, options: see `chains.migrate.migrate`. What is not given is as it was for the folder
            that is moved.
        ask_pins: asks the user whether pins that are proposed for the other board are right, as rows of texts (`before`, `pin`,
            `name`, `ports`); None to ask nobody.

    Raises:
        SourceError, UsageError, StoppedError: see `chains.migrate.migrate` and `stages.moving.moving`.
    """
    former = former_output(files)
    if former is None:
        return migrate(files, output, target=target, hardware=hardware, project=project, dry_run=dry_run, **options)
    return _moved(former, Path(output), target, hardware, project, dry_run, ask_pins, options)


@again_when_changed
def _moved(
    former: Path,
    output: Path,
    target: str | None,
    hardware: str | Path | None,
    project: Project | None,
    dry_run: bool,
    ask_pins: Callable[[Sequence[Mapping[str, str]]], bool] | None,
    options: Mapping[str, Any],
) -> Generated:
    if not dry_run:
        recover(output)
    drawing = Path(hardware) if hardware is not None else None
    moved, arguments = moving(former, output, target=target, drawing=drawing, project=project, ask=ask_pins)
    given = {name: value for name, value in options.items() if value or name not in arguments.options}
    with moved.reading():
        return migrate(arguments.files, output, dry_run=dry_run, moved=moved, **{**arguments.options, **given})


def project_for(files: Sequence[str | Path]) -> Project:
    """The project file for what `migrate` is given: the one beside the first source, or the one of an output folder.

    Raises:
        SourceError: it cannot be read.
    """
    former = former_output(files)
    return project_of(Path(files[0])) if former is None else settings_of(former)
