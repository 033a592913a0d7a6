"""The two programs of a stored plan: the sketch as it is in the output folder now, and the original from the stored sources."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from robosmi.base.trust import acting
from robosmi.inputs import SOURCE, read_text
from robosmi.metamodels import migration, platform
from robosmi.transformations.chains.stages.models import MigrationModels
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.m2t.retained_text import STORED as STORED_FILES
from robosmi.transformations.queries.reports.written_bodies import AS_BYTES
from robosmi.transformations.queries.source_text import is_header
from robosmi.transformations.verification.engine_original import engine_original, source_board_of
from robosmi.transformations.verification.originals import original_program, written_sources
from robosmi.transformations.verification.stubs import Stubs
from robosmi.transformations.verification.target_side import LIMIT_S
from robosmi.verify.host_model import load_host_model
from robosmi.verify.host_original import HostOriginal
from robosmi.verify.original import Original
from robosmi.verify.toolchains.compile_report import CompileReport
from robosmi.verify.toolchains.sketch import find_sketch


def board_of(models: MigrationModels, report: CompileReport) -> platform.Board:
    """The board that a program was compiled for: the plan's own, else the repository's."""
    stored = models.plan.board
    return stored if stored is not None and stored.name == report.board else load_board(report.board)


def source_mv(plan: migration.MigrationPlan) -> float:
    """The supply of the source board, if the plan has one, whose parts are fed by it; else 0."""
    board = source_board_of(plan)
    return board.volts * 1000 if board is not None else 0.0


def sketch_files(output: Path) -> list[Path]:
    """The files of the migrated program as it is now."""
    sketch, _ = find_sketch(output)
    return [sketch.main, *sketch.parts, *(path for path in sorted(sketch.folder.glob("*")) if path.suffix in (".h", ".hpp"))]


def sketch_texts(files: Sequence[Path]) -> list[str]:
    """The texts of these files."""
    return [read_text(path, SOURCE, errors=AS_BYTES) for path in files]


def stored_original(models: MigrationModels, place: Path, trusted: bool = False, stubs: Stubs | None = None) -> Original:
    """The original of a plan, built from the stored sources.

    Args:
        models: the stored plan with its models.
        place: an empty folder, in which everything is made.
        trusted: whether it may run where the system has no sandbox for it.
        stubs: functions and missing headers that may be stubbed.

    Raises:
        MissingToolError: the host's compiler is not installed, or the system has no sandbox.
        VerificationError: the program does not compile or link.
    """
    plan = models.plan
    assert plan.program is not None
    assert plan.source is not None
    if (board := source_board_of(plan)) is not None:
        texts = {path.removeprefix(STORED_FILES): text for path, text in stored_sources(models).items()}
        main = str(plan.program.units[0].path).removeprefix(STORED_FILES)
        return engine_original(texts, main, str(plan.source.name), board, place)
    stored = place / "stored"
    files = written_sources(list(plan.program.units), stored_sources(models), stored)
    sources = [stored / unit.path for unit in plan.program.units if not is_header(unit)]
    with acting(host=True):
        model = load_host_model(str(plan.source.name))
        return HostOriginal(original_program(sources, model, place, limit_s=LIMIT_S, only=files, trusted=trusted, stubs=stubs))


def stored_sources(models: MigrationModels) -> dict[str, bytes]:
    """Path -> content of the program's files, as the plan has recorded them."""
    return {str(entry.path): models.files[entry.path] for entry in models.plan.inputs if entry.kind == "source"}
