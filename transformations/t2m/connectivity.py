"""What readers of drawings share about connections: disjoint sets of connectors, what a part joins inside, order of names.

A union-find is used and not a graph library, because importing one takes longer than a whole reading; a test compares the
two. Which connectors a drawing joins is told by each tool's reader, what a net is for by `knowledge/rails`.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from robosmi.transformations.knowledge.part import Part
from robosmi.typed import remembered

Node = tuple[str, str]
"""Identity of a component, and the connector that stands for all that its part joins to it (empty for a wire)."""

Leaders = Mapping[str, Mapping[str, str]]
"""By part id, for each connector that a part joins to others the one that stands for all of them."""

_DIGITS = "0123456789"
_NUMBER = re.compile(r"([0-9]{1,18})")  # int() refuses very long numbers


class Joined:
    """Disjoint sets of nodes."""

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
        """Make the two nodes one."""
        self.parent[self.find(one)] = self.find(other)


def bus_leaders(part: Part) -> dict[str, str]:
    """For every connector that the part joins to others the one that stands for all of them."""
    joined = Joined()
    for members in part.buses.values():
        for member in members:  # a connector in two buses joins them
            joined.union((member, ""), (members[0], ""))
    leaders: dict[str, str] = {}
    for member, _ in list(joined.parent):
        leaders[member] = joined.find((member, ""))[0]
    return leaders


@remembered(8192)
def natural(text: str) -> tuple[tuple[int, int, str], ...]:
    """A sort key by which connector2 comes before connector10."""
    return tuple((0, int(piece), "") if piece[0] in _DIGITS else (1, 0, piece) for piece in _NUMBER.split(text) if piece)
