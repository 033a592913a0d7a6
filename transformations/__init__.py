"""The content: readers, transformations, generators and chains, one file each, found by the framework through `registry`.

No framework code lives here. What is offered is a table of names and `module:attribute` texts; nothing is imported
before it is asked for.
"""

from __future__ import annotations

from robosmi.plugins import Registry

_CONTENT = {
    ("program reader", "c_source"): "t2m.c_source:read_program",
    ("drawing reader", "fritzing"): "t2m.fritzing:read_circuit",
    ("ranker", "tfidf"): "m2m.library_ranking:tfidf_ranker",
    ("generator", "arduino_sketch"): "m2t.arduino_sketch:generate",
    ("chain", "analyse"): "chains.analyse:analyse",
    ("chain", "hardware"): "chains.hardware:hardware",
    ("chain", "recommend"): "chains.recommend:recommend",
    ("chain", "migrate"): "chains.migrate:migrate",
    ("chain", "plan"): "chains.migrate:plan_migration",
    ("chain", "generate"): "chains.generate:generate",
}


def registry(target: Registry) -> None:
    """Offer everything of this package (the value of its entry point)."""
    for (kind, name), place in _CONTENT.items():
        target.add(kind, name, f"robosmi.transformations.{place}")
