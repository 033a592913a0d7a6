"""The registry: how the framework finds content (readers, transformations, generators, chains) without knowing its name.

Content is offered by ONE kind of entry point, group `robosmi.transformations`, whose value is a function that fills a
`Registry`. The built-in content registers the same way; a source checkout that is not installed is found by the module
name alone. Nothing is imported before it is asked for: a registry holds `module:attribute` texts.
"""

from __future__ import annotations

import dis
import importlib
import os
import sys
from collections.abc import Callable, Iterable
from functools import cache
from importlib.machinery import PathFinder
from pathlib import Path
from types import ModuleType
from typing import Any

from msgspec import Struct

from robosmi import inputs
from robosmi.base.foreign_code import frames_of
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import InternalError, MissingToolError, RuleError, UsageError, did_you_mean
from robosmi.plugin_contracts import KINDS, ContentFunction, ContentKind, unused

ENTRY_POINTS = "robosmi.transformations"
BUILT_IN = "robosmi.transformations:registry"
_INFO = (".dist-info", "egg-info")


class BrokenPlugin(Struct, frozen=True):
    """A plug-in, or something it registers, that cannot be loaded and so is missing.

    Attributes:
        distribution: the installed package, with its version.
        entry_point: what cannot be loaded: the entry point's value or an offer, `module:attribute`, or a folder of data.
        cause: what was raised.
    """

    distribution: str
    entry_point: str
    cause: str

    @property
    def fix(self) -> str:
        """What to do about it."""
        return f"mend, update or uninstall {self.distribution.partition(' ')[0]}"


class Replaced(Struct, frozen=True):
    """Content that a plug-in has replaced by its own.

    Attributes:
        kind: what it is.
        name: how it is asked for.
        former: the distribution that had offered it before; empty for what is built in.
        distribution: the distribution of the plug-in.
    """

    kind: str
    name: str
    former: str
    distribution: str


