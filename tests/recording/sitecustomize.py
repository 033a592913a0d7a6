"""Imported by every Python that a test starts: its writer's results are recorded too (`written_models` beside this file)."""

import importlib

importlib.import_module("written_models").start()
