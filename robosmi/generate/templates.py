"""Renders Jinja2 templates like EGL's, to a `Text` that knows the elements it came from; errors have their place in the template.

Templates come from folders or from a mapping of texts. Undefined names, features included, are errors; lines with nothing but a
tag are dropped; values print as in EOL. `generator` decides which template is used for which element and file.

Templates run in Jinja's sandbox. Of parts of models they may only read and call what `robosmi.model.elements.reachable` lists, as
queries do. Every access asks for this, so results are cached by class and name. Values that a Python program passes to its
templates are not restricted.

Compiled templates are cached in the user's cache folder, since compiling takes longer than rendering. The key consists of the
text, Jinja's version and our own modules.

The id of a region is derived from the model (`region_id`), so that a user's text stays with its element.
"""

from __future__ import annotations

import functools
from collections.abc import Iterable, Mapping, Sequence
from functools import partial, partialmethod
from pathlib import Path, PurePath
from types import CodeType, FrameType, FunctionType, MethodType, ModuleType, TracebackType
from typing import TYPE_CHECKING, Any

import jinja2
from jinja2.bccache import Bucket
from jinja2.runtime import Context
from jinja2.sandbox import SandboxedEnvironment, is_internal_attribute

from robosmi import resources
from robosmi.base.template_files import TemplateFiles
from robosmi.base.user_cache import code_version, read_cached, write_cached
from robosmi.diagnostics import Location
from robosmi.errors import ModelError, RobosmiError, RuleError
from robosmi.generate import quoting_filters
from robosmi.generate.output import Buffer, Text, joined, outdented, printed, text_of
from robosmi.generate.regions import partition
from robosmi.generate.template_output import Blocks, Comments, Stop, TemplateOutput
from robosmi.model.elements.containment_order import ORDERED_FEATURES, ordered_feature
from robosmi.model.elements.driver import DynamicNode, Item, ModelElement, TypeHandle, features_of, is_element, name_of, type_of
from robosmi.model.elements.ecore import EObject
from robosmi.model.elements.fragments import own_id
from robosmi.model.elements.reachable import of_models
from robosmi.query.problems import unknown_property

if TYPE_CHECKING:
    from robosmi.base.functions import Function


Where = str | Path | Sequence[str | Path] | Mapping[str, str] | None
"""Where templates come from: a folder, several, texts by name, or None for the project's and the built-in ones."""

_OF_MAPS = frozenset(dir(dict))
_KNOWN: dict[type, bool] = {}
"""Class -> whether its objects are model elements; asking pyecore and abc each time would cost more than the attribute."""


class _Environment(SandboxedEnvironment):
    """Jinja's sandbox; notes the elements that are looked at and refuses features that they do not have."""

    seen: list[Any]

    def call(self, context: Context, function: Any, /, *args: Any, **kwargs: Any) -> Any:
        if (
            function.__class__ is MethodType and function.__self__.__class__ is TemplateOutput
        ):  # asking what else Jinja may pass costs more
            kwargs.pop("_loop_vars", None)  # Jinja's own, given inside loops and blocks
            kwargs.pop("_block_vars", None)
            return function(*args, **kwargs)
        if not may_call(function):
            raise access_error(function, "()")
        return context.call(function, *args, **kwargs)

    def is_safe_attribute(self, obj: Any, attr: str, value: Any) -> bool:  # Jinja's own way to attributes, in `getitem` too
        return allowed(obj, attr)

    def unsafe_undefined(self, obj: Any, attribute: str) -> jinja2.Undefined:
        raise access_error(obj, attribute)

    def region_id(self, element: Any, *purpose: str) -> str:
        """`region_id`, which is a look at the element too."""
        self.seen.append(element)
        return region_id(element, *purpose)

    def concat(self, pieces: Iterable[str], /) -> str:  # Jinja joins macros and blocks by this
        return joined(pieces)

    def _parse(self, source: str, name: str | None, filename: str | None) -> jinja2.nodes.Template:
        from robosmi.generate.contexts import parsed  # most runs find their templates compiled

        return parsed(self, source, name, filename)

    def getattr(self, obj: Any, attribute: str) -> Any:
        if obj.__class__ is dict and attribute in obj and attribute not in _OF_MAPS and not attribute.startswith("_"):
            return obj[attribute]
        is_element = _KNOWN.get(obj.__class__)
        if is_element is None:
            is_element = _KNOWN[obj.__class__] = isinstance(obj, (EObject, ModelElement))
        if is_element:
            self.seen.append(obj)
        if not allowed(obj, attribute):
            raise access_error(obj, attribute)
        if is_element and attribute in ORDERED_FEATURES and (ordered := ordered_feature(obj, attribute)) is not None:
            return ordered
        try:
            found = getattr(obj, attribute)
            if attribute in ("format", "format_map"):  # their texts reach for attributes too
                return self.wrap_str_format(found) or found
            return found
        except AttributeError as error:
            if isinstance(error, RobosmiError):
                raise
            if is_element:
                name = name_of(type_of(obj))
                raise unknown_property(f"a {name}", attribute, features_of(obj)) from error
            return super().getattr(obj, attribute)

    def getitem(self, obj: Any, argument: Any) -> Any:  # the filters map, selectattr, sort ... go this way
        if isinstance(argument, str) and isinstance(obj, (EObject, ModelElement)):
            return self.getattr(obj, argument)
        return super().getitem(obj, argument)


