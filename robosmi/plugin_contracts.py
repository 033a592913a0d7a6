"""The kinds of content that can be registered, each with its contract: how it is called, what it returns, how it is named.

There is one class for each kind. An instance is a plug-in's contribution of that kind: a call that does not fit the contract is
an error that names the plug-in and states the contract. `robosmi doctor` and docs/reference/plug-ins.md list the kinds.
What is registered, and by whom, is in `plugins`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from types import FunctionType
from typing import Any, ClassVar, Literal, Protocol, TypeAlias

from msgspec import Struct

from robosmi.diagnostics import Location
from robosmi.errors import InternalError, RobosmiError, RuleError, UsageError, did_you_mean

ContentKind: TypeAlias = Literal[
    "chain", "constraints", "device", "drawing reader", "drawing recogniser", "driver", "engine", "generator", "model migration",
    "named query", "parts reader", "program reader", "query", "ranker", "view", "wiring form",
]  # fmt: skip
"""The name of a kind, as `Registry.add` takes it."""


class ContentFunction(Protocol):
    """A registered function; its kind defines parameters and result."""

    def __call__(self, *arguments: object, **options: object) -> Any:
        """The result of the function."""


class Contribution(Struct, frozen=True):
    """Something that a plug-in registers.

    Attributes:
        function: what it registers.
        name: the name under which it registers it.
        owner: the plug-in's distribution, with its version.

    Each kind is a subclass, which states:
        kind: its name.
        description: what content of this kind does.
        called: how it is called; empty for an object that is not called.
        returns: what the call has to return, or what the object has to be.
        members: attributes that the result of a call must have, where no caller checks its type.
        names: how its names look.
        adds_up: whether everything registered under one name counts, instead of the latest alone.
    """

    function: ContentFunction
    name: str
    owner: str

    kind: ClassVar[ContentKind]
    description: ClassVar[str]
    called: ClassVar[str] = ""
    returns: ClassVar[str]
    members: ClassVar[tuple[str, ...]] = ()
    names: ClassVar[str]
    adds_up: ClassVar[bool] = False

    @classmethod
    def contract(cls) -> str:
        """How content of this kind is called and what it has to return, as half a sentence."""
        if not cls.called:
            return f"it has to be {cls.returns}"
        return f"it is called as {cls.called} and has to return {cls.returns}"

    @classmethod
    def name_fault(cls, name: str, metamodels: Iterable[str]) -> str | None:
        """Why nothing will ever look up that name; None if something may.

        Args:
            name: as a plug-in registers it.
            metamodels: the names of the known metamodels.
        """
        return None

    def __call__(self, *arguments: object, **options: object) -> Any:
        """What the function returns.

        Raises:
            RuleError: it cannot be called with these arguments, or its result lacks one of the `members`.
        """
        try:
            made = self.function(*arguments, **options)
        except TypeError as error:
            if error.__traceback__ is not None and error.__traceback__.tb_next is not None:
                raise  # out of the plug-in's code
            raise self.fault(f"cannot be called as it has to be: {error}", _place(self.function)) from error
        if absent := next((name for name in self.members if not hasattr(made, name)), None):
            raise self.fault(f"gives {made!r:.60}, which has no '{absent}'", _place(self.function))
        return made

    def fault(self, what: str, location: Location | None = None) -> RuleError:
        """The error for a contribution that breaks its contract.

        Args:
            what: what is wrong with it, behind its name.
            location: where, or None.
        """
        return RuleError(
            f"the {self.kind} '{self.name}' of the plug-in {self.owner} {what}",
            location=location,
            fix=f"report it to the authors of {self.owner.partition(' ')[0]}: {self.contract()}",
        )


class ProgramReaderContribution(Contribution, frozen=True):
    """Text to model, for programs."""

    kind = "program reader"
    description = "parses a program into a code model (`ccode.ecore`)"
    called = "read(PATHS, platform=NAME, include_dirs=FOLDERS, defines=MACROS)"
    returns = "(Program, list of Finding)"
    names = "a word; `[readers]` of a `defaults.toml` maps file endings to it"


class DrawingReaderContribution(Contribution, frozen=True):
    """Text to model, for drawings."""

    kind = "drawing reader"
    description = "parses a drawing into a hardware model (`hardware.ecore`)"
    called = "read(PATH, roles=ROLES, board=BOARD)"
    returns = "(Circuit, list of Finding)"
    names = "a word; `[readers]` of a `defaults.toml` maps file endings to it"


class DrawingRecogniserContribution(Contribution, frozen=True):
    """Recognises the files of a drawing reader."""

    kind = "drawing recogniser"
    description = "recognises a drawing by its content, whatever its ending"
    called = "recognises(FIRST_BYTES)"
    returns = "whether a file that begins so is of that form"
    names = "the name of the drawing reader that reads such a file"


class PartsReaderContribution(Contribution, frozen=True):
    """Text to model, for the parts of a drawing tool."""

    kind = "parts reader"
    description = "reads part definitions of a drawing tool for `robosmi parts import`"
    called = "read(FOLDERS)"
    returns = "a PartLibrary: `parts`, `findings` and the number of `repeated` ids"
    members = ("parts", "findings", "repeated")
    names = "the drawing tool in lower case"


class DriverContribution(Contribution, frozen=True):
    """A technology of models."""

    kind = "driver"
    description = "opens a file or folder as a model that queries, rules, constraints and templates use"
    called = "driver(PATH, NAME, **OPTIONS)"
    returns = "a Model with all its abstract methods"
    names = "a word, a file ending (`.csv`), or the file that marks a folder (`/platform.toml`)"


class GeneratorContribution(Contribution, frozen=True):
    """Model to text."""

    kind = "generator"
    description = "generates the files of a target from a plan"
    called = "generate(PLAN, SOURCES)"
    returns = "a Generation, whose files are FileChanges"
    names = "a word; a target names it (`generator = ...` in `[targets.NAME]`)"


class ConstraintsContribution(Contribution, frozen=True):
    """Validation of models."""

    kind = "constraints"
    description = "constraints that `check` and the chains evaluate; those of all plug-ins add up"
    returns = "an EVL"
    names = "the metamodel of the elements: `ccode`, `hardware`, `migration`, or one of your own"
    adds_up = True

    @classmethod
    def name_fault(cls, name: str, metamodels: Iterable[str]) -> str | None:
        """A name that is nearly that of a known metamodel is misspelt; any other may be that of a metamodel of the user's."""
        meant = "" if name in metamodels else did_you_mean(name, metamodels)
        return f"no metamodel is called '{name}'{meant}" if meant else None


