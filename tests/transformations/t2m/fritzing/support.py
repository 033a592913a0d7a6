"""What the tests of the Fritzing reader and of the connector mapping share: where their files are."""

from __future__ import annotations

import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
FIXTURES = HERE / "fixtures"
LABELS = HERE / "labels"
ROOT = Path(__file__).resolve().parents[4]
SHARED = ROOT.parent / "shared" / "fritzing"
EXAMPLES = ROOT / "docs" / "examples"
CASES = {
    "line_following_robot": EXAMPLES / "line_follower" / "line_following_robot.fzz",
    "environmental_monitoring_robot": EXAMPLES / "environmental_monitoring" / "environmental_monitoring_robot.fzz",
}


def zipped(folder: Path, sketch: str, parts: tuple[str, ...] = ()) -> Path:
    """A .fzz of a fixture with definitions of parts, named as Fritzing does."""
    path = folder / f"{sketch}.fzz"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.write(FIXTURES / f"{sketch}.fz", f"{sketch}.fz")
        for part in parts:
            archive.write(FIXTURES / f"{part}.fzp", f"part.{part}.fzp")
    return path
