"""Small EAGLE schematics for tests: libraries, parts and nets as text."""

from __future__ import annotations

from pathlib import Path

Pins = list[tuple[str, str]]
"""Names and directions of a symbol's pins."""

UNO: Pins = [(f"D{n}", "io") for n in range(14)] + [("A0", "io"), ("5V", "pwr"), ("GND@1", "pwr"), ("GND@2", "pwr")]
CHIP: Pins = [(f"(PCINT{n})PB{n}", "io") for n in range(8)] + [(f"PD{n}", "io") for n in range(8)]
CHIP += [("PC0", "io"), ("PC1", "io"), ("VCC", "pwr"), ("GND", "pwr")]
TWO: Pins = [("1", "pas"), ("2", "pas")]
HEADER: Pins = [(str(n), "pas") for n in range(1, 5)]


def device(name: str, pins: Pins, description: str = "", gates: int = 1) -> str:
    """A library called LIB-name with one device set; its gates A, B, ... have the same symbol."""
    listed = "".join(f'<pin name="{pin}" direction="{way}"/>' for pin, way in pins)
    drawn = "".join(f'<gate name="{chr(65 + n)}" symbol="S"/>' for n in range(gates))
    return (
        f'<library name="lib-{name.lower()}"><symbols><symbol name="S">{listed}</symbol></symbols><devicesets>'
        f'<deviceset name="{name}"><description>{description}</description><gates>{drawn}</gates>'
        '<devices><device name=""/></devices></deviceset></devicesets></library>'
    )


def part(name: str, kind: str, value: str = "") -> str:
    """A part of such a library."""
    return f'<part name="{name}" library="lib-{kind.lower()}" deviceset="{kind}" device="" value="{value}"/>'


def net(name: str, *pins: str) -> str:
    """A net; pins are PART.PIN of gate A."""
    refs = "".join('<pinref part="{}" gate="A" pin="{}"/>'.format(*pin.split(".")) for pin in pins)
    return f'<net name="{name}"><segment>{refs}</segment></net>'


def schematic(folder: Path, libraries: list[str], parts: list[str], nets: list[str], more: str = "", sheet: str = "") -> Path:
    """A schematic on disk, each part and net in a line of its own."""
    lines = [
        '<?xml version="1.0"?>', '<!DOCTYPE eagle SYSTEM "eagle.dtd">', '<eagle version="9.6.2"><drawing><schematic>',
        f"<libraries>{''.join(libraries)}</libraries>{more}<parts>", *parts, f"</parts><sheets><sheet>{sheet}<nets>", *nets,
        "</nets></sheet></sheets></schematic></drawing></eagle>",
    ]  # fmt: skip
    path = folder / "robot.sch"
    path.write_text("\n".join(lines) + "\n")
    return path
