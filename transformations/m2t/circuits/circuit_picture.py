"""A circuit as a picture (SVG) that a user can compare with the robot.

Boards are in the middle with their pins where they are at the board, beside them is what is wired to them, then what is behind
that, each as the symbol of its kind; apart from them is what no signal connects to a board. Each connection of a signal net is a
line, each connector on a rail has a coloured tag with the net's name. Power symbols are no boxes: one table lists the rails that
they stand for. Beyond `MOST_LINES` lines the picture is by component: one line between two boxes stands for all their wires, and
each row names what it is wired to. Ports of the source are shown at the pins that they became. A wire and a pin bear `data-net`,
and `data-pin` and `data-port` where they lead to a pin of a board. This module decides what is drawn, `circuit_layout` arranges
it, the template writes it.

No two nets have the same name or colour. A rail has the name that the drawing gives to its net, else that of its supply; further
nets of that name get a number.

A finding is marked at a component, at pins of a board or at a net: by its element, by `model_index`, `pins` and `net` in its
evidence, or by its message: quoted titles and labels of pins. One without any of these is about the drawing as a whole.
"""

from __future__ import annotations

import colorsys
import re
from collections import Counter, deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from textwrap import wrap

from msgspec import Struct

from robosmi.base.quantities import quantity
from robosmi.diagnostics import Finding, Severity
from robosmi.generate import Gen
from robosmi.metamodels import hardware, migration
from robosmi.transformations.m2t.circuits.circuit_layout import (
    HEAD,
    Box,
    DrawnLink,
    DrawnMark,
    IdlePin,
    PartRow,
    Place,
    placed,
)
from robosmi.transformations.queries.circuits.circuit_walk import natural_key, pins_of
from robosmi.transformations.queries.circuits.connector_names import displayed_name
from robosmi.transformations.queries.circuits.drawn_symbols import outline_of, places_at, plain_name, symbol_of
from robosmi.transformations.queries.plans.plan import ports_by_pin
from robosmi.transformations.queries.plans.presumed_circuit import presumed_circuit

_FILLS = {
    "Board": "#cfe3f5", "Input": "#d9f0d3", "Output": "#fde3c8", "Both": "#e9dcf2", "Passive": "#eeeeee", "Power": "#f8d0d0",
    "Unknown": "#fff6b8",
}  # fmt: skip
_TOLD = ("resistance", "capacitance", "voltage", "color")
_LETTERS = 36
_ENDS = 2
_LOOSE = "#9aa5ad"
_ROW_LETTERS = 44
_MARK_LETTERS, _MARK_LINES = 52, 3
_FOOT_LETTERS = 110
_MARKS = 6
MOST_LINES = 20
"""Number of lines above which the lines between two boxes are merged into one."""


class Picture:
    """The contents of a picture: boxes with rows, links between rows or boxes, and lines of text below."""

    def __init__(self, title: str) -> None:
        self.title = title
        self.boxes: list[Box] = []
        self.links: list[DrawnLink] = []
        self.below: list[str] = []


def circuit_picture(
    circuit: hardware.Circuit,
    findings: Iterable[Finding] = (),
    ports: Mapping[str, Sequence[str]] | None = None,
    unwired: bool = False,
) -> Picture:
    """The contents of a circuit's picture, not arranged yet.

    Args:
        circuit: what to draw.
        findings: about it; each is marked at its component, pin or net.
        ports: label of a board's pin -> the ports of the source that it became.
        unwired: draw what no wire leads to, too, and do not only list it.
    """
    return _Drawing(circuit, marks(circuit, findings), ports or {}, unwired).picture()


def picture_svg(picture: Picture) -> str:
    """The picture as SVG."""
    width, height = placed(picture.boxes, picture.links, picture.below)
    lines = [(20, height - 14 - 16 * (len(picture.below) - 1 - number), line) for number, line in enumerate(picture.below)]
    symbols = sorted({box.symbol for box in picture.boxes if not box.is_board})
    what = {"title": picture.title, "boxes": picture.boxes, "links": picture.links, "below": lines, "symbols": symbols}
    what["about"] = _about(picture)
    return Gen().text("circuit/picture.svg.j2", width=width, height=height, **what)


