"""Helpers that read a small drawing of any tool."""

from __future__ import annotations

from pathlib import Path

from robosmi.diagnostics import Finding
from robosmi.transformations.chains.hardware import hardware


def pins(path: Path) -> dict[str, str]:
    """The component on each pin of the board."""
    return {m["pin"]: m["component"] for m in hardware(path).result["mappings"]}


def said(findings: list[Finding], rule: str) -> list[str]:
    """The messages of a rule's findings; each finding must have a fix."""
    found = [f for f in findings if f.rule == rule]
    assert all(f.fix for f in found)
    return [f.message for f in found]
