"""Which arguments of a third-party library are pins: by the names of the parameters in the index of libraries.

The libraries are those with a header that a program includes; of several with one header, the first that has the class counts.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import cached_property

from robosmi.errors import RobosmiError
from robosmi.transformations.knowledge.adapters.adapter_index import AdapterIndex
from robosmi.transformations.knowledge.api_facts import PinFacts, PinParameter
from robosmi.transformations.knowledge.libraries.library_ranking import libraries_by_header, library_api

_MOST = 5
_PIN = re.compile(r"(?i:pins?\d*)$|^_*[Pp][Ii][Nn]s?(?=[A-Z_\d])")


class LibraryPins:
    """The pins of the functions of a program's libraries; see `platform_api.DeclaredPins`.

    Args:
        headers: the headers that the program includes and its platform does not know.
        index: the platform whose index of libraries is asked; empty for none.
    """

    def __init__(self, headers: Iterable[str], index: str) -> None:
        self._headers, self._index = tuple(dict.fromkeys(headers)), index

    @property
    def index(self) -> AdapterIndex | None:
        """None: no adapter declares them."""
        return None

    def of(self, function: str, header: str) -> PinFacts | None:
        """The pins of a class's constructor, or of `CLASS::METHOD`; None where the name of no parameter tells one."""
        return None if header else self._known.get(function)

    @cached_property
    def _known(self) -> dict[str, PinFacts]:
        found: dict[str, PinFacts] = {}
        for header in self._headers if self._index else ():
            for name in [library.name for library in libraries_by_header(header, self._index)][:_MOST]:
                for key, parameters in self._parameters(name):
                    pins = _pins(parameters)
                    if pins and key not in found:
                        found[key] = PinFacts(pins, ())
        return found

    def _parameters(self, name: str) -> list[tuple[str, list[str]]]:
        """Each class and method of a library with the parameters of its overloads."""
        try:
            api = library_api(name, self._index)
        except RobosmiError:
            return []
        made: dict[str, list[str]] = {}
        for one in (each for header in api.headers for each in header.classes):
            made.setdefault(one.name, []).extend(one.constructors)
            for method in one.methods:
                made.setdefault(f"{one.name}::{method.name}", []).append(method.parameters)
        return list(made.items())


def _pins(overloads: Iterable[str]) -> tuple[PinParameter, ...]:
    found: dict[int, PinParameter] = {}
    for parameters in overloads:
        for position, text in enumerate(parameters.strip("()").split(",")):
            declared = text.partition("=")[0]
            name = (re.findall(r"\w+", declared) or [""])[-1]
            if _PIN.search(name) and "(" not in declared and "*" not in declared and "&" not in declared:
                found.setdefault(position, PinParameter(position, name, "unknown"))
    return tuple(found[position] for position in sorted(found))


def may_be_pin(name: str) -> bool:
    """Whether a name says that it is a pin's."""
    return bool(_PIN.search(name))
