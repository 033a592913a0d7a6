"""Records every model that any test writes, so that real EMF can judge them all at the end of the run.

`start()` waits for the import of the writer (`robosmi.model.xmi.xmi_writer`) and wraps its one function; nothing is imported
before a test does so. What is written goes to the folder that `ROBOSMI_WRITTEN_MODELS` names, once for every content: the files
that were asked for, those that they refer to, and the metamodels. Programs that a test starts record through `sitecustomize`
beside this file; so nothing of the tests is imported here. `tests/written_models_judge.py` judges.
"""

from __future__ import annotations

import errno
import functools
import hashlib
import json
import os
import posixpath
import shutil
import sys
import tempfile
from collections.abc import Callable, Iterable, Mapping, Sequence
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec, PathFinder
from pathlib import Path
from types import ModuleType
from typing import Any
from urllib.parse import unquote

FOLDER = "ROBOSMI_WRITTEN_MODELS"
"""The environment variable that names the folder."""
WRITER = "robosmi.model.xmi.xmi_writer"

Write = Callable[..., dict[str, bytes]]


def start() -> None:
    """Record in this process from now on, if the environment says so."""
    if os.environ.get(FOLDER) and not any(isinstance(finder, _Finder) for finder in sys.meta_path):
        sys.meta_path.insert(0, _Finder())


class _Finder(MetaPathFinder):
    """Finds the writer's module as it is found otherwise; it is wrapped when it has been loaded."""

    def find_spec(self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None) -> ModuleSpec | None:
        found = PathFinder.find_spec(fullname, path, target) if fullname == WRITER else None
        if found is not None and found.loader is not None:
            found.loader = _Recording(found.loader)
        return found


class _Recording(Loader):
    def __init__(self, loader: Loader) -> None:
        self.loader = loader

    def create_module(self, spec: ModuleSpec) -> ModuleType | None:
        return self.loader.create_module(spec)

    def exec_module(self, module: ModuleType) -> None:
        self.loader.exec_module(module)
        module.__dict__["to_xmi"] = _recorded(module.__dict__["to_xmi"])


def _recorded(to_xmi: Write) -> Write:
    last: dict[str, tuple[Any, bytes]] = {}  # what was written last: name -> its roots, and the text

    @functools.wraps(to_xmi)
    def write(
        models: Mapping[str, Any],
        wanted: Iterable[str] | None = None,
        places: Any = None,
        schema_locations: Mapping[str, str] | None = None,
    ) -> dict[str, bytes]:
        names = None if wanted is None else list(wanted)
        written = to_xmi(models, names, places, schema_locations)
        folder = os.environ.get(FOLDER)
        if folder and os.path.isdir(folder):
            from robosmi.errors import ModelError

            known = {n: text for n, (roots, text) in last.items() if n not in written and roots is models.get(n)}
            last.clear()
            last.update((n, (models[n], text)) for n, text in {**known, **written}.items())
            try:
                _keep(Path(folder), to_xmi, models, written, known)
            except ModelError:  # a file beside it refers further than is known here
                pass
            except OSError as error:
                if error.errno not in (errno.EFBIG, errno.ENOSPC):  # a test of a full disk
                    raise
        return written

    return write


def _keep(folder: Path, to_xmi: Write, models: Mapping[str, Any], written: dict[str, bytes], known: dict[str, bytes]) -> None:
    """Put one result of the writer into the folder, unless it lies there already."""
    files = dict(written)
    while missing := (models.keys() - files.keys()) and (_referred(files) & (models.keys() - files.keys())):
        files |= {name: known[name] for name in missing & known.keys()}
        files |= to_xmi(models, missing - known.keys())
    if any(name.startswith("../") for name in files):  # it would lie outside of the folder
        return
    used = [root for name in files for root in _roots(models[name])]
    metamodels = _metamodels(to_xmi, used)
    info = {
        "models": sorted(written),
        "metamodels": _store(folder, "metamodels", metamodels).name,
        "names": list(metamodels),
        "elsewhere": _elsewhere(to_xmi, used),
    }
    place = _store(folder, "models", {**files, "written.json": json.dumps(info).encode()})
    with (place / "tests.txt").open("a", encoding="utf-8") as tests:
        tests.write(os.environ.get("PYTEST_CURRENT_TEST", "a program").rpartition(" (")[0] + "\n")


