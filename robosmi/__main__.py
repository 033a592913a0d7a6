"""`python -m robosmi`, and the command `robosmi`: the command line, also where it is interrupted before it has begun."""

import os
import signal
import sys


def _current_folder_is_first() -> bool:
    """Whether Python put the current folder first, where a stranger may offer plug-ins and modules, and it is not our own."""
    try:
        here = os.getcwd()
        own = os.path.samefile(os.path.dirname(os.path.dirname(__file__)), here)
    except OSError:  # the current folder is gone
        return bool(sys.path) and sys.path[0] == ""
    return bool(sys.path) and sys.path[0] in ("", here) and not own


def start() -> int:
    """Run the command of this process; an interruption ends it with a word and exit code 130, whenever it comes."""
    try:
        from robosmi.cli.main import main

        code = main()
    except KeyboardInterrupt:  # while the program was loaded
        print("robosmi: interrupted", file=sys.stderr)
        code = 130
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # what was done is done; Python itself would end with a traceback
    return code


if __name__ == "__main__":
    if _current_folder_is_first():
        del sys.path[0]
    sys.exit(start())
