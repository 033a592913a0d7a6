"""What content registers under a name, and the form that this must have in a plug-in, so that mistakes are blamed on it.

A plug-in's function called with wrong arguments would raise a `TypeError` in our code, and one that returns a wrong type would
break our code later. Both are faults of the plug-in; here they become errors that name it and state what is expected.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from types import FunctionType
from typing import Any, Protocol

from msgspec import Struct

from robosmi.diagnostics import Location
from robosmi.errors import InternalError, RobosmiError, RuleError, did_you_mean

FORMS = {
    "drawing reader": "it is called as read(PATH, roles=ROLES, board=BOARD) and has to return (Circuit, list of Finding)",
    "drawing recogniser": "it is called with the first bytes of a file and has to return whether it is of that form",
    "driver": "it is called as driver(PATH, NAME, **OPTIONS) and has to return a Model with all its abstract methods",
    "generator": "it is called as generate(PLAN, SOURCES) and has to return a Generation, whose files are FileChanges",
    "program reader": "it is called as read(PATHS, platform=NAME, include_dirs=FOLDERS, defines=MACROS) "
    "and has to return (Program, list of Finding)",
}
"""For each kind of content: what messages call it, and what it has to return."""


def unasked(
    offered: Mapping[str, Mapping[str, str]], known: Mapping[str, Mapping[str, str]], metamodels: Iterable[str]
) -> Iterator[tuple[str, str]]:
    """What a plug-in registers that nothing will ever look up, because its kind or name is misspelt, as (what, why).

    Args:
        offered: kind -> names, as the plug-in registers them.
        known: kind -> names of what is there already.
        metamodels: the names that constraints may have without being told, those of known metamodels.
    """
    for kind, names in offered.items():
        if kind not in known:
            yield kind, f"nothing asks for content of the kind '{kind}'{did_you_mean(kind, known) or _one_of(known)}"
        for name in names:
            if kind == "constraints" and name not in metamodels and (meant := did_you_mean(name, metamodels)):
                yield f"{kind} {name}", f"no metamodel is called '{name}'{meant}"
            if kind == "view" and "#" not in name:
                yield f"{kind} {name}", f"'{name}' names no class (NAMESPACE#CLASS)"


def _one_of(known: Iterable[str]) -> str:
    return f"; there are: {', '.join(sorted(known))}"


class Offered(Protocol):
    """A function that content registers under a name; each kind defines its parameters and result."""

    def __call__(self, *arguments: object, **options: object) -> Any:
        """The result of the function."""


class PluginOffer(Struct, frozen=True):
    """A function that a plug-in offers.

    Attributes:
        function: what it offers.
        kind: the kind of content.
        name: how it is asked for.
        owner: the plug-in's distribution, with its version.
    """

    function: Offered
    kind: str
    name: str
    owner: str

    def __call__(self, *arguments: object, **options: object) -> Any:
        """What it makes.

        Raises:
            RuleError: it cannot be called with these arguments.
        """
        try:
            return self.function(*arguments, **options)
        except TypeError as error:
            if error.__traceback__ is not None and error.__traceback__.tb_next is not None:
                raise  # out of the plug-in's code
            raise self.fault(f"cannot be called as it has to be: {error}", _place(self.function)) from error

    def fault(self, what: str, location: Location | None = None) -> RuleError:
        """The error for an offer that is not of the form of its kind.

        Args:
            what: what is wrong with it, behind its name.
            location: where, or None.
        """
        return RuleError(
            f"the {self.kind} '{self.name}' of the plug-in {self.owner} {what}",
            location=location,
            fix=f"report it to the authors of {self.owner.partition(' ')[0]}: "
            + FORMS.get(self.kind, f"it has to be called and to return what a built-in {self.kind} does"),
        )


def wrong_result(offered: Offered, made: object, expected: str, path: Path | None = None) -> RobosmiError:
    """The error for something that returned what nobody can use.

    Args:
        offered: what was called.
        made: what it returned.
        expected: what it has to return.
        path: the file that it was called for, or None.
    """
    what, place = f"gives {made!r:.60}, not {expected}", Location(str(path)) if path is not None else None
    if isinstance(offered, PluginOffer):
        return offered.fault(what, place)
    return InternalError(f"{offered!r} {what}", location=place, fix="this is a bug of robosmi: please report it")


def _place(function: object) -> Location | None:
    """Where a function or class is defined, if that is known."""
    import inspect  # slow to load, and only after a mistake

    if not isinstance(function, (type, FunctionType)):
        return None
    try:
        file, (_, line) = inspect.getsourcefile(function), inspect.getsourcelines(function)
    except (OSError, TypeError):
        return None
    return Location(file, line) if file is not None else None