class Templates:
    """The templates of a generation.

    Args:
        where: a folder, several (the first that has a template counts), or a mapping of names to texts; if None, the folders
            `templates` of the project, the user and this package (see `resources`).
        values: what every template sees, by name.
        filters: further filters, by name.
    """

    def __init__(
        self,
        where: Where = None,
        values: Mapping[str, Any] | None = None,
        filters: Mapping[str, Function] | None = None,
    ) -> None:
        self.comments = Comments()
        self._templates: dict[str, jinja2.Template] = {}
        self._contexts: dict[str, list[Context]] = {}
        self._shared = where is None and not values and not filters
        self._environment = _built_in(tuple(resources.folders("templates"))) if self._shared else _environment(_loader(where))
        self._globals = dict(self._environment.globals)
        if values or filters:
            self.give(values or {}, filters or {})

    def give(self, values: Mapping[str, Any], filters: Mapping[str, Function]) -> None:
        """Give all templates further values and filters, by name."""
        if self._shared:
            self._shared, self._environment = False, _environment(_loader(None))
        self._environment.globals.update(values)
        self._globals = dict(self._environment.globals)  # what templates have is a ChainMap, and slow
        self._environment.filters.update(filters)

    def names(self) -> list[str]:
        """The names of all templates."""
        return list(self._environment.list_templates())

    def text(self, name: str, values: Mapping[str, Any]) -> Text:
        """Render a template.

        Args:
            name: of the template.
            values: what it sees, beside the values of all.

        Raises:
            RuleError: it does not exist, does not parse, uses an undefined name, or breaks the rules of regions.
            ModelError: it asks an element for a feature that it does not have.
        """
        template = self._templates.get(name) or self._load(name)
        pool = self._contexts.setdefault(name, [])
        context = pool.pop() if pool else template.new_context()
        buffer = Buffer()
        parts = buffer.parts
        seen: list[Any] = []
        marks: list[int] = []
        taken = 0
        outer, self._environment.seen = self._environment.seen, seen
        out = TemplateOutput(self.comments, buffer)
        context.parent = {**self._globals, **values, "out": out}
        try:
            for piece in template.root_render_func(context):
                if len(seen) > taken:
                    taken = len(seen)
                    marks.append(len(parts))
                    marks.append(taken)
                parts.append(piece if piece.__class__ is str else buffer.special(piece))
            if not context.blocks:  # making a context costs more than rendering a small template
                context.vars.clear()
                context.exported_vars.clear()
                pool.append(context)
        except Stop:
            pass
        except (Exception, SystemExit) as error:
            raise self._located(error, name) from error
        finally:
            self._environment.seen = outer
        if out.open is not None:
            raise RuleError(
                f"the region '{out.open}' is never stopped, so that text in it would be lost",
                location=self._place(name, None),
                fix="stop it with {{ out.stop_preserve() }}",
            )
        text = "".join(parts)
        if out.regions:
            self._check_regions(text, out.regions, name)
        return text_of(text, parts, seen, marks, out.regions, out.named)

    def _check_regions(self, text: str, regions: list[str], name: str) -> None:
        """Make sure that the next run finds the regions again that a template has made.

        Raises:
            RuleError: one of them cannot be found, so that what the user writes there would be lost.
        """
        found = partition(text, self.comments.styles).by_id()
        for identity in regions:
            if identity not in found:
                raise RuleError(
                    f"the region '{identity}' could not be found again, so that what is written in it would be lost: text stands "
                    "behind its first marker in the same line, or its markers are changed",
                    location=self._place(name, None),
                    fix="let the line end behind the first marker",
                )

    def _load(self, name: str) -> jinja2.Template:
        try:
            found = self._templates[name] = self._environment.get_template(name)
            return found
        except jinja2.TemplateNotFound as error:
            wanted = error.name or name
            known = ", ".join(self.names()) or "no templates"
            raise RuleError(f"there is no template '{wanted}'", fix=f"use one of: {known}") from error
        except jinja2.TemplateSyntaxError as error:
            raise self._unparsed(error) from error

    def _unparsed(self, error: jinja2.TemplateSyntaxError) -> RuleError:
        return RuleError(
            f"the template does not parse: {error.message}",
            location=Location(error.filename or error.name or "template", error.lineno),
            fix="correct the template",
        )

    def _located(self, error: BaseException, name: str) -> RobosmiError:
        """The error with its location in the template."""
        if isinstance(error, jinja2.TemplateSyntaxError):
            return self._unparsed(error)
        place = self._place(name, error)
        if isinstance(error, RobosmiError):
            error.location = error.location or place
            return error
        if isinstance(error, jinja2.TemplateNotFound):
            return RuleError(f"there is no template '{error.name}'", location=place, fix=f"use one of: {', '.join(self.names())}")
        if isinstance(error, jinja2.UndefinedError):
            return RuleError(
                f"{error.message}", location=place, fix="correct the name, or give the value with the rule's parameters"
            )
        return RuleError(f"{type(error).__name__}: {error}", location=place, fix="correct the template, or what it calls")

    def _place(self, name: str, error: BaseException | None) -> Location:
        """The innermost place in a template that an error passed through, else the template."""
        import traceback  # wanted only after a mistake

        template = self._environment.get_template(name)
        found = Location(template.filename or name)
        for frame in traceback.extract_tb(error.__traceback__ if error is not None else None):
            source = self._templates_by_file().get(frame.filename)
            if source is not None and frame.lineno is not None:
                found = Location(frame.filename, source.get_corresponding_lineno(frame.lineno))
        return found

    def _templates_by_file(self) -> dict[str, jinja2.Template]:
        cache = self._environment.cache or {}
        return {t.filename: t for t in cache.values() if t.filename is not None}


