"""The chain `parts import`: folders of part definitions to a file of the catalogue."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from msgspec import Struct

from robosmi.diagnostics import Finding
from robosmi.plugins import content
from robosmi.transformations.knowledge.parts_store import FIRST_TOOL, write_parts


class PartsImport(Struct, frozen=True):
    """What an import did: the file, the contract's result, and what was left out."""

    path: Path
    result: dict[str, Any]
    findings: list[Finding]

    def lines(self) -> list[str]:
        """What the user reads."""
        roles = ", ".join(f"{role} {count}" for role, count in self.result["roles"].items())
        return [
            f"{self.result['added']} parts to {self.path} ({self.result['repeated']} duplicates)",
            f"  roles: {roles}",
            *(f"  unknown role: {title or part_id} ({part_id})" for part_id, title in self.result["unknown"][:10]),
        ]


def import_parts(folders: Sequence[Path], target: Path, tool: str = FIRST_TOOL) -> PartsImport:
    """Read part definitions, give each a role, and write them to a file that drawings are read with.

    Args:
        folders: folders with definitions, below them too; the first that has an id counts.
        target: the file to write; its folder is made.
        tool: the drawing tool in lower case, whose parts they are; the name of a registered `parts reader`.

    Raises:
        SourceError: a folder is not there or has no definition in it.
        UsageError: no reader takes that tool's parts.
        PlatformDataError: the rules for roles are damaged.
    """
    library = content("parts reader", tool)(folders)
    target.parent.mkdir(parents=True, exist_ok=True)
    write_parts(target, library.parts, tool)
    roles: dict[str, int] = {}
    for part, _ in library.parts:
        roles[part.role] = roles.get(part.role, 0) + 1
    result = {
        "added": len(library.parts),
        "repeated": library.repeated,
        "skipped": [{"path": f.location.path if f.location else "", "why": f.message} for f in library.findings],
        "written": [str(target)],
        "missing": [],
        "roles": dict(sorted(roles.items())),
        "unknown": [[part.id, part.title] for part, _ in library.parts if part.role == "Unknown"],
    }
    return PartsImport(target, result, library.findings)
