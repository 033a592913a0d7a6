"""Schematics of tools that draw symbols and named nets (EAGLE, KiCad): their records, and the hardware model made of them.

A reader of such a tool fills a `Schematic`: parts with the pins of their symbols, nets with the pins on them. This module
decides what the symbols stand for: boards by their names, bare microcontrollers by their ports, headers whose other side is not
drawn, solder bridges, power symbols. Files and the joining of pins are left to the readers.

In these tools anyone writes libraries, so a board's symbol is recognised by what it is called and by its pins. A board's file
lists under `drawn_symbols` what such symbols are called (shields too: a shield is drawn as the board that it is put on); their
pins bear the labels that are printed on the board, in many spellings. Catalogues with ids of their own are the business of
`drawn_boards`, bare microcontrollers that of `drawn_chips`.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from msgspec import Struct
from msgspec.structs import replace

from robosmi.base.data_tables import DataTable
from robosmi.diagnostics import Severity
from robosmi.errors import did_you_mean
from robosmi.metamodels import hardware
from robosmi.transformations.knowledge.board_models import check_drawn, drawing_files, only_draws, table_of, text_of
from robosmi.transformations.knowledge.drawn_boards import DrawnBoard, drawn_board, normalised_label
from robosmi.transformations.knowledge.drawn_chips import chip_named, drawn_chip, port_of
from robosmi.transformations.knowledge.part import Part, PartConnector
from robosmi.transformations.knowledge.part_names import connector_kind
from robosmi.transformations.knowledge.part_roles import classify, is_connector
from robosmi.transformations.knowledge.wildcards import fits
from robosmi.transformations.queries.circuits.former_titles import SHEET, title_on_sheet
from robosmi.transformations.t2m.connectivity import Joined
from robosmi.transformations.t2m.drawing import CircuitBuilder, End, KnownPart, Placed
from robosmi.transformations.t2m.schematic_headers import OF_THE_BOARD, PROGRAMMER, HeaderPin, why_no_part, words_of

_CLOCK_PARTS = ("crystal", "resonator", "oscillator", "quartz", "xtal")
_NET_NAMES = 3
_LEAST_PORTS = 3
_BUS_LINES = frozenset(
    {"MOSI", "MISO", "SCK", "SCLK", "COPI", "CIPO", "SS", "CS", "SDA", "SCL", "RX", "TX", "RXD", "TXD", "RXI", "TXO"}
)
_NUMBERED = ("N$", "Net-(", "unconnected-(")
"""Prefixes of the names that tools give to nets without a name."""


class SchematicPart(Struct, frozen=True):
    """A placed part.

    Attributes:
        identity: the tool's own identity of it, unique in the drawing.
        title: its reference in the drawing.
        sheet: names of the sheets above it, joined by `/`; empty on the root sheet.
        symbol: what the library calls the symbol.
        listed_as: its id in the tool's catalogue.
        family: name of its library.
        value: its value in the drawing, such as `10k` or the name of a chip.
        description: the library's sentence about it.
        tags: the library's key words.
        pins: connector -> its name, in the symbol's order.
        count: number of terminals of its package; 0 if it equals the number of pins.
        properties: further properties.
        line: its line in the file.
        power: whether it only names a net.
        defined: whether the drawing has its symbol.
    """

    identity: str
    title: str
    symbol: str
    listed_as: str
    family: str = ""
    value: str = ""
    description: str = ""
    tags: tuple[str, ...] = ()
    pins: Mapping[str, str] = {}
    count: int = 0
    properties: Mapping[str, str] = {}
    line: int | None = None
    power: bool = False
    defined: bool = True
    sheet: str = ""


def with_unique_titles(parts: Sequence[SchematicPart]) -> list[SchematicPart]:
    """The parts, those whose reference another part has with the names of their sheets before it (`left/D1`)."""
    counts = Counter(part.title for part in parts)
    return [
        replace(part, title=title_on_sheet(part.sheet, part.title)) if counts[part.title] > 1 and part.sheet else part
        for part in parts
    ]


class SchematicNet(Struct):
    """A net: its name in the drawing, and its pins. Nets that have a pin in common are one."""

    name: str
    ends: list[End] = []


class Schematic(Struct):
    """The contents of a schematic: parts and nets in the file's order, digest and version of the file, further files read."""

    path: str
    digest: str
    tool: str
    version: str = ""
    parts: list[SchematicPart] = []
    nets: list[SchematicNet] = []
    companions: Sequence[str] = ()


