"""Text-to-model transformation from Fritzing sketches (`.fz`, `.fzz`) to the hardware metamodel (paper 3.2).

`read_circuit` is the whole of it to the outside. The format, and what of it is not obvious, is described in the modules.
"""

from __future__ import annotations

from robosmi.transformations.t2m.fritzing.reader import read_circuit

__all__ = ["read_circuit"]