@functools.cache
def _built_in(folders: tuple[Path, ...]) -> _Environment:
    """The environment of the templates in these folders; compiling them takes longer than what is made with them."""
    return _environment(TemplateFiles([str(folder) for folder in folders], found=True), auto_reload=True, cache=TemplateCache())


def _environment(loader: jinja2.BaseLoader, *, auto_reload: bool = False, cache: TemplateCache | None = None) -> _Environment:
    environment = _Environment(
        loader=loader,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,
        auto_reload=auto_reload,
        cache_size=-1,
        optimized=False,  # folding constants takes longer than it saves
        finalize=printed,
        extensions=[Blocks, quoting_filters.Declaration, "jinja2.ext.do", "jinja2.ext.loopcontrols"],
        bytecode_cache=cache,
    )
    environment.seen = []
    environment.globals["region_id"] = environment.region_id
    environment.filters.update(quoting_filters.filters(), outdent=outdented)
    return environment


class _Texts(jinja2.BaseLoader):
    """Templates by name, whose errors are placed by that name."""

    def __init__(self, texts: dict[str, str]) -> None:
        self._texts = texts

    def get_source(self, environment: jinja2.Environment, template: str) -> tuple[str, str, None]:
        if template not in self._texts:
            raise jinja2.TemplateNotFound(template)
        return self._texts[template], template, None

    def list_templates(self) -> list[str]:
        return sorted(self._texts)


def _loader(where: Where) -> jinja2.BaseLoader:
    if isinstance(where, Mapping):
        return _Texts(dict(where))
    if where is None:
        return TemplateFiles([str(folder) for folder in resources.folders("templates")], found=True)
    listed = [where] if isinstance(where, (str, Path)) else list(where)
    for folder in listed:
        if not Path(folder).is_dir():
            raise RuleError("the folder of templates does not exist", location=Location(str(folder)), fix="check the path")
    return TemplateFiles([str(folder) for folder in listed], found=False)


