"""Installs a library where a toolchain finds it: by the platform's library manager, or from an archive or a folder.

Which manager that is, is data (`[libraries.manager]` of a toolchain). It is the only program here that may use the network. A
library from an archive or a folder needs none: it is checked, copied beside the others and then renamed, so that a run that ends
early leaves nothing behind.
"""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Mapping
from pathlib import Path, PurePosixPath
from tempfile import mkdtemp
from zipfile import BadZipFile

from msgspec import Struct

from robosmi import inputs
from robosmi.diagnostics import Location
from robosmi.errors import MissingToolError, SourceError, StoppedError, UsageError
from robosmi.files.files import read_input, within
from robosmi.files.zip_archive import entries, unpacked
from robosmi.verify.toolchains.libraries import properties_in, properties_of
from robosmi.verify.toolchains.toolchain_data import Toolchain, fill, places
from robosmi.verify.toolchains.tools import run

MOST_FILES, MOST_BYTES = 20_000, 256 << 20
"""Of a library."""
_NAME = re.compile(r"(?P<name>[A-Za-z0-9_][^@/\\\0-\x1f]*?)(?:@(?P<version>[A-Za-z0-9][A-Za-z0-9.+~-]*))?")
Files = Mapping[str, bytes]
"""Path relative to the library's folder -> content."""


class InstalledLibrary(Struct, frozen=True, order=True):
    """A library that is installed.

    Attributes:
        name: its name, as library managers know it.
        version: its version; empty if it does not say.
        folder: where it is.
    """

    name: str
    version: str
    folder: Path


class LibraryInstallation(Struct, frozen=True):
    """What was installed.

    Attributes:
        library: the library that was asked for.
        added: this and the libraries that came with it; empty if all of them were there.
        tool: the library manager; empty for an archive or a folder.
    """

    library: InstalledLibrary
    added: tuple[InstalledLibrary, ...]
    tool: str = ""


def install_library(
    wanted: str, toolchain: Toolchain, source: Path | None = None, *, replace: bool = False
) -> LibraryInstallation:
    """Install a library.

    Args:
        wanted: `NAME` or `NAME@VERSION`.
        toolchain: whose libraries.
        source: a zip file or a folder with the library; None for the library manager.
        replace: whether an installed library with other content gives way to the one from `source`.

    Raises:
        UsageError: this is no name, the platform has no libraries, or `source` has another library or version.
        MissingToolError: the library manager is not installed.
        SourceError: `source` cannot be read, nothing can be written, or the manager fails.
        StoppedError: another content of this library is installed.
    """
    read = _NAME.fullmatch(wanted.strip())
    if read is None:
        named = "give NAME or NAME@VERSION, for example Servo@1.2.1"
        fix = f"give its name, and the file as --from {wanted}" if os.path.exists(wanted) else named
        raise UsageError(f"'{wanted}' is no name of a library", fix=fix)
    name, version = read["name"].strip(), read["version"] or ""
    home = _home(toolchain)
    if source is None:
        return _by_manager(name, version, toolchain)
    label = toolchain.libraries.text("properties")
    files, called = _files(source, label)
    stated = properties_in(files[label].decode(errors="replace"))
    found = InstalledLibrary(stated.get("name") or called, stated.get("version", ""), home / _folder_name(name))
    if found.name.casefold() != name.casefold():
        raise UsageError(f"{source} has the library '{found.name}', not '{name}'", fix="give the name of the library in it")
    if version and found.version != version:
        raise UsageError(
            f"{source} has version {found.version or 'unknown'} of '{found.name}', not {version}", fix="give its version, or none"
        )
    if _same(found.folder, files):
        return LibraryInstallation(found, ())
    if os.path.lexists(found.folder) and not replace:
        there = properties_of(found.folder / label).get("version", "unknown")
        raise StoppedError(
            f"the library '{found.name}' is installed with other content (version {there})", location=Location(str(found.folder)),
            fix="remove the folder, or add --replace",
        )  # fmt: skip
    _put(files, found.folder)
    return LibraryInstallation(found, (found,))


def installed_libraries(toolchain: Toolchain) -> list[InstalledLibrary]:
    """The libraries that library managers have installed for a toolchain, those of its core not counted."""
    label = toolchain.libraries.text("properties")
    texts = [text for text in toolchain.libraries.texts("places") if "{" not in text]
    found = []
    for place in places(texts, toolchain.libraries.text("env")):
        for folder in sorted(path for path in place.iterdir() if (path / label).is_file()):
            stated = properties_of(folder / label)
            found.append(InstalledLibrary(stated.get("name") or folder.name, stated.get("version", ""), folder))
    return found


def _home(toolchain: Toolchain) -> Path:
    """The folder for new libraries: the first that the environment variable names, else the first of the toolchain's places.

    Raises:
        UsageError: the toolchain has no libraries.
    """
    named = [text for text in os.environ.get(toolchain.libraries.text("env"), "").split(os.pathsep) if text]
    own = [text for text in toolchain.libraries.texts("places") if "{" not in text and "*" not in text]
    if not own:
        raise UsageError(f"programs for {toolchain.platform} use no libraries", fix="give another --platform")
    return Path((named or own)[0]).expanduser()


