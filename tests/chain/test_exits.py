"""Code of a chain that ends the program is an error of its step, whatever exit code it names."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.running import run

CHAIN = '[[step]]\nload = "m"\nfile = "m.xml"\n\n[[step]]\ngenerate = "steps.py:work"\nmodels = "m"\nfolder = "out"\n'


@pytest.mark.parametrize("ending", ["raise SystemExit(0)", "import sys; sys.exit(7)", "raise SystemExit"])
@pytest.mark.parametrize("where", ["in the function", "at the import"])
def test_who_ends_the_program_fails_with_the_place(ending: str, where: str, tmp_path: Path) -> None:
    body = f"def work(gen, m):\n    {ending}\n" if where == "in the function" else f"def work(gen, m):\n    return 1\n{ending}\n"
    (tmp_path / "steps.py").write_text(body, encoding="utf-8")
    (tmp_path / "m.xml").write_text("<a/>", encoding="utf-8")
    (tmp_path / "chain.toml").write_text(CHAIN, encoding="utf-8")
    outcome = run("run", str(tmp_path / "chain.toml"), "--json")
    assert outcome.code == 3, outcome.err
    assert "SystemExit" in outcome.err
    assert f"steps.py:{2 if where == 'in the function' else 3}" in outcome.err


CUSTOM = "class Stop(BaseException): pass\ndef work(gen, m):\n    raise Stop('here')\n"
ENDLESS = "def again(x):\n    return again(x)\ndef work(gen, m):\n    return again(m)\n"


@pytest.mark.parametrize(
    ("code", "said", "line"),
    [(CUSTOM, "Stop: here", 3), (ENDLESS, "the function 'again' calls itself without end", 1)],
    ids=["no Exception", "no end"],
)
@pytest.mark.parametrize("where", ["a function", "a rule"])
def test_what_a_persons_code_raises_is_said_with_its_place(code: str, said: str, line: int, where: str, tmp_path: Path) -> None:
    """No traceback, and no word about the input, which is not to blame."""
    chain = CHAIN
    if where == "a rule":
        chain = CHAIN.replace(
            'generate = "steps.py:work"\nmodels = "m"\nfolder = "out"\n', 'validate = "steps.py:module"\nmodels = "m"\n'
        )
        code += "def module(v, m):\n    v.context('t_a').constraint(name='Known')(lambda a: work(None, a))\n"
    (tmp_path / "steps.py").write_text(code, encoding="utf-8")
    (tmp_path / "m.xml").write_text("<a/>", encoding="utf-8")
    (tmp_path / "chain.toml").write_text(chain, encoding="utf-8")
    outcome = run("run", str(tmp_path / "chain.toml"), "--json")
    assert outcome.code == 3, outcome.err
    assert said in outcome.err
    assert f"steps.py:{line}" in outcome.err
    assert "nested" not in outcome.err
