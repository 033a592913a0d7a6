"""Model to model: the record of what was made from what.

A first part of the ETL mirror (its own issue completes it): the trace that rules write. Rules themselves are functions
in `robosmi.transformations.m2m`. Nothing here knows a metamodel but `trace`.
"""

from __future__ import annotations

from robosmi.transform.trace import TraceRecorder

__all__ = ["TraceRecorder"]
