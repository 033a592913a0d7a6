"""Imported by every Python that a test starts: its writer's results are recorded, too, and it has the same mutant, if any."""

import importlib

for name in ("mutant", "written_models"):
    importlib.import_module(name).start()
