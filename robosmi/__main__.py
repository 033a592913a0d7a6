"""`python -m robosmi` is the command line."""

import os
import sys

# Python puts the current folder first, where a stranger's folder may offer plug-ins and modules. `robosmi` itself does not.
if sys.path and sys.path[0] in ("", os.getcwd()) and not os.path.samefile(os.path.dirname(os.path.dirname(__file__)), "."):
    del sys.path[0]

from robosmi.cli.main import main

if __name__ == "__main__":
    sys.exit(main())
