"""`python -m robosmi`, and the command `robosmi`: runs the command line, and handles interruptions even while it starts."""

import atexit
import gc
import os
import signal
import sys
import threading
from contextlib import suppress
from typing import NoReturn


def _current_folder_is_first() -> bool:
    """Whether Python searches the current folder first for modules, where a stranger could place some, unless it is our own."""
    try:
        here = os.getcwd()
        own = os.path.samefile(os.path.dirname(os.path.dirname(__file__)), here)
    except OSError:  # the current folder is gone
        return bool(sys.path) and sys.path[0] == ""
    return bool(sys.path) and sys.path[0] in ("", here) and not own


def _collect_less() -> None:
    """Look for garbage in circles less often: a command is over before it pays (a fifth of a migration).

    What models refer to in circles lives as long as the command, so Python's default of a look after every 700 new objects
    finds nothing, again and again. A migration of a small program makes fewer than 200,000 that stay.
    """
    gc.set_threshold(200_000, 20, 20)


def start() -> int:
    """Run the command of this process; an interruption at any time ends it with a short message and exit code 130."""
    _collect_less()  # before modules are imported
    try:
        from robosmi.cli.main import main

        code = main()
    except KeyboardInterrupt:  # while the program was loaded
        print("robosmi: interrupted", file=sys.stderr)
        code = 130
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # what was done is done; Python itself would end with a traceback
    return code


def command() -> NoReturn:
    """Run the command of this process and end it without freeing its models and modules one by one.

    The system reclaims all memory at once. If threads are running, or output cannot be written, Python ends the process as
    usual.
    """
    try:
        code = start()
    except SystemExit as error:  # of --help and --version
        code = int(error.code or 0)
    if threading.active_count() == 1:
        atexit._run_exitfuncs()
        with suppress(OSError, ValueError, AttributeError):  # AttributeError: the stream is None
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(code)
    sys.exit(code)


if __name__ == "__main__":
    if _current_folder_is_first():
        del sys.path[0]
    command()
