"""The page of rules is the one that the rules' data gives."""

from __future__ import annotations

from tests.rules_page import PAGE, filled


def test_the_page_of_rules_is_made_of_their_data() -> None:
    text = PAGE.read_text(encoding="utf-8")
    assert filled(text) == text, "run make rules"