def circuit_of(drawn: Schematic, builder: CircuitBuilder) -> hardware.Circuit:
    """The hardware model of a schematic; findings go to the builder."""
    return _Making(drawn, builder).circuit()


class _Making:
    """Makes one model."""

    def __init__(self, drawn: Schematic, builder: CircuitBuilder) -> None:
        self.drawn, self.builder, self.project = drawn, builder, builder.project
        self.report = builder.report
        self.used: dict[str, dict[str, list[str]]] = {}
        for net in drawn.nets:
            for end in net.ends:
                self.used.setdefault(end.component, {}).setdefault(end.connector, []).append(net.name)
        self.nets_of: dict[End, list[SchematicNet]] = {}
        for net in drawn.nets:
            for end in net.ends:
                self.nets_of.setdefault(end, []).append(net)
        self.chips: dict[str, tuple[str, int]] = {}
        self.boards: dict[tuple[str, ...], DrawnBoard | None] = {}
        self.parts = {part.identity: part for part in drawn.parts}
        self.headers = {part.identity for part in drawn.parts if self._is_header(part)}
        self.known: dict[str, tuple[str, KnownPart]] = {}
        for part in sorted(drawn.parts, key=lambda each: each.identity in self.headers):  # headers depend on what they lead to
            self.known[part.identity] = self._known(part)
        if (odd := next((end for net in drawn.nets for end in net.ends if end.component not in self.known), None)) is not None:
            guess = did_you_mean(odd.component, self.known)
            raise builder.fault(f"names the end '{odd.component}.{odd.connector}', but has no part '{odd.component}'{guess}")

    # ---- what parts are

    def _known(self, part: SchematicPart) -> tuple[str, KnownPart]:
        builder = self.builder
        if builder.catalogue.find(part.listed_as) is not None:
            return part.listed_as, builder.know(part.listed_as)
        described, board, own = self._described(part)
        alike = (part.identity,) if own else (part.symbol, part.value, *part.pins.items())
        key = repr((part.listed_as, *alike))  # texts joined might be those of another part
        if board is not None:
            described = replace(described, role="Board", evidence=f"drawn as {board.title} (boards of the platform repository)")
        return key, builder.know(key, described, board=board, own=own)

    def _described(self, part: SchematicPart) -> tuple[Part, DrawnBoard | None, bool]:
        """The part as drawn, the board that it stands for if any, and whether names say nothing about what it is."""
        connectors = {pin: self._connector(pin, name) for pin, name in part.pins.items()}
        found = Part(
            part.listed_as, part.symbol.replace("_", " "), part.family, part.tags, connectors=connectors,
            source="the drawing", description=part.description or self._meaning(part), buses=self._joined_inside(part),
        )  # fmt: skip
        if part.power:
            return replace(found, role="Power", evidence="it is a supply or ground symbol"), None, False
        if not part.pins and part.defined:
            return replace(found, role="Decoration", evidence="its symbol has no pins"), None, False
        if self._called(part, self.builder.names.solder_jumpers):
            evidence = "a solder jumper, which counts as open"
            return replace(found, family="solder jumper", role="Passive", evidence=evidence), None, False
        if (board := self._board(part)) is not None:
            return replace(found, buses=self._joined(part)), board, False
        if (chip := self._chip(part)) and part.identity not in self.chips:
            return replace(found, role="Board", evidence=f"a bare {chip}, which runs a program"), None, False
        if len(part.pins) == 1 and self._called(part, self.builder.names.test_points):
            return replace(found, role="Passive", evidence="a point to measure at"), None, False
        if part.identity in self.headers:
            return self._header(part, found)
        if part.value:
            device = classify(replace(found, title=part.value, family="", description="", connectors={}), self.project)
            if device.role in ("Input", "Output", "Both"):  # the value decides over the symbol
                return replace(found, role=device.role, driver=device.driver, evidence=f"value: {device.evidence}"), None, False
        return found, None, False

    def _meaning(self, part: SchematicPart) -> str:
        """What a symbol stands for, judged by its short name alone; empty if unknown."""
        known = self.builder.names.symbols.items()
        return next((means for means, called in known if self._called(part, called)), "")

    def _connector(self, pin: str, name: str) -> PartConnector:
        return PartConnector(pin, name, connector_kind(name, self.builder.names))

    def _joined(self, part: SchematicPart) -> dict[str, tuple[str, ...]]:
        """Groups of supply and ground pins with one name (`GND@1`, `GND@2`), which a board joins."""
        by_name: dict[str, list[str]] = {}
        for pin, name in part.pins.items():
            if connector_kind(name, self.builder.names) in ("supply", "ground"):
                by_name.setdefault(name, []).append(pin)
        return {name: tuple(pins) for name, pins in by_name.items() if len(pins) > 1}

    def _joined_inside(self, part: SchematicPart) -> dict[str, tuple[str, ...]]:
        """Groups of pins that are joined inside a part, such as one contact of a switch, according to the repository's data."""
        for entry in self.builder.names.joined:
            if entry.pins in (0, len(part.pins)) and self._called(part, entry.called):
                groups = [tuple(pin for pin, name in part.pins.items() if pin in g or name in g) for g in entry.groups]
                return {"-".join(group): group for group in groups if len(group) > 1}
        return {}

    def _called(self, part: SchematicPart, patterns: Sequence[str]) -> bool:
        return any(fits(part.symbol.lower(), pattern) for pattern in patterns)

    def _board(self, part: SchematicPart) -> DrawnBoard | None:
        texts = (part.value, part.symbol)  # a library called `arduino` has other parts too
        pins = part.pins if part.defined else {pin: pin for pin in self.used.get(part.identity, ())}
        alike = (part.listed_as, *texts, str(part.defined), *(text for pin in pins.items() for text in pin))
        if alike not in self.boards:
            told = drawn_board(part.listed_as or part.symbol, self.builder.tool, self.project)
            least = LEAST_PINS if part.defined else 0
            self.boards[alike] = told if told is not None else drawn_symbol(texts, pins, self.project, least=least)
        if (board := self.boards[alike]) is not None:
            return board
        if not (chip := self._chip(part)):
            return None
        counted = dict(part.pins)
        counted.update({f" {number}": "" for number in range(part.count - len(counted))})
        if (stands := drawn_chip(texts, counted, self.project)) is None:
            self.report(
                "RS215", Severity.warning, f"'{part.title}' is {chip}, but no board of the repository matches the drawing",
                part.line, "draw the board that runs the program, or describe one (docs/how-to/add-a-board.md)",
            )  # fmt: skip
            return None
        self.chips[part.identity] = (stands.chip, stands.clock)
        self.report(
            "RS215", Severity.info,
            f"'{part.title}' is a bare {stands.chip}: RoboSMi treats it as {stands.board.title}, with its pins by their ports",
            part.line, "check that the target board has the same chip",
        )  # fmt: skip
        lacking = [
            name for pin, name in part.pins.items()
            if pin in self.used.get(part.identity, ()) and port_of(name) and pin not in stands.board.pins
            and not any(word in name.upper() for word in ("XTAL", "TOSC", "RESET")) and not self._at_clock(part, pin)
        ]  # fmt: skip
        if lacking:
            self.report(
                "RS216", Severity.error, f"{stands.board.title} has no pins for {', '.join(lacking)} of '{part.title}'",
                part.line, "move the wires to other pins",
            )  # fmt: skip
        return stands.board

    def _at_clock(self, part: SchematicPart, pin: str) -> bool:
        """Whether a crystal or another clock part is on the net of a pin."""
        end = End(part.identity, pin)
        clocks = {each.identity for each in self.drawn.parts if _is_clock(each)}
        return any(end in net.ends and any(other.component in clocks for other in net.ends) for net in self.drawn.nets)

    @staticmethod
    def _chip(part: SchematicPart) -> str:
        """The name of the microcontroller that a part is, by its name and its ports; empty if it is none."""
        ports = sum(bool(port_of(name)) for name in part.pins.values())
        return chip_named((part.value, part.symbol)) if ports >= _LEAST_PORTS else ""

    def _is_header(self, part: SchematicPart) -> bool:
        """Whether a part is a header, a terminal or a socket, whose other side is not drawn."""
        if part.power or not part.pins:
            return False
        if self._called(part, self.builder.names.headers):
            return True
        drawn = Part(
            part.listed_as, part.symbol.replace("_", " "), part.family, part.tags, tool=self.builder.tool,
            description=part.description,
        )  # fmt: skip
        if is_connector(drawn, self.project) and "jumper" not in f"{part.symbol} {part.family} {part.description}".lower():
            return True
        told = any(fits(part.family.lower(), pattern) for pattern in self.builder.names.header_families)
        return told and classify(drawn, self.project).role in ("Passive", "Unknown")

    def _header(self, part: SchematicPart, found: Part) -> tuple[Part, DrawnBoard | None, bool]:
        for text, what, own in ((part.value, "for", False), (part.title, "labelled", True)):
            device = classify(Part(part.listed_as, text, tool=self.builder.tool), self.project)
            if text and device.role in ("Input", "Output", "Both"):
                evidence = f"a header {what} '{text}': {device.evidence}"
                told = replace(found, title=text, family="", role=device.role, driver=device.driver, evidence=evidence)
                return told, None, own
        nets = [name for names in self.used.get(part.identity, {}).values() for name in names]
        signals = [
            n for n in dict.fromkeys(nets) if not n.startswith(_NUMBERED) and connector_kind(n, self.builder.names) == "signal"
        ]
        title = part.value or ", ".join(signals[:_NET_NAMES]) or part.symbol
        found = replace(found, title=title, family="", description="", evidence="a header without a drawn device")
        on = [self._header_pin(End(part.identity, pin)) for pin in self.used.get(part.identity, ())]
        texts = [text.lower() for text in (part.symbol, part.value, part.title)]
        programmer = any(pin.pins for pin in on) and any(_any_fits(text, self.builder.names.programmers) for text in texts)
        if why := PROGRAMMER if programmer else why_no_part(on, part.title):
            self.report(
                "RS259", Severity.info, f"the header '{part.title}' counts as no part: {why}", part.line,
                "give its role in robosmi.toml under [roles] if a part is plugged in there",
            )  # fmt: skip
            found = replace(found, family="header", role="Passive", evidence=f"{found.evidence}: {why}")
        return found, None, True

    def _header_pin(self, pin: End) -> HeaderPin:
        """What is on a pin of a header; the other parts are known by now, other headers need not be."""
        nets = self.nets_of.get(pin, ())
        ends = [end for net in nets for end in net.ends if end != pin and end.component not in self.headers]
        boards = [end for end in ends if end.component in self.known and self._role(end) == "Board"]
        labels = [label for end in boards if (label := self._label(end))]
        names = [self.parts[end.component].pins.get(end.connector, end.connector) for end in boards]
        kinds = [connector_kind(text, self.builder.names) for text in (*names, *(net.name for net in nets))]
        return HeaderPin(
            pins=labels,
            named=any(self._names_pin(net.name, end) for net in nets for end in boards if self._label(end)),
            bus=any(words_of(net.name) & _BUS_LINES for net in nets),
            words=words_of(*names, *(net.name for net in nets)),
            led_out=not labels and bool(words_of(*names) & OF_THE_BOARD),
            supply=not labels
            and (any(kind in ("supply", "ground") for kind in kinds) or any(self.parts[e.component].power for e in ends)),
            device=any(self._role(end) in ("Input", "Output", "Both", "Unknown") for end in ends),
        )

    def _role(self, end: End) -> str:
        """The role of the part that has an end, empty if it is not known yet."""
        return self.known[end.component][1].part.role if end.component in self.known else ""

    def _label(self, end: End) -> str:
        """The label of a board's pin, empty for other connectors."""
        known = self.known[end.component][1]
        name = self.parts[end.component].pins.get(end.connector, end.connector)
        return known.board.pins.get(end.connector, "") if known.board is not None else normalised_label(name, known.numbered)

    def _names_pin(self, net: str, pin: End) -> bool:
        """Whether a net is named like the board's pin that is on it: by its label, or by its port."""
        if net.startswith(_NUMBERED):
            return False
        port = port_of(self.parts[pin.component].pins.get(pin.connector, pin.connector))
        return self._label(pin) in (normalised_label(net), *words_of(net)) or (port != "" and port == port_of(net))

    # ---- the model

    def circuit(self) -> hardware.Circuit:
        joined = Joined()
        ends: dict[End, None] = {}
        for net in self.drawn.nets:
            nodes = [(end.component, self.known[end.component][1].leader(end.connector)) for end in net.ends]
            for node in nodes:
                joined.union(nodes[0], node)
            ends.update(dict.fromkeys(net.ends))
        for part in self.drawn.parts:
            self._place(part)
        groups: dict[tuple[str, str], list[End]] = {}
        for part in self.drawn.parts:
            known = self.known[part.identity][1]
            for connector in part.pins or self.used.get(part.identity, {}):
                node = (part.identity, known.leader(connector))
                if node in joined and self.builder.connector(End(part.identity, connector)) is not None:
                    groups.setdefault(joined.find(node), []).append(End(part.identity, connector))
        titles: dict[tuple[str, str], str] = {}
        for net in self.drawn.nets:
            if net.ends and net.name and not net.name.startswith(_NUMBERED):
                end = net.ends[0]
                titles.setdefault(joined.find((end.component, self.known[end.component][1].leader(end.connector))), net.name)
        nets = {root: self.builder.net(members, titles.get(root, ""), by_name=True) for root, members in groups.items()}
        for number, net in enumerate(self.drawn.nets, 1):
            if len(net.ends) > 1:
                end = net.ends[0]
                root = joined.find((end.component, self.known[end.component][1].leader(end.connector)))
                self.builder.wire(f"{net.name} ({number})", net.ends, nets.get(root))
        if len(self.drawn.parts) > 1 and not ends:
            self.report(
                "RS212", Severity.warning, "no part is connected to another", fix=f"connect the parts in {self.drawn.tool}"
            )
        self._clocks()
        self._without_board()
        return self.builder.circuit(
            Path(self.drawn.path).stem, self.drawn.digest, self.drawn.tool, self.drawn.version, companions=self.drawn.companions
        )

    def _place(self, part: SchematicPart) -> None:
        key = self.known[part.identity][0]
        used = self.used.get(part.identity, {})
        properties = {**({"value": part.value} if part.value else {}), **part.properties}
        if part.sheet:
            properties[SHEET] = part.sheet
        placed = Placed(
            identity=part.identity, part_id=key, title=part.title, properties=properties, used=used, line=part.line,
            symbol=part.power, listed_as=part.listed_as,
        )  # fmt: skip
        self.builder.place(placed)

    def _clocks(self) -> None:
        """Report a drawn clock of another frequency than programs for the board expect (RS218)."""
        if not self.chips:
            return
        clock = Counter(chip_clock for _, chip_clock in self.chips.values()).most_common(1)[0][0]
        for part in self.drawn.parts:
            hertz = hertz_of(part.value) if _is_clock(part) else 0
            if hertz and hertz != clock and hertz > 1_000_000:
                self.report(
                    "RS218", Severity.warning,
                    f"'{part.title}' is a clock of {part.value}, but programs for the board expect {clock // 1_000_000} MHz",
                    part.line, "check that the target board has the clock that you need; times and baud rates differ",
                )  # fmt: skip

    def _without_board(self) -> None:
        """Report that there is no board: only its headers, which do not name its pins (RS219), or nothing at all (RS229)."""
        if any(component.role is hardware.Role.Board for component in self.builder.components):
            return
        words = ("digital", "analog", "power", "arduino", "shield")
        found = [
            part.title for part in self.drawn.parts
            if not part.power and len(part.pins) >= 4
            and (any(word in f"{part.value} {part.symbol} {part.family}".lower() for word in words) or self._bears_labels(part))
        ]  # fmt: skip
        if len(found) > 1:
            self.report(
                "RS219", Severity.error, f"the drawing has no board, but {', '.join(found[:4])} seem to be its headers", None,
                "draw the board with its own symbol, such as an Arduino Uno or a shield",
            )  # fmt: skip
            return
        self.report(
            "RS229", Severity.warning, "the drawing has no board: RoboSMi reads its parts and nets, but no pins", None,
            "give the file with the board, or give a part the role Board in robosmi.toml under [roles]",
        )  # fmt: skip

    def _bears_labels(self, part: SchematicPart) -> bool:
        """Whether a part is a header most of whose nets are named like pins of a board (`IO5`, `A3`) or ports (`PE5`).

        False if the drawing has a chip with such ports itself.
        """
        if not self._called(part, self.builder.names.headers) or any(
            sum(bool(port_of(name.removeprefix("G"))) for name in other.pins.values()) >= _LEAST_PORTS  # GPA0 of an expander
            for other in self.drawn.parts
        ):
            return False
        nets = list(dict.fromkeys(name for names in self.used.get(part.identity, {}).values() for name in names))
        told = [n for n in nets if not n.startswith(_NUMBERED) and connector_kind(n, self.builder.names) == "signal"]
        labelled = [name for name in told if normalised_label(name) or port_of(name)]
        return len(labelled) >= _LEAST_PORTS and 2 * len(labelled) > len(told)


