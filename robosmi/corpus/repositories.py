"""Lays the files of a commit of a git repository on this machine out as a folder, once for all runs.

Nothing of the repository is run and nothing is fetched: git only reads objects. Links in a commit and files that no program could
use, because they are larger than a drawing may be, are left out.
"""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Iterable, Iterator
from pathlib import Path

from msgspec import Struct

from robosmi import inputs
from robosmi.errors import MissingToolError, SourceError
from robosmi.files.files import within, write_atomic
from robosmi.inputs import DRAWING

_LIMIT_S = 600.0
_SAFE = {"GIT_NO_LAZY_FETCH": "1", "GIT_ALLOW_PROTOCOL": "none", "GIT_TERMINAL_PROMPT": "0", "GIT_CONFIG_NOSYSTEM": "1",
         "GIT_OPTIONAL_LOCKS": "0", "LC_ALL": "C"}  # fmt: skip


class Checkout(Struct, frozen=True):
    """A commit as a folder.

    Attributes:
        folder: the folder.
        commit: the full id of the commit.
        missing: why there is none; None if there is.
    """

    folder: Path
    commit: str = ""
    missing: str | None = None


def checkout(repository: Path, revision: str, folder: Path) -> Checkout:
    """The files of a commit, in a folder of their own.

    Args:
        repository: a clone, or a bare repository.
        revision: a commit, branch or tag.
        folder: where commits are laid out.

    Raises:
        MissingToolError: git is not installed.
        SourceError: the files cannot be written.
    """
    if not repository.is_dir():
        return Checkout(repository, missing="there is no such repository")
    if revision.startswith("-"):
        return Checkout(repository, missing=f"'{revision}' is no revision")
    done = _git(repository, "rev-parse", "--verify", "--quiet", f"{revision}^{{commit}}")
    commit = done.stdout.decode().strip()
    if done.returncode or not commit:
        said = done.stderr.decode(errors="replace").strip().splitlines()
        return Checkout(repository, missing=f"it has no commit '{revision}'" if not said else f"git cannot read it: {said[0]}")
    name = hashlib.sha256(os.fsencode(repository.resolve())).hexdigest()[:12]
    made = folder / f"{repository.resolve().name.removesuffix('.git')}-{name}-{commit[:12]}"
    if made.is_dir():
        return Checkout(made, commit)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        part = Path(tempfile.mkdtemp(prefix=".part-", dir=folder))
        try:
            for path, data in _files(repository, commit):
                place = part / path
                place.parent.mkdir(parents=True, exist_ok=True)
                place.write_bytes(data)
            part.chmod(0o755)
            part.rename(made)
        finally:
            shutil.rmtree(part, ignore_errors=True)
    except _Damaged as error:
        return Checkout(repository, missing=f"git cannot read it: {error}")
    except OSError as error:
        raise SourceError(f"the files of {repository} cannot be laid out: {error.strerror}", fix="check the disk") from error
    return Checkout(made, commit)


_LAID = re.compile(r"-[0-9a-f]{12}-[0-9a-f]{12}")


def repository_of(folder: str) -> str:
    """What the names of all folders of a repository's commits begin with.

    Args:
        folder: a folder that `checkout` has made, or its name.
    """
    return os.path.basename(folder).rpartition("-")[0]


def name_commit(file: Path, before: str, after: str) -> None:
    """Let a text that names the folder of a commit name that of another one of the repository.

    Only the digests at the ends of the two names differ, and no format of a text escapes them.

    Args:
        file: the file with the text.
        before, after: the folders.
    """
    data = inputs.read_bytes(file, inputs.MODEL)
    old, new = (f"{_LAID.findall(os.path.basename(folder))[-1]}/".encode() for folder in (before, after))
    changed = data.replace(old, new)
    if changed != data:
        write_atomic(file, changed)


def remove_unused(folder: Path, used: Iterable[str]) -> None:
    """Remove the commits that no program is of any more.

    Args:
        folder: where commits are laid out.
        used: paths of programs.
    """
    inside = str(folder) + os.sep
    names = {path.removeprefix(inside).partition(os.sep)[0] for path in used if path.startswith(inside)}
    for laid in folder.iterdir() if folder.is_dir() else ():
        if laid.name not in names and _LAID.search(laid.name) and not laid.is_symlink():
            shutil.rmtree(laid, ignore_errors=True)


class _Damaged(Exception):
    """A repository lacks an object."""


def _files(repository: Path, commit: str) -> Iterator[tuple[str, bytes]]:
    """Path and content of each ordinary file of a commit."""
    tree = _git(repository, "ls-tree", "-r", "-z", "--long", commit)
    if tree.returncode:
        raise _Damaged(tree.stderr.decode(errors="replace").strip().partition("\n")[0])
    wanted: list[tuple[str, str, int]] = []
    for entry in tree.stdout.split(b"\0"):
        facts, _, name = entry.partition(b"\t")
        parts = facts.split()
        path = os.fsdecode(name)
        ordinary = len(parts) == 4 and parts[0] in (b"100644", b"100755") and parts[3].isdigit() and within(path)
        if ordinary and int(parts[3]) <= DRAWING.most:
            wanted.append((parts[2].decode(), path, int(parts[3])))
    for some in _batches(wanted):
        found = _git(repository, "cat-file", "--batch", given="".join(f"{digest}\n" for digest, _, _ in some).encode())
        data, place = found.stdout, 0
        for _, path, _ in some:
            head, _, _ = data[place : place + 200].partition(b"\n")
            told = head.split()
            if len(told) != 3 or not told[2].isdigit():
                raise _Damaged(f"the file {path} is missing")
            place += len(head) + 1
            size = int(told[2])
            yield path, data[place : place + size]
            place += size + 1


def _batches(wanted: list[tuple[str, str, int]]) -> Iterator[list[tuple[str, str, int]]]:
    """Files in groups that fit into memory together."""
    some: list[tuple[str, str, int]] = []
    for each in wanted:
        some.append(each)
        if len(some) == 256 or sum(size for _, _, size in some) > DRAWING.most:
            yield some
            some = []
    if some:
        yield some


def _git(repository: Path, *arguments: str, given: bytes = b"") -> subprocess.CompletedProcess[bytes]:
    """Run git on a repository, with nothing of it that would run or fetch something."""
    settings = ("safe.directory=*", "core.fsmonitor=false", "protocol.allow=never", "core.hooksPath=/dev/null")
    safe = [word for setting in settings for word in ("-c", setting)]
    environment = {key: value for key, value in os.environ.items() if not key.startswith("GIT_")}
    try:
        return subprocess.run(
            ["git", *safe, "-C", str(repository), *arguments], input=given, capture_output=True, timeout=_LIMIT_S, check=False,
            env={**environment, **_SAFE, "GIT_CEILING_DIRECTORIES": str(repository.resolve().parent)},
        )  # fmt: skip
    except FileNotFoundError as error:
        raise MissingToolError("git is not installed, and the specification names a repository", fix="install git") from error
    except subprocess.TimeoutExpired as error:
        raise SourceError(f"git takes longer than {_LIMIT_S:.0f} s on {repository}", fix="check the repository") from error
