"""The generation rules of EGX: for which elements which template makes which file, and with which values.

A rule is a function: its name is the rule's, its parameter the name by which the template knows the element, its result the
template's further values. The order of evaluation is the engine's: guard, pre, the flags, template, the function, target, then
text and file, post. `gen` writes the files.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, TypeAlias

from msgspec import Struct

from robosmi.errors import RuleError
from robosmi.model.driver import Model
from robosmi.query.erl import RuleType, called, place_of

if TYPE_CHECKING:
    from robosmi.functions import Function


Flag: TypeAlias = "bool | Function"
Formatter = Callable[[str], str]


class GenerationRule(Struct, eq=False, dict=True):
    """A rule. Everything that may be a function is called with the element, or with nothing where the rule has no type.

    Attributes:
        name: the rule's name.
        variable: the name by which the template knows the element, "" for a rule without elements.
        parameters: the function; it gives the template's further values, or None for none.
        template: name of the template.
        target: path of the file, relative to the output folder; None if the text is only wanted by `post`.
        kind: a type of a model (`L.Book`), a class or a name, or None.
        domain: the elements instead of all of the type, or None.
        greedy: whether elements of subtypes count.
        guard: for which elements it applies.
        pre: called before the template is chosen.
        post: called with the path of the file (or the text, without a target) as last argument, after the file was made.
        overwrite: whether a file that is there is made anew.
        merge: whether what a person wrote in protected regions is put into it.
        append: whether the text comes behind what the file holds, and nothing is merged.
        formatters: applied to the text one after the other.
    """

    name: str
    variable: str
    parameters: Callable[..., Mapping[str, Any] | None]
    template: str | Callable[..., str]
    target: str | Callable[..., str | None] | None = None
    kind: Any = None
    domain: Iterable[Any] | Callable[[], Iterable[Any]] | None = None
    greedy: bool = False
    guard: Flag = True
    pre: Callable[..., object] | None = None
    post: Callable[..., object] | None = None
    overwrite: Flag = True
    merge: Flag = True
    append: Flag = False
    formatters: tuple[Formatter, ...] = ()

    @cached_property
    def applies_to_all(self) -> bool:
        """Whether no guard has to be asked."""
        return self.guard is True

    @cached_property
    def _same_flags(self) -> tuple[bool, bool, bool] | None:
        if any(callable(flag) for flag in (self.overwrite, self.merge, self.append)):
            return None
        return bool(self.overwrite), bool(self.merge), bool(self.append)

    def flags(self, element: tuple[Any, ...]) -> tuple[bool, bool, bool]:
        """Overwrite, merge and append for an element."""
        if self._same_flags is not None:
            return self._same_flags
        return bool(value_of(self.overwrite, element)), bool(value_of(self.merge, element)), bool(value_of(self.append, element))

    def elements(self, models: Sequence[Model]) -> Iterable[tuple[Any, ...]]:
        """What the functions of the rule are called with: one element each, or once nothing.

        Raises:
            UnknownTypeError: the type is given by name, and no model has it.
        """
        if self.domain is not None:
            return [(element,) for element in (self.domain() if callable(self.domain) else self.domain)]
        if self.kind is None:
            return [()]
        return [(element,) for element in RuleType(self.kind, models).instances(exact=not self.greedy)]


def value_of(given: Any, element: tuple[Any, ...]) -> Any:
    """What a rule says for an element: the value itself, or what the function gives."""
    return given(*element) if callable(given) else given


def variable_of(function: Function, has_elements: bool) -> str:
    """The name of the function's parameter, "" where there are no elements.

    Raises:
        RuleError: it does not take exactly one parameter for the element, or none where there is no element.
    """
    names = list(inspect.signature(function).parameters)
    if len(names) != int(has_elements):
        wanted = "exactly one, the element" if has_elements else "none, since the rule has no type"
        raise RuleError(
            f"the function of the rule {called(function)} has {len(names)} parameters",
            location=place_of(function),
            fix=f"give it {wanted}",
        )
    return names[0] if has_elements else ""
