"""A syntax error in a file of a checkout, of a plug-in, of an installed package: the file and line, and who can correct it."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest

import robosmi
from robosmi import plugins
from robosmi.cli.main import as_error
from robosmi.errors import MissingToolError, RobosmiError, RuleError
from robosmi.plugins import Registry

BROKEN = "x = 1\nif x\n    pass\n"


def raised(target: str, owner: str, monkeypatch: pytest.MonkeyPatch) -> RobosmiError:
    """The error that a command ends with when it asks for a driver that is registered so."""
    offered, known = Registry(), Registry()
    offered.add("driver", "lamp", target)
    known.take(offered, owner)
    filled = cache(lambda: known)
    filled()
    monkeypatch.setattr(plugins, "registry", filled)
    with pytest.raises((SyntaxError, RobosmiError)) as error:
        plugins.content("driver", "lamp")
    return as_error(error.value)


def test_in_a_file_of_a_checkout_it_is_to_be_corrected_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "my_rule.py").write_text(BROKEN)
    monkeypatch.setattr(robosmi, "__path__", [*robosmi.__path__, str(tmp_path)])
    error = raised("robosmi.my_rule:open_lamp", "", monkeypatch)
    assert isinstance(error, RuleError)
    assert error.location is not None
    assert (error.location.path, error.location.line) == (str(tmp_path / "my_rule.py"), 2)
    assert error.fix == "correct the line"


def test_in_an_installed_package_that_is_damaged_it_is_to_be_installed_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "site-packages"
    folder.mkdir()
    (folder / "my_rule.py").write_text(BROKEN)
    monkeypatch.setattr(robosmi, "__path__", [*robosmi.__path__, str(folder)])
    error = raised("robosmi.my_rule:open_lamp", "", monkeypatch)
    assert isinstance(error, MissingToolError)
    assert f"{folder / 'my_rule.py'}, line 2" in error.message


def test_in_a_plug_in_it_names_the_plug_in_and_the_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "lamps_of_mine.py").write_text(BROKEN)
    monkeypatch.syspath_prepend(tmp_path)
    error = raised("lamps_of_mine:open_lamp", "lamps 1.2", monkeypatch)
    assert isinstance(error, MissingToolError)
    assert error.location is not None
    assert (error.location.path, error.location.line) == (str(tmp_path / "lamps_of_mine.py"), 2)
    assert "the plug-in lamps 1.2" in error.message
    assert error.message.count("line 2") == 1
