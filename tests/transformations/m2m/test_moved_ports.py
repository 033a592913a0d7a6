"""Each port moves its own pin: programs are migrated, compiled and run on a simulator, and the pins that rise are counted.

A program says in its first lines how often each pin of the target has to rise (`// expect D9=1`), to which a port is bound
beyond those that the plan lists (`// bind P1=D8`), and what level is at a pin (`// level D2 [[0, 1]]`, milliseconds and level).
No port of the source has the number of the pin that it is bound to, so that a number that is not moved is seen.
"""

from __future__ import annotations

import json
import re
from itertools import pairwise
from pathlib import Path

import pytest

import robosmi
from robosmi.metamodels import migration
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.queries.plans.waiting_calls import CallStates
from robosmi.transformations.verification.jobs import job
from robosmi.verify.simulation import DeviceUse, simulate
from robosmi.verify.toolchains.toolchain import compile_sketch
from tests.tiers import sample
from tests.tools import require_engine, require_tools

PROGRAMS = sorted((Path(__file__).parent / "moved_ports").glob("*.c"))
CHOICES: tuple[dict[str, str], ...] = ({}, {"P3": "D9"}, {"P3": "D9", "P7": "D8"}, {"P3": "D9", "P7": "none"})
"""The listed port of a program is P3; what else its loop reaches only a run shows."""
PINS = {0: "D9", 1: "D8", 2: "D7", 3: "D6", 4: "D5", 5: "D4", 6: "D3", 7: "D2", 8: "D10", 10: "D12"}


def rises(levels: list[tuple[float, object]]) -> int:
    """The number of rising edges."""
    values = [0, *(level for _, level in levels)]
    return sum(after == 1 != before for before, after in pairwise(values))


def bound(plan: migration.MigrationPlan) -> dict[str, str]:
    """A pin for each port that a plan lists."""
    return {f"P{b.sourcePin}": PINS[b.sourcePin] for b in plan.portBindings if b.sourcePin in PINS}


def findings(plan: migration.MigrationPlan) -> list[str]:
    """The rules of a plan's findings about ports."""
    return [str(f.rule) for f in plan.findings if f.rule in ("RS326", "RS327", "RS328")]


@pytest.mark.processes
@pytest.mark.parametrize("program", sample(PROGRAMS, 9), ids=lambda path: path.stem)
def test_each_port_moves_its_own_pin(program: Path, tmp_path: Path) -> None:
    require_tools("avr-gcc", "avr-g++", "arduino-core-avr")
    require_engine("simavr")
    text = program.read_text()
    wanted = {pin: int(count) for pin, count in re.findall(r"\b([DA]\d+)=(\d+)", re.findall(r"// expect (.*)", text)[0])}
    devices = [
        DeviceUse("levels", {"pin": pin}, {"points": json.loads(points)})
        for pin, points in re.findall(r"// level (\S+) (.*)", text)
    ]
    said = bound(robosmi.plan_migration([program]).plan) | dict(re.findall(r"// bind (\S+)=(\S+)", text))
    made = robosmi.migrate([program], tmp_path / "out", bind=said)
    (tmp_path / "built").mkdir()
    report = compile_sketch(made.sketch, "uno", keep=tmp_path / "built")
    assert report.ok, report.diagnostics
    assert report.elf is not None
    assert report.hex is not None
    trace = simulate(job(report.elf, report.hex, load_board("uno"), 600_000, devices))
    pins = [f"D{n}" for n in range(14)] + [f"A{n}" for n in range(6)]
    assert {pin: count for pin in pins if (count := rises(list(trace.levels(pin))))} == wanted


@pytest.mark.parametrize(
    ("name", "rules"),
    [
        ("beyond_the_board", ["RS326"]),
        ("stepped_result", ["RS327"]),
        ("calculated_character", ["RS327"]),
        ("counting_while", []),
        ("recursion", []),
        ("named_table", []),
        ("list_in_macro", []),
        ("mask_of_members", []),
        ("pointer_through_table", []),
        ("platform_function_pointer", []),
        ("written_array", ["RS327"]),
        ("list_of_members", []),
        ("members_of_a_union", []),
    ],
)
def test_what_only_a_run_shows_is_told(name: str, rules: list[str]) -> None:
    plan = robosmi.plan_migration([path for path in PROGRAMS if path.stem == name]).plan
    assert sorted(set(findings(plan))) == rules