# ---- what a template may read and call

_OF_PATHS = frozenset(name for name in dir(PurePath) if not name.startswith("_"))
_CLOSED = (ModuleType, CodeType, FrameType, TracebackType, partial, partialmethod)
_WATCHED = (FunctionType, MethodType)
_ALLOWED: dict[tuple[type, str], bool] = {}


def allowed(obj: Any, attribute: str) -> bool:
    """Whether a template may ask an object for an attribute."""
    key = (obj.__class__, attribute)
    known = _ALLOWED.get(key)
    if known is None:
        known = _ALLOWED[key] = _judged(obj, attribute)
    return known


def _judged(obj: Any, attribute: str) -> bool:
    if attribute.startswith("_") or isinstance(obj, _CLOSED) or is_internal_attribute(obj, attribute):
        return False
    part = of_models(obj, attribute)
    if part is not None:
        return part
    return attribute in _OF_PATHS if isinstance(obj, Path) else True


def access_error(obj: Any, attribute: str) -> RuleError:
    """The error for an attribute that is not allowed."""
    return RuleError(
        f"a template may not use '{attribute}' of a {type(obj).__name__}",
        fix="compute it in the rule, and give it to the template",
    )


def may_call(function: Any) -> bool:
    """Whether a template may call an object: not a type of a model, which would make an element, nor what is marked unsafe."""
    if function.__class__ is TypeHandle:
        return False
    if function.__class__ in _WATCHED:
        return not any(getattr(function, mark, False) is True for mark in ("unsafe_callable", "alters_data"))
    return True


# ---- the cache of compiled templates

_MODULES = (
    "robosmi.generate.contexts",
    "robosmi.generate.languages",
    "robosmi.generate.output",
    "robosmi.generate.quoting_filters",
    "robosmi.generate.template_output",
    "robosmi.generate.templates",
)
"""How templates are compiled: code that an older version of these modules compiled is not used."""


class TemplateCache(jinja2.BytecodeCache):
    """The cache of the environment that has no values and filters of a caller's: what these are decides what code is made."""

    _known: str | None = None

    def _name(self, bucket: Bucket) -> str:
        if self._known is None:
            self._known = f"{jinja2.__version__}-{code_version(*_MODULES)}"
        return f"templates/{self._known}-{bucket.key}"

    def load_bytecode(self, bucket: Bucket) -> None:
        """Fill in the code of a template, if it is there."""
        if (code := read_cached(self._name(bucket))) is not None:
            bucket.bytecode_from_string(code)

    def dump_bytecode(self, bucket: Bucket) -> None:
        """Cache the code of a template."""
        write_cached(self._name(bucket), bucket.bytecode_to_string())


# ---- ids of regions


def region_id(element: Item, *purpose: str) -> str:
    """An id for a region that belongs to an element.

    It is the element's own id (the attribute that is the class's id, else its `xmi:id`) where it has one, so that a renamed or
    moved element keeps its text. Else it is the names on the way to it, which stay while others are added or reordered, but not
    when it is renamed. A position is never part of it: the text would go to another element when one is inserted.

    Args:
        element: a model element.
        purpose: what the region is for, where an element has several.

    Returns:
        For example `City/Stories/Ants body`.

    Raises:
        ModelError: it is no element, or it has no id, and it or a container has no name.
    """
    if not is_element(element):
        raise ModelError(f"{element!r} is no element of a model", fix="give the element that the region belongs to")
    own = _own_id(element)
    return " ".join([own if own is not None else _names(element), *purpose])


def _own_id(element: DynamicNode) -> str | None:
    return (own_id(element) or None) if isinstance(element, EObject) else None


def _names(element: DynamicNode) -> str:
    found: list[str] = []
    step: DynamicNode | None = element
    while step is not None:
        name = getattr(step, "name", None)
        if not (name and isinstance(name, str)):
            raise ModelError(
                f"a {name_of(type_of(step))} has neither an id nor a name, so nothing in the model says which region is its own",
                fix="give it an id attribute or a name, or write the region's id in the template",
            )
        found.append(str(name))
        step = step.eContainer()
    return "/".join(reversed(found))
