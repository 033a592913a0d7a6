"""What readers of drawings share about connections: disjoint sets of connectors, buses inside parts, natural sort order.

This is a union-find and not a graph library, because importing one takes longer than reading a drawing; a test compares the
two. Each tool's reader decides which connectors a drawing joins, `t2m/drawing` what a net is for.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import lru_cache

from robosmi.transformations.knowledge.part import Part

Node = tuple[str, str]
"""(identity of a component, representative of the connectors that its part joins); a wire has no connector."""

Leaders = Mapping[str, Mapping[str, str]]
"""Part id -> connector that the part joins to others -> the representative of all of them."""

_DIGITS = "0123456789"
_NUMBER = re.compile(r"([0-9]{1,18})")  # int() refuses very long numbers


class Joined:
    """Disjoint sets of nodes (union-find with path compression)."""

    def __init__(self) -> None:
        self.parent: dict[Node, Node] = {}

    def __contains__(self, node: Node) -> bool:
        return node in self.parent

    def find(self, node: Node) -> Node:
        """The representative of the node's set; a new node is a set of its own."""
        parent = self.parent
        root = parent.setdefault(node, node)
        while parent[root] != root:
            root = parent[root]
        while parent[node] != root:
            parent[node], node = root, parent[node]
        return root

    def union(self, one: Node, other: Node) -> None:
        """Merge the sets of two nodes."""
        self.parent[self.find(one)] = self.find(other)


def bus_leaders(part: Part) -> dict[str, str]:
    """Connector that the part joins to others -> the representative of all of them."""
    joined = Joined()
    for members in part.buses.values():
        for member in members:  # a connector in two buses joins them
            joined.union((member, ""), (members[0], ""))
    leaders: dict[str, str] = {}
    for member, _ in list(joined.parent):
        leaders[member] = joined.find((member, ""))[0]
    return leaders


@lru_cache(maxsize=8192)
def natural(text: str) -> tuple[tuple[int, int, str], ...]:
    """A natural sort key, by which connector2 comes before connector10."""
    return tuple((0, int(piece), "") if piece[0] in _DIGITS else (1, 0, piece) for piece in _NUMBER.split(text) if piece)
