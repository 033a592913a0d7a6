"""Stands for the tool that uploads where a test wants to see what it is asked, or to hear what it says: put in its place on PATH.

It notes its arguments, one run a line (JSON), in `asked` beside itself; what it says is in `says`, one text for each run, as JSON
[[exit code, text], ...]; once these are used up it succeeds.
"""

import json
import sys
from pathlib import Path

here = Path(__file__).resolve().parent
if sys.argv[1:] == ["-v"]:
    print("avrdude: Version 7.1", file=sys.stderr)
    sys.exit(0)
with (here / "asked").open("a") as asked:
    asked.write(json.dumps(sys.argv[1:]) + "\n")
says = json.loads((here / "says").read_text()) if (here / "says").exists() else []
run = len((here / "asked").read_text().splitlines()) - 1
code, text = says[run] if run < len(says) else (0, "avrdude done.  Thank you.\n")
sys.stderr.write(text)
sys.exit(code)
