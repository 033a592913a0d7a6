"""What RoboSMi leans on in pyecore holds in the version that is installed; other versions: `pyecore_contract.py`."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from tests.model.pyecore_contract import FACTS


@pytest.mark.parametrize("holds", FACTS, ids=lambda function: function.__name__)
def test_pyecore_is_as_the_model_room_needs_it(holds: Callable[[], None]) -> None:
    holds()
