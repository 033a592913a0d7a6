"""The regression check over the small corpus: today's results are no worse than those that are kept."""

from __future__ import annotations

import pytest

from tests.corpus_runs import check


@pytest.mark.processes
def test_no_program_has_become_worse() -> None:
    assert check.check() == 0


@pytest.mark.processes
def test_a_worse_result_is_noticed(monkeypatch: pytest.MonkeyPatch, tmp_path_factory: pytest.TempPathFactory) -> None:
    better = tmp_path_factory.mktemp("expected")
    for path in check.EXPECTED.iterdir():
        text = path.read_text(encoding="utf-8")
        (better / path.name).write_text(text.replace("no_main.c,failed", "no_main.c,done"), encoding="utf-8")
    monkeypatch.setattr(check, "EXPECTED", better)
    assert check.check() == 1