def _is_clock(part: SchematicPart) -> bool:
    told = f"{part.symbol} {part.family} {part.description}".lower()
    return any(word in told for word in _CLOCK_PARTS)


def hertz_of(value: str) -> int:
    """The frequency in hertz that a value such as `16MHz` or `16.000` names; 0 if it names none."""
    text = value.strip().lower().replace(",", ".").removesuffix("hz").strip()
    scale = {"m": 1_000_000, "k": 1_000}.get(text[-1:], 0)
    try:
        return round(float(text[:-1] if scale else text) * (scale or (1_000_000 if "." in text or len(text) < 3 else 1)))
    except ValueError:
        return 0


# ---- boards

LEAST_PINS = 6
"""Minimum number of labelled pins of a board's symbol; logos and parts of boards have fewer."""

_SPELLED = re.compile(r"[^a-z0-9]+")
_OVERLINE = re.compile(r"[!*~{}]")
_ANALOG_INPUT = re.compile(r"(?<![A-Z0-9])AIN ?([0-9]{1,2})(?![0-9])")
_SERIAL_LINE = re.compile(r"[RT]XD?[01]")
_COUNTED = re.compile(r"@[0-9A-Z]*$|\.[0-9]+$")


def drawn_symbol(
    texts: Iterable[str], connectors: Mapping[str, str], project: Path | None = None, least: int = LEAST_PINS
) -> DrawnBoard | None:
    """The board that a symbol stands for, or None.

    Args:
        texts: what the drawing calls the part, what counts most first: its value goes before its symbol.
        connectors: connector -> its name, with the label of the pin in it (`D3`, `*D3`, `D0/RX`, `SDA`).
        project: the project folder, whose own data goes first; the current folder if None.
        least: how many of its connectors have to bear labels of the board.

    Raises:
        PlatformDataError: an entry is damaged.
    """
    if len(connectors) < least:
        return None
    spelled = [_SPELLED.sub(" ", text.lower()).strip() for text in texts]
    for called in spelled:
        for path in drawing_files(project) if called else ():
            if "drawn_symbols" not in text_of(path) or only_draws(path):
                continue
            table = table_of(path)
            check_drawn(table)
            for entry in table.tables("drawn_symbols", needed=False):
                if not _any_fits(called, entry.texts("called")) or any(
                    _any_fits(each, entry.texts("not", ())) for each in spelled
                ):
                    continue
                pins = labelled_pins(table, connectors)
                if len(pins) >= least:
                    return DrawnBoard(path.stem, table.text("title", path.stem), pins)
    return None