class ModelMigrationContribution(Contribution, frozen=True):
    """Migration of stored models."""

    kind = "model migration"
    description = "migrates stored models of an older version of a metamodel to the next"
    returns = "a ModelMigration"
    names = "the namespace URI of the older version"


class ViewContribution(Contribution, frozen=True):
    """Display in notebooks."""

    kind = "view"
    description = "shows the elements of a class in a notebook"
    called = "view(ELEMENT)"
    returns = "HTML text"
    names = "NAMESPACE#CLASS"

    @classmethod
    def name_fault(cls, name: str, metamodels: Iterable[str]) -> str | None:
        """A name without `#` is that of no class."""
        return None if "#" in name else f"'{name}' names no class ({cls.names})"


class RankerContribution(Contribution, frozen=True):
    """Ranking of libraries."""

    kind = "ranker"
    description = "ranks the libraries of a platform for a component"
    called = "ranker(PLATFORM, architecture=NAME)"
    returns = "a Ranker with the method `rank`"
    members = ("rank",)
    names = "a word, as `recommend --ranker` takes it"


class WiringFormContribution(Contribution, frozen=True):
    """Export of the wiring."""

    kind = "wiring form"
    description = "exports the wiring of a migration for `robosmi wiring --as`"
    called = "form(MODELS, OUT, PATH)"
    returns = "Handed: `files`, their `kinds`, `findings` and a `result`"
    members = ("files", "kinds", "findings", "result")
    names = "a word, as `wiring --as` takes it"


class EngineContribution(Contribution, frozen=True):
    """Simulation of a microcontroller."""

    kind = "engine"
    description = "simulates programs on microcontrollers for `simulate` and `verify`"
    called = "engine()"
    returns = "an Engine with the methods `missing`, `version`, `serves` and `run`"
    members = ("name", "missing", "version", "serves", "run")
    names = "a word, as `simulate --engine` takes it"


class DeviceContribution(Contribution, frozen=True):
    """Simulation of what is wired to a microcontroller."""

    kind = "device"
    description = "simulates a component at the pins of a simulated microcontroller"
    called = "device(BENCH, NUMBER, PINS, SETTINGS)"
    returns = "a Device (what is registered is a subclass of it)"
    names = "a word; the data of parts and scenarios name it"