@pytest.mark.parametrize(
    ("text", "ports", "rules"),
    [
        ("struct R{int&p;}; int main(){int q=3; high(q); R r{q}; r.p=4; while(1) high(q);}", {3, 4}, []),
        ('void set(int&x,int v=5){x=v;} int main(){int q=3; set(q); print("%d",q); while(1) high(q);}', {3, 5}, ["RS327"]),
        ("struct L{int pin=3;}; int main(){L a,b; b.pin=4; while(1){high(a.pin); high(b.pin);}}", {3, 4}, []),
        ("struct L{int pin;}; void on(L l){high(l.pin);} int main(){L a{3}; on(a); while(1) on({4});}", {3, 4}, []),
        ("struct L{int pin;void on(){high(pin);}}; int main(){L a{3}; a.on(); while(1) L{4}.on();}", {3, 4}, []),
        ("struct L{int pin;}; int main(){L a{3}; high(a.pin); L*b=new L{4}; while(1) high(b->pin);}", {3, 4}, []),
        ("struct L{int pin;}; L made(){return{4};} int main(){L a{3}; high(a.pin); while(1) high(made().pin);}", {3, 4}, []),
        ("void (*f)(int)=high; int main(void){while(1){f(3); f=pause; f(5);}}", {3, 5}, ["RS327"]),
        ("void (*f)(int)=high; int main(){while(1){f(3); f=pause; f(5);}}", {3, 5}, ["RS327"]),
        ("void act(void(*f)(int),int p){f(p);} int main(){act(high,3); pause(5); while(1) act(&low,4);}", {3, 4}, []),
        ("struct L{int pin;L(int p):pin{p}{}void on(){high(pin);}}; int main(){L a{3}; while(1) a.on();}", {3}, []),
        ("struct L{int pin[2];L():pin{3,4}{}void on(){high(pin[1]);}}; L a; int main(){while(1) a.on();}", {3, 4}, []),
        ("int a[]={3,4}; int main(){while(1) for(int p:a) high(p);}", {3, 4}, []),
        ("int a[]={3,4}; int main(){for(auto&p:a) p++; while(1) for(int p:a) high(p);}", {3, 4}, ["RS327"]),
        ("int main(void){int p; for(p=3;p<6;p++) pause(1); while(1) high(p);}", {3, 4, 5, 6}, []),
        ("int main(void){int p=6; do p--; while(p>4); while(1) high(p);}", {4, 5, 6}, []),
        ("int main(void){int p=3; while(++p<6) pause(1); while(1) high(p);}", {3, 4, 5, 6}, []),
        ("int main(void){int p=3; for(;;){p++; if(p>=6) break;} while(1) high(p);}", {3, 4, 5, 6}, []),
        ("int main(void){int p=3; while(p<6){high(p); p++; high(p); p++; high(p);} while(1);}", {3, 4, 5, 6, 7}, []),
        ("int main(void){int p=3; a: p++; if(p<6) goto a; while(1) high(p);}", {3, 4, 5, 6}, []),
        ("int p=3; void on(void){high(p); p++;} int main(void){while(p<5) on(); while(1) low(p);}", {3, 4, 5}, []),
        ("int main(void){int p=3,n=6; while(n--){high(p); if(++p>5) p=3;} while(1);}", {3, 4, 5}, []),
        ("int main(void){int p=3,n=6; while(n--){if(p<5) pause(1); high(p); p++;} while(1);}", {3}, ["RS327"]),
        ("int main(void){int p=3,n=6; while(p<5||n>0){high(p); p++; n--;} while(1);}", {3}, ["RS327"]),
        ("void f(int p,int n){if(p==4) pause(1); high(p); if(n) f(p+1,n-1);} int main(void){f(3,5); while(1);}", {3}, ["RS327"]),
        ("int main(void){int e=getChar(),p=3; if(p<5) pause(1); while(p<e) high(p++); while(1);}", {3}, ["RS327"]),
        ("int main(void){int e=4,p=3; while(p<e){high(p); p++; if(e<6) e++;} while(1);}", {3, 4, 5}, []),
        ("int main(void){char p=254,n=6; while(n--){p++; if(p<9) high(p);} while(1);}", set(), ["RS327"]),
        ("struct s{char a,b;}; int main(){s x={3,4}; char*p=(char*)&x; while(1) high(p[1]);}", set(), ["RS327"]),
    ],
)  # fmt: skip
def test_each_number_that_gets_to_a_pin_is_a_port(text: str, ports: set[int], rules: list[str], tmp_path: Path) -> None:
    program = tmp_path / ("program.c" if "main(void)" in text else "program.cpp")
    program.write_text(f'#include "simpletools.h"\n{text}\n')
    plan = robosmi.plan_migration([program]).plan
    assert {int(each.sourcePin) for each in plan.portBindings} == ports
    assert sorted(set(findings(plan))) == rules


def test_a_bound_port_that_only_a_run_shows_is_told_as_info() -> None:
    program = next(path for path in PROGRAMS if path.stem == "stepped_result")
    plan = robosmi.plan_migration([program], bind={"P1": "D8"}).plan
    assert [(f.rule, f.severity.name) for f in plan.findings if f.rule == "RS327"] == [("RS327", "info")]


def test_calls_of_ports_that_only_a_run_shows_are_ready_only_when_the_user_binds_one_of_them(tmp_path: Path) -> None:
    program = tmp_path / "program.c"
    program.write_text('#include "simpletools.h"\nint main(void) { int p = 3, n = 4; while (n--) p += 1; while (1) high(p); }\n')
    waits = [CallStates(robosmi.plan_migration([program], bind=bind).plan).counts()["waits_for_port"] for bind in CHOICES]
    assert waits == [1, 1, 0, 0]


def test_a_pointer_to_functions_of_both_kinds_is_told(tmp_path: Path) -> None:
    program = tmp_path / "both.c"
    program.write_text(
        '#include "simpletools.h"\nvoid flash(int pin) { high(pin); low(pin); }\nvoid (*acts[2])(int) = { flash, high };\n'
        "int main() { for (int i = 0; i < 2; i++) acts[i](3); }\n"
    )
    plan = robosmi.plan_migration([program]).plan
    assert "RS328" in findings(plan)


def test_registers_that_are_put_back_change_only_what_is_put_in() -> None:
    program = next(path for path in PROGRAMS if path.stem == "register_table")
    plan = robosmi.plan_migration([program]).plan
    assert {b.sourcePin for b in plan.portBindings} == {0, 1, 2}


def test_a_call_through_a_pointer_is_named_by_what_holds_the_pointer(tmp_path: Path) -> None:
    program = tmp_path / "program.c"
    program.write_text(
        '#include "simpletools.h"\nstruct s { void (*go)(int); } t = {high}; void (*acts[])(int) = {high, low};\n'
        'int main() { int n; scan("%d", &n); while (1) { acts[1](n); t.go(n); } }\n'
    )
    (finding,) = [f for f in robosmi.plan_migration([program]).plan.findings if f.rule == "RS327"]
    assert "'acts', 'go'" in finding.message
