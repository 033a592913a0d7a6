"""`python -m robosmi` is the command line."""

import os
import sys


def _current_folder_is_first() -> bool:
    """Whether Python put the current folder first, where a stranger may offer plug-ins and modules, and it is not our own."""
    try:
        here = os.getcwd()
        own = os.path.samefile(os.path.dirname(os.path.dirname(__file__)), here)
    except OSError:  # the current folder is gone
        return bool(sys.path) and sys.path[0] == ""
    return bool(sys.path) and sys.path[0] in ("", here) and not own


if __name__ == "__main__":
    if _current_folder_is_first():
        del sys.path[0]
    from robosmi.cli.main import main

    sys.exit(main())
