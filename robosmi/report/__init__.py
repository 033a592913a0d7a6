"""The output of a command: the JSON document of the contract, and texts for a terminal.

`Report` collects result, findings, tasks, artifacts and timings of one command; `render` prints it. The only decision made here
is the exit code that follows from the findings.
"""

from __future__ import annotations

from robosmi.report.document import Report
from robosmi.report.terminal_text import takes_colour, terminal_text

__all__ = ["Report", "takes_colour", "terminal_text"]
