"""Elements that are made in one go equal those that pyecore's own setters make: values, containers, opposites, back links."""

from __future__ import annotations

import gc
import weakref
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from pyecore import ecore
from pyecore.notification import EObserver

import robosmi
from robosmi.errors import ModelError
from robosmi.metamodels import ccode, hardware
from robosmi.model.changes import Recording
from robosmi.model.ecore.metamodels import built_in
from robosmi.model.elements import compact_slots
from robosmi.model.elements.strict import FeatureValueError
from robosmi.model.emf import EmfModel
from robosmi.model.xmi.xmi_reader import read_documents
from robosmi.model.xmi.xmi_writer import to_xmi


def one_by_one(cls: Any, **features: Any) -> Any:
    """An element whose features are set one by one."""
    element = cls()
    for name, value in features.items():
        if isinstance(value, list):
            getattr(element, name).extend(value[:1])
            for one in value[1:]:
                getattr(element, name).append(one)
        else:
            setattr(element, name, value)
    return element


def slow(cls: Any, **features: Any) -> Any:
    """The same, by pyecore's setters and collections."""
    with Recording():
        return one_by_one(cls, **features)


def fast(cls: Any, **features: Any) -> Any:
    """An element that is made with its features."""
    return cls(**features)


def state(root: Any) -> list[tuple[Any, ...]]:
    """Everything that pyecore knows of the elements of a model, in a form that two models can be compared by."""
    elements = [root, *root.eAllContents()]
    names = {id(element): number for number, element in enumerate(elements)}

    def shown(value: Any) -> Any:
        if hasattr(value, "eClass") and id(value) in names:
            return names[id(value)]
        return value if isinstance(value, (str, int, float, bool, type(None))) else repr(value)

    result = []
    for element in elements:
        features = {}
        for feature in element.eClass.eAllStructuralFeatures():
            value = element.eGet(feature)
            features[feature.name] = [shown(v) for v in value] if feature.many else shown(value)
        container = element.eContainer()
        result.append(
            (
                type(element).__name__,
                features,
                shown(container),
                element.eContainmentFeature().name if container is not None else None,
                sorted(feature.name for feature in element._isset),
                sorted((names.get(id(owner), -1), feature.name) for owner, feature in element._inverse_rels),
                element.eResource,
            )
        )
    return result


def circuit(make: Any) -> Any:
    """A circuit with containments, opposites of both kinds and a reference between siblings."""
    pulse = make(hardware.Connector, name="pulse", connectorId="connector2")
    ground = make(hardware.Connector, name="gnd", connectorId="connector0")
    servo = make(
        hardware.Component,
        title="Servo",
        elementId="7",
        connectors=[pulse, ground],
        tags=["motor", "motor"],
        role=hardware.Role.Output,
    )
    net = make(hardware.Net, name="N1", connectors=[pulse])
    other = make(hardware.Net, name="N2")
    ground.net = other
    return make(hardware.Circuit, path="a.fz", components=[servo], nets=[net, other])


def program(make: Any) -> Any:
    """A program with calls, whose callee collects them."""
    function = make(ccode.Function, name="high", line=1)
    calls = [make(ccode.Call, calleeName="high", callee=function, line=n) for n in (4, 3)]
    statements = [make(ccode.ExpressionStatement, expression=call) for call in calls]
    main = make(ccode.Function, name="main", definition=True, body=make(ccode.Block, statements=statements))
    macro = make(ccode.Macro, name="ON", parameters=["a", "b", "a"])
    unit = make(ccode.SourceUnit, path="a.c", declarations=[function, main], macros=[macro])
    return make(ccode.Program, name="p", units=[unit])


@pytest.mark.parametrize("model", [circuit, program])
def test_one_go_equals_one_by_one(model: Any) -> None:
    assert state(model(fast)) == state(model(slow)) == state(model(one_by_one))


@pytest.mark.parametrize("make", [one_by_one, slow])
def test_what_a_model_of_its_own_has_is_no_quiet_element(make: Any) -> None:
    net = make(hardware.Net, name="N1")
    circuit = EmfModel(make(hardware.Circuit, path="a.fz", nets=[net]))
    circuit.touched()
    connector = make(hardware.Connector, connectorId="c1")
    connector.net = net
    assert circuit.touched()
    assert [list(net.connectors), connector.net] == [[connector], net]
    net.name = "N2"
    assert circuit.touched()
    circuit.roots[0].nets.append(make(hardware.Net, name="N3"))
    assert circuit.touched()
    assert len(circuit.all_of_kind("Net")) == 2


