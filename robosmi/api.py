"""The Python API: everything the command line does is one function call, and every result is a model or holds one.

`import robosmi` offers these functions without importing this module; that happens at the first use. Readers,
transformations and generators are found through the registry, so no platform is named here.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Protocol, TypedDict, TypeVar, Unpack

from robosmi.plugins import content

if TYPE_CHECKING:
    from robosmi.base.data_text import Json
    from robosmi.diagnostics import Finding
    from robosmi.metamodels import ccode, hardware, migration
    from robosmi.model import Metamodel, Model
    from robosmi.model.comparison.comparison import ModelComparison
    from robosmi.model.comparison.merging import ModelMerge
    from robosmi.project import Project
    from robosmi.recommend.ranking import Recommendation
    from robosmi.verify.toolchains.compile_report import CompileReport
    from robosmi.verify.traces.verdict import Verdict
    from robosmi.verify.uploads.upload import UploadReport


class Analysed(Protocol):
    """The result of reading an input."""

    @property
    def result(self) -> Mapping[str, Json]:
        """The command's part of the JSON document, as the contract has it."""

    @property
    def findings(self) -> Sequence[Finding]:
        """What is worth knowing, in order."""

    def lines(self) -> list[str]:
        """Text for a terminal."""


class AnalysedCode(Analysed, Protocol):
    """The result of reading the source files of a program."""

    @property
    def program(self) -> ccode.Program:
        """The code model."""


class AnalysedDrawing(Analysed, Protocol):
    """The result of reading a drawing."""

    @property
    def circuit(self) -> hardware.Circuit:
        """The hardware model."""

    def picture(self) -> str:
        """The circuit as SVG."""

    def pin_table(self, target: Path) -> str:
        """The pins and what they drive, in the format that a file name's ending selects."""


class RankedLibraries(Analysed, Protocol):
    """Libraries for components, best first."""

    @property
    def answers(self) -> Sequence[Recommendation]:
        """The recommendations, one for each component, in their order."""


class PlannedMigration(Protocol):
    """The models of a migration."""

    @property
    def plan(self) -> migration.MigrationPlan:
        """The plan, with every decision."""

    @property
    def program(self) -> ccode.Program:
        """The code model."""

    @property
    def circuit(self) -> hardware.Circuit | None:
        """The hardware model; None without a drawing."""


class MigratedSketch(Protocol):
    """The result of a migration."""

    @property
    def models(self) -> PlannedMigration:
        """The models of the migration, including the plan."""

    @property
    def sketch(self) -> Path:
        """The sketch's folder."""

    @property
    def contents(self) -> Mapping[str, bytes]:
        """Every file made, path relative to the output folder -> bytes."""

    @property
    def output(self) -> Path:
        """The output folder."""

    @property
    def diff(self) -> str:
        """The changes that a dry run would make, as a diff; otherwise empty unless it was requested."""

    @property
    def written(self) -> bool:
        """Whether the files were written (not in a dry run)."""

    @property
    def open_choices(self) -> int:
        """How many choices are left to the user."""

    @property
    def verification(self) -> tuple[Mapping[str, Json], int] | None:
        """The comparison with the original in the contract's form, and its exit code; None if none was requested."""

    @property
    def findings(self) -> Sequence[Finding]:
        """What is worth knowing."""

    def result(self) -> Mapping[str, Json]:
        """The command's part of the JSON document, as the contract has it."""

    def tasks(self) -> Sequence[Finding]:
        """What is left for the user."""

    def artifacts(self) -> list[dict[str, str]]:
        """Files written, {path, kind}."""

    def lines(self) -> list[str]:
        """Text for a terminal."""


class VerifiedMigration(Analysed, Protocol):
    """The original and the migrated program, run under the same scenarios."""

    @property
    def verdict(self) -> Verdict:
        """Whether they do the same."""

    @property
    def exit_code(self) -> int:
        """The exit code of the contract."""

    @property
    def written(self) -> Sequence[tuple[Path, str]]:
        """Path and kind of each file written."""