def svg(
    circuit: hardware.Circuit,
    findings: Iterable[Finding] = (),
    ports: Mapping[str, Sequence[str]] | None = None,
    unwired: bool = False,
) -> str:
    """The picture of a circuit as SVG; see `circuit_picture`."""
    return picture_svg(circuit_picture(circuit, findings, ports, unwired))


def plan_svg(plan: migration.MigrationPlan, findings: Iterable[Finding] = ()) -> str:
    """The picture of a plan's circuit with the source's ports at their pins; without a drawing, that of what the program uses.

    Returns:
        The picture as SVG; empty where there is neither a drawing nor a port.
    """
    circuit = plan.circuit if plan.circuit is not None else presumed_circuit(plan)
    return svg(circuit, findings, ports_by_pin(plan), unwired=plan.circuit is None) if circuit is not None else ""


def _about(picture: Picture) -> str:
    wires = sum(link.wires for link in picture.links)
    parts = ", ".join(box.title for box in picture.boxes)
    return f"{parts}. {quantity(wires, 'signal wire')}; coloured tags tell the supply that a pin is on."


class _Drawing:
    """Builds the contents of one picture."""

    def __init__(self, circuit: hardware.Circuit, found: Marks, ports: Mapping[str, Sequence[str]], unwired: bool) -> None:
        self.circuit, self.marks, self.ports, self.unwired = circuit, found, ports, unwired
        self.result = Picture(_short(circuit.name, 80))
        self.rows: dict[hardware.Connector, Place] = {}
        self.rails = rail_names(net for net in circuit.nets if net.rail)
        self.colours = net_colours(circuit.nets, self.rails)
        self.reached = _pins_reached(circuit)

    def picture(self) -> Picture:
        loose: list[str] = []
        shown = [c for c in self.circuit.components if c.role is not hardware.Role.Decoration and not _only_joins(c)]
        symbols = [component for component in shown if self._only_names_a_rail(component)]
        shown = [component for component in shown if component not in symbols]
        far = _distances(shown)
        for component in sorted(shown, key=lambda c: (far[c], natural_key(c.elementId))):
            box = self._box(component, *far[component])
            if box.rows or self.unwired:
                self.result.boxes.append(box)
            else:
                loose.append(_name(component))
        self._link()
        for row in (row for box in self.result.boxes for row in box.rows if not row.partners and not row.tag):
            row.colour = _LOOSE
        if symbols:
            self._table_of_rails(symbols)
        if len(self.result.links) > MOST_LINES:
            self._bundle()
        if loose:
            self.result.below += wrap(f"not connected: {', '.join(loose)}", _FOOT_LETTERS)
        drawn = {id(component) for component in (*shown, *symbols)}
        whole = [*self.marks.whole, *(m for c, found in self.marks.components.items() if id(c) not in drawn for m in found)]
        for mark in dict.fromkeys(whole):
            self.result.below += wrap(f"{mark.rule}: {_short(mark.message, 3 * _FOOT_LETTERS)}", _FOOT_LETTERS)
        return self.result

    # ---- boxes

    def _only_names_a_rail(self, component: hardware.Component) -> bool:
        """Whether a component is a power symbol without findings of its own, so that the table of rails is enough."""
        if component.role is not hardware.Role.Power or len(component.connectors) != 1 or component in self.marks.components:
            return False
        net = component.connectors[0].net
        return net is not None and bool(net.rail)

    def _table_of_rails(self, symbols: Sequence[hardware.Component]) -> None:
        """Add a box that lists the rails with power symbols, and how many other connectors are on each."""
        named = Counter(id(component.connectors[0].net) for component in symbols)
        wrong = {id(c.net): self.marks.connectors[c] for s in symbols for c in s.connectors if c in self.marks.connectors}
        group = max((box.group for box in self.result.boxes), default=0) + 1
        box = Box(len(self.result.boxes), "Rails", f"drawn with {len(symbols)} symbols", _FILLS["Power"], 0, group)
        for net in sorted((n for n in self.circuit.nets if id(n) in named), key=lambda n: natural_key(self.rails[id(n)])):
            count = len(net.connectors) - named[id(net)]
            row = PartRow(len(box.rows), quantity(count, "connector"))
            row.tag, row.tag_colour = self.rails[id(net)], self.colours[id(net)]
            if (mark := wrong.get(id(net))) is not None:
                row.mark_colour, row.mark_text = mark.colour, f"{mark.rule}: {mark.message}"
            box.rows.append(row)
        self.result.boxes.append(box)

    def _box(self, component: hardware.Component, column: int, group: int) -> Box:
        role = component.role.name + (", driver" if component.driver else "")
        values = [p.value for p in component.properties if p.name in _TOLD and p.value]
        about = component.family if values and component.family else component.partTitle  # "220 Ω Resistor" may be one of 1k
        found = self.marks.components.get(component, [])
        lines = [DrawnMark(line, mark.message, mark.colour) for mark in found[:_MARKS] for line in _mark_lines(mark)]
        if len(found) > _MARKS:
            more = found[_MARKS:]
            lines.append(DrawnMark(f"and {len(more)} more", "; ".join(mark.message for mark in more), more[0].colour))
        number = len(self.result.boxes)
        box = Box(
            number,
            _name(component),
            _short(" · ".join(filter(None, [*values[:1], about])), 34) or role,
            _FILLS[component.role.name],
            column,
            group,
            marks=lines,
            about=" · ".join(filter(None, (component.partTitle, role))),
        )
        if lines:
            box.edge = lines[0].colour
        box.symbol, box.paint = symbol_of(component)
        groups = _groups(component, every=self.unwired and component.role is not hardware.Role.Board)
        plain = component.role is hardware.Role.Passive and len(groups) <= _ENDS
        for text, connectors in groups:
            net = connectors[0].net
            row = PartRow(len(box.rows), _short(self._row_text(component, connectors[0], text), _ROW_LETTERS))
            for connector in connectors:
                self.rows[connector] = Place(number, row.number)
                if (mark := self.marks.connectors.get(connector)) is not None:
                    row.mark_colour, row.mark_text = mark.colour, f"{mark.rule}: {mark.message}"
            if net is not None and net.rail:
                row.tag, row.tag_colour, row.rail = self.rails[id(net)], self.colours[id(net)], True
            if net is not None:
                row.net, row.colour, row.plain = net.name, self.colours[id(net)], plain
            if component.role is hardware.Role.Board:
                row.pin, row.ports = connectors[0].pin, ", ".join(self.ports.get(connectors[0].pin, ()))
            box.rows.append(row)
        if box.is_board:
            _set_outline(box, component, [connectors[0].pin or text for text, connectors in groups])
        return box

    def _row_text(self, component: hardware.Component, connector: hardware.Connector, text: str) -> str:
        names = self.ports.get(connector.pin, ()) if component.role is hardware.Role.Board else ()
        return f"{text} = {', '.join(names)}" if names else text

    # ---- lines

    def _link(self) -> None:
        boxes = self.result.boxes
        for net in self.circuit.nets:
            if net.rail:
                continue
            ends = list(dict.fromkeys(self.rows[c] for c in net.connectors if c in self.rows))
            ends.sort(key=lambda place: (boxes[place.box].column, place.box, place.row))
            for other in ends[1:]:
                names = " - ".join(f"{boxes[end.box].title} {boxes[end.box].rows[end.row].text}" for end in (ends[0], other))
                pins = self.reached[id(net)]
                ports = dict.fromkeys(port for pin in pins for port in self.ports.get(pin, ()))
                link = DrawnLink(ends[0], other, self.colours[id(net)], names, 1, " ".join(pins), ", ".join(ports), net.name)
                self.result.links.append(link)
                for here, there in ((ends[0], other), (other, ends[0])):
                    boxes[here.box].rows[here.row].partners.append(there)

    def _bundle(self) -> None:
        """Merge all links between two boxes into one line, and tag each row with what it is wired to."""
        boxes = self.result.boxes
        pairs: dict[tuple[int, int], list[DrawnLink]] = {}
        partners: dict[tuple[int, int], list[str]] = {}
        for link in self.result.links:
            pairs.setdefault((link.one.box, link.other.box), []).append(link)
            for one, other in ((link.one, link.other), (link.other, link.one)):
                box, row = boxes[one.box], boxes[one.box].rows[one.row]
                there = boxes[other.box]
                name = there.rows[other.row].text.partition(" = ")[0]
                partners.setdefault((box.number, row.number), []).append(f"{there.title} {name}" if there.column else name)
                row.tag_colour = link.colour
        for (box_number, row_number), names in partners.items():
            row = boxes[box_number].rows[row_number]
            row.tag = _short(", ".join(dict.fromkeys(names)), _LETTERS) if not row.tag else row.tag
        self.result.links = [
            DrawnLink(
                Place(one, HEAD), Place(other, HEAD), "#777777", "; ".join(link.text for link in links), len(links),
                " ".join(dict.fromkeys(link.pins for link in links if link.pins)),
                ", ".join(dict.fromkeys(link.ports for link in links if link.ports)),
            )
            for (one, other), links in pairs.items()
            if one != other  # the rows' tags say it; the line would come back to where it begins
        ]  # fmt: skip