def _any_fits(called: str, patterns: Iterable[str]) -> bool:
    return any(fits(called, pattern.lower()) for pattern in patterns)


def labelled_pins(table: DataTable, connectors: Mapping[str, str]) -> dict[str, str]:
    """Connector -> label of the board's pin, for connectors whose names say one."""
    pins = table.tables("pins")
    labels = {pin.text("label") for pin in pins}
    ports = {pin.text("port", "").upper(): pin.text("label") for pin in pins}
    aliases = {alias: pin.text("label") for pin in pins for alias in pin.texts("aliases", ())}
    found = {connector: _of_port(name, ports) or _label(name, labels, aliases) for connector, name in connectors.items()}
    told = {connector: label for connector, label in found.items() if label}
    given = {*told.values()}
    for connector, name in connectors.items():
        if not found[connector] and (analog := _ANALOG_INPUT.search(name.upper())) is not None:
            label = f"A{int(analog[1])}"
            if label in labels - given:  # beside A0 it is an input of the comparator
                told[connector] = label
    return told


def _of_port(name: str, ports: Mapping[str, str]) -> str:
    """The label of the pin whose port a name has; it goes before other names: `(AD0)PA0` is no analogue input."""
    words = re.split(r"[/ _()]", name.upper())
    return ports.get(port_of(name), "") or next((ports[word] for word in words if word.startswith("GPIO") and word in ports), "")


def _label(name: str, labels: set[str], aliases: Mapping[str, str]) -> str:
    text = _COUNTED.sub("", _OVERLINE.sub("", name).strip())
    words = [word for word in re.split(r"[/ _()]", text) if word]
    own = {label.upper(): label for label in labels}
    for known in (own, aliases):  # as the board's file has it, before what other boards call so
        if text.upper() in known:
            return known[text.upper()]
    label = normalised_label(text) or (normalised_label(words[0]) if words else "")
    if label not in labels:
        label = aliases.get(label, "")
    known = {**aliases, **own}
    if not label and _SERIAL_LINE.fullmatch(text.upper()):  # RX1 of a board with several serial ports is known by now
        label = known.get(text[:2].upper(), "")
    return label or next((known[word.upper()] for word in words if word.upper() in known), "")
