"""The adapter files for a source and a target platform, read when a program needs them.

They are in `<target platform>/adapters/<source platform>/` of the platform repository, one for each header, with its name
(`sys/time.cpp` is for `sys/time.h`); those of its folder `hal` are for no header, but for an architecture each, or for
all others. Files of a project, of the user and of plug-ins precede the built-in ones, piece by piece.
`queries.plans.adapter_needs` determines which pieces a program needs.

`AdapterPins` says which parameters of a function are pins according to its adapter. The platform's `pins.json` takes precedence.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from functools import cached_property
from pathlib import Path, PurePath, PurePosixPath
from types import MappingProxyType

from robosmi import inputs, resources
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError, did_you_mean
from robosmi.transformations.knowledge.adapters.adapter_checks import parameters_of
from robosmi.transformations.knowledge.adapters.adapter_data import adapter_paths, load
from robosmi.transformations.knowledge.adapters.adapter_files import HAL, MARK
from robosmi.transformations.knowledge.adapters.adapter_records import AdapterFile, AdapterPiece
from robosmi.transformations.knowledge.api_facts import PinFacts, PinParameter
from robosmi.transformations.knowledge.board_models import architecture_of

BUILT_IN = "built-in"
OWN = "adapters"
"""Name of the folder for adapter files beside a project file, and in the user's data."""
ENDING_OF = {"C": ".c", "C++": ".cpp"}
"""Language of a target's programs -> the ending of its adapter files."""


class AdapterIndex:
    """The adapter files of some folders.

    Args:
        folders: the folders, in order of precedence.
        mcus: the known microcontrollers, for which variants may exist; any if none are given.
        ending: the ending of the files, which selects their language; any if it is empty.
        own: those of the folders that persons maintain -> the owner, `project` or `user`.
        architectures: tells the known architectures, which variants of persons may name; any if it tells none.
    """

    def __init__(
        self,
        folders: Sequence[Path],
        mcus: Iterable[str] = (),
        ending: str = "",
        own: Mapping[Path, str] = MappingProxyType({}),
        architectures: Callable[[], Collection[str]] = tuple,
    ) -> None:
        self._architectures = architectures
        self.folders = list(folders)
        self.mcus = sorted(mcus)
        self.own = dict(own)
        self._ending = ending
        self._listings: dict[Path, list[tuple[str, Path]]] = {}
        self._files: dict[str, list[AdapterFile]] = {}

    @property
    def headers(self) -> list[str]:
        """The headers for which there are files, sorted by name."""
        return sorted({header for folder in self.folders for header, _ in self._listed(folder)})

    def files(self, header: str) -> list[AdapterFile]:
        """The files for a header, in order of precedence.

        Raises:
            PlatformDataError: a file cannot be read, says something wrong, or is for another header than its name says.
        """
        known = self._files.get(header)
        if known is None:
            known = self._files[header] = []
            for folder in self.folders:
                known += [self._checked(path, header) for named, path in self._listed(folder) if named == header]
        return known

    def check_those_of(self, whose: str) -> None:
        """Read all files of an owner, to report their errors even if they are not needed.

        Args:
            whose: `project` or `user`.

        Raises:
            PlatformDataError: as for `files`.
        """
        for folder in (folder for folder, kept in self.own.items() if kept == whose):
            for header, _ in self._listed(folder):
                self.files(header)

    def own_headers(self) -> list[str]:
        """The headers for which the user keeps adapter files."""
        return list(dict.fromkeys(header for folder in self.folders if folder in self.own for header, _ in self._listed(folder)))

    def own_adapter(self, function: str) -> AdapterPiece | None:
        """The adapter that the user keeps for a function, of whatever header; None if there is none.

        Raises:
            PlatformDataError: as for `files`.
        """
        pieces = (piece for header in self.own_headers() for file in self.files(header) for piece in file.pieces)
        return next((p for p in pieces if p.kind == "adapter" and p.name == function and self.owner_of(p) != BUILT_IN), None)

    def owner_of(self, piece: AdapterPiece) -> str:
        """The owner of a piece: `project`, `user` or `built-in`."""
        path = Path(piece.location.path)
        return next((whose for folder, whose in self.own.items() if path.is_relative_to(folder)), BUILT_IN)

    def _listed(self, folder: Path) -> list[tuple[str, Path]]:
        """The adapter files of a folder, with the headers that they are named like."""
        if folder not in self._listings:
            paths = [path for path in adapter_paths(folder) if not self._ending or path.suffix == self._ending]
            if folder in self.own:  # where there may be code that is none of ours
                paths = [path for path in paths if MARK.encode() in inputs.read_bytes(path, inputs.DATA)]
            self._listings[folder] = [(_header(path.relative_to(folder)), path) for path in paths]
        return self._listings[folder]

    def _checked(self, path: Path, header: str) -> AdapterFile:
        file = load(path)
        if file.header != header:
            if header == HAL:
                message = f"the adapter file is for '{file.header}', but its folder '{HAL}' is for no header"
                raise PlatformDataError(message, location=Location(str(path), 1), fix=f"begin with `{MARK} header {HAL}`")
            fix = f"rename it to {file.header.removesuffix('.h')}{path.suffix}"
            raise PlatformDataError(f"the adapter file is for '{file.header}'", location=Location(str(path), 1), fix=fix)
        for piece in file.pieces:
            for mcu in piece.mcus if self.mcus else ():
                if mcu not in self.mcus:
                    message = f"'{piece.name}' is a variant for an unknown microcontroller '{mcu}'"
                    raise PlatformDataError(
                        f"{message}{did_you_mean(mcu, self.mcus)}", location=piece.location, fix=f"use: {', '.join(self.mcus)}"
                    )
        named = [(piece, name) for piece in file.pieces for name in piece.architectures]
        if named and any(path.is_relative_to(folder) for folder in self.own) and (known := sorted(self._architectures())):
            for piece, name in named:
                if name not in known:
                    message = f"'{piece.name}' is a variant for an unknown architecture '{name}'{did_you_mean(name, known)}"
                    raise PlatformDataError(message, location=piece.location, fix=f"use: {', '.join(known)}")
        return file

    def of(self, header: str) -> list[list[AdapterPiece]]:
        """The pieces for a header, folder by folder."""
        groups: dict[Path, list[AdapterPiece]] = {folder: [] for folder in self.folders}
        for file in self.files(header):
            if file.pieces:  # all of them in one place
                path = Path(file.pieces[0].location.path)
                groups[next(folder for folder in self.folders if path.is_relative_to(folder))] += file.pieces
        return [pieces for pieces in groups.values() if pieces]

    def task(self, name: str, header: str) -> str:
        """The reason why no adapter is possible for a function of a header; empty if none is stated."""
        return next((file.tasks[name] for file in self.files(header) if name in file.tasks), "")

    def unsupported(self, header: str) -> str:
        """The reason why the target cannot support a header; empty if a file has adapters for it, or none is stated."""
        files = self.files(header)
        served = any(piece.kind == "adapter" for file in files for piece in file.pieces)  # values of a header do not serve it
        return "" if served else next((f.unsupported for f in files if f.unsupported), "")


