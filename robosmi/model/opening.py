"""Any model file by its ending: `open_model("x.xmi")`, `open_model("m.json")`, `open_model("a.csv")`, `open_model("robot.c")`.

Drivers of the framework are listed here; others are offered through the registry (`robosmi.plugins`) as kind "driver", under a
name, under each ending they take (`.c`), and under a slash with the name of the file that marks the folders they take: a function
of a path and a name that gives a `Model`. The registry's come first.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib.util import find_spec
from inspect import Parameter, signature
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from msgspec import Struct

from robosmi import inputs
from robosmi.diagnostics import Location
from robosmi.errors import RobosmiError, SourceError, UsageError, did_you_mean
from robosmi.model.elements.driver import Model
from robosmi.plugin_contracts import Contribution, wrong_result
from robosmi.plugins import content, load, registry

if TYPE_CHECKING:
    from robosmi.model.ecore.metamodel import Packages
    from robosmi.model.emf import EmfModel
    from robosmi.model.xmi.open_files import OpenFiles

V = TypeVar("V")
_DRIVERS = {
    "emf": "robosmi.model.opening:open_xmi",
    "xml": "robosmi.model.plain_xml:open_xml",
    "rows": "robosmi.model.table:open_rows",
}
_ENDINGS = {".xml": "xml", ".csv": "rows", ".tsv": "rows"}
_ENDINGS |= dict.fromkeys((".xmi", ".ecore", ".json", ".yaml", ".yml"), "emf")


_SCRIPT = "an Epsilon script, which is no model", "write it as rules in Python: docs/reference/epsilon.md"
_NO_MODELS = {
    **dict.fromkeys((".eol", ".etl", ".evl", ".egl", ".egx", ".ecl", ".eml", ".epl", ".mig", ".pinset"), _SCRIPT),
    ".emf": ("an Emfatic text, which is not read", "make an .ecore file of it with Eclipse, and give that"),
    ".flexmi": ("a Flexmi model, which is not read", "save it as XMI with Epsilon, and open that"),
}
"""Endings of files that are no models here -> what they are, and what to do."""


def drivers() -> list[str]:
    """The names of all drivers, sorted."""
    return sorted({*_DRIVERS, *(name for name in registry().names("driver") if not name.startswith((".", "/")))})


def endings() -> dict[str, str]:
    """The file endings that are known -> the `module:attribute` that opens such files."""
    offered = registry().entries.get("driver", {})
    own = {ending: _DRIVERS[name] for ending, name in _ENDINGS.items()}
    return own | {name: target for name, target in offered.items() if name.startswith(".")}


def open_model(path: str | Path, driver: str | None = None, name: str | None = None, **options: V) -> Model:
    """Open a model of any technology.

    Args:
        path: the file, or the folder with tables.
        driver: the driver's name; found by the file's ending, else by its first bytes, if None.
        name: what `M!Book` calls the model; the file's name without its ending if None.
        options: what the driver takes besides, as `metamodel` for XMI.

    Raises:
        UsageError: there is no such driver.
        SourceError: no driver takes the file, or it cannot be read.
        ModelError: it contradicts its metamodel.
    """
    file = Path(path)
    return opened_by(driver_of(file, driver, "metamodel" in options), file, name, **options)


def open_xmi(
    path: Path,
    name: str | None = None,
    metamodel: Packages | str | Path | None = None,
    strict: bool = False,
    lenient: bool = True,
    open_files: OpenFiles | None = None,
    lazy: bool = False,
) -> EmfModel:
    """Open an XMI file; see `EmfModel.load`. If `lazy`, it is loaded when something needs more than its skeleton."""
    if lazy:
        from robosmi.model.lazy_model import open_lazily

        return open_lazily(path, name, metamodel, strict or not lenient, open_files)
    from robosmi.model.emf import EmfModel

    return EmfModel.load(path, metamodel, name, strict=strict, lenient=lenient, open_files=open_files)


def opened_by(opener: Callable[..., Model], file: Path, name: str | None, **options: V) -> Model:
    """The model of a file by its driver.

    Raises:
        UsageError: the driver does not take one of the options.
    """
    taken = signature(opener.driver.function if isinstance(opener, _OfPlugin) else opener).parameters
    known = [key for key, each in taken.items() if each.kind in (Parameter.POSITIONAL_OR_KEYWORD, Parameter.KEYWORD_ONLY)][2:]
    wrong = [key for key in options if key not in known]
    if wrong and not any(each.kind is Parameter.VAR_KEYWORD for each in taken.values()):
        public = [key for key in known if key != "open_files"]
        raise UsageError(
            f"the driver of '{file.name}' takes no option '{wrong[0]}'{did_you_mean(wrong[0], public)}",
            fix=f"omit it, or name another driver; this one takes {', '.join(public) or 'no options'}",
        )
    return opener(file, name, **options)


def driver_of(file: Path, driver: str | None = None, has_metamodel: bool = False) -> Callable[..., Model]:
    """What opens a file: by the driver's name, else by the file.

    Args:
        file: the file or folder.
        driver: the driver's name, or None.
        has_metamodel: whether a metamodel is given with it, so that XML which no plug-in takes is XMI.

    Raises:
        UsageError: there is no such driver.
        SourceError: no driver takes the file, or it cannot be read.
    """
    key = _key_of(file, driver)
    return _driver("emf" if has_metamodel and driver is None and key in ("xml", ".xml") else key)


def code_of_driver(file: Path, driver: str | None = None) -> list[Path]:
    """The Python files of the plug-in whose driver opens a file; none for a built-in driver, or where no driver takes the file.

    Args:
        file: the file or folder.
        driver: the driver's name; found by the file if None.
    """
    try:
        key = _key_of(file, driver)
    except (RobosmiError, OSError):  # reported when the file is opened
        return []
    if not registry().owner("driver", key):
        return []
    package = registry().entries["driver"][key].partition(":")[0].partition(".")[0]
    spec = find_spec(package)
    places = list(spec.submodule_search_locations or ()) if spec is not None else []
    found = [path for place in places for path in Path(place).rglob("*.py")]
    return sorted(found) or ([Path(spec.origin)] if spec is not None and spec.origin is not None else [])


def _key_of(file: Path, driver: str | None) -> str:
    """The name, ending or marking file under which the driver of a file is offered."""
    offered = registry().entries.get("driver", {})
    if driver is not None and (driver not in {*offered, *_DRIVERS} or driver.startswith((".", "/"))):
        raise UsageError(
            f"no driver is called '{driver}'{did_you_mean(driver, drivers())}", fix=f"use one of: {', '.join(drivers())}"
        )
    ending, known = file.suffix.lower(), endings()
    key = driver
    if driver is None and file.is_dir():
        key = next((key for key in offered if key.startswith("/") and (file / key[1:]).is_file()), "rows")
    elif driver is None:
        key = ending if ending in offered else _ENDINGS.get(ending) or _by_content(file)
    if key is None and (said := _NO_MODELS.get(ending)) is not None:
        raise SourceError(f"'{file.name}' is {said[0]}", location=Location(str(file)), fix=said[1])
    if key is None:
        raise SourceError(
            f"no driver takes a '{file.suffix or file.name}' file",
            location=Location(str(file)),
            fix=f"name a driver ({', '.join(drivers())}), or give one of: {', '.join(sorted(known))}",
        )
    return key


def _driver(key: str) -> Callable[..., Model]:
    """The driver of that name, ending or marking file; one of a plug-in is held to give a `Model`."""
    if key not in registry().entries.get("driver", {}):
        return load(_DRIVERS[key])  # type: ignore[no-any-return]
    offered = content("driver", key)
    return _OfPlugin(offered) if isinstance(offered, Contribution) else offered


class _OfPlugin(Struct, frozen=True):
    """A driver that a plug-in offers."""

    driver: Contribution

    def __call__(self, path: Path, name: str | None = None, **options: object) -> Model:
        """The model that it opens."""
        model = self.driver(path, name, **options)
        if not isinstance(model, Model):
            raise wrong_result(self.driver, model, "a Model", path)
        return model


_XMI = (b"http://www.omg.org/XMI", b"http://www.omg.org/spec/XMI/", b"http://schema.omg.org/spec/XMI/")


def _by_content(file: Path) -> str | None:
    from robosmi.files.files import read_input

    start = read_input(file, "model", inputs.MODEL)[:2000]
    if any(namespace in start for namespace in _XMI):
        return "emf"
    return "xml" if start.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"<") else None
