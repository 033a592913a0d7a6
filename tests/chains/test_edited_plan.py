"""What of a stored plan is compared to tell choices from other edits."""

from __future__ import annotations

import pytest

from robosmi.transformations.chains.stages.edited_plan import digest_without_choices

PLAN = b'<plan><portBindings choice="%s" port="LED"/></plan>'


def test_choices_do_not_count() -> None:
    assert digest_without_choices(PLAN % b"D13") == digest_without_choices(PLAN % b"D12")
    assert digest_without_choices(PLAN % b"D13") != digest_without_choices(PLAN.replace(b"LED", b"EYE") % b"D13")


@pytest.mark.parametrize("damage", [b"<plan", b'<plan xmlns:ccode="true"/>'])
def test_what_has_no_canonical_form_has_no_digest(damage: bytes) -> None:
    """A namespace that is no absolute URI is well-formed XML, and Canonical XML refuses it."""
    assert digest_without_choices(damage) == ""