class Registry:
    """Named content by kind, and folders of data.

    The kinds and what content of each has to be are in `plugin_contracts`.

    Attributes:
        entries: kind -> name -> `module:attribute`.
        more: kind and name -> what was offered under it later, for the kinds that add up.
        data: folders that hold data as a project's folder `.robosmi` does (`platform_repo/...`): a plug-in's boards, targets,
            parts, and its `defaults.toml`, which says which endings its readers take.
        broken: plug-ins that cannot be loaded.
        providers: `module:attribute` -> the plug-in's distribution; what is built in has none.
        plugins: the distributions of the plug-ins that were loaded.
        replaced: kind and name -> what a plug-in has put its own in the place of.
        asked: those of `replaced` that somebody has asked for.
    """

    def __init__(self, entries: dict[str, dict[str, str]] | None = None) -> None:
        self.entries = entries or {}
        self.more: dict[tuple[str, str], list[str]] = {}
        self.data: list[str] = []
        self.broken: list[BrokenPlugin] = []
        self.providers: dict[str, str] = {}
        self.plugins: set[str] = set()
        self.replaced: dict[tuple[str, str], Replaced] = {}
        self.asked: set[tuple[str, str]] = set()

    def add(self, kind: str, name: str, target: str) -> None:
        """Offer content. A later entry of the same kind and name replaces an earlier one; constraints add up.

        Args:
            kind: one of `plugin_contracts.KINDS`; another one is a finding if a plug-in adds it.
            name: how it is asked for; its form is in the contract of the kind.
            target: `module:attribute`, imported only when asked for.
        """
        known = self.entries.setdefault(kind, {})
        if _adds_up(kind) and known.setdefault(name, target) != target:
            self.more.setdefault((kind, name), []).append(target)
        else:
            known[name] = target

    def add_data(self, folder: str) -> None:
        """Offer a folder of data; it counts before the built-in data and behind the user's own.

        Args:
            folder: absolute path; one that is not there is passed over with a warning.
        """
        self.data.append(folder)

    def names(self, kind: ContentKind) -> list[str]:
        """The names of a kind, sorted."""
        return sorted(self.entries.get(kind, {}))

    def get(self, kind: ContentKind, name: str) -> Any:
        """Import and return the content of that kind and name; of several the first.

        Raises:
            UsageError: nothing of that name is registered.
            MissingToolError: it is a plug-in's and cannot be imported.
            InternalError: it is built in and cannot be imported.
        """
        known = self.entries.get(kind, {})
        if name not in known:
            broken = f"; not loaded: {', '.join(p.distribution for p in self.broken)} (robosmi doctor)" if self.broken else ""
            raise UsageError(
                f"no {kind} is called '{name}'{did_you_mean(name, known)}{broken}",
                fix=f"use one of: {', '.join(sorted(known)) or 'none is installed'}",
            )
        if (kind, name) in self.replaced:
            self.asked.add((kind, name))
        return self._load(known[name])

    def all(self, kind: ContentKind, name: str) -> list[tuple[Any, str]]:
        """Everything of that kind and name, each with the distribution that offers it (empty for what is built in).

        What is a plug-in's and cannot be imported is left out, and from then on among `broken`.

        Raises:
            InternalError: something is built in and cannot be imported.
        """
        targets = [target for target in self.targets(kind, name) if self._there(target)]
        return [(self._load(target), self.providers.get(target, "")) for target in targets]

    def check(self) -> None:
        """Import everything that plug-ins offer; what cannot be imported is among `broken` then."""
        for target in self.providers:
            self._there(target)

    def _there(self, target: str) -> bool:
        """Whether an offer can be imported; that of a plug-in which cannot be is put to `broken`, once."""
        distribution = self.providers.get(target, "")
        if not distribution:
            return True
        try:
            self._load(target)
        except MissingToolError as error:
            if not any(each.entry_point == target for each in self.broken):
                self.broken.append(BrokenPlugin(distribution, target, _said(error.__cause__)))
            return False
        return True

    def targets(self, kind: str, name: str) -> list[str]:
        """`module:attribute` of everything of that kind and name, in the order in which it was offered."""
        first = self.entries.get(kind, {}).get(name)
        return [] if first is None else list(dict.fromkeys([first, *self.more.get((kind, name), ())]))

    def owner(self, kind: ContentKind, name: str) -> str:
        """The distribution of the plug-in that offers the content of that kind and name; empty for what is built in."""
        return self.providers.get(self.entries.get(kind, {}).get(name, ""), "")

    def owners(self, kind: ContentKind, name: str) -> list[str]:
        """The distributions whose content of that kind and name counts; empty for what is built in."""
        return list(dict.fromkeys(self.providers.get(target, "") for target in self.targets(kind, name)))

    def provider(self, module: str) -> str:
        """The distribution whose plug-in has that module (`package.module`); empty for what is built in."""
        package = module.partition(".")[0]
        mine = (name for target, name in self.providers.items() if target.partition(":")[0].partition(".")[0] == package)
        return next(mine, "")

    def take(self, other: Registry, distribution: str) -> None:
        """Take over what a plug-in offers.

        Args:
            other: filled by the plug-in.
            distribution: its name, or empty for what is built in.
        """
        faults = list(unused(other.entries, self.entries, self.entries.get("constraints", {}))) if distribution else []
        self.broken += [BrokenPlugin(distribution, what, why) for what, why in faults]
        for kind, names in other.entries.items():
            for name in names:
                before = self.entries.get(kind, {}).get(name)
                if before is not None and distribution and not _adds_up(kind):
                    self.replaced[kind, name] = Replaced(kind, name, self.providers.get(before, ""), distribution)
                for target in other.targets(kind, name):
                    self.add(kind, name, target)
                    if distribution:
                        self.providers[target] = distribution
        self.data += other.data
        if distribution:
            self.plugins.add(distribution)
            self.broken += [
                BrokenPlugin(distribution, folder, "there is no such folder of data")
                for folder in other.data
                if not os.path.isdir(folder)
            ]

    def _load(self, target: str) -> Any:
        distribution = self.providers.get(target, "")
        if not distribution:
            return load(target)
        module, _, attribute = target.partition(":")
        try:
            return getattr(importlib.import_module(module), attribute)
        except (Exception, SystemExit) as error:
            raise MissingToolError(
                f"'{target}' of the plug-in {distribution} cannot be loaded: {_said(error)}",
                location=_place_of_syntax(error),
                fix=f"mend, update or uninstall {distribution.partition(' ')[0]}",
            ) from error


