"""Which parameters of a function are pins according to its adapter, if the platform's own data says nothing about the function.

The platform's `pins.json` takes precedence. Adapter files are read by `adapter_index`.
"""

from __future__ import annotations

from functools import cached_property

from robosmi.transformations.knowledge.adapters.adapter_checks import parameters_of
from robosmi.transformations.knowledge.adapters.adapter_index import AdapterIndex
from robosmi.transformations.knowledge.adapters.adapter_records import AdapterPiece
from robosmi.transformations.knowledge.api_facts import PinFacts, PinParameter


class AdapterPins:
    """The pins of functions, from the markers `pin:` of their adapters.

    Args:
        index: the adapter files of the target.
    """

    def __init__(self, index: AdapterIndex) -> None:
        self.index = index
        self._known: dict[tuple[str, str], PinFacts | None] = {}

    def of(self, function: str, header: str) -> PinFacts | None:
        """The pins of a function; None where no adapter declares any.

        Args:
            function: its name.
            header: where it is declared; empty where nobody knows it, so that the adapters of all headers are asked.

        Raises:
            PlatformDataError: an adapter file cannot be read, or says something wrong.
        """
        key = function, header
        if key not in self._known:
            pieces = [p for group in self.index.of(header) for p in group] if header else self._of_all.get(function, ())
            found = (_pins(piece) for piece in pieces if piece.name == function)
            self._known[key] = next((pins for pins in found if pins is not None), None)
        return self._known[key]

    @cached_property
    def _of_all(self) -> dict[str, list[AdapterPiece]]:
        """Name -> the pieces of that name of all headers."""
        found: dict[str, list[AdapterPiece]] = {}
        for piece in (p for header in self.index.headers for group in self.index.of(header) for p in group):
            found.setdefault(str(piece.name), []).append(piece)
        return found


def _pins(piece: AdapterPiece) -> PinFacts | None:
    if piece.kind != "adapter" or not piece.pins:
        return None
    names = parameters_of(piece.text, piece.target_name or piece.name)
    pins = [PinParameter(names.index(pin.name), pin.name, pin.direction) for pin in piece.pins if pin.name in names]
    return PinFacts(tuple(pins), ()) if pins else None
