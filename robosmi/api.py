"""The Python API: everything the command line does is one function call, and every result is a model or holds one.

`import robosmi` offers these functions without importing this module; that happens at the first use. Readers,
transformations and generators are found through the registry, so no platform is named here.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from robosmi.plugins import content


def load_code(
    *files: str | Path, source_platform: str | None = None, include_dirs: Sequence[Path] = (), defines: Sequence[str] = ()
) -> Any:
    """Read the source files of one program.

    Args:
        files: the files.
        source_platform: platform it was written for; the default of the repository if None.
        include_dirs: folders with headers.
        defines: macros defined from outside, NAME or NAME=VALUE.

    Returns:
        A `ccode.Program`.

    Raises:
        SourceError: a file cannot be read as a program.
    """
    paths = [Path(f) for f in files]
    return content("chain", "analyse")(paths, source_platform=source_platform, include_dirs=include_dirs, defines=defines).program


def load_hardware(sketch: str | Path, *, roles: Mapping[str, str] | None = None) -> Any:
    """Read a drawing.

    Args:
        sketch: the file.
        roles: component -> role, where the catalogue of parts is wrong or silent.

    Returns:
        A `hardware.Circuit`.

    Raises:
        SourceError: it cannot be read, or has no board.
    """
    return content("chain", "hardware")(Path(sketch), roles=roles or {}).circuit


def recommend_libraries(
    sketch: str | Path | None = None,
    *,
    components: str | Path | None = None,
    ranker: str | None = None,
    target: str | None = None,
) -> Any:
    """Rank libraries for the components of a drawing, or for components listed in a JSON file.

    Returns:
        The recommendations; `.answers` in order, `.result` as the JSON contract has them.

    Raises:
        SourceError: the input cannot be read.
        UsageError: there is no such ranker or target.
    """
    drawing, listed = Path(sketch) if sketch is not None else None, Path(components) if components is not None else None
    return content("chain", "recommend")(drawing, components=listed, ranker=ranker, target=target)


def plan_migration(files: Sequence[str | Path], **options: Any) -> Any:
    """Make the plan of a migration without generating anything.

    Args:
        files: source files of one program.
        options: hardware, target, source_platform, include_dirs, defines, libraries, bind, project.

    Returns:
        The models of the migration; `.plan` is the `migration.MigrationPlan`.

    Raises:
        SourceError: an input cannot be read or used.
        UsageError: a choice names what does not exist.
    """
    return content("chain", "plan")(files, **options)


def migrate(files: Sequence[str | Path], output: str | Path, **options: Any) -> Any:
    """Migrate a program: plan, generate, write.

    Args:
        files: source files of one program.
        output: the output folder.
        options: as for `plan_migration`, and dry_run, strict.

    Returns:
        What was made; `.models.plan` is the plan, `.sketch` the sketch's folder.

    Raises:
        SourceError: an input cannot be read or used, or the output cannot be written.
        UsageError: a choice names what does not exist.
        StoppedError: a choice is open under `strict`, or a person's edit would be lost.
    """
    return content("chain", "migrate")(files, output, **options)


def generate_sketch(
    plan: str | Path, output: str | Path, *, dry_run: bool = False, strict: bool = False, bench: bool = False
) -> Any:
    """Make the sketch of a stored plan, from it and the models beside it alone.

    Raises:
        SourceError: a file cannot be read, or does not match its digest.
        StoppedError: a choice is open under `strict`, or a person's edit would be lost.
    """
    return content("chain", "generate")(Path(plan), Path(output), dry_run=dry_run, strict=strict, bench=bench)


def check_model(path: str | Path) -> Any:
    """Hold a drawing, a stored plan or any other model against all constraints registered for its metamodel.

    Args:
        path: the file.

    Returns:
        What was checked; `.findings` in order, `.result` as the JSON contract has it.

    Raises:
        SourceError: it cannot be read.
        ModelError: it contradicts its metamodel.
    """
    return content("chain", "check")(path)


def compile_sketch(sketch: str | Path, board: str | None = None, output: str | Path | None = None) -> Any:
    """Compile a generated sketch with the target's real toolchain.

    Args:
        sketch: the output folder, or the sketch's own.
        board: another board than the one in the sketch's project file.
        output: a folder for the program and the compilation database, made when missing; None leaves nothing.

    Returns:
        A `robosmi.verify.compile_report.CompileReport`.

    Raises:
        MissingToolError: the compiler is not installed.
        SourceError: there is no sketch, or the folder cannot be written.
    """
    if output is None:
        from robosmi.verify.toolchain import compile_sketch as compiled

        return compiled(Path(sketch), board)
    from robosmi.verify.kept_program import compile_into

    return compile_into(Path(sketch), board, into=Path(output))


def upload_sketch(sketch: str | Path, port: str, **options: Any) -> Any:
    """Put the compiled program of a sketch on the board at a port.

    Args:
        sketch: the output folder, or the sketch's own.
        port: the serial port, as the system calls it.
        **options: `kept_in` (the folder that it was compiled into), `baud`, `unfinished`, `dry_run`; see
            `robosmi.verify.upload.upload_sketch`.

    Returns:
        A `robosmi.verify.upload.UploadReport`.

    Raises:
        SourceError: it is not compiled, was changed since, or cannot be sent.
        MissingToolError: the tool that uploads is not installed.
        UploadError: the board did not take it.
    """
    from robosmi.verify.upload import upload_sketch as uploaded

    return uploaded(sketch, port, **options)
