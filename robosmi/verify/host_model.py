"""Host models, by which programs of a source platform run on this machine; data and C files of the platform repository.

A host model simulates the platform's time, cores and pins, and implements its libraries as documented. `original_build` builds
a program from it and the user's files, `original_run` runs the program. Comments in `host.toml` explain its entries. Models of
further libraries may be in `PLATFORM/host/include` and `PLATFORM/host/libraries` of every data folder (see
`robosmi.resources`); a file of the nearest folder hides those of the same name elsewhere.
"""

from __future__ import annotations

import shutil
from collections.abc import Mapping
from pathlib import Path

from msgspec import Struct

from robosmi import resources
from robosmi.base.data_tables import KIND, DataTable
from robosmi.errors import MissingToolError
from robosmi.verify.simulation import DeviceUse

TOOLS = ("command", "linker", "names", "rename", "coverage", "archiver", "places")
"""The programs that building takes, as `host.toml` names them."""


class HostModel(Struct, frozen=True):
    """A host model.

    Attributes:
        folder: where its `host.toml` lies; `chip` beside it holds the C files that simulate the chip.
        platform: the platform's name.
        title: what it is called in reports.
        headers: folders in which a program's headers are looked for after its own, the nearest first.
        libraries: the C files that do what the platform's libraries do, the nearest first.
        prefix: what the program and the libraries call `x` is linked as this prefix and `x`.
        clock_hz: ticks of the virtual time in a second.
        block_ticks, call_ticks: the nominal time of a basic block of the program, and of a call of a library's function.
        pins: labels of the pins, by number.
        channels: labels of the converter's channels, by number.
        compiler: the table `compiler`: programs and their flags.
        predefined: what the platform's own compiler defines: names of macros, and their text after `=`.
        undefined: macros that the platform's own compiler lacks and this machine's has.
        same: functions of the machine's C library that programs may use as they are.
        devices: what the board has at its pins and buses by itself.
        stores: the functions by which programs store bytes that the board keeps without power.
        store_pins: the board's own pins of that memory.
        store: the number of that memory among `devices`, or None.
        waves_have_edges: whether a wave at a pin with a device comes as changes of the pin, too.
    """

    folder: Path
    platform: str
    title: str
    headers: tuple[Path, ...]
    libraries: tuple[Path, ...]
    prefix: str
    clock_hz: int
    block_ticks: int
    call_ticks: int
    pins: tuple[str, ...]
    channels: tuple[str, ...]
    compiler: DataTable
    predefined: tuple[str, ...]
    undefined: tuple[str, ...]
    same: frozenset[str]
    devices: tuple[DeviceUse, ...]
    stores: frozenset[str] = frozenset()
    store_pins: frozenset[str] = frozenset()
    store: int | None = None
    waves_have_edges: bool = True

    @property
    def files(self) -> list[Path]:
        """The C files of the chip and of the libraries, and their headers."""
        inside = [path for path in self.folder.rglob("*") if path.suffix in (".c", ".h", ".toml")]
        return sorted({*inside, *self.libraries, *(path for folder in self.headers for path in folder.rglob("*.h"))})

    def sources(self, part: str) -> list[Path]:
        """The C files of a part: `chip` or `libraries`."""
        return list(self.libraries) if part == "libraries" else sorted((self.folder / part).glob("*.c"))

    def tools(self) -> Mapping[str, str]:
        """The programs that building takes: their role in `host.toml` -> their path.

        Raises:
            MissingToolError: one is not installed.
        """
        found = {role: shutil.which(self.compiler.text(role)) for role in TOOLS}
        missing = sorted(self.compiler.text(role) for role, path in found.items() if path is None)
        if missing:
            raise MissingToolError(f"not installed: {', '.join(missing)}", fix=self.install)
        return {role: path for role, path in found.items() if path is not None}

    @property
    def predefined_text(self) -> str:
        """A header with what the platform's own compiler defines, and without what it does not."""
        macros = (macro.partition("=") for macro in self.predefined)
        lines = [f"#undef {name}\n" for name in self.undefined]
        return "".join([*lines, *(f"#define {name} {text if sign else 1}\n" for name, sign, text in macros)])

    @property
    def install(self) -> str:
        """The instruction for installing what is missing."""
        return self.compiler.text("install")


def host_models(project: Path | None = None) -> list[str]:
    """The platforms that have a host model."""
    places = (path for folder in resources.folders(KIND, project) for path in folder.glob("*/host/host.toml"))
    return sorted({path.parents[1].name for path in places})


def load_host_model(platform: str, project: Path | None = None) -> HostModel:
    """The host model of a platform.

    Args:
        platform: its name, as its folder in the repository is called.
        project: the project folder (see `robosmi.resources`); the current folder if None.

    Raises:
        PlatformDataError: it has none, or its data is damaged.
    """
    path = resources.find(KIND, f"{platform}/host/host.toml", project)
    table = DataTable.read(path)
    places = [place for folder in resources.folders(KIND, project) if (place := folder / platform / "host").is_dir()]
    libraries: dict[str, Path] = {}
    for library in (file for place in places for file in sorted((place / "libraries").glob("*.c"))):
        libraries.setdefault(library.name, library.resolve())
    parser = DataTable.read(resources.find(KIND, f"{platform}/platform.toml", project)).table("parser")
    pin, channel = table.text("pin_label"), table.text("channel_label")
    devices, stores = table.tables("devices", needed=False), table.table("stores", needed=False)
    return HostModel(
        folder=path.parent,
        platform=platform,
        title=table.text("title"),
        headers=tuple((place / name).resolve() for place in places for name in table.texts("headers")),
        libraries=tuple(libraries.values()),
        prefix=table.text("own_names"),
        clock_hz=table.number("clock_hz"),
        block_ticks=table.number("block_ticks"),
        call_ticks=table.number("call_ticks"),
        pins=tuple(f"{pin}{number}" for number in range(table.number("pins"))),
        channels=tuple(f"{channel}{number}" for number in range(table.number("channels"))),
        compiler=table.table("compiler"),
        predefined=parser.texts("predefined", ()) + parser.texts("defines", ()),
        undefined=parser.texts("undefined", ()),
        same=frozenset(table.table("compiler").texts("same")),
        devices=tuple(_device(each) for each in devices),
        stores=frozenset(stores.texts("functions", ())),
        store_pins=frozenset(stores.texts("pins", ())),
        store=next((number for number, each in enumerate(devices) if each.values.get("stores")), None),
    )


def _device(entry: DataTable) -> DeviceUse:
    return DeviceUse(entry.text("kind"), {}, dict(entry.table("settings", needed=False).values))
