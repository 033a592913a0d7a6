"""Which adapter fills a call, and what is said where none does."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Unpack

import pytest

import robosmi
from robosmi.api import PlannedMigration, PlanOptions
from robosmi.errors import UsageError
from robosmi.metamodels import migration
from tests.tools import require_tools


def planned(folder: Path, text: str, **options: Unpack[PlanOptions]) -> PlannedMigration:
    """The plan of a program."""
    path = folder / "program.c"
    path.write_text(text)
    return robosmi.plan_migration([path], **options)


def uses(models: PlannedMigration) -> dict[str, migration.AdapterUse]:
    """The uses of functions, by name."""
    return {str(use.name): use for use in models.plan.adapterUses}


def test_a_use_refers_to_its_adapter_and_the_platform_model_holds_what_that_needs_and_no_more(tmp_path: Path) -> None:
    models = planned(tmp_path, '#include "ping.h"\nint main() { while (1) ping_cm(7); }\n')
    use = uses(models)["ping_cm"]
    assert use.adapter is not None
    assert (use.adapter.name, use.adapter.sourceHeader, use.adapter.source) == (
        "ping_cm",
        "ping.h",
        "adapters/propeller/ping.cpp",
    )
    assert [f.name for f in use.adapter.functions] == ["ping_cm"]
    assert [(p.name, p.capability.name, p.direction.name, p.componentRole) for p in use.adapter.pins] == [
        ("pin", "digital", "both", "ranger")
    ]
    assert models.plan.target is not None
    stored = [piece.name for piece in models.plan.target.adapters]
    assert stored.index("ping") < stored.index("ping_cm")
    assert "high" not in stored
    assert not any(task.rule == "RS501" for task in models.plan.tasks)


def test_names_of_a_header_have_adapters_in_the_header_that_includes_it(tmp_path: Path) -> None:
    """The counter is declared in propeller1.h, which programs get through propeller.h."""
    models = planned(tmp_path, "#include <propeller.h>\nint main() { while (1) waitcnt(CNT + CLKFREQ); }\n")
    headers = {use.name: use.adapter.sourceHeader for use in models.plan.symbolUses if use.adapter is not None}
    assert headers == {"CLKFREQ": "propeller.h", "CNT": "propeller.h"}
    assert uses(models)["waitcnt"].status is migration.AdapterStatus.care
    assert not models.plan.tasks


def test_names_of_a_header_have_adapters_in_the_header_that_it_includes(tmp_path: Path) -> None:
    """What waits is declared in sys/unistd.h, which programs get through unistd.h."""
    models = planned(tmp_path, "#include <unistd.h>\nint main() { while (1) { sleep(1); usleep(50); } }\n")
    adapters = {name: use.adapter for name, use in uses(models).items()}
    assert {name: each and each.sourceHeader for name, each in adapters.items()} == {
        "sleep": "sys/unistd.h", "usleep": "sys/unistd.h",
    }  # fmt: skip


def test_a_function_of_the_same_name_in_another_header_is_another_function(tmp_path: Path) -> None:
    """drive_speed gives back something in abdrive360.h and nothing in abdrive.h."""
    for header in ("abdrive.h", "abdrive360.h"):
        models = planned(tmp_path, f'#include "{header}"\nint main() {{ while (1) drive_speed(1, 2); }}\n')
        adapter = uses(models)["drive_speed"].adapter
        assert adapter is not None
        assert adapter.sourceHeader == header


def test_a_header_that_the_target_cannot_serve_is_a_task_that_says_what_is_missing(tmp_path: Path) -> None:
    models = planned(tmp_path, '#include "badgetools.h"\nint main() { while (1) badge_setup(); }\n')
    use = uses(models)["badge_setup"]
    assert use.status is migration.AdapterStatus.unsupported
    assert use.reason
    (task,) = [task for task in models.plan.tasks if task.rule == "RS501"]
    assert use.reason in task.message
    assert models.plan.target is not None
    assert [(h.name, h.reason) for h in models.plan.target.unsupportedHeaders] == [("badgetools.h", use.reason)]


def test_a_function_that_no_adapter_can_serve_is_a_task_that_says_what_to_do(tmp_path: Path) -> None:
    text = "#include <propeller.h>\nextern int image[];\nint main() { cognew(image, 0); while (1) waitvid(1, 2); }\n"
    models = planned(tmp_path, text)
    found = uses(models)
    assert {name: found[name].status for name in ("cognew", "waitvid")} == dict.fromkeys(
        ("cognew", "waitvid"), migration.AdapterStatus.todo
    )
    assert "machine code of the Propeller" in found["cognew"].reason
    assert "video generator" in found["waitvid"].reason
    said = [task.message for task in models.plan.tasks if task.rule == "RS501"]
    assert [found[name].reason in message for name, message in zip(("cognew", "waitvid"), said, strict=True)] == [True, True]


def test_a_call_that_no_signature_takes_has_no_adapter(tmp_path: Path) -> None:
    models = planned(tmp_path, '#include "simpletools.h"\nint main() {\n  while (1) { high(3, 4); low(3); }\n}\n')
    assert uses(models)["high"].reason == "line 3 calls it with 2 arguments, but its adapter takes 1"
    assert uses(models)["high"].status is migration.AdapterStatus.todo
    assert uses(models)["low"].status is migration.AdapterStatus.filled


def test_of_two_adapters_that_need_one_interrupt_the_second_is_a_task(tmp_path: Path) -> None:
    text = '#include "simpletools.h"\n#include "servo.h"\n'
    text += "int main() { servo_angle(1, 900); while (1) pwm_start(2000); }\n"
    found = uses(planned(tmp_path, text))
    assert found["pwm_start"].adapter is not None
    assert found["servo_angle"].adapter is None
    assert "'pwm_start' both need the interrupt TIMER1_COMPA_vect" in found["servo_angle"].reason


def test_serial_lines_and_servos_with_feedback_share_the_interrupts_of_pins(tmp_path: Path) -> None:
    text = '#include "fdserial.h"\n#include "abdrive360.h"\n'
    text += "int main() { fdserial_open(1, 2, 0, 9600); while (1) drive_speed(1, 2); }\n"
    found = uses(planned(tmp_path, text))
    assert [found[name].reason for name in ("drive_speed", "fdserial_open") if found[name].adapter is None] == []


def test_variants_are_chosen_for_the_microcontroller(tmp_path: Path) -> None:
    text = '#include "servo360.h"\nint main() { servo360_connect(1, 2); while (1) servo360_speed(1, 3); }\n'
    texts = {}
    for target in ("uno", "leonardo"):
        models = planned(tmp_path, text, target=target)
        assert models.plan.target is not None
        texts[target] = next(p for p in models.plan.target.adapters if "PCINT0_vect" in p.vectors)
    assert [*texts["uno"].vectors] == ["PCINT0_vect", "PCINT1_vect", "PCINT2_vect"]
    assert ([*texts["leonardo"].vectors], [*texts["leonardo"].mcus]) == (["PCINT0_vect"], ["atmega32u4"])


def test_standard_functions_that_do_otherwise_on_the_target_are_adapted(tmp_path: Path) -> None:
    text = '#include <stdio.h>\n#include <stdlib.h>\nint main() { while (1) printf("%f", 1.5 * abs(-1)); }\n'
    found = uses(planned(tmp_path, text))
    assert [*found] == ["printf"]
    assert found["printf"].targetName == "c_printf"
    assert uses(planned(tmp_path, text, adapters="placeholders")) == {}


def test_placeholders_have_no_bodies_but_constants_have_their_values(tmp_path: Path) -> None:
    text = '#include "simpletools.h"\nint main() { while (1) print("%c%d", HOME, CNT); }\n'
    models = planned(tmp_path, text, adapters="placeholders")
    assert uses(models)["print"].adapter is None
    assert {s.name: s.adapter is not None for s in models.plan.symbolUses} == {"CNT": False, "HOME": True}


def test_adapters_are_filled_or_placeholders(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="adapters cannot be 'empty'"):
        planned(tmp_path, "int main() { }\n", adapters="empty")


def test_a_function_that_the_program_declares_itself_is_declared_with_its_adapter_only(tmp_path: Path) -> None:
    """The program's own `void freqout(int, int, int)` would be another function beside the adapter's, which takes 32 bits."""
    text = "int ping_cm(int pin);  // centimetres\nextern void freqout(int, int ms, int);\nint main() {\n"
    (tmp_path / "program.c").write_text(f"{text}  int ping_cm(int);\n  while (1) freqout(4, ping_cm(7), 440);\n}}\n")
    made = robosmi.migrate([tmp_path / "program.c"], tmp_path / "out")
    sketch = (tmp_path / "out" / "program" / "program.ino").read_text()
    assert "ping_cm(int" not in sketch
    assert "freqout(int" not in sketch
    assert "// centimetres" in sketch
    assert all(use.adapter is not None for use in made.models.plan.adapterUses)
    declared = [d for d in made.models.plan.dispositions if "adapter-declared" in d.rules]
    assert [(d.element.line, d.action.name) for d in declared if d.element] == [(1, "drop"), (2, "drop"), (4, "drop")]


def test_a_function_that_the_program_declares_otherwise_is_not_the_platforms(tmp_path: Path) -> None:
    use = uses(planned(tmp_path, "void ping_cm(char *text);\nint main() { while (1) ping_cm(0); }\n"))["ping_cm"]
    assert use.adapter is None
    assert use.reason == "the program declares it as 'void ping_cm(char *text)', but its adapter is for 'int ping_cm(int pin)'"


NAMES = """#include "simpletools.h"
#include "abdrive.h"
#define servo_places 3
int left_servo = servo_places;
struct Io { int wheels; };
void drive_frame(int ms) { left_servo = ms; }
int main() {
  struct Io Wheel = {1};
  while (1) {
    drive_frame(Wheel.wheels);
    drive_speed(left_servo, 0);
  }
}
"""


def test_names_of_the_program_give_way_to_those_that_adapters_declare(tmp_path: Path) -> None:
    """A function of the same types would be defined twice, one of others would be an overload that adapters call."""
    require_tools("avr-gcc", "arduino-core-avr")
    (tmp_path / "program.c").write_text(NAMES)
    robosmi.migrate([tmp_path / "program.c"], tmp_path / "out")
    sketch = (tmp_path / "out" / "program" / "program.ino").read_text()
    for name in ("servo_places", "left_servo", "Io", "drive_frame"):
        assert not re.search(rf"\b{name}\b", sketch), name
        assert f"{name}_" in sketch
    assert "drive_speed(left_servo_, 0);" in sketch
    report = robosmi.compile_sketch(tmp_path / "out")
    assert [d.message for d in report.diagnostics if d.severity.name != "info"] == []


def test_an_adapter_is_handed_on_where_the_program_has_its_widths(tmp_path: Path) -> None:
    require_tools("avr-gcc", "arduino-core-avr")
    text = '#include "simpletools.h"\nunsigned int (*ask)(int);\nint main() { ask = get_state; while (1) pause(ask(3)); }\n'
    kept = uses(planned(tmp_path, text, widths="keep"))["get_state"]
    assert (kept.adapter, kept.reason) == (None, "the program uses it as a value, but its adapter has other types")
    made = robosmi.migrate([tmp_path / "program.c"], tmp_path / "out")
    assert all(use.adapter is not None for use in made.models.plan.adapterUses)
    report = robosmi.compile_sketch(tmp_path / "out")
    assert [d.message for d in report.diagnostics if d.severity.name != "info"] == []


def test_no_local_hides_what_the_changed_text_calls(tmp_path: Path) -> None:
    text = '#include "simpletools.h"\nint shown(int port) { print("%d", port); return input(port); }\n'
    (tmp_path / "program.c").write_text(f"{text}int main() {{ while (1) pause(shown(7)); }}\n")
    robosmi.migrate([tmp_path / "program.c"], tmp_path / "out")
    sketch = (tmp_path / "out" / "program" / "program.ino").read_text()
    assert 'shown(int32_t port_) { print("%d", port_); return input(port(port_)); }' in sketch


@pytest.mark.parametrize(("widths", "filled"), [("fix", True), ("keep", False)])
def test_long_and_int_are_one_type_where_the_text_has_the_widths_of_the_source(tmp_path: Path, widths: str, filled: bool) -> None:
    declared = '#include "simpletools.h"\nlong int pulse_in(int pin, long state);\n'
    text = declared + 'int main() { while (1) print("%d", pulse_in(3, 1)); }\n'
    use = uses(planned(tmp_path, text, widths=widths))["pulse_in"]
    assert (use.adapter is not None) is filled


@pytest.mark.parametrize("use", ["clock() / CLOCKS_PER_SEC", "IN_SECONDS(clock())"])
def test_values_of_standard_headers_that_adapters_have_are_those_of_the_source(use: str, tmp_path: Path) -> None:
    text = "#include <time.h>\n#define IN_SECONDS(t) ((t) / CLOCKS_PER_SEC)\n"
    text += f"int main() {{ int seconds = 0; while (1) seconds = {use}; }}\n"
    (value,) = (symbol for symbol in planned(tmp_path, text).plan.symbolUses if symbol.name == "CLOCKS_PER_SEC")
    assert value.adapter is not None
    assert "80000000" in str(value.adapter.text)
