"""What is merely found and would run, runs only after `robosmi trust`; an output folder without a name is refused."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from robosmi import inputs, resources
from robosmi.base import trust
from robosmi.cli.commands.doctor import tools
from robosmi.cli.main import main
from robosmi.errors import SourceError
from robosmi.generate import Gen
from robosmi.generate.packages import generate_packages
from robosmi.verify.toolchains.toolchain_data import load_toolchains

TOOLCHAIN = "platform_repo/arduino/toolchain.toml"


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "project"
    (folder / ".robosmi" / "templates").mkdir(parents=True)
    (folder / ".robosmi" / "templates" / "own.j2").write_text("hello")
    monkeypatch.chdir(folder)
    return folder


@pytest.fixture
def programs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A stranger's folder whose toolchain starts a program that leaves a mark."""
    folder = tmp_path / "stranger"
    place = folder / ".robosmi" / TOOLCHAIN
    place.parent.mkdir(parents=True)
    program = folder / "evil"
    program.write_text(f"#!/bin/sh\ntouch {tmp_path}/mark\necho 1.2\n")
    program.chmod(0o755)
    text = (resources.built_in("platform_repo") / "arduino" / "toolchain.toml").read_text()
    place.write_text(text.replace('"avr-gcc"', f'"{program}"').replace('"avr-g++"', f'"{program}"'))
    (folder / "out" / "blink").mkdir(parents=True)
    (folder / "out" / "blink" / "blink.ino").write_text("void setup() {}\nvoid loop() {}\n")
    monkeypatch.chdir(folder)
    return folder


