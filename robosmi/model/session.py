"""`Session`: metamodels and models that belong together, in which an .ecore file is the same metamodel whoever asks for it.

    s = Session()
    old, new = s.open_model("old.xmi", metamodel="library.ecore"), s.open_model("new.xmi", metamodel="library.ecore")
    old.Book is new.Book                # elements may go from one to the other, and rules are about both

In EMF's words it is a resource set with its registry of packages: a reference from one file to another leads to the elements of
the model that is open, whichever of the two was opened first. `Metamodel.load` alone makes classes anew at each call, and
nothing is shared by the whole process. How a file finds its driver is `opening`'s business.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TypeVar

from robosmi import inputs
from robosmi.diagnostics import Location
from robosmi.errors import ModelError
from robosmi.files.files import read_input, write_atomic
from robosmi.model.ecore.ecore_classes import PackageMaker
from robosmi.model.ecore.ecore_loader import MetamodelReader
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.ecore.metamodel_files import means_ecore, metamodel_files
from robosmi.model.elements.driver import Model
from robosmi.model.emf import EmfModel
from robosmi.model.opening import driver_of, open_xmi, opened_by
from robosmi.model.xmi.open_files import Hook, OpenFiles
from robosmi.model.xmi.saved_places import back_up_comments, texts_of

V = TypeVar("V")
Paths = str | Path | Sequence[str | Path]


class Session:
    """Metamodels by their files, and models that were opened with them.

    Two files with one namespace and different content are two versions of a metamodel, as a migration needs them: each model has
    the one that it was opened with. A file that is opened a second time is read a second time, with all that it refers to;
    references of files that are opened later lead to the last model of it.

    Args:
        resolve: asked for the element of a reference that leads nowhere, by its URI, the file, and the file's root elements; it
            gives the element, or None for a proxy. It is asked again for a proxy whenever a further model is open.
        uris: beginnings of URIs -> the file or folder that they stand for (`{"pathmap://UML_LIBRARIES/": "libraries"}`).
    """

    def __init__(self, resolve: Hook | None = None, uris: Mapping[str, str | Path] | None = None) -> None:
        self._reader = MetamodelReader(stand_ins=True)
        self._maker = PackageMaker()
        self._digests: dict[Path, str] = {}
        self._files = OpenFiles(resolve, uris)
        self._models: list[Model] = []

    def __repr__(self) -> str:
        names = ", ".join(path.name for path in self._digests) or "no metamodels yet"
        return f"<Session of {names}>"

    def _repr_html_(self) -> str:
        from robosmi.model.elements.show import pairs_html  # for notebooks only

        return pairs_html({str(path): f"{digest[:12]}..." for path, digest in self._digests.items()}, ("metamodel", "SHA-256"))

    def metamodel(self, *paths: str | Path) -> Metamodel:
        """The metamodel of .ecore files, and of those that they refer to: made by the first call, the same in all others.

        Args:
            paths: the files, folders or patterns (`models/*.ecore`); their packages come first, in this order; `ecore` is Ecore.

        Raises:
            SourceError: a file cannot be read as XML.
            ModelError: it is no metamodel, or contradicts Ecore; or a file that was read before has changed since.
        """
        files = [path for path in paths if not means_ecore(path)]
        described = self._reader.read(metamodel_files(files), named=map(Path, files))
        for source in dict.fromkeys(package.source for package in described):
            digest = _digest(source)
            if self._digests.setdefault(source, digest) != digest:
                raise ModelError(
                    "the metamodel has changed since this session read it",
                    location=Location(str(source)), fix="open the models again in a new session",
                )  # fmt: skip
        own = Metamodel.ecore().packages if len(files) < len(paths) else []
        made = Metamodel([*self._maker.make(described), *own])
        made.refused = self._reader.refused
        return made

    def open_model(
        self,
        path: str | Path,
        driver: str | None = None,
        name: str | None = None,
        *,
        metamodel: Paths | Metamodel = (),
        **options: V,
    ) -> Model:
        """Open a model of any technology; see `open_model`.

        Args:
            path: the file, or the folder with tables.
            driver: the driver's name; found by the file if None.
            name: what `M!Book` calls the model; the file's name without its ending if None.
            metamodel: .ecore files, of XMI, or a `Metamodel`; the built-in metamodels and those of the open models if none.
            options: what the driver takes besides.

        Raises:
            SourceError, ModelError, UsageError: as `open_model` and `metamodel`.
        """
        more: dict[str, Metamodel | OpenFiles] = {}
        if isinstance(metamodel, Metamodel):
            more["metamodel"] = metamodel
        elif files := [metamodel] if isinstance(metamodel, (str, Path)) else list(metamodel):
            more["metamodel"] = self.metamodel(*files)
        driven = driver_of(Path(path), driver, bool(more))
        if driven is open_xmi:
            more["open_files"] = self._files
        model = opened_by(driven, Path(path), name, **options, **more)
        self._models.append(model)
        self._files.ask_again()
        return model

    @property
    def models(self) -> list[Model]:
        """The models that were opened, in this order; a hook finds in them what a reference leads to."""
        return list(self._models)

    def save_all(self) -> list[Path]:
        """Write all models of this session, each into its file: the open ones, and the files that were read with them.

        All are made before the first is written, so that an error leaves them as they are; a file that has its bytes already is
        left untouched. Of a file that was opened twice the last model is written.

        Returns:
            The files that were written.

        Raises:
            ModelError, SourceError: as `EmfModel.save`.
        """
        texts = texts_of(self._files)
        others = [model for model in self._models if not isinstance(model, EmfModel) and not model.read_only]
        before = {path: inputs.read_bytes(path, inputs.MODEL) for path in texts if path.is_file()}
        changed = {path: text for path, text in texts.items() if before.get(path) != text}
        for path, text in changed.items():
            back_up_comments(path, text)
            write_atomic(path, text)
        for model in self._models:
            if isinstance(model, EmfModel):
                model.others_are_saved()
        for model in others:
            model.save()
        return [*changed, *(model.path for model in others if model.path is not None)]

    def changed(self) -> Path | None:
        """An .ecore file that is no longer what this session read, or None."""
        return next((path for path, digest in self._digests.items() if not path.is_file() or _digest(path) != digest), None)


def _digest(path: Path) -> str:
    return hashlib.sha256(read_input(path, "metamodel", inputs.MODEL)).hexdigest()
