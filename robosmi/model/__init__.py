"""Models: strict elements, metamodels, reading and writing XMI, atomic writing of files.

`load_model` and `save_model` are the simple functions for XMI, `open_model` opens models of any technology; `Metamodel`,
`EmfModel` and `Repository` are for working with models, `Model` is the interface that a driver implements. The other modules
each have one task and are imported when first used. Nothing here knows what the models are about.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from robosmi.model.ecore.metamodel import Metamodel
    from robosmi.model.elements.driver import Model
    from robosmi.model.elements.ecore import DynamicEObject, EObject
    from robosmi.model.emf import EmfModel
    from robosmi.model.opening import open_model
    from robosmi.model.repository import Repository
    from robosmi.model.session import Session
    from robosmi.model.xmi.xmi_layout import Root

__all__ = ["EmfModel", "Metamodel", "Model", "Repository", "Session", "load_model", "open_model", "save_model"]

_PLACES = {
    "EmfModel": "emf",
    "Metamodel": "ecore.metamodel",
    "Model": "elements.driver",
    "Repository": "repository",
    "Session": "session",
    "open_model": "opening",
}


def __getattr__(name: str) -> Any:
    if name in _PLACES:
        from importlib import import_module

        return getattr(import_module(f"robosmi.model.{_PLACES[name]}"), name)
    raise AttributeError(f"module 'robosmi.model' has no attribute '{name}'")


def load_model(path: str | Path) -> DynamicEObject:
    """Read an XMI or JSON file, with the files it refers to, and return its root; older versions of metamodels are migrated.

    Raises:
        SourceError: a file cannot be read as XMI.
        ModelError: it contradicts its metamodel.
    """
    from robosmi.model.ecore.metamodels import built_in
    from robosmi.model.versions import read_current

    return next(iter(read_current(Path(path), built_in()).values()))


def save_model(root: EObject, path: str | Path, others: Mapping[str, Root] | None = None) -> None:
    """Write a model as XMI, or as JSON or YAML by the file's name (`.json`, `.yaml`, `.yml`), atomically.

    Args:
        root: its root element.
        path: the file.
        others: models in the same folder that it refers to, file name -> root; they are not written.

    Raises:
        ModelError: a reference leads to none of these models.
    """
    from robosmi.files.files import write_atomic
    from robosmi.model.xmi.text_forms import is_json, is_yaml
    from robosmi.model.xmi.xmi_writer import roots_in, to_xmi

    target = Path(path)
    models = {target.name: root, **(others or {})}
    if is_json(target) or is_yaml(target):
        from robosmi.model.xmi.json_writer import to_json
        from robosmi.model.xmi.xmi_locations import XmiLocations
        from robosmi.model.xmi.yaml_writer import to_yaml

        every = {name: roots_in(given) for name, given in models.items()}
        write = to_yaml if is_yaml(target) else to_json
        write_atomic(target, write(target.name, every[target.name], XmiLocations(every)))
    else:
        write_atomic(target, to_xmi(models)[target.name])
