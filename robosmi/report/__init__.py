"""What a command says: the JSON document of the contract, and texts for a terminal.

`Report` collects result, findings, tasks, artifacts and timings of one command; `render` prints it. Nothing here
decides anything but the exit code that findings amount to.
"""

from __future__ import annotations

from robosmi.report.document import Report
from robosmi.report.terminal_text import takes_colour, terminal_text

__all__ = ["Report", "takes_colour", "terminal_text"]