def _set_outline(box: Box, board: hardware.Component, names: Sequence[str]) -> None:
    """Give the rows of a board their places at its outline, and add the pins that nothing is wired to."""
    outline = outline_of(board)
    if outline is None:
        return
    for row, place in zip(box.rows, places_at(outline, names), strict=True):
        row.slot = place
    taken = {row.slot for row in box.rows}
    box.slots = max(len(outline.left), len(outline.right))
    for side, pins in ((-1, outline.left), (1, outline.right)):
        box.idle += [
            IdlePin(plain_name(pin), side, number) for number, pin in enumerate(pins) if pin and (side, number) not in taken
        ]


def _pins_reached(circuit: hardware.Circuit) -> dict[int, list[str]]:
    """`id` of each net -> the pins of boards that it leads to, also through parts with two ends such as a resistor."""
    pins = {id(net): list(dict.fromkeys(c.pin for c in net.connectors if c.pin)) for net in circuit.nets}
    beyond: dict[int, list[hardware.Net]] = {}
    for component in circuit.components:
        nets = {id(c.net): c.net for c in component.connectors if c.net is not None}
        if component.role is hardware.Role.Passive and len(nets) == _ENDS and not any(net.rail for net in nets.values()):
            one, other = nets.values()
            beyond.setdefault(id(one), []).append(other)
            beyond.setdefault(id(other), []).append(one)
    todo = deque(net for net in circuit.nets if pins[id(net)] and not net.rail)
    while todo:
        net = todo.popleft()
        for other in beyond.get(id(net), ()):
            if not pins[id(other)]:
                pins[id(other)] = pins[id(net)]
                todo.append(other)
    return pins


