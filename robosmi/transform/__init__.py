"""Model to model: Epsilon's ETL and Flock in Python, and the trace of what was made from what.

`ETL` is a module of transformation rules, `Flock` a migration from one version of a metamodel to the next, `Trace` a trace that
can be searched in both directions and stored as a model. Rules themselves are content. docs/reference/etl.md and flock.md
compare them with the languages.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from robosmi.transform.etl import ETL
from robosmi.transform.rule import Rule
from robosmi.transform.trace import Link, Trace

if TYPE_CHECKING:
    from robosmi.transform.flock import Flock
    from robosmi.transform.migration import ModelMigration

__all__ = ["ETL", "Flock", "Link", "ModelMigration", "Rule", "Trace"]


def __getattr__(name: str) -> type[Flock | ModelMigration]:
    if name == "Flock":
        from robosmi.transform.flock import Flock  # few chains migrate models

        return Flock
    if name == "ModelMigration":
        from robosmi.transform.migration import ModelMigration

        return ModelMigration
    raise AttributeError(f"module 'robosmi.transform' has no attribute '{name}'")
