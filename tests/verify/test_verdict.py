"""The verdict of scenarios together: what decides, what does not, and what is said of the source's lines."""

from __future__ import annotations

import pytest

from robosmi.verify.missed_lines import line_ranges
from robosmi.verify.original import LibraryCall
from robosmi.verify.scenario import Scenario
from robosmi.verify.traces.comparison import ChannelComparison, FirstDifference
from robosmi.verify.traces.verdict import CallsAround, ScenarioVerdict, Verdict

CRASH = FirstDifference(400.0, "program", "the migrated program crashes", None, None)


def told(verdict: str, *statuses: str, until_ms: float = 1000.0, crash: FirstDifference | None = None) -> ScenarioVerdict:
    """The verdict of a scenario of one second with these channels."""
    channels = tuple(ChannelComparison(f"c{number}", status) for number, status in enumerate(statuses))
    return ScenarioVerdict(Scenario("s", 1000.0, {}), verdict, channels, until_ms, crash=crash)


@pytest.mark.parametrize(
    ("scenarios", "verdict", "nothing"),
    [
        ([told("no-difference-found", "same", "not-exercised")], "no-difference-found", False),
        ([told("no-difference-found", "not-exercised"), told("no-difference-found", "same")], "no-difference-found", False),
        ([told("no-difference-found", "not-exercised", "not-exercised")], "not-decidable", True),
        ([told("no-difference-found")], "not-decidable", True),
        ([told("different", "not-exercised", crash=CRASH, until_ms=400.0)], "different", False),
        ([], "not-decidable", False),
    ],
)
def test_without_anything_compared_nothing_is_decided(scenarios: list[ScenarioVerdict], verdict: str, nothing: bool) -> None:
    found = Verdict(scenarios=scenarios)
    assert (found.verdict, found.nothing_compared) == (verdict, nothing)


def test_a_crash_is_the_first_difference_and_ends_what_is_said_of_channels() -> None:
    found = Verdict(scenarios=[told("different", "same", crash=CRASH, until_ms=400.0)])
    assert found.exit_code == 6
    assert found.first_difference == (found.scenarios[0], CRASH)
    assert [c["until_ms"] for c in found.channels()] == [400.0]
    assert any(line.startswith("  same") and line.endswith("compared until 400.0 ms") for line in found.lines())
    assert Verdict(scenarios=[told("no-difference-found", "same")]).channels()[0]["until_ms"] is None


def test_a_crash_where_the_stack_has_little_room_names_that() -> None:
    crashed = Verdict(
        scenarios=[told("different", "same", crash=CRASH, until_ms=400.0)], little_room="246 bytes are left [RS807]"
    )
    assert "    likely cause: the stack may have run out: 246 bytes are left [RS807]" in crashed.lines()
    assert crashed.to_json()["first_difference"]["likely_cause"].endswith("[RS807]")
    late = ChannelComparison("P5", "different", FirstDifference(100.0, "P5", "high is missing", None, None))
    other = Verdict(scenarios=[ScenarioVerdict(Scenario("s", 1000.0, {}), "different", (late,), 1000.0)], little_room="[RS807]")
    assert other.to_json()["first_difference"]["likely_cause"] is None


def test_lines_of_the_source_are_counted_only_where_a_scenario_counts() -> None:
    dropped = Verdict(reasons=["no scenario is left"], racy=3)
    for text in (dropped.sentence(), dropped.lines()[0]):
        assert "no source line counts as reached" in text
        assert "%" not in text
    counted = Verdict(scenarios=[told("no-difference-found", "same")], counted=1, lines_pct=50.0, branches_pct=25.0)
    assert "source lines 50.0 %, branches 25.0 %" in counted.sentence()


def test_stand_ins_for_libraries_are_said() -> None:
    found = Verdict(scenarios=[told("no-difference-found", "same")], stand_ins=["Servo"])
    said = "simulated with stand-ins for missing libraries: 'Servo'"
    assert found.to_json()["stand_ins"] == ["Servo"]
    assert said in found.sentence()
    assert f"  {said}" in found.lines()
    assert said not in Verdict(scenarios=[told("no-difference-found", "same")]).sentence()


