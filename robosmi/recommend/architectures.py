"""Whether a library works on a processor architecture: what it declares, what the core brings along, and what replaces it.

A library that declares `*`, or nothing, probably works, unless its source uses registers of other processors. Names of
architectures are those of cores: `rp2040` and `mbed_rp2040` are two, although the processor is the same.
"""

from __future__ import annotations

import enum
from collections.abc import Mapping

from msgspec import Struct

from robosmi.recommend.index import Library

ANY = "*"
"""What a library declares that is for all architectures."""


class Support(enum.Enum):
    """How sure it is that a library works on an architecture."""

    listed = "listed"
    probable = "probable"
    absent = "absent"


class LibrarySubstitute(Struct, frozen=True):
    """The library to use for another one on an architecture, and why."""

    library: str
    why: str


class ArchitectureFacts(Struct, frozen=True, eq=False):
    """What is known beyond what libraries declare.

    Attributes:
        brings: architecture -> the libraries that its core brings along.
        instead: architecture -> library that does not work there -> what to use.
        home: the architecture that libraries are written for which list none, or all.
    """

    brings: Mapping[str, frozenset[str]] = {}
    instead: Mapping[str, Mapping[str, LibrarySubstitute]] = {}
    home: str = ""

    def support(self, library: Library, architecture: str | None) -> Support:
        """How sure it is that a library works on an architecture; everything probably works on none in particular."""
        if not architecture:
            return Support.probable
        if library.name in self.brings.get(architecture, ()) or architecture in library.architectures:
            return Support.listed
        if library.name in self.instead.get(architecture, {}) or (library.registers and architecture != self.home):
            return Support.absent
        return Support.probable if not library.architectures or ANY in library.architectures else Support.absent

    def remark(self, library: Library, architecture: str | None) -> str:
        """What to know of a library on an architecture: why it does not work there, or that it probably does; empty otherwise."""
        support = self.support(library, architecture)
        if support is Support.absent:
            return self.objection(library, architecture)
        if support is Support.listed or not architecture or architecture == self.home:
            return ""
        listed = "lists all architectures" if library.architectures else "lists no architecture"
        return f"probably works on {architecture}: it {listed}"

    def replacement(self, library: str, architecture: str | None) -> LibrarySubstitute | None:
        """What to use for a library on an architecture; None if nothing is known."""
        return self.instead.get(architecture or "", {}).get(library)

    def objection(self, library: Library, architecture: str | None) -> str:
        """Why a library does not work on an architecture, with what to use; empty if nothing speaks against it."""
        if self.support(library, architecture) is not Support.absent:
            return ""
        listed = f" (it lists {', '.join(library.architectures)})" if library.architectures else ""
        text = f"does not list the architecture {architecture}{listed}"
        if library.registers:
            text = f"does not work on {architecture}: its source uses registers of {self.home} ({', '.join(library.registers)})"
        found = self.replacement(library.name, architecture)
        return f"{text}; use {found.library} there: {found.why}" if found is not None else text