def _distances(components: Sequence[hardware.Component]) -> dict[hardware.Component, tuple[int, int]]:
    """(column, group) of each component.

    Components with a signal path to a board are in group 0; their column is the number of signal nets on that path. The others
    form one group for each connected set, with columns counted from 1 at the component with most signal connectors.
    """
    known = set(components)
    found: dict[hardware.Component, tuple[int, int]] = {}
    seen: set[int] = set()

    def walk(first: Iterable[hardware.Component], column: int, group: int) -> None:
        todo = deque(first)
        found.update((component, (column, group)) for component in todo)
        while todo:
            component = todo.popleft()
            for net in _signals(component):
                if id(net) in seen:
                    continue
                seen.add(id(net))
                for other in (c.component for c in net.connectors):
                    if other is not None and other in known and other not in found:
                        found[other] = found[component][0] + 1, group
                        todo.append(other)

    walk([c for c in components if c.role is hardware.Role.Board], 0, 0)
    far = [component for component in components if component not in found]
    far.sort(key=lambda c: (-len(_signals(c)), natural_key(c.elementId)))
    for group, component in enumerate(far, 1):
        if component not in found:
            walk([component], 1, group)
    return found


def _signals(component: hardware.Component) -> list[hardware.Net]:
    return [c.net for c in component.connectors if c.net is not None and not c.net.rail]


