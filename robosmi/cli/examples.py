"""An example of each command, as its `--help` shows it at the end."""

from __future__ import annotations

EXAMPLES = {
    "analyse": "robosmi analyse robot.c -I include --json",
    "hardware": "robosmi hardware robot.fzz --svg wiring.svg",
    "recommend": "robosmi recommend robot.fzz",
    "migrate": "robosmi migrate robot.c --hardware robot.fzz -o out --bind leftQTI=D10",
    "generate": "robosmi generate out/models/plan.xmi -o out",
    "choose": "robosmi choose out port:leftServo=D9",
    "open": "robosmi open out",
    "report": "robosmi report out -o report.html",
    "wiring": "robosmi wiring out --as csv -o wiring.csv",
    "undo": "robosmi undo out",
    "check": "robosmi check robot.fzz --fail-on warning",
    "compile": "robosmi compile out",
    "upload": "robosmi upload out --port /dev/ttyACM0",
    "simulate": "robosmi simulate out --seconds 10 -o trace.vcd",
    "verify": "robosmi verify out",
    "adapters": "robosmi adapters save out --as project",
    "history": "robosmi history export choices.csv",
    "libraries": "robosmi libraries import installed/libraries",
    "run": "robosmi run chain.toml --dry-run",
    "query": 'robosmi query out/models/plan.xmi "PortBinding.all.select(lambda b: b.open).name"',
    "parts": "robosmi parts import parts-folder",
    "platform": "robosmi platform import include --name mine",
    "metamodels": "robosmi metamodels generate library.ecore -o packages",
    "trust": "robosmi trust .",
    "mcp": "robosmi mcp --root my-robot",
    "explain": "robosmi explain RS311",
    "doctor": "robosmi doctor",
    "completion": "robosmi completion bash > ~/.local/share/bash-completion/completions/robosmi",
}
"""Command -> a command line of it."""
