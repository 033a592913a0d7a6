"""The process in which an engine runs: reads a job from standard input, answers with a trace on standard output, both JSON.

It is started by `simulation.simulate`, which bounds its time and ends it with everything that it started; its processor time,
and that of each process that it starts, it bounds itself. An engine may be
of another licence than this package; it is loaded here and nowhere else.
"""

from __future__ import annotations

import gc
import sys
from typing import Any

from robosmi.base.data_text import as_number, as_table, json_of, json_written
from robosmi.errors import RobosmiError
from robosmi.plugins import content
from robosmi.verify.simulation import DeviceUse, Engine, Job, PinTrace
from robosmi.verify.toolchains.processor_time import bound_own


def answer(question: dict[str, Any]) -> dict[str, Any]:
    """The trace of a job, or the error that ended it.

    Args:
        question: `engine`, the engine's name, and `job`, the fields of a `Job`.
    """
    given = question["job"]
    job = Job(**{**given, "devices": tuple(DeviceUse(**use) for use in given["devices"])})
    engine: Engine = content("engine", question["engine"])()
    try:
        trace: PinTrace = engine.run(job)
    except RobosmiError as error:
        return {"error": type(error).__name__, "message": error.message, "fix": error.fix}
    return {
        "engine": trace.engine,
        "state": trace.state,
        "simulated_us": trace.simulated_us,
        "changes": trace.changes,
        "waves": trace.waves,
        "console": trace.console,
        "device_events": trace.device_events,
        "reached": trace.reached,
        "stack_bytes": trace.stack_bytes,
        "console_baud": trace.console_baud,
        "rests_until_us": trace.rests_until_us,
        "stored": trace.stored,
        "store_bytes": trace.store_bytes,
        "jumped": trace.jumped,
        "passed": trace.passed,
    }


if __name__ == "__main__":
    gc.disable()  # a run makes many small things, keeps them, and ends
    question = as_table(json_of(sys.stdin.read()))
    bound_own(as_number(question["limit_s"]))
    sys.stdout.write(json_written(answer(question)))  # `json.dump` to a file takes seven times as long