def _groups(component: hardware.Component, every: bool) -> list[tuple[str, Sequence[hardware.Connector]]]:
    """The connected connectors of a component, or all, grouped by name and net; a board's pins first, in their order."""
    found: dict[tuple[str, int], list[hardware.Connector]] = {}
    pins = [c for connectors in pins_of(component).values() for c in connectors]
    same = {id(c.net): c.pin for c in reversed(pins)}  # ICSP MOSI of a board is its D11
    others = [c for c in component.connectors if not c.pin]
    for connector in (*pins, *others):
        if every or (connector.net is not None and any(c.component is not component for c in connector.net.connectors)):
            text = connector.pin or same.get(id(connector.net)) or displayed_name(connector) or connector.connectorId
            found.setdefault((text, id(connector.net)), []).append(connector)
    return [(text, connectors) for (text, _), connectors in found.items()]


def _only_joins(component: hardware.Component) -> bool:
    """Whether a component only joins connectors, as a breadboard does; then its nets are drawn, not the component."""
    return component.role is hardware.Role.Passive and len(component.connectors) > 4


def _name(component: hardware.Component) -> str:
    return _short(component.title or component.partTitle or f"#{component.elementId}")


def _mark_lines(mark: Mark) -> list[str]:
    return wrap(_short(f"{mark.rule} {mark.message}", _MARK_LINES * _MARK_LETTERS - 10), _MARK_LETTERS, subsequent_indent="   ")


def _short(text: str, letters: int = _LETTERS) -> str:
    """A text on one line, without characters that XML forbids, truncated to a number of characters."""
    line = " ".join("".join(c if c.isprintable() else " " for c in text).split())
    return line if len(line) <= letters else line[: letters - 1] + "…"


# ---- names and colours of nets

_KNOWN = {"GND": "#111111", "5V": "#c62828", "3.3V": "#d35400"}
_LABEL_LETTERS = 18
_FIRST_HUE, _LAST_HUE = 45, 330  # degrees; without red and orange, which are the supplies' alone
_TURN = 137.508  # degrees; colours that follow one another are far apart


def rail_names(rails: Iterable[hardware.Net]) -> dict[int, str]:
    """`id` of each rail -> its unique name; rails of a board are named first, and so without a number.

    Args:
        rails: the rails in the circuit's order.
    """
    names: dict[int, str] = {}
    taken: set[str] = set()
    for net in sorted(rails, key=lambda net: not _of_a_board(net)):
        wanted = " ".join((net.title or net.voltage or "supply").split())[:_LABEL_LETTERS]
        name, number = wanted, 1
        while name in taken:
            number += 1
            name = f"{wanted} {number}"
        taken.add(name)
        names[id(net)] = name
    return names


def net_colours(nets: Iterable[hardware.Net], names: dict[int, str]) -> dict[int, str]:
    """`id` of each net -> its unique colour.

    Args:
        nets: the nets that are drawn.
        names: the names of those that are rails.
    """
    colours = _colours()
    found: dict[int, str] = {}
    used = {*_KNOWN.values()}
    for net in nets:
        known = _KNOWN.get(names.get(id(net), "").lstrip("+").replace("3V3", "3.3V"))
        if known is None or known in found.values():
            known = next(colour for colour in colours if colour not in used)
        used.add(known)
        found[id(net)] = known
    return found


def _of_a_board(net: hardware.Net) -> bool:
    return any(c.component is not None and c.component.role is hardware.Role.Board for c in net.connectors)