def _by_manager(name: str, version: str, toolchain: Toolchain) -> LibraryInstallation:
    data = toolchain.libraries.table("manager")
    tool = data.text("command")
    path = shutil.which(tool)
    if path is None:
        raise MissingToolError(f"{tool} is not installed", fix=data.text("missing"))
    before = set(installed_libraries(toolchain))
    wanted = fill([data.text("versioned")], {"name": name, "version": version})[0] if version else name
    arguments = fill(data.texts("arguments"), {"library": wanted})
    advice = "check the connection, then run the command again"
    done = run([path, *arguments], limit_s=data.decimal("limit_s"), reads_files=False, advice=advice)
    if done.returncode:
        lines = [line.strip() for line in (done.stderr or done.stdout).splitlines() if line.strip()]
        raise SourceError(f"{tool} cannot install '{wanted}': {lines[-1] if lines else 'no message'}", fix=data.text("failed"))
    after = installed_libraries(toolchain)
    library = next((each for each in after if each.name.casefold() == name.casefold()), None)
    if library is None:
        raise SourceError(
            f"{tool} installed '{wanted}' where RoboSMi does not look for libraries",
            fix=f"name the folder with {toolchain.libraries.text('env')}",
        )
    return LibraryInstallation(library, tuple(each for each in after if each not in before), tool)


def _folder_name(name: str) -> str:
    """The folder of a library, as library managers name it: `DHT_sensor_library`."""
    return re.sub(r"[^A-Za-z0-9_.-]", "_", name)


def _files(source: Path, label: str) -> tuple[Files, str]:
    """The files of a library and the name of its folder.

    Raises:
        SourceError: they cannot be read, are no library, or are too many or too large.
    """
    found = _of_folder(source) if source.is_dir() else _of_archive(source)
    root = min((PurePosixPath(name).parent for name in found if PurePosixPath(name).name == label), key=_depth, default=None)
    if root is None or len(root.parts) > 1:
        raise SourceError(
            f"there is no library in it: it has no {label}",
            location=Location(str(source)),
            fix="give the library's own zip file or folder",
        )
    inside = {str(PurePosixPath(name).relative_to(root)): data for name, data in found.items() if _below(name, root)}
    return inside, root.name or source.resolve().name


def _depth(path: PurePosixPath) -> int:
    return len(path.parts)


def _below(name: str, root: PurePosixPath) -> bool:
    return PurePosixPath(name).is_relative_to(root)


def _of_folder(folder: Path) -> dict[str, bytes]:
    found, left = dict[str, bytes](), MOST_BYTES
    for root, folders, names in os.walk(folder):
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        for path in (Path(root) / name for name in sorted(names)):
            if path.is_symlink() or not path.is_file():
                continue
            data = read_input(path, "file of a library", inputs.DATA)
            left -= len(data)
            if left < 0 or len(found) == MOST_FILES:
                raise _too_large(folder)
            found[path.relative_to(folder).as_posix()] = data
    return found


def _of_archive(path: Path) -> dict[str, bytes]:
    data, place = read_input(path, "library", inputs.DATA), str(path)
    found, left = dict[str, bytes](), MOST_BYTES
    for entry in entries(data, place, MOST_FILES):
        if entry.is_dir():
            continue
        if not within(entry.filename) or "\\" in entry.filename:
            raise SourceError(
                f"'{entry.filename}' in the archive lies outside of it", location=Location(place), fix="do not use this archive"
            )
        try:
            found[entry.filename] = unpacked(data, entry, place, inputs.DATA.most)
        except BadZipFile as error:
            raise SourceError(f"the archive is damaged: {error}", location=Location(place), fix="load it again") from error
        left -= len(found[entry.filename])
        if left < 0:
            raise _too_large(path)
    return found


def _too_large(path: Path) -> SourceError:
    limit = f"{MOST_FILES} files or {MOST_BYTES >> 20} MB"
    return SourceError(f"the library has more than {limit}", location=Location(str(path)), fix="check that it is a library")


def _same(folder: Path, files: Files) -> bool:
    """Whether a folder holds these files."""
    if folder.is_symlink() or not folder.is_dir():
        return False
    try:
        return _of_folder(folder) == files
    except SourceError:
        return False


def _put(files: Files, folder: Path) -> None:
    """Write a library into its folder, in the place of what is there.

    Raises:
        SourceError: it cannot be written.
    """
    made = None
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        made = Path(mkdtemp(prefix=".installing-", dir=folder.parent))
        for name, data in files.items():
            path = made / "new" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)
        if os.path.lexists(folder):
            folder.rename(made / "old")
        (made / "new").rename(folder)
    except OSError as error:
        if made is not None and os.path.lexists(made / "old"):
            (made / "old").rename(folder)
        raise SourceError(
            f"the library cannot be written: {error.strerror}",
            location=Location(str(folder)),
            fix="check the folder and the disk",
        ) from error
    finally:
        if made is not None:
            shutil.rmtree(made, ignore_errors=True)
