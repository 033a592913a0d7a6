"""Finds what the user's code includes: libraries of its own, and headers that the generated program no longer needs.

A library disappears from the program with its component. If the user's body that uses it stays, its header has to stay, too.
Only texts are examined, with the library index's knowledge of headers.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Mapping
from typing import Any

from robosmi.errors import PlatformDataError, UsageError
from robosmi.metamodels import migration
from robosmi.query import Q
from robosmi.recommend.index import Library
from robosmi.transformations.knowledge.lexer import tokens
from robosmi.transformations.knowledge.libraries.library_ranking import libraries_by_header, library_api
from robosmi.transformations.knowledge.platforms.target_platform import target_facts
from robosmi.transformations.m2m.choices.library_choice import LibraryModels
from robosmi.transformations.queries.plans.plan import target_of
from robosmi.transformations.queries.reports.written_bodies import AS_BYTES

_MOST = 8
"""Limit on the libraries examined for one header name; the likeliest come first."""
_INCLUDE = re.compile(r"^[ \t]*#[ \t]*include[ \t]*[<\"]([^>\"\n]+)[>\"].*$", re.MULTILINE)


def needed_still(texts: Mapping[str, tuple[str, str, str]], platform: str) -> dict[str, list[str]]:
    """The headers that are no longer generated but still needed: header -> the person's names that come from it, in order.

    Args:
        texts: path of a file of code -> the text that was made last, the one that is there, the one that is made anew.
        platform: whose libraries; empty for none.

    A header that the index knows nothing of is needed by names that have its own in them, `EncoderPair` for `Encoder.h`.
    """
    gone = dict.fromkeys(header for last, there, made in texts.values() for header in _leaving(last, there, made))
    own = Counter[str]()
    for last, there, _ in texts.values() if gone else ():
        own += Counter(_names(there)) - Counter(_names(last))
    found = dict[str, list[str]]()
    for header in gone:
        offered, stem = _offered(header, platform), header.rpartition("/")[2].partition(".")[0].lower()
        used = [name for name in own if name in offered or (not offered and stem in name.lower())]
        if used:
            found[header] = used
    return found


def own_includes(texts: Mapping[str, tuple[str, str, str]]) -> list[str]:
    """The headers that the user has included, in order; `texts` as for `needed_still`."""
    return list(dict.fromkeys(h for last, there, _ in texts.values() for h in _included(there) if h not in _included(last)))


def set_own_libraries(plan: migration.MigrationPlan, headers: Collection[str]) -> bool:
    """Set the libraries whose headers the user's code needs, so that the project files list them; whether that changes the plan.

    One that is not in the registry, such as those that come with a core, is not installed by its name.
    """
    platform = libraries_for(plan) if headers else ""
    names = [found[0].name for header in headers if (found := _with_header(header, platform)) and found[0].in_registry]
    libraries = [library_of(plan, str(name)) for name in dict.fromkeys(names)]
    if [*plan.ownLibraries] == libraries:
        return False
    plan.ownLibraries.clear()
    plan.ownLibraries.extend(libraries)
    return True


def libraries_for(plan: migration.MigrationPlan) -> str:
    """The platform whose libraries are for the target of a plan; empty where it takes none."""
    return str(target_of(plan).libraryIndex or "")


def library_of(plan: migration.MigrationPlan, name: str) -> Any:
    """The library element of a name in the plan, added from the library index if it is missing.

    Raises:
        UsageError: no library has that name.
    """
    assert plan.target is not None
    found = Q(plan.target.libraries).select_one(lambda library: library.name == name)
    if found is not None:
        return found
    assert plan.board is not None
    facts = target_facts(plan.targetDescription.name if plan.targetDescription is not None else "")
    if not facts.libraries:
        raise UsageError(f"the target '{facts.target}' has no libraries to choose", fix="choose: none")
    known = {str(library.name) for library in plan.target.libraries}
    models = LibraryModels(facts, plan.board)
    chosen = models.get(name)
    plan.target.libraries.extend(library for own, library in models.elements.items() if own not in known)
    plan.target.coreLibraries.extend(facts.own_platform.coreLibraries)
    return Q(plan.target.libraries).select_one(lambda library: library.name == chosen.name)


def without_includes(text: str, headers: Mapping[str, list[str]], made: str) -> tuple[str, list[str]]:
    """A text without the lines that include some headers, so that the same lines of the user's text count as written by them.

    Args:
        text: the text that was made last.
        headers: as `needed_still` gives them.
        made: the text that is made anew; what it includes is no matter.

    Returns:
        The text, and the headers whose lines were taken out.
    """
    staying = set(_included(made))
    taken, lines = list[str](), list[str]()
    for line in text.splitlines(keepends=True):
        here = [header for header in _included(line) if header in headers and header not in staying]
        taken += here
        lines += [line] * (not here)
    return "".join(lines), taken


def _with_header(header: str, platform: str) -> tuple[Library, ...]:
    """The libraries that offer a header, the likeliest first."""
    try:
        return libraries_by_header(header.rpartition("/")[2], platform) if platform else ()
    except PlatformDataError:
        return ()  # the platform has no index


def _leaving(last: str, there: str, made: str) -> list[str]:
    """The headers that a text includes, now and when it was last generated, and that are no longer generated."""
    before, now = set(_included(last)), set(_included(made))
    return [header for header in _included(there) if header in before - now]


def _included(text: str) -> list[str]:
    """The headers that a text includes, in its order."""
    return [str(found.group(1)) for found in _INCLUDE.finditer(text)]


def _names(text: str) -> list[str]:
    return [word for kind, *_, word in tokens(text.encode("utf-8", AS_BYTES)) if kind == "name"]


def _offered(header: str, platform: str) -> set[str]:
    """The names that libraries with this header declare; empty if the index knows none."""
    found = set[str]()
    for library in _with_header(header, platform)[:_MOST]:
        for api in library_api(str(library.name), platform).headers:
            found |= {str(each.name) for each in api.classes} | {str(each.name) for each in api.functions} | set(api.constants)
            found |= {name for values in api.enums.values() for name in values}
    return found