class PlanOptions(TypedDict, total=False):
    """What a plan of a migration may be made with.

    Attributes:
        project: the settings of a project; those beside the first source file if they are not given.
        hardware: the drawing of the new hardware.
        target: name of the target board.
        source_platform: platform that the program was written for.
        source_board: board that it runs on today.
        include_dirs: folders with headers.
        defines: macros defined from outside, NAME or NAME=VALUE.
        libraries: drawn component -> library.
        bind: port of the source -> pin of the target.
        adapters: bodies of adapters, `filled` or `placeholders`.
        history: a file or a URL with earlier choices instead of the user's.
        widths: `fix` keeps the widths of the source's numbers, `keep` their text.
        ranker: name of the ranker of libraries (`devices`, or `tfidf`, the paper's).
        bench: whether a sketch that tries one component at a time is made, too.
    """

    project: Project | None
    hardware: str | Path | None
    target: str | None
    source_platform: str | None
    source_board: str | None
    include_dirs: Sequence[Path]
    defines: Sequence[str]
    libraries: Mapping[str, str] | None
    bind: Mapping[str, str] | None
    adapters: str | None
    history: str | None
    widths: str
    ranker: str | None
    bench: bool


class MigrationOptions(PlanOptions, total=False):
    """What a migration may be made with.

    Attributes:
        dry_run: whether nothing is written.
        strict: whether an open choice stops it.
        verify: whether the sketch is compared with the original at the end.
    """

    dry_run: bool
    strict: bool
    verify: bool


class VerifyOptions(TypedDict, total=False):
    """How a migrated program is compared with its original.

    Attributes:
        scenarios: files with inputs over time; those stored with the models, and generated ones, if there are none.
        engine: name of the simulator.
        seed: of the search for scenarios.
        vcd: file for both traces of a scenario.
        generate: whether to search for scenarios where none are given.
        budget_s: seconds of a typical machine's time for that search.
        clock_s: its limit in seconds by the clock.
        horizon_ms: how long its scenarios last at most, in milliseconds.
        trust_original: whether the original may run where the system has no sandbox for it.
        report: whether to write the verdict into the report.
    """

    scenarios: Sequence[Path]
    engine: str | None
    seed: int
    vcd: Path | None
    generate: bool
    budget_s: float
    clock_s: float | None
    horizon_ms: float | None
    trust_original: bool
    report: bool


class UploadOptions(TypedDict, total=False):
    """How a sketch is uploaded.

    Attributes:
        kept_in: the folder that it was compiled into.
        baud: the speed of the port.
        unfinished: whether a sketch with open tasks is sent, too.
        dry_run: whether nothing is sent.
        project: a folder whose project file counts.
    """

    kept_in: Path | None
    baud: int | None
    unfinished: bool
    dry_run: bool
    project: Path | None


_T = TypeVar("_T", bound="str | Path")


def _listed(given: _T | Sequence[_T]) -> list[_T]:
    """A list where a list is wanted; one path or text stands for itself."""
    return [given] if isinstance(given, (str, Path)) else list(given)


def _listed_options(options: Mapping[str, Any]) -> dict[str, Any]:
    return {key: _listed(value) if key in ("include_dirs", "defines") else value for key, value in options.items()}


def load_code(
    *files: str | Path, source_platform: str | None = None, include_dirs: Sequence[Path] = (), defines: Sequence[str] = ()
) -> ccode.Program:
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
    paths = [Path(f) for given in files for f in _listed(given)]
    include_dirs, defines = [Path(folder) for folder in _listed(include_dirs)], _listed(defines)
    found: AnalysedCode = content("chain", "analyse")(
        paths, source_platform=source_platform, include_dirs=include_dirs, defines=defines
    )
    return found.program


