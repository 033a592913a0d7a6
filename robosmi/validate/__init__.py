"""Constraints on models and the findings they give.

A first part of the EVL mirror (its own issue completes it): a constraint has a context class, a guard, a check, a
message and advice; `check` runs a list of them over a model. Constraints themselves are content.
"""

from __future__ import annotations

from robosmi.validate.constraint import Constraint, check

__all__ = ["Constraint", "check"]
