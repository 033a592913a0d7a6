"""Bar charts as SVG texts, without scripts; colours are classes of the page's style."""

from __future__ import annotations

import math
from collections.abc import Sequence

from robosmi.quoting import html

WIDTH, BAR, LABEL = 640, 20, 200


def bars(rows: Sequence[tuple[str, float, str]], title: str) -> str:
    """Horizontal bars.

    Args:
        rows: label, value and class of each bar.
        title: what a screen reader reads.
    """
    most = max((value for _, value, _ in rows), default=0) or 1
    parts = [f'<svg viewBox="0 0 {WIDTH} {BAR * len(rows)}" role="img" aria-label="{html(title)}" class="chart">']
    for number, (label, value, kind) in enumerate(rows):
        top, length = number * BAR, (WIDTH - LABEL - 80) * value / most
        parts.append(
            f'<text x="{LABEL - 6}" y="{top + 14}" text-anchor="end">{html(label[:34])}<title>{html(label)}</title></text>'
            f'<rect x="{LABEL}" y="{top + 3}" width="{max(length, 1):.1f}" height="{BAR - 6}" class="{html(kind)}"/>'
            f'<text x="{LABEL + length + 5:.1f}" y="{top + 14}">{value:,g}</text>'
        )
    return "".join([*parts, "</svg>"])


def histogram(values: Sequence[float], unit: str, title: str) -> str:
    """How many values lie in each of up to ten ranges, whose bounds are 1, 2 or 5 times a power of ten apart.

    Args:
        values: what is counted.
        unit: behind the bounds.
        title: what a screen reader reads.
    """
    if not values:
        return ""
    most = max(values)
    whole = all(value == int(value) for value in values)
    width = _step(max(most / 10, 1.0 if whole else 0.0)) if most > 0 else 1.0
    counts = [0] * (int(most / width) + 1)
    for value in values:
        counts[int(value / width)] += 1
    rows = [(_range(number * width, width, whole, unit), float(count), "plain") for number, count in enumerate(counts)]
    return bars(rows, title)


def _range(first: float, width: float, whole: bool, unit: str) -> str:
    """The label of a range; its upper bound belongs to the next one."""
    if not whole:
        return f"{first:g} to below {first + width:g} {unit}".rstrip()
    return f"{first:g} {unit}".rstrip() if width == 1 else f"{first:g} to {first + width - 1:g} {unit}".rstrip()


def _step(least: float) -> float:
    """The smallest number of 1, 2 and 5 times a power of ten that is not below."""
    power = 10.0 ** math.floor(math.log10(least))
    return next(step * power for step in (1, 2, 5, 10) if step * power >= least * (1 - 1e-9))
