"""Boards in drawings of tools whose libraries anyone writes: which board a symbol stands for, by what it is called and its pins.

A board's file says under `drawn_symbols` what such symbols are called (shields too: a shield is drawn as the board that it is
put on); their pins bear the labels that are printed on the board, in many spellings. Catalogues with ids of their own are the
business of `drawn_boards`, bare microcontrollers that of `drawn_chips`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from pathlib import Path

from robosmi.transformations.knowledge.board_models import check_drawn, drawing_files, only_draws, table_of, text_of
from robosmi.transformations.knowledge.drawn_boards import DrawnBoard, normalised_label
from robosmi.transformations.knowledge.wildcards import fits
from robosmi.verify.tables import DataTable

LEAST_PINS = 6
"""Minimum number of labelled pins of a board's symbol; logos and parts of boards have fewer."""

_SPELLED = re.compile(r"[^a-z0-9]+")
_OVERLINE = re.compile(r"[!*~{}]")
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
    for text in texts:
        called = _SPELLED.sub(" ", text.lower()).strip()
        for path in drawing_files(project) if called else ():
            if "drawn_symbols" not in text_of(path) or only_draws(path):
                continue
            table = table_of(path)
            check_drawn(table)
            for entry in table.tables("drawn_symbols", needed=False):
                if not any(fits(called, pattern.lower()) for pattern in entry.texts("called")):
                    continue
                pins = labelled_pins(table, connectors)
                if len(pins) >= least:
                    return DrawnBoard(path.stem, table.text("title", path.stem), pins)
    return None


def labelled_pins(table: DataTable, connectors: Mapping[str, str]) -> dict[str, str]:
    """Connector -> label of the board's pin, for connectors whose names say one."""
    pins = table.tables("pins")
    labels = {pin.text("label") for pin in pins}
    aliases = {alias: pin.text("label") for pin in pins for alias in pin.texts("aliases", ())}
    found = ((connector, _label(name, labels, aliases)) for connector, name in connectors.items())
    return {connector: label for connector, label in found if label}


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
    return label or next((known[word.upper()] for word in words if word.upper() in known), "")
