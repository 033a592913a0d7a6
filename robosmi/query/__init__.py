"""Queries over models in the style of the Epsilon Object Language: `Q` and the extents.

A first part of the EOL mirror (its own issue completes it): the operations on collections that the application needs,
under EOL's names in snake case. Extents are in EMF's containment pre-order. Nothing here knows a metamodel.
"""

from __future__ import annotations

from robosmi.query.collections import Q
from robosmi.query.extents import all_contents, all_of_kind, all_of_type, ancestor_of_kind, root_of

__all__ = ["Q", "all_contents", "all_of_kind", "all_of_type", "ancestor_of_kind", "root_of"]
