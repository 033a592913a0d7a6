"""What `sketch.yaml` (Arduino CLI) and `platformio.ini` (PlatformIO) say: board and libraries with their versions.

The libraries are those that something in the sketch uses, but for those that the board's core brings: one of the index would
go before the core's own, and may not compile there.
"""

from __future__ import annotations

from typing import Any

from robosmi.metamodels import migration
from robosmi.transformations.queries.plans.plan_adapters import emitted


def project(plan: migration.MigrationPlan) -> dict[str, Any]:
    """The board's core, the libraries that are used, and these with all that they depend on as the file lists them."""
    assert plan.board is not None
    assert plan.target is not None
    mapping = next((m for m in plan.target.boardMappings if m.board is plan.board), None)
    full_name = str(mapping.boardId) if mapping is not None else ""
    core = ":".join(full_name.split(":")[:2])  # arduino:avr of arduino:avr:uno
    own = str(mapping.coreVersion) if mapping is not None else ""
    version = own or (str(plan.target.coreVersion) if plan.target.coreName in ("", core) else "")
    versions = {library.name: library.version for library in plan.target.libraries}
    used = {str(name) for piece in emitted(plan) for name in piece.libraries}
    included = [c.chosen for c in plan.libraryChoices if c.chosen is not None and c.included]
    adapted = [library for library in plan.target.libraries if library.name in used]
    chosen = list({id(library): library for library in (*included, *adapted, *plan.ownLibraries)}.values())
    needed = dict.fromkeys(name for library in chosen for name in (library.name, *library.depends))
    names = [name for name in needed if name not in plan.target.coreLibraries]
    return {
        "board": full_name,
        "platform": core,
        "core": f"{core} ({version})" if version else core,
        "chosen": chosen,
        "libraries": [f"{name} ({versions[name]})" if versions.get(name) else name for name in names],
        "platformio": str(mapping.platformioId) if mapping is not None else "",
        "platformio_platform": str(mapping.platformioPlatform) if mapping is not None else "",
        "platformio_settings": [str(line) for line in mapping.platformioSettings] if mapping is not None else [],
        "index_url": str(mapping.coreIndex) if mapping is not None else "",
        "dependencies": [_dependency(str(name), str(versions.get(name) or "")) for name in names],
    }


def _dependency(name: str, version: str) -> str:
    """A library as an entry of PlatformIO's `lib_deps`: one line, in which ` ;` would begin a comment."""
    plain = " ".join(name.replace(" ;", ";").split())
    return f"{plain} @ {version}" if version else plain
