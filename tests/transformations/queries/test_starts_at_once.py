"""How many coroutines run beside main at once: one restarted after its end counts once, one never reached does not count."""

from __future__ import annotations

from pathlib import Path

import pytest

import robosmi

HEAD = """#include "simpletools.h"
int *one, *two, level;
void work(void) { while (1) { toggle(3); pause(5); } }
"""
BODIES = {
    "ended before": ("one = cog_run(work, 64);", 1),
    "ended again and again": (
        "while (1) { if (level) { cog_end(one); one = cog_run(work, 64); } cog_end(one); one = cog_run(work, 64); }",
        1,
    ),
    "ended at one place only": ("one = cog_run(work, 64); if (level) { cog_end(one); one = cog_run(work, 64); }", 2),
    "another is ended": ("cog_end(two); one = cog_run(work, 64); cog_end(two); one = cog_run(work, 64);", 2),
    "ended on a way only": ("if (level) cog_end(one); one = cog_run(work, 64); cog_end(one); one = cog_run(work, 64);", 2),
    "started twice behind one end": ("cog_end(one); one = cog_run(work, 64); one = cog_run(work, 64);", 2),
    "kept and lost": ("cog_end(one); one = cog_run(work, 64); one = two; cog_end(one); one = cog_run(work, 64);", 2),
    "behind what never ends": ("one = cog_run(work, 64); stay(); two = cog_run(work, 64);", 1),
    "behind what may end": ("one = cog_run(work, 64); wait(); two = cog_run(work, 64);", 2),
}


@pytest.mark.parametrize("name", BODIES)
def test_what_runs_at_once(name: str, tmp_path: Path) -> None:
    body, wanted = BODIES[name]
    waits = "void stay(void) { while (1) pause(9); }\nvoid wait_(void) { while (1) { if (level > 3) break; pause(9); } }\n"
    source = tmp_path / "robot.c"
    source.write_text(f"{HEAD}{waits}int main(void) {{ {body.replace('wait()', 'wait_()')} }}\n")
    concurrency = robosmi.plan_migration([source]).plan.concurrency
    assert concurrency is not None
    assert concurrency.slots == wanted
