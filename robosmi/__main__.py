"""`python -m robosmi` is the command line."""

import sys

from robosmi.cli.main import main

if __name__ == "__main__":
    sys.exit(main())