def load_hardware(sketch: str | Path, *, roles: Mapping[str, str] | None = None, target: str | None = None) -> hardware.Circuit:
    """Read a drawing.

    Args:
        sketch: the file.
        roles: component -> role, where the catalogue of parts is wrong or silent.
        target: the target whose board it has, for a file that does not say which.

    Returns:
        A `hardware.Circuit`.

    Raises:
        SourceError: it cannot be read, has no board, or another one than the target's.
        UsageError: there is no such target.
    """
    found: AnalysedDrawing = content("chain", "hardware")(Path(sketch), roles=roles or {}, target=target)
    return found.circuit


def recommend_libraries(
    sketch: str | Path | None = None,
    *,
    components: str | Path | None = None,
    ranker: str | None = None,
    target: str | None = None,
) -> RankedLibraries:
    """Rank libraries for the components of a drawing, or for components listed in a JSON file.

    Returns:
        The recommendations; `.answers` in order, `.result` as the JSON contract has them.

    Raises:
        SourceError: the input cannot be read.
        UsageError: there is no such ranker or target.
    """
    drawing, listed = Path(sketch) if sketch is not None else None, Path(components) if components is not None else None
    ranked: RankedLibraries = content("chain", "recommend")(drawing, components=listed, ranker=ranker, target=target)
    return ranked


def plan_migration(files: Sequence[str | Path], **options: Unpack[PlanOptions]) -> PlannedMigration:
    """Make the plan of a migration without generating anything.

    Args:
        files: source files of one program.
        options: see `PlanOptions`.

    Returns:
        The models of the migration; `.plan` is the `migration.MigrationPlan`.

    Raises:
        SourceError: an input cannot be read or used.
        UsageError: a choice names what does not exist.
    """
    planned: PlannedMigration = content("chain", "plan")(_listed(files), **_listed_options(options))
    return planned


def migrate(files: Sequence[str | Path], output: str | Path, **options: Unpack[MigrationOptions]) -> MigratedSketch:
    """Migrate a program: plan, generate, write.

    Args:
        files: source files of one program.
        output: the output folder.
        options: see `MigrationOptions`.

    Returns:
        What was made; `.models.plan` is the plan, `.sketch` the sketch's folder.

    Raises:
        SourceError: an input cannot be read or used, or the output cannot be written.
        UsageError: a choice names what does not exist.
        StoppedError: a choice is open under `strict`, or the user's edit would be lost.
    """
    made: MigratedSketch = content("chain", "migrate")(_listed(files), output, **_listed_options(options))
    return made


def generate_sketch(
    plan: str | Path, output: str | Path, *, dry_run: bool = False, strict: bool = False, bench: bool = False
) -> MigratedSketch:
    """Make the sketch of a stored plan, from it and the models beside it alone.

    Raises:
        SourceError: a file cannot be read, or does not match its digest.
        StoppedError: a choice is open under `strict`, or the user's edit would be lost.
    """
    made: MigratedSketch = content("chain", "generate")(Path(plan), Path(output), dry_run=dry_run, strict=strict, bench=bench)
    return made


def check_model(path: str | Path, *, target: str | None = None) -> Analysed:
    """Check a drawing, a stored plan or any other model: all constraints that are registered for its metamodel.

    Args:
        path: the file.
        target: the target whose board a drawing or pin table has; if None that of the project file.

    Returns:
        What was checked; `.findings` in order, `.result` as the JSON contract has it.

    Raises:
        SourceError: it cannot be read, or has another board than the target's.
        ModelError: it contradicts its metamodel.
        UsageError: there is no such target, or a target is given for something else than a drawing.
    """
    found: Analysed = content("chain", "check")(path, target=target)
    return found