@pytest.mark.parametrize("make", [one_by_one, slow])
def test_a_listener_is_told_of_every_change(make: Any) -> None:
    block, seen = make(ccode.Block), list[Any]()
    observer: Any = type("Observer", (EObserver,), {"notifyChanged": lambda self, change: seen.append(change.feature.name)})
    observer(block)
    block.statements.append(make(ccode.ExpressionStatement))
    block.line = 3
    block.statements.extend([make(ccode.ExpressionStatement)])
    assert seen == ["statements", "line", "statements"]


@pytest.mark.parametrize("make", [one_by_one, slow])
def test_a_block_cannot_be_put_into_itself(make: Any) -> None:
    outer = make(ccode.Block)
    inner = make(ccode.Block)
    outer.statements.append(inner)
    with pytest.raises(ModelError, match="cannot be put into"):
        inner.statements.append(outer)
    assert (list(outer.statements), list(inner.statements), outer.eContainer()) == ([inner], [], None)


def test_many_new_objects_are_old_after_a_load_and_are_collected_all_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compact_slots, "_aged", 0)
    monkeypatch.setattr(compact_slots, "_none_frozen", True)
    monkeypatch.setattr(gc, "get_freeze_count", lambda: 0)  # of the tests' own objects

    class Circle(list[Any]):
        """An object that only the collector can remove."""

    with compact_slots.collector_at_rest():
        circles = [Circle() for _ in range(compact_slots._MANY + 1000)]
        for circle in circles:
            circle.append(circle)
    there, circles[:] = weakref.ref(circles[-1]), []
    del circle
    gc.collect(1)
    assert there() is not None, "it is old"
    monkeypatch.setattr(compact_slots, "_aged", 41 * compact_slots._MANY)
    with compact_slots.collector_at_rest():
        assert there() is not None
    with compact_slots.collector_at_rest(makes_models=True):
        assert there() is None
    assert gc.isenabled()
    gc.freeze()  # as tests are run


def test_frozen_objects_of_somebody_else_are_counted_once_and_stay_frozen(monkeypatch: pytest.MonkeyPatch) -> None:
    """Python counts them one by one, which takes longer than to load a small model."""
    counted: list[int] = []

    def frozen() -> int:
        counted.append(1)
        return 7

    monkeypatch.setattr(compact_slots, "_none_frozen", True)
    monkeypatch.setattr(gc, "get_freeze_count", frozen)
    monkeypatch.setattr(gc, "unfreeze", lambda: pytest.fail("they would thaw"))
    for many in (10, compact_slots._MANY, compact_slots._MANY):
        with compact_slots.collector_at_rest():
            made: list[list[int]] = [[] for _ in range(many + 1000)]
        assert len(made) > many
        del made
    assert counted == [1]


def test_the_order_of_collected_opposites_is_the_order_of_making() -> None:
    assert [call.line for call in program(fast).units[0].declarations[0].calls] == [4, 3]


@pytest.mark.parametrize("make", [fast, one_by_one, slow])
def test_an_element_that_lives_elsewhere_moves(make: Any) -> None:
    servo = make(hardware.Component, title="Servo", elementId="7")
    old = make(hardware.Circuit, components=[servo])
    new = make(hardware.Circuit, components=[servo])
    assert list(old.components) == []
    assert list(new.components) == [servo]
    assert servo.circuit is new
    assert servo.eContainer() is new


@pytest.mark.parametrize("make", [fast, slow])
def test_a_block_that_lives_elsewhere_moves(make: Any) -> None:
    block = make(ccode.Block)
    first = make(ccode.Function, name="a", body=block)
    second = make(ccode.Function, name="b", body=block)
    assert first.body is None
    assert second.body is block
    assert block.eContainer() is second


@pytest.mark.parametrize("make", [fast, slow])
def test_an_element_comes_into_a_collection_once(make: Any) -> None:
    pin = make(hardware.Connector, connectorId="c1")
    assert list(make(hardware.Component, elementId="1", connectors=[pin, pin]).connectors) == [pin]


@pytest.mark.parametrize("make", [fast, one_by_one, slow])
def test_a_deleted_element_is_gone_from_everywhere(make: Any) -> None:
    model = program(make)
    function, main = model.units[0].declarations
    calls = list(function.calls)
    function.delete()
    assert list(model.units[0].declarations) == [main]
    assert [call.callee for call in calls] == [None, None]
    assert b"callee=" not in to_xmi({"a.xmi": model})["a.xmi"]


