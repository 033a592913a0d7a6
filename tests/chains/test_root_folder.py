"""The root of the file system as output folder, however it is written: the look at it comes to an end."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from robosmi.generate.output_paths import Places
from tests.running import tree

LOOK = """import sys; from pathlib import Path; from robosmi.generate.output_paths import Places
print(Places(Path(sys.argv[1])).read(sys.argv[2]))"""


@pytest.mark.parametrize("folder", ["/", "//", "///", "/.", "//."])
@pytest.mark.parametrize("name", ["no-such-folder-of-robosmi/deep/a.txt", "no-such-file-of-robosmi"])
def test_a_file_below_the_root_is_looked_for(folder: str, name: str) -> None:
    found = subprocess.run([sys.executable, "-c", LOOK, folder, name], capture_output=True, text=True, timeout=60, check=False)
    assert (found.returncode, found.stdout) == (0, "None\n"), found.stderr


@pytest.mark.parametrize("folder", ["/", "//", "///no-such-folder-of-robosmi"])
def test_a_dry_run_below_the_root_comes_to_an_end(folder: str, line_follower: Path) -> None:
    before = tree(line_follower.parent)
    command = [sys.executable, "-m", "robosmi", "migrate", str(line_follower), "-o", folder, "--dry-run", "--json"]
    found = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    assert found.returncode == 0, found.stdout + found.stderr
    assert tree(line_follower.parent) == before


def test_a_file_in_the_way_of_a_folder_is_named(tmp_path: Path) -> None:
    (tmp_path / "a").write_text("x")
    with pytest.raises(Exception, match="a file is in the place of a folder"):
        Places(tmp_path).read("a/b/c.txt")