def test_a_template_whose_name_is_misspelt_is_told(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    place = project / ".robosmi" / "templates" / "arduino"
    place.mkdir()
    including = "{% include 'arduino/sketch.yam.j2' %}"
    for name, text in (("sketch.inoo.j2", "x"), ("sketch.yaml.j2", including), ("sketch.yam.j2", "x")):
        (place / name).write_text(text)
    assert main(["trust", str(project)]) == 0
    told = [line for line in capsys.readouterr().out.splitlines() if "matches no template" in line]
    assert told == ["templates/arduino/sketch.inoo.j2 matches no template (did you mean 'arduino/sketch.ino.j2'?)"]


def test_found_templates_run_only_while_they_are_as_they_were_trusted(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SourceError, match="not trusted") as refused:
        Gen(project / "out").text("own.j2")
    assert refused.value.exit_code == 3
    assert "robosmi trust" in (refused.value.fix or "")
    assert main(["trust", str(project), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["result"]["trusted"] == ["templates/own.j2"]
    assert Gen(project / "out").text("own.j2") == "hello"
    (project / ".robosmi" / "templates" / "more.j2").write_text("more")
    with pytest.raises(SourceError, match="changed since"):
        Gen(project / "out").text("own.j2")


def test_a_template_that_is_swapped_after_it_was_looked_at_does_not_run(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    trust.trust(project)
    monkeypatch.setattr(trust, "demand", lambda folder, kind: None)  # as if the file were changed right after that
    (project / ".robosmi" / "templates" / "own.j2").write_text("evil")
    with pytest.raises(SourceError, match="changed since"):
        Gen(project / "out").text("own.j2")
    (project / ".robosmi" / "templates" / "added.j2").write_text("evil")
    with pytest.raises(SourceError, match="changed since"):
        Gen(project / "out").text("added.j2")


def test_a_found_template_of_the_packages_is_not_run(project: Path, tmp_path: Path) -> None:
    own = project / ".robosmi" / "templates" / "metamodel"
    own.mkdir()
    (own / "package.py.j2").write_text("{{ cycler.__init__.__globals__.os.system('touch mark') }}")
    metamodel = next(resources.built_in("metamodels").glob("*.ecore"))
    with pytest.raises(SourceError, match="not trusted"):
        generate_packages([metamodel], tmp_path / "out")
    trust.trust(project)
    with pytest.raises(Exception, match="unsafe"):
        generate_packages([metamodel], tmp_path / "out")
    assert not (project / "mark").exists()


def test_a_template_folder_that_is_named_runs(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert Gen(project / "out", project / ".robosmi" / "templates").text("own.j2") == "hello"
    monkeypatch.setenv("ROBOSMI_PATH", str(project / ".robosmi"))
    assert Gen(project / "out").text("own.j2") == "hello"


def test_trust_moves_with_nothing_and_follows_no_link(project: Path, tmp_path: Path) -> None:
    trust.trust(project)
    shutil.copytree(project, tmp_path / "copy")
    with pytest.raises(SourceError, match="not trusted"):
        trust.demand(tmp_path / "copy" / ".robosmi", "templates")
    (project / ".robosmi" / "templates" / "link").symlink_to(tmp_path)
    assert main(["trust", str(project)]) == 3
    assert main(["trust", str(tmp_path)]) == 3


def test_a_damaged_note_trusts_nothing(project: Path) -> None:
    trust.trust(project)
    for note in (resources.user_data() / "trusted").iterdir():
        note.write_text("[]")
    with pytest.raises(SourceError, match="not trusted"):
        trust.demand(project / ".robosmi", "templates")


@pytest.mark.parametrize("others", [0o620, 0o602])
def test_a_note_that_another_user_could_have_written_trusts_nothing(others: int, project: Path) -> None:
    trust.trust(project)
    trust.demand(project / ".robosmi", "templates")
    for note in (resources.user_data() / "trusted").iterdir():
        note.chmod(others)
    with pytest.raises(SourceError, match="not trusted"):
        trust.demand(project / ".robosmi", "templates")


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() != 0, reason="only root can give files away")
def test_root_trusts_nothing_because_of_another_users_note(project: Path) -> None:
    trust.trust(project)
    for note in (resources.user_data() / "trusted").iterdir():
        os.chown(note, 65534, 65534)
    with pytest.raises(SourceError, match="not trusted"):
        trust.demand(project / ".robosmi", "templates")


def test_a_command_that_needs_found_templates_exits_with_3(project: Path, examples: Path, tmp_path: Path) -> None:
    source = examples / "line_follower" / "line_follower.c"
    assert main(["migrate", str(source), "-o", str(tmp_path / "out"), "--json"]) == 3
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    "words", [["compile", "out"], ["compile", "out", "--json"], ["doctor"], ["doctor", "--json"], ["targets"]]
)
def test_found_data_starts_no_program(
    words: list[str], programs: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(words) == 3
    assert "robosmi trust" in "".join(capsys.readouterr())
    assert not (tmp_path / "mark").exists()


@pytest.mark.processes
def test_trusted_data_starts_its_programs(programs: Path, tmp_path: Path) -> None:
    assert main(["trust", str(programs)]) == 0
    tools()
    assert (tmp_path / "mark").exists()


def test_data_that_is_swapped_or_added_while_it_is_read_starts_no_program(programs: Path) -> None:
    trust.trust(programs)
    place = programs / ".robosmi" / TOOLCHAIN
    added = programs / ".robosmi" / "platform_repo" / "arduino" / "boards" / "own.toml"
    added.parent.mkdir()
    with trust.acting():
        assert load_toolchains()
        place.write_text(f"# swapped\n{place.read_text()}")
        with pytest.raises(SourceError, match="changed since"):
            load_toolchains()
        added.write_text('extra_flags = ["-fplugin=./evil.so"]\n')
        with pytest.raises(SourceError, match="changed since"):
            inputs.read_text(added, inputs.SETTINGS)


def test_found_tables_that_start_nothing_are_read_without_being_asked_about(programs: Path, examples: Path) -> None:
    source = examples / "line_follower" / "line_follower.c"
    assert main(["migrate", str(source), "-o", "made"]) == 0


def test_python_m_takes_no_plug_in_from_the_current_folder(tmp_path: Path) -> None:
    (tmp_path / "evil-1.dist-info").mkdir()
    (tmp_path / "evil-1.dist-info" / "METADATA").write_text("Name: evil\nVersion: 1\n")
    (tmp_path / "evil-1.dist-info" / "entry_points.txt").write_text("[robosmi.transformations]\nevil = evil:fill\n")
    (tmp_path / "evil.py").write_text("open('mark', 'w')\ndef fill(registry): pass\n")
    environment = {**os.environ, "PYTHONSAFEPATH": ""}
    subprocess.run([sys.executable, "-m", "robosmi", "doctor"], cwd=tmp_path, env=environment, check=True, capture_output=True)
    assert not (tmp_path / "mark").exists()


@pytest.mark.parametrize("words", [["migrate", "a.c"], ["generate", "plan.xmi"], ["metamodels", "generate", "a.ecore"]])
def test_an_output_folder_without_a_name_is_refused(words: list[str], project: Path) -> None:
    assert main([*words, "-o", ""]) == 2


def test_templates_beside_the_program_run_only_when_trusted_wherever_the_command_is_run(
    line_follower: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    own = line_follower.parent / ".robosmi" / "templates" / "arduino" / "sketch.ino.j2"
    own.parent.mkdir(parents=True)
    built_in = resources.built_in("templates") / "arduino" / "sketch.ino.j2"
    own.write_text("// of the project\n" + built_in.read_text())
    words = ["migrate", str(line_follower), "-o", str(tmp_path / "out")]
    assert main(words) == 3
    assert f"robosmi trust {line_follower.parent}" in capsys.readouterr().err
    assert main(["trust", str(line_follower.parent)]) == 0
    assert main(words) == 0
    assert (tmp_path / "out" / "line_follower" / "line_follower.ino").read_text().startswith("// of the project\n")
