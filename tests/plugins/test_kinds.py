"""The kinds of content: each is documented, and a plug-in that breaks the contract of one is blamed with that contract."""

from __future__ import annotations

from typing import get_args

import pytest

from robosmi import plugins
from robosmi.errors import RuleError
from robosmi.plugin_contracts import KINDS, ContentKind, Contribution
from robosmi.plugins import Registry, load
from robosmi.verify import bench
from tests import plug_ins_page


def nothing(*arguments: object, **options: object) -> None:
    """A function that returns nothing, whatever it is given."""


def test_every_kind_has_one_class_and_one_name() -> None:
    assert sorted(KINDS) == sorted(get_args(ContentKind))
    assert set(KINDS.values()) == set(Contribution.__subclasses__())
    assert all(kind.kind == name for name, kind in KINDS.items())


@pytest.mark.parametrize("kind", KINDS.values(), ids=list(KINDS))
def test_a_kind_says_what_its_content_is(kind: type[Contribution]) -> None:
    assert all((kind.description, kind.returns, kind.names))
    assert kind.returns in kind.contract()
    assert kind.called in kind.contract()


def test_the_built_in_content_has_kinds_and_names_of_their_form() -> None:
    found = Registry()
    load(plugins.BUILT_IN)(found)
    assert set(found.entries) <= set(KINDS)
    metamodels = found.names("constraints")
    faults = [KINDS[kind].name_fault(name, metamodels) for kind, names in found.entries.items() for name in names]
    assert set(faults) == {None}


def test_the_page_of_plug_ins_lists_the_kinds_as_the_code_has_them() -> None:
    text = plug_ins_page.PAGE.read_text(encoding="utf-8")
    assert plug_ins_page.filled(text) == text, "make rules"
    assert all(f"| `{kind}` |" in text for kind in KINDS)


WITH_MEMBERS = [kind for kind in KINDS.values() if kind.members]


@pytest.mark.parametrize("kind", WITH_MEMBERS, ids=[kind.kind for kind in WITH_MEMBERS])
def test_a_result_without_a_member_that_is_used_is_a_fault_of_the_plug_in(kind: type[Contribution]) -> None:
    with pytest.raises(RuleError) as raised:
        kind(nothing, "mine", "lamps 1.2")()
    assert raised.value.message == f"the {kind.kind} 'mine' of the plug-in lamps 1.2 gives None, which has no '{kind.members[0]}'"
    assert raised.value.fix == f"report it to the authors of lamps: {kind.contract()}"
    assert raised.value.location is not None
    assert raised.value.location.path == __file__


def test_a_device_that_is_no_class_of_devices_is_a_fault_of_the_plug_in(monkeypatch: pytest.MonkeyPatch) -> None:
    offered, known = Registry(), Registry()
    offered.add("device", "lamp", f"{__name__}:nothing")
    known.take(offered, "lamps 1.2")
    for module in (plugins, bench):
        monkeypatch.setattr(module, "registry", lambda: known)
    with pytest.raises(RuleError, match="the device 'lamp' of the plug-in lamps") as raised:
        bench.device_class("lamp")
    assert raised.value.message.endswith(", not a subclass of Device")
    assert raised.value.fix == f"report it to the authors of lamps: {KINDS['device'].contract()}"