def _header(path: PurePath) -> str:
    """The header that an adapter file is for, by its path in its folder."""
    return HAL if path.parent.as_posix() == HAL else path.with_suffix(".h").as_posix()


def adapter_index(
    target: str, source: str, project: Path | None = None, *, beside: Path | None = None, language: str = ""
) -> AdapterIndex:
    """The adapter files that there are: those that persons keep for themselves, then those of the platform repository.

    Args:
        target: name of the target platform.
        source: name of the source platform.
        project: the project folder; the current folder if None.
        beside: the folder of the project file, whose folder `adapters` counts first; None without a project file.
        language: of the target's programs; files in another one are left out.
    """
    relative = PurePosixPath(target, "adapters", source)
    folders = list(resources.folders("platform_repo", project))
    mcus = {path.stem for folder in folders for path in (folder / "mcus").glob("*.toml")}
    own = {folder: whose for folder, whose in own_folders(beside).items() if folder.is_dir()}
    places = [place for folder in folders if (place := folder / relative).is_dir()]
    shipped = resources.built_in("platform_repo")
    repositories = {place: "user" for place in places if not place.is_relative_to(shipped)}
    return AdapterIndex(
        [*own, *places], mcus, ENDING_OF.get(language, ""), own | repositories,
        lambda: {architecture_of(name, project) for name in mcus},
    )  # fmt: skip


def own_folders(beside: Path | None) -> dict[Path, str]:
    """Where persons keep adapter files for themselves, whether or not it is there: for one project, and for all of a user's.

    Args:
        beside: the folder of the project file; None without one.
    """
    of_project = {beside / OWN: "project"} if beside is not None else {}
    return {**of_project, resources.user_data() / OWN: "user"}


class AdapterPins:
    """The pins of functions, from the markers `pin:` of their adapters.

    Args:
        index: the adapter files of the target.
    """

    def __init__(self, index: AdapterIndex) -> None:
        self.index = index
        self._known: dict[tuple[str, str], PinFacts | None] = {}

    def of(self, function: str, header: str) -> PinFacts | None:
        """The pins of a function; None where no adapter declares any.

        Args:
            function: its name.
            header: where it is declared; empty where nobody knows it, so that the adapters of all headers are asked.

        Raises:
            PlatformDataError: an adapter file cannot be read, or says something wrong.
        """
        key = function, header
        if key not in self._known:
            pieces = [p for group in self.index.of(header) for p in group] if header else self._of_all.get(function, ())
            found = (_pins(piece) for piece in pieces if piece.name == function)
            self._known[key] = next((pins for pins in found if pins is not None), None)
        return self._known[key]

    @cached_property
    def _of_all(self) -> dict[str, list[AdapterPiece]]:
        """Name -> the pieces of that name of all headers."""
        found: dict[str, list[AdapterPiece]] = {}
        for piece in (p for header in self.index.headers for group in self.index.of(header) for p in group):
            found.setdefault(str(piece.name), []).append(piece)
        return found


def _pins(piece: AdapterPiece) -> PinFacts | None:
    if piece.kind != "adapter" or not piece.pins:
        return None
    names = parameters_of(piece.text, piece.target_name or piece.name)
    pins = [PinParameter(names.index(pin.name), pin.name, pin.direction) for pin in piece.pins if pin.name in names]
    return PinFacts(tuple(pins), ()) if pins else None
