"""Functions of a program that take a format for the standard library, and so have its widths."""

from __future__ import annotations

import pytest

from robosmi.transformations.m2m.widths.width_formats import handing_on
from robosmi.transformations.queries.typed import TypedExpression


@pytest.mark.parametrize("form", ["function", "lambda"])
def test_a_function_with_a_deduced_result_passes_a_format_on_like_others(form: str) -> None:
    inner = TypedExpression("call", name="vsprintf", origin="standard")
    own = TypedExpression("call", name="vsprintf", origin="program")
    top = [TypedExpression(form, name="say", children=[inner]), TypedExpression(form, name="other", children=[own])]
    assert handing_on(top) == {"say"}
