"""Flows of port numbers: which constants, variables, parameters and calls of a program can exchange the number of a port.

A flow ends in the arguments that are pins for functions of the platform. Each flow tells whether its numbers may be changed
where they are written: not when something in it is printed, calculated with, compared, kept in a structure or in a table that
is filled at run time, comes from a function of the platform, is the end of a range, or is used in any other way that is not
followed here. Numbers of such a flow stay as they are: an assumption in the other direction could move a wrong wire. Names and
pins of ports are decided elsewhere.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.flow_reader import FlowReader
from robosmi.transformations.queries.made_pins import follow_made
from robosmi.transformations.queries.port_macros import follow_macros
from robosmi.transformations.queries.value_flows import Flow
from robosmi.transformations.queries.value_uses import ValueUses


def port_flows(views: Sequence[CodeView], sources: Mapping[str, bytes]) -> list[Flow]:
    """The flows of a program that reach a pin of a platform function, in text order of their first call.

    Args:
        views: a view of each unit.
        sources: path of a unit -> its bytes.
    """
    reader = FlowReader(views, sources)
    for view in views:
        reader.follow(view)
    uses = ValueUses(reader)
    for view in views:
        uses.follow(view)
    follow_macros(reader)
    follow_made(reader)
    found = [flow for flow in reader.flows.all() if flow.arguments]
    count = next((view.api.ports for view in views), 0)
    for flow in found:
        beyond = sorted({place.value for place in flow.places if place.value >= count})
        flow.kept += [f"{number} is no port of the source (0 to {count - 1})" for number in beyond]
        flow.places.sort(key=lambda p: (p.unit.path, p.start))
        flow.arguments.sort(key=lambda a: (a.unit.path, a.start))
    return sorted(found, key=lambda f: (f.arguments[0].unit.path, f.arguments[0].start))
