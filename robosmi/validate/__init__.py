"""Constraints on models in the style of the Epsilon Validation Language (EVL), in Python.

`EVL` is a module of constraints: contexts by kind, guards, constraints and critiques, messages, fixes, `satisfies`, pre and
post. A run gives a `Validation`, with reports as text, JSON and findings. Constraints themselves are content.
docs/reference/evl.md sets EVL beside it.
"""

from __future__ import annotations

from robosmi.validate.constraint import Constraint, Context, Fail, Fix
from robosmi.validate.evl import EVL
from robosmi.validate.findings import Applied, OfferedFix, Unsatisfied, Validation

__all__ = ["EVL", "Applied", "Constraint", "Context", "Fail", "Fix", "OfferedFix", "Unsatisfied", "Validation"]
