"""`Gen`, the counterpart of EGX and EGL: generation rules over models, templates in Jinja2, files written all or none.

    g = Gen("out", "templates", [L])

    @g.rule(L.Book, template="book.txt", target=lambda b: f"{b.name}.txt", guard=lambda b: b.year > 1900)
    def Books(b):
        return {"title": b.name.upper()}

    g.run()

A rule says for which elements which template makes which file. It is a function: its name is the rule's, its parameter the name
by which the template knows the element, its result the template's further values. The order of evaluation is the engine's: guard,
pre, the flags, template, the function, target, then text and file, post. `templates` renders the texts, `staging` writes the
files. docs/reference/egl.md compares EGL and EGX with this.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import nullcontext
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

from msgspec import Struct

from robosmi.base.quantities import quantity
from robosmi.diagnostics import Location
from robosmi.errors import RobosmiError, RuleError, SourceError
from robosmi.files.recovery import at_work
from robosmi.generate.output import Text, text_of
from robosmi.generate.record import Record
from robosmi.generate.result import Generation, Write
from robosmi.generate.staging import Staging, as_text
from robosmi.generate.templates import Templates, Where
from robosmi.model.elements.compact_slots import collector_at_rest
from robosmi.model.elements.driver import Model
from robosmi.query.own_operations import called_for
from robosmi.query.rules.options import with_options
from robosmi.query.rules.rule_language import Given, RuleBlocks, RuleType, as_model, called, failed, place_of
from robosmi.query.rules.settings import Settings
from robosmi.query.rules.verdicts import guarded

if TYPE_CHECKING:
    from typing import Protocol

    from robosmi.base.functions import Function
    from robosmi.model.elements.driver import Item
    from robosmi.query.rules.rule_language import RuleKind

    Giving = TypeVar("Giving", bound=Callable[..., Mapping[str, Any] | None])

    class RuleDecorator(Protocol):
        """A decorator of functions that give a template its further values; they stay what they are."""

        def __call__(self, function: Giving, /) -> Giving:
            """The function that was given."""


V = TypeVar("V")
RECORD = ".robosmi/generated"
"""Where the last texts are kept below the output folder, unless said otherwise."""


class Gen(Settings):
    """A generation: rules and templates that make the files of a folder.

    Args:
        folder: the output folder, the current one if none is given; no file is made outside of it.
        templates: where templates come from: a folder, several, a mapping of names to texts; the built-in ones if None.
        models: handles or root elements; every template sees them by their names.
        keep: false for the engine's behaviour, in which edits outside of protected regions are lost; true to merge them, with the
            last texts in `.robosmi/generated` below the folder; or another place below it for the last texts.
        values: what every template sees besides, by name.
        filters: further filters for templates, by name.

    Attributes:
        models: the models.
        pre: blocks that run before the rules; `@g.pre` adds one.
        post: blocks that run after them.
        rules: the rules in their order.
    """

    def __init__(
        self,
        folder: str | Path = ".",
        templates: Where = None,
        models: Sequence[Given] = (),
        *,
        keep: bool | str = False,
        values: Mapping[str, V] | None = None,
        filters: Mapping[str, Function] | None = None,
    ) -> None:
        self.folder = Path(folder)
        if self.folder.exists() and not self.folder.is_dir():
            raise SourceError("the output path is a file", location=Location(str(folder)), fix="give another output folder")
        self.models: list[Model] = [as_model(m) for m in models]
        self.templates = Templates(templates, {**{m.name: m for m in self.models}, **(values or {})}, filters)
        self.pre = RuleBlocks()
        self.post = RuleBlocks()
        self.rules: list[GenerationRule] = []
        self._record = Record(self.folder, RECORD if keep is True else keep) if keep else None
        self._staging = self._fresh()
        self.settle(Gen)

    def give(self, values: Mapping[str, V] | None = None, filters: Mapping[str, Function] | None = None) -> None:
        """Give the templates further values and filters, before the first is rendered: for functions that add rules to a `Gen`.

        Args:
            values: what every template sees besides, by name.
            filters: further filters for templates, by name.
        """
        self.templates.give(values or {}, filters or {})

    def _fresh(self) -> Staging:
        return Staging(self.folder, self._record)

    @with_options("a rule of Gen")
    def rule(
        self,
        kind: RuleKind | None = None,
        /,
        *,
        template: str | Callable[..., str],
        target: str | Callable[..., str | None] | None = None,
        domain: Iterable[V] | Callable[[], Iterable[V]] | None = None,
        greedy: bool = False,
        guard: Flag = True,
        pre: Callable[..., object] | None = None,
        post: Callable[..., object] | None = None,
        overwrite: Flag = True,
        merge: Flag = True,
        append: Flag = False,
        formatter: Formatter | Sequence[Formatter] = (),
        name: str | None = None,
    ) -> RuleDecorator:
        """Make a function a generation rule (EGX `rule R transform x : T`).

        The function's name is the rule's. Its parameter is the name by which the template knows the element; a rule without type
        and domain runs once and its function has no parameter. What it returns, a mapping or None, are the template's further
        values (EGX `parameters`). What may be a function is called with the element, or with nothing.

        Args:
            kind: a type of a model, `L.Book` (or a class, or a name): its elements of exactly that type, in containment order.
            template: name of the template.
            target: path of the file, relative to the output folder; without one no file is made.
            domain: the elements instead (EGX `in`).
            greedy: elements of subtypes too.
            guard: for which elements the rule applies.
            pre: called before the template is chosen.
            post: called with the path of the file as last argument, or with the text where there is no target. Files are written
                at the end of the run; none of them is there yet.
            overwrite: false leaves a file that is there as it is.
            merge: false drops what protected regions of the file hold.
            append: true puts the text behind what the file holds.
            formatter: functions from text to text, applied in order.
            name: the rule's name where it cannot be the function's.

        Raises:
            RuleError: the function has other parameters, or the rule's name is taken.
        """

        def decorate(function: Giving) -> Giving:
            title = name or called(function)
            if any(rule.name == title for rule in self.rules):
                raise RuleError(f"two rules are called {title}", location=place_of(function), fix="give one another name")
            has_elements = kind is not None or domain is not None
            self.rules.append(
                GenerationRule(
                    title, variable_of(function, has_elements), function, template, target, kind, domain, greedy, guard, pre,
                    post, overwrite, merge, append, (formatter,) if callable(formatter) else tuple(formatter),
                )
            )  # fmt: skip
            return function

        return decorate

    def text(self, template: str, /, **values: V) -> Text:
        """Render a template; no file is touched.

        Args:
            template: its name.
            values: what it sees.

        Raises:
            SourceError: it does not exist, does not parse, or uses what is not defined.
        """
        return self.templates.text(template, values)

    def write(
        self,
        path: str,
        text: str,
        *,
        overwrite: bool = True,
        merge: bool = True,
        append: bool = False,
        elements: Sequence[Item] = (),
        rule: str = "",
    ) -> Path:
        """Put a text into a file of this generation; it is written with all others at the end of `run`.

        Args:
            path: relative to the output folder, with slashes.
            text: as `text` made it, or any other.
            overwrite: false leaves a file that is there as it is.
            merge: false drops what protected regions of the file hold.
            append: true puts the text behind what the file holds.
            elements: what it comes from, for the trace.
            rule: which rule made it, for the trace.

        Returns:
            The path of the file.

        Raises:
            SourceError: the path leads out of the folder, or the file that is there is no text.
        """
        self._put(path, as_text(text), (overwrite, merge, append), rule, tuple(elements))
        return self.folder / path

    def _put(self, path: str, text: Text, flags: tuple[bool, bool, bool], rule: str, elements: tuple[Item, ...]) -> None:
        self._staging.write(Write(path, text, *flags, rule, elements, self.templates.comments.styles))

    @property
    def messages(self) -> list[str]:
        """What EGL's engine says of the files so far."""
        return self._staging.messages

    def run(self, *, dry_run: bool = False) -> Generation:
        """Run the rules in their order and write all files, or none where something fails.

        What an earlier run was killed in is finished first.

        Args:
            dry_run: write nothing; the result has the diff.

        Raises:
            RuleError: a rule or template is wrong, or raises.
            SourceError: a file cannot be read or written.
            StoppedError: with `keep`, an edit would be lost.
        """
        try:
            with collector_at_rest(), nullcontext() if dry_run else at_work(self.folder):
                self._run_rules()
                return self._staging.finish(dry_run=dry_run)
        finally:
            self._staging = self._fresh()

    def make(self) -> Generation:
        """Run the rules as if the folder were empty, and give what they make; the folder is neither read nor written.

        For who writes the files himself, with others in one commit. What `post` blocks are given is not there afterwards either.

        Raises:
            RuleError: a rule or template is wrong, or raises.
            SourceError: a target lies outside of the folder.
        """
        self._staging.ignore_folder()
        try:
            with collector_at_rest():
                self._run_rules()
                return self._staging.finish(dry_run=True)
        finally:
            self._staging = self._fresh()

    def _run_rules(self) -> None:
        self.pre.run("pre")
        for rule in self.rules:
            self._apply(rule)
        self.post.run("post")

    def _apply(self, rule: GenerationRule) -> None:
        part, function = "domain", rule.parameters
        element: tuple[Any, ...] = ()
        try:
            for element in rule.elements(self.models):
                part = "guard"
                if not rule.applies_to_all and not guarded(value_of(rule.guard, element)):
                    continue
                if rule.pre is not None:
                    part = "pre block"
                    rule.pre(*element)
                part = "choice of flags and template"
                flags = rule.flags(element)
                template = value_of(rule.template, element)
                part = "function"
                values = dict(rule.parameters(*element) or ())
                if element:
                    values.setdefault(rule.variable, element[0])
                part = "target"
                target = value_of(rule.target, element)
                if not (target is None or isinstance(target, str)):
                    said = (
                        f"the target of {rule.name} is {target!r}{f' for {element[0]!r}' if element else ''}, which is not a text"
                    )
                    fix = "give the path of a file, relative to the output folder, or None for no file"
                    raise RuleError(said, location=place_of(function), fix=fix)
                part = "template"
                made = self._made(rule, element, target, template, values, flags)
                if rule.post is not None:
                    part = "post block"
                    rule.post(*element, made if target is None else self.folder / target)
        except RobosmiError as error:
            if part == "template":
                about = f" for {element[0]!r}" if element else ""
                error.message = f"{error.message} (rule {rule.name}{about})"
                raise
            raise failed(error, f"the {part} of {rule.name}", function, element[0] if element else None, self.models) from error
        except (Exception, SystemExit) as error:
            raise failed(error, f"the {part} of {rule.name}", function, element[0] if element else None, self.models) from error

    def _made(
        self,
        rule: GenerationRule,
        element: tuple[Any, ...],
        target: str | None,
        template: str,
        values: dict[str, Any],
        flags: tuple[bool, bool, bool],
    ) -> Text | None:
        """The text of a rule for an element, put into its file; None where the file is left alone."""
        overwrite, _, append = flags
        if target is not None and not overwrite and not append and self._staging.preserved(target):
            return None
        text = called_for(rule.parameters, self.templates.text, template, values)
        for formatter in rule.formatters:
            text = text_of(formatter(text), regions=text.regions)
        if target is not None:
            self._put(target, text, flags, rule.name, element)
        return text


# ---- rules

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
        merge: whether what the user wrote in protected regions is put into it.
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
            f"the function of the rule {called(function)} has {quantity(len(names), 'parameter')}",
            location=place_of(function),
            fix=f"give it {wanted}",
        )
    return names[0] if has_elements else ""