def test_a_call_beside_a_difference_is_not_called_its_cause() -> None:
    late = FirstDifference(100.0, "P5", "high lasts 102 ms instead of 107 ms", None, None)
    channel = ChannelComparison("P5", "different", late)
    scenario = ScenarioVerdict(Scenario("s", 1000.0, {}), "different", (channel,), 1000.0)
    made, waits = LibraryCall(0.0, "high", "a.c", 5, False), LibraryCall(50.0, "print", "a.c", 7, True)
    for found in (
        Verdict(scenarios=[scenario], calls=CallsAround(made, (waits,))),
        Verdict(scenarios=[scenario], functions={"P5": ("high",)}),
    ):
        said = "\n".join(found.lines())
        assert "high" in said
        assert "made by" not in said
        assert "the trace does not show which" in said


def test_places_of_the_source_that_no_scenario_reaches_are_named() -> None:
    missed = [f"a.c:{line}" for line in range(1, 41, 3)]
    found = Verdict(
        scenarios=[told("no-difference-found", "same")], counted=1, lines_pct=61.5, branches_pct=50.0,
        missed_lines=["a.c:3", "a.c:5-9", "b.c:2"], missed_branches=["a.c:5", "a.c:12", "a.c:12"], untaken=["a.c:12", "a.c:12"],
        racy_branches=["a.c:20"],
    )  # fmt: skip
    for said in (found.sentence(), "\n".join(found.lines())):
        assert "lines not reached: a.c:3, 5-9; b.c:2" in said
        assert "branches not taken: a.c:12" in said
        assert "since the original is not repeatable there: a.c:20" in said
    assert found.to_json()["source_coverage"]["missed_lines"] == ["a.c:3", "a.c:5-9", "b.c:2"]
    many = Verdict(scenarios=found.scenarios, counted=1, missed_lines=missed)
    assert "a.c:1, 4, 7, 10, 13, 16, 19, 22, 25, 28, 31, 34 and 2 more (verify -v shows all)" in "\n".join(many.lines())
    assert "34, 37, 40" in "\n".join(many.lines(verbose=True))
    assert "not reached" not in "\n".join(Verdict(scenarios=found.scenarios, counted=1).lines())


def test_ranges_end_at_lines_with_code_that_are_reached() -> None:
    known = [("/x/a.c", line) for line in (1, 3, 4, 7, 9)] + [("/x/b.c", 2)]
    assert line_ranges({("/x/a.c", 3), ("/x/a.c", 4), ("/x/a.c", 7), ("/x/b.c", 2)}, known) == ["a.c:3-7", "b.c:2"]
    assert line_ranges({("/x/a.c", 9), ("/x/b.c", 2), ("/x/a.c", 1)}, known) == ["a.c:1", "a.c:9", "b.c:2"]


def test_a_channel_that_is_the_same_says_how_many_events_were_compared() -> None:
    lines = Verdict(scenarios=[told("no-difference-found", "same", "not-exercised")]).lines()
    assert "  same           c0 (0 events)" in lines
    assert "  not-exercised  c1" in lines


@pytest.mark.parametrize(
    ("outputs", "missed", "counted", "partial"),
    [
        ({"lamp": True, "wheel": True}, [], 1, False),
        ({"lamp": True, "wheel": False}, [], 1, True),
        ({"lamp": True}, ["a.c:3"], 1, True),
        ({"lamp": True}, [], 0, True),
    ],
)
def test_a_comparison_is_partial_unless_all_outputs_and_lines_were_compared(
    outputs: dict[str, bool], missed: list[str], counted: int, partial: bool
) -> None:
    found = Verdict(
        scenarios=[told("no-difference-found", "same")], outputs=outputs, missed_lines=missed, counted=counted, lines_pct=80.0
    )
    assert found.to_json()["partial"] is partial
    assert found.to_json()["compared"] == {"outputs": sum(outputs.values()), "of": len(outputs), "lines_pct": 80.0}
    assert found.lines()[0].startswith("PARTLY COMPARED") is partial
    assert found.sentence().startswith("partly compared") is partial
    assert found.exit_code == 0
    assert found.covers(80.0) is (counted > 0 and all(outputs.values()))
    assert not found.covers(80.5)