class ChainContribution(Contribution, frozen=True):
    """The work of a command."""

    kind = "chain"
    description = "does the work of a command of `robosmi` or of a function of its Python interface"
    called = "chain(...)"
    returns = "what the built-in chain of that name returns"
    names = "the command, or `COMMAND_ACTION` (`parts_import`)"


class QueryContribution(Contribution, frozen=True):
    """A question of the framework to the content."""

    kind = "query"
    description = "answers a question of the framework that only the content can answer"
    called = "query(...)"
    returns = "what the built-in query of that name returns"
    names = "a word, fixed by the framework (`stack_bound`)"


class NamedQueryContribution(Contribution, frozen=True):
    """A function for queries that are given as text."""

    kind = "named query"
    description = "a function of models and elements that the expressions of `robosmi query` call by its name"
    called = "query(...), as the expression calls it"
    returns = "a value: an element, a number, a text, a Boolean, None, or a collection of values"
    names = "the name in expressions; a function of `robosmi.query` and a type of the model come before it"

    @classmethod
    def name_fault(cls, name: str, metamodels: Iterable[str]) -> str | None:
        """An expression can only name what is an identifier, and not hidden by an underscore."""
        return None if name.isidentifier() and name[0] != "_" else f"no expression can name '{name}'"

    def __call__(self, *arguments: object, **options: object) -> Any:
        """What the function returns. Another call than it takes is a mistake of the expression, not of the plug-in.

        Raises:
            UsageError: it cannot be called with these arguments.
        """
        try:
            return self.function(*arguments, **options)
        except TypeError as error:
            if error.__traceback__ is not None and error.__traceback__.tb_next is not None:
                raise  # out of the function's code
            raise UsageError(
                f"{self.name} cannot be called so: {error}", fix=f"write {self.name}{_parameters(self.function)}"
            ) from error


KINDS: Mapping[str, type[Contribution]] = {
    each.kind: each
    for each in (
        ProgramReaderContribution,
        DrawingReaderContribution,
        DrawingRecogniserContribution,
        PartsReaderContribution,
        DriverContribution,
        GeneratorContribution,
        ConstraintsContribution,
        ModelMigrationContribution,
        ViewContribution,
        RankerContribution,
        WiringFormContribution,
        EngineContribution,
        DeviceContribution,
        ChainContribution,
        QueryContribution,
        NamedQueryContribution,
    )
}
"""Every kind by its name, in the order in which they are listed."""


def unused(
    registered: Mapping[str, Mapping[str, str]], known: Mapping[str, Mapping[str, str]], metamodels: Iterable[str]
) -> Iterator[tuple[str, str]]:
    """What a plug-in registers that nothing will ever look up, because its kind or name is misspelt, as (what, why).

    Args:
        registered: kind -> names, as the plug-in registers them.
        known: kind -> names of what is there already; a kind of another plug-in's is known, too.
        metamodels: the names of the known metamodels.
    """
    kinds = {*KINDS, *known}
    for kind, names in registered.items():
        if kind not in kinds:
            yield kind, f"nothing asks for content of the kind '{kind}'{did_you_mean(kind, kinds) or _one_of(kinds)}"
        elif kind in KINDS:
            for name in names:
                if why := KINDS[kind].name_fault(name, metamodels):
                    yield f"{kind} {name}", why


def _one_of(kinds: Iterable[str]) -> str:
    return f"; there are: {', '.join(sorted(kinds))}"


def wrong_result(used: ContentFunction, made: object, expected: str, path: Path | None = None) -> RobosmiError:
    """The error for something that returned what nobody can use.

    Args:
        used: what was called.
        made: what it returned.
        expected: what it has to return.
        path: the file that it was called for, or None.
    """
    what, place = f"gives {made!r:.60}, not {expected}", Location(str(path)) if path is not None else None
    if isinstance(used, Contribution):
        return used.fault(what, place)
    return InternalError(f"{used!r} {what}", location=place, fix="this is a bug of robosmi: please report it")


def _parameters(function: ContentFunction) -> str:
    """The parameters of a function by their names, such as `(circuit, name)`."""
    import inspect  # slow to load, and only after a mistake

    return f"({', '.join(inspect.signature(function).parameters)})"


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
