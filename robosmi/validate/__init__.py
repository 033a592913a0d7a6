"""Constraints on models in the style of the Epsilon Validation Language (EVL), in Python.

`EVL` is a module of constraints: contexts by type, guards, constraints and critiques, messages, fixes, `satisfies`, pre and
post blocks. A run gives a `Validation`, with reports as text, JSON and findings. Constraints on concrete metamodels are content
and not here. docs/reference/evl.md compares this module with EVL.
"""

from __future__ import annotations

from robosmi.validate.constraint import Constraint, Context, Fail, Fix
from robosmi.validate.evl import EVL
from robosmi.validate.findings import ApplicableFix, Applied, Unsatisfied, Validation

__all__ = ["EVL", "ApplicableFix", "Applied", "Constraint", "Context", "Fail", "Fix", "Unsatisfied", "Validation"]