def _adds_up(kind: str) -> bool:
    return kind in KINDS and KINDS[kind].adds_up


def load(target: str) -> Any:
    """The object behind `module:attribute`.

    Raises:
        InternalError: the module or the attribute does not exist.
        MissingToolError: a package that the module needs cannot be loaded.
    """
    module, _, attribute = target.partition(":")
    try:
        return getattr(importlib.import_module(module), attribute)
    except (ImportError, AttributeError) as error:
        if (missing := unloadable(error)) is not None:
            raise missing from error
        raise InternalError(f"'{target}' is registered but cannot be loaded: {error}") from error


@cache
def registry() -> Registry:
    """The registry of this process, filled from the entry points at the first call; damaged plug-ins are in its `broken`."""
    result = Registry()
    load(BUILT_IN)(result)
    if not others_may_offer(sys.path):
        return result
    from importlib.metadata import entry_points

    points = {point.value: point for point in entry_points(group=ENTRY_POINTS)}
    for value, point in points.items():
        if value == BUILT_IN:
            continue
        distribution = f"{point.dist.name} {point.dist.version}" if point.dist is not None else point.name
        offered = Registry()  # apart, so that of a plug-in that fails half-way nothing counts
        try:
            fill: Callable[[Registry], None] = point.load()
            fill(offered)
        except (Exception, SystemExit) as error:
            result.broken.append(BrokenPlugin(distribution, value, _said(error)))
        else:
            result.take(offered, distribution)
    return result


def others_may_offer(folders: Iterable[str]) -> bool:
    """Whether an installed distribution but our own offers something, or may do so where it is not seen at a glance.

    `importlib.metadata` would know for certain, but loading it takes longer than many a command, and few people have plug-ins.

    Args:
        folders: where distributions are installed, as `sys.path` has them.
    """
    if any("find_distributions" in dir(finder) for finder in sys.meta_path if finder is not PathFinder):
        return True
    for folder in folders:
        try:
            names = os.listdir(folder or ".")
        except FileNotFoundError:
            continue
        except OSError:  # an archive
            return True
        for name in names:
            if name.endswith(".egg"):
                return True
            if name.lower().endswith(_INFO) and _offers(os.path.join(folder, name, "entry_points.txt")):
                return True
    return False


def _offers(path: str) -> bool:
    """Whether a file of entry points has one of our group that is not our own."""
    try:
        text = inputs.read_text(path, inputs.SETTINGS)
    except (FileNotFoundError, NotADirectoryError):
        return False
    except (OSError, UnicodeDecodeError):
        return True
    section = text.partition(f"[{ENTRY_POINTS}]")[2].partition("\n[")[0]
    return any(line.partition("=")[2].strip() != BUILT_IN for line in section.splitlines() if "=" in line)


def unloadable(error: BaseException) -> MissingToolError | RuleError | None:
    """The error for a package that cannot be loaded, whatever it raised; None for any other exception.

    Of our own package this is a file with a syntax error, in the checkout of somebody who changes it.
    """
    place = _place_of_syntax(error)
    if isinstance(error, SyntaxError) and place is not None and _of_checkout(place.path):
        return RuleError(_said(error, named=False), location=place, fix="correct the line")
    if isinstance(error, ImportError) and error.name:
        foreign = not is_own(error.name) and (error.__traceback__ is None or _came_of_an_import(error))
    elif isinstance(error, AttributeError) and isinstance(error.obj, ModuleType):
        foreign = not is_own(error.obj.__name__)
    else:
        foreign = _came_of_an_import(error)
    if not foreign:
        return None
    cause = str(error) if isinstance(error, (ImportError, AttributeError)) else _said(error)
    return MissingToolError(
        f"a package that robosmi needs cannot be loaded: {cause}",
        fix="install robosmi again in a fresh environment (robosmi doctor says what is there)",
    )