def compare(
    before: str | Path | Model, after: str | Path | Model, *, metamodel: str | Path | Sequence[str | Path] | Metamodel = ()
) -> ModelComparison:
    """What is different about two models: elements matched by id, by key, else by similarity.

    Args:
        before: a model of EMF, or its file (XMI, JSON, .ecore).
        after: the other.
        metamodel: .ecore files of models that are given as files, or a `Metamodel`; the built-in metamodels if none.

    Returns:
        The comparison; `.changes` in order, `.equal` whether there are none.

    Raises:
        SourceError: a file cannot be read.
        ModelError: a model contradicts its metamodel, they are of different ones, or one is no model of EMF.
    """
    from robosmi.model.comparison.comparison import compare as compared

    return compared(before, after, metamodel)


def merge(
    base: str | Path | Model,
    a: str | Path | Model,
    b: str | Path | Model,
    *,
    take: Literal["a", "b"] | None = None,
    metamodel: str | Path | Sequence[str | Path] | Metamodel = (),
) -> ModelMerge:
    """Merge what two models made of one: what only one changed is taken, what both changed differently is a conflict.

    Args:
        base: what both were made from, a model of EMF or its file (XMI, JSON, .ecore).
        a: the first. Given as a model, it becomes the merged one, unless there are conflicts and no side is to win them.
        b: the second.
        take: the side that wins all conflicts.
        metamodel: .ecore files of models that are given as files, or a `Metamodel`; the built-in metamodels if none.

    Returns:
        The merge; `.conflicts` in order, `.model` the merged model, to be saved.

    Raises:
        SourceError: a file cannot be read.
        ModelError: a model contradicts its metamodel, they are of different ones, or one is no model of EMF.
    """
    from robosmi.model.comparison.merging import merge as merged

    return merged(base, a, b, take, metamodel)


def compile_sketch(sketch: str | Path, board: str | None = None, output: str | Path | None = None) -> CompileReport:
    """Compile a generated sketch with the target's real toolchain.

    Args:
        sketch: the output folder, or the sketch's own.
        board: another board than the one in the sketch's project file.
        output: a folder for the program and the compilation database, made when missing; None leaves nothing.

    Returns:
        A `robosmi.verify.toolchains.compile_report.CompileReport`.

    Raises:
        MissingToolError: the compiler is not installed.
        SourceError: there is no sketch, or the folder cannot be written.
    """
    if output is None:
        from robosmi.verify.toolchains.toolchain import compile_sketch as compiled

        return compiled(Path(sketch), board)
    from robosmi.verify.toolchains.compiled_program import compile_into

    return compile_into(Path(sketch), board, into=Path(output))


def verify_migration(output: str | Path, **options: Unpack[VerifyOptions]) -> VerifiedMigration:
    """Compare a migrated program with its original at the pins, and write the verdict into its report.

    Args:
        output: the output folder of a migration.
        options: see `VerifyOptions`.

    Returns:
        What was compared; `.verdict` is the verdict, `.exit_code` 0 where no difference was found.

    Raises:
        SourceError: there is no plan or program, or a file cannot be read or written.
        UsageError: a scenario names what is not there, or no simulator knows the board.
        MissingToolError: a compiler or simulator is not installed, or the system has no sandbox for the original.
        VerificationError: the simulator crashed or did not end.
    """
    compared: VerifiedMigration = content("chain", "verify")(Path(output), **options)
    return compared


def upload_sketch(sketch: str | Path, port: str | None = None, **options: Unpack[UploadOptions]) -> UploadReport:
    """Put the compiled program of a sketch on the board at a port.

    Args:
        sketch: the output folder, or the sketch's own.
        port: the serial port, as the system calls it, or the folder of the board's drive; None where the tool finds the board.
        **options: see `UploadOptions`.

    Returns:
        A `robosmi.verify.uploads.upload.UploadReport`.

    Raises:
        SourceError: it is not compiled, was changed since, or cannot be sent.
        MissingToolError: the tool that uploads is not installed.
        UploadError: the board did not take it.
    """
    from robosmi.verify.uploads.upload import upload_sketch as uploaded

    return uploaded(sketch, port, **options)