def _store(folder: Path, kind: str, files: Mapping[str, bytes]) -> Path:
    """Put files into a folder that is named by what they hold, in one step."""
    digest = hashlib.sha256()
    for name, text in files.items():
        digest.update(f"{name} {len(text)} ".encode() + text)
    place = folder / f"{kind}-{digest.hexdigest()}"
    if not place.is_dir():
        stage = Path(tempfile.mkdtemp(dir=folder, prefix="."))
        for name, text in files.items():
            (stage / name).parent.mkdir(parents=True, exist_ok=True)
            (stage / name).write_bytes(text)
        try:
            os.rename(stage, place)
        except OSError:  # another process was faster
            shutil.rmtree(stage)
    return place


def _referred(files: Mapping[str, bytes]) -> set[str]:
    """What stands before `#` in the texts of files, as a name like theirs; more than references, but no fewer."""
    found = set()
    for name, text in files.items():
        for piece in text.split(b"#")[:-1]:
            path = unquote(piece[max(piece.rfind(b'"'), piece.rfind(b" ")) + 1 :].decode())
            found.add(posixpath.normpath(posixpath.join(posixpath.dirname(name), path)))
    return found


def _roots(given: Any) -> list[Any]:
    """The root elements of a model; modules of generated packages as their packages."""
    from robosmi.model.elements.features import as_package

    return [as_package(r) if isinstance(r, ModuleType) else r for r in (given if isinstance(given, (list, tuple)) else [given])]


def _closed(packages: Iterable[Any]) -> dict[str, Any]:
    """Packages and all that they use, but for those that every EMF has, by namespace."""
    from robosmi.model.ecore.ecore_description import KNOWN

    pending = list(packages)
    found: dict[str, Any] = {}
    while pending:
        package = pending.pop()
        if package.nsURI and package.nsURI not in (*KNOWN, *found):
            found[package.nsURI] = package
            pending += _neighbours(package)
    return found


def _elsewhere(to_xmi: Write, roots: list[Any]) -> dict[str, str]:
    """The packages that metamodels among the roots refer to by namespace, since they are in none of the files."""
    from pyecore import ecore

    here = [root for root in roots if isinstance(root, ecore.EPackage)]
    others = {uri: package for uri, package in _closed(here).items() if package not in here}
    return {uri: to_xmi({"m.ecore": package})["m.ecore"].decode() for uri, package in others.items()}


def _metamodels(to_xmi: Write, roots: list[Any]) -> dict[str, bytes]:
    """The .ecore files that EMF needs to read models: file name -> text, in an order in which they can be read."""
    from pyecore import ecore

    from robosmi.model.elements.features import root_package
    from robosmi.model.elements.structure import walk

    elements = [root for root in roots if isinstance(root, ecore.EObject) and not isinstance(root, ecore.EPackage)]
    classes = {element.__class__: element.eClass for root in elements for element in walk(root)}
    found = _closed(root_package(eclass.ePackage) for eclass in classes.values() if eclass.ePackage is not None)
    own = {
        module.eClass: Path(module.__file__ or "").parents[1]
        for name, module in list(sys.modules.items())
        if name.startswith("robosmi.metamodels.") and name.count(".") == 2
    }
    files: dict[str, bytes] = {}
    for folder in {own[package] for package in found.values() if package in own}:
        files |= {path.name: path.read_bytes() for path in sorted(folder.glob("*.ecore"))}
    others = [found[uri] for uri in sorted(found) if found[uri] not in own]
    return files | to_xmi({f"{number}_{package.name}.ecore": package for number, package in enumerate(others)})


def _neighbours(package: Any) -> list[Any]:
    """The packages whose classifiers a package uses; one may be named more than once."""
    from pyecore import ecore

    from robosmi.model.elements.datatypes import is_data_type
    from robosmi.model.elements.features import declared_type, root_package, subpackages, supertypes

    used = []
    for one in (package, *subpackages(package)):
        for classifier in one.eClassifiers:
            if not is_data_type(classifier):
                used += [*supertypes(classifier), *map(declared_type, classifier.eStructuralFeatures)]
    used = [kind for kind in used if not isinstance(kind, ecore.EProxy)]  # to a file that the test does not have
    return [root_package(kind.ePackage) for kind in used if kind.ePackage is not None]