def _said(error: BaseException | None, named: bool = True) -> str:
    """An exception as text; of a syntax error with its whole path, if `named`, where Python has the name alone."""
    text = error.msg if isinstance(error, SyntaxError) else str(error)
    place = _place_of_syntax(error) if named else None
    return f"{type(error).__name__}: {text}{f' ({place.path}, line {place.line})' if place is not None else ''}"


def _place_of_syntax(error: BaseException | None) -> Location | None:
    if not isinstance(error, SyntaxError) or not error.filename:
        return None
    return Location(error.filename, error.lineno, error.offset)


def _of_checkout(file: str) -> bool:
    """Whether a file is one of a source checkout of this package, which somebody may be writing; an installed one is damaged."""
    import robosmi

    path = Path(file)
    return (
        path.is_absolute() and "site-packages" not in path.parts and any(path.is_relative_to(root) for root in robosmi.__path__)
    )


def _came_of_an_import(error: BaseException) -> bool:
    """Whether the last code of ours on the way to an exception was importing something."""
    own, importing = False, False
    trace = error.__traceback__
    while trace is not None:
        module = trace.tb_frame.f_globals.get("__name__", "")
        if is_own(module):
            own = True
            importing = dis.opname[trace.tb_frame.f_code.co_code[trace.tb_lasti]].startswith("IMPORT_")
        elif own and module.partition(".")[0] == "importlib":
            importing = True
        own = is_own(module)
        trace = trace.tb_next
    return importing


def is_own(module: str) -> bool:
    """Whether a module, by its name, is one of this package."""
    return module.partition(".")[0] == "robosmi"


def raised_by(error: BaseException) -> RuleError | None:
    """The error that names the plug-in whose code an exception came out of; None where it was no plug-in's."""
    if not registry.cache_info().currsize:
        return None
    for frame, line in reversed(list(frames_of(error))):
        if owner := registry().provider(frame.f_globals.get("__name__", "")):
            return RuleError(
                f"the plug-in {owner} raised {type(error).__name__}: {error}",
                location=Location(frame.f_code.co_filename, line),
                fix=f"report it to the authors of {owner.partition(' ')[0]}; ROBOSMI_DEBUG=1 shows where it happened",
            )
    return None


def plugin_findings() -> list[Finding]:
    """A warning for each plug-in that could not be loaded, and for each one whose content replaced other content.

    There are none before the registry was used; replaced content that was never asked for is not reported.
    """
    if not registry.cache_info().currsize:
        return []
    known = registry()
    broken = [
        Finding(
            "RS908",
            Severity.warning,
            f"the plug-in {plugin.distribution} ('{plugin.entry_point}') cannot be loaded: {plugin.cause}",
            fix=plugin.fix,
        )
        for plugin in known.broken
    ]
    return broken + [
        Finding(
            "RS910",
            Severity.warning,
            f"the {each.kind} '{each.name}' is that of the plug-in {each.distribution}, "
            f"not {f'that of the plug-in {each.former}' if each.former else 'the built-in one'}",
            fix=f"uninstall {each.distribution.partition(' ')[0]} if that is not meant, or let it use a name of its own",
        )
        for key, each in known.replaced.items()
        if key in known.asked
    ]


def content(kind: ContentKind, name: str) -> ContentFunction:
    """The registered function of that kind and name; a wrong call of a plug-in's function is an error that blames the plug-in."""
    found: ContentFunction = registry().get(kind, name)
    owner = registry().owner(kind, name)
    return KINDS[kind](found, name, owner) if owner else found