@pytest.mark.parametrize("make", [fast, slow])
def test_a_deleted_caller_is_gone_from_its_function(make: Any) -> None:
    model = program(make)
    function = model.units[0].declarations[0]
    function.calls[0].delete()
    assert [call.line for call in function.calls] == [3]


def test_an_unset_reference_forgets_its_back_link() -> None:
    model = circuit(fast)
    pulse = model.components[0].connectors[0]
    pulse.net = None
    assert list(model.nets[0].connectors) == []


def parts(root: Any) -> Iterator[tuple[Any, dict[str, Any]]]:
    """Every element of a model, children first, with its attributes and children by feature name."""
    for child in root.eContents:
        yield from parts(child)
    own: dict[str, Any] = {}
    for feature in root.eClass.eAllStructuralFeatures():
        if root.eIsSet(feature) and not feature.derived and (feature.is_attribute or feature.containment):
            value = root.eGet(feature)
            own[feature.name] = list(value) if feature.many else value
    yield root, own


def test_a_whole_program_is_made_the_same_both_ways(examples: Path) -> None:
    original = robosmi.load_code(examples / "environmental_monitoring" / "environmental_monitoring.c")
    twins: list[Any] = []
    for make in (fast, one_by_one, slow):
        made: dict[int, Any] = {}
        for element, own in parts(original):
            features = {n: [made.get(id(v), v) for v in x] if isinstance(x, list) else made.get(id(x), x) for n, x in own.items()}
            made[id(element)] = make(type(element), **features)
        twins.append(made[id(original)])
    assert len(state(twins[0])) > 300
    assert state(twins[0]) == state(twins[1]) == state(twins[2])


def test_a_value_given_to_the_constructor_behaves_as_one_set_later() -> None:
    macro = ccode.Macro(name="ON", functionLike=True, line=3)
    assert (macro.name, macro.functionLike, macro.line, macro.column) == ("ON", True, 3, 0)
    assert [macro.eIsSet(name) for name in ("name", "line", "column")] == [True, True, False]
    seen: list[Any] = []
    observer: Any = type("Observer", (EObserver,), {"notifyChanged": lambda self, change: seen.append((change.old, change.new))})
    observer(macro)
    macro.name = "OFF"
    macro.line = 4
    assert seen == [("ON", "OFF"), (3, 4)]
    with pytest.raises(FeatureValueError, match="does not take"):
        macro.line = "five"  # type: ignore[assignment]
    assert (macro.name, macro.line) == ("OFF", 4)
    del_name: Any = macro
    del del_name.name
    assert del_name.name != "OFF"


def test_a_value_read_from_a_file_lies_bare_and_behaves_as_one_set_later(tmp_path: Path) -> None:
    file = tmp_path / "macro.xmi"
    file.write_bytes(to_xmi({file.name: ccode.Macro(name="ON", functionLike=True, line=3)})[file.name])
    (macro,) = read_documents(file, built_in())[file].roots
    assert isinstance(macro, ccode.Macro)
    assert [macro.__dict__[key] for key in ("name", "functionLike", "line")] == ["ON", True, 3]
    assert [macro.eIsSet(name) for name in ("name", "line", "column")] == [True, True, False]
    seen: list[Any] = []
    observer: Any = type("Observer", (EObserver,), {"notifyChanged": lambda self, change: seen.append((change.old, change.new))})
    observer(macro)
    with Recording() as recording:
        macro.name = "OFF"
        macro.line = 4
    assert seen == [("ON", "OFF"), (3, 4)]
    recording.undo()
    assert (macro.name, macro.line) == ("ON", 3)


def test_an_undone_change_gives_back_what_the_constructor_got() -> None:
    macro = ccode.Macro(name="ON")
    with Recording() as recording:
        macro.name = "OFF"
    recording.undo()
    assert macro.name == "ON"


def test_an_attribute_whose_values_lie_bare_is_an_attribute_of_ecore_all_the_same() -> None:
    ccode.Function(name="f")
    attribute = ccode.Function.eClass.findEStructuralFeature("name")
    assert attribute.eClass is ecore.EAttribute.eClass
    assert isinstance(attribute, ecore.EAttribute)
    assert not hasattr(compact_slots, "eClass"), "the module is no package"
