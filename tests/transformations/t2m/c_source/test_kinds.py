"""The numbers of libclang's kinds, by name, are those of its own Python package."""

from __future__ import annotations

from types import ModuleType
from typing import Any

import pytest
from clang.cindex import CursorKind, TypeKind

from robosmi.transformations.t2m.c_source import type_kinds
from robosmi.transformations.t2m.c_source.parsing import cursor_kinds


@pytest.mark.parametrize(("ours", "theirs"), [(cursor_kinds, CursorKind), (type_kinds, TypeKind)])
def test_the_kinds_are_those_of_libclang(ours: ModuleType, theirs: Any) -> None:
    found = {name: value for name, value in vars(ours).items() if name.isupper() and isinstance(value, int)}
    assert len(found) >= 15
    assert {name: getattr(theirs, name).value for name in found} == found