def _colours() -> Iterator[str]:
    """An endless sequence of colours with contrast to white; after some thousands they repeat in a lighter shade."""
    number = 0
    while True:
        level = 0.25 + 0.05 * (number % 3) + 0.01 * (number // 40 % 4) + 0.001 * (number // 160 % 50)
        hue = _FIRST_HUE + (number * _TURN % 360) / 360 * (_LAST_HUE - _FIRST_HUE)
        red, green, blue = colorsys.hls_to_rgb(hue / 360, level, 0.75)
        yield f"#{round(red * 255):02x}{round(green * 255):02x}{round(blue * 255):02x}"
        number += 1


# ---- marks of findings

_ELEMENT = re.compile(r"//@(components|nets)\.(\d+)")
_QUOTED = re.compile(r"'([^']+)'")
_LABEL = re.compile(r"\b[DA]\d{1,2}\b")
_COLOURS = {Severity.error: "#c00000", Severity.warning: "#b45f06", Severity.info: "#3d6b99"}


class Mark(Struct, frozen=True):
    """A finding in the picture: its rule, its message, the colour of its severity."""

    rule: str
    message: str
    colour: str


class Marks:
    """The marks of a picture: by component, by connector, and those of the drawing as a whole."""

    def __init__(self) -> None:
        self.components: dict[hardware.Component, list[Mark]] = {}
        self.connectors: dict[hardware.Connector, Mark] = {}
        self.whole: list[Mark] = []


def marks(circuit: hardware.Circuit, findings: Iterable[Finding]) -> Marks:
    """The marks of findings, the worst first; each stands once at a component.

    Args:
        circuit: what the findings are about.
        findings: of all severities.
    """
    made = Marks()
    by_identity = {c.elementId: c for c in circuit.components}
    by_title: dict[str, list[hardware.Component]] = {}
    for component in circuit.components:
        by_title.setdefault(component.title, []).append(component)
    nets = {net.name: net for net in circuit.nets}
    for finding in sorted(findings, key=lambda f: (-f.severity, f.rule)):
        mark = Mark(finding.rule, finding.message, _COLOURS[finding.severity])
        about = _components(finding, circuit, by_identity, by_title)
        net = nets.get(str(finding.evidence.get("net", ""))) or _net(finding, circuit)
        for connector in _pins(finding, about):
            made.connectors.setdefault(connector, mark)
        if net is not None:
            for connector in net.connectors:
                made.connectors.setdefault(connector, mark)
            about = about or list(dict.fromkeys(c.component for c in net.connectors if c.component is not None))
        for component in about:
            mine = made.components.setdefault(component, [])
            if mark not in mine:
                mine.append(mark)
        if not about:
            made.whole.append(mark)
    return made


def _components(
    finding: Finding,
    circuit: hardware.Circuit,
    by_identity: dict[str, hardware.Component],
    by_title: dict[str, list[hardware.Component]],
) -> list[hardware.Component]:
    found = _ELEMENT.search(finding.element or "")
    if found is not None and found[1] == "components" and int(found[2]) < len(circuit.components):
        return [circuit.components[int(found[2])]]
    if (component := by_identity.get(str(finding.evidence.get("model_index", "")))) is not None:
        return [component]
    quoted = [by_title.get(title, []) for title in _QUOTED.findall(finding.message)]
    return [components[0] for components in quoted if len(components) == 1]


def _net(finding: Finding, circuit: hardware.Circuit) -> hardware.Net | None:
    found = _ELEMENT.search(finding.element or "")
    if found is None or found[1] != "nets" or int(found[2]) >= len(circuit.nets):
        return None
    return circuit.nets[int(found[2])]


def _pins(finding: Finding, components: Iterable[hardware.Component]) -> list[hardware.Connector]:
    """The connectors on the pins that a finding names, limited to some components."""
    told = finding.evidence.get("pins")
    named = told.split(",") if told and isinstance(told, str) else [str(each) for each in finding.listed("pins")]
    labels = {label.strip() for label in named or (match[0] for match in _LABEL.finditer(finding.message))}
    return [c for component in components for c in component.connectors if labels & _labels(c)]


def _labels(connector: hardware.Connector) -> set[str]:
    if connector.pin:
        return {connector.pin}
    net = connector.net
    return {other.pin for other in net.connectors if other.pin} if net is not None and not net.rail else set()
