"""Renames the program's names that the target needs for itself.

C++ reserves words that C does not, and a sketch shares its names with the target's core and its adapters. Such a name is
renamed at every place, in macros too, so that generated text keeps meaning the target's. A local that merely hides a name
stays.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence

from msgspec import Struct

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.platforms.target_names import TargetNames
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.macros.tokens import name_tokens

RENAME = "rename"
"""Rule of dispositions: the name differs in the sketch."""
RENAME_HERE = "rename-here"
"""Rule of dispositions: the name differs in the sketch, in one file."""


class Renaming(Struct, frozen=True):
    """A name that changes.

    Attributes:
        element: the first declaration or macro with the name.
        name: the name in the source.
        new: the name in the sketch.
        reason: the reason, in one sentence.
    """

    element: ccode.Located
    name: str
    new: str
    reason: str


def renamings(views: Sequence[CodeView], sources: Mapping[str, bytes], names: TargetNames) -> list[Renaming]:
    """The names that have to change, in the order of their first declaration.

    Args:
        views: a view of each unit.
        sources: path of a unit -> its bytes.
        names: the target's names.
    """
    found: dict[str, Renaming] = {}
    taken: set[str] | None = None
    for declaration, top in _declarations(views):
        name = str(declaration.name or "")
        if not name or name in found or (name == "main" and isinstance(declaration, ccode.Function)):
            continue
        if name in names.keywords:
            reason = f"'{name}' is a keyword of the target's language"
        elif name in names.macros:
            reason = f"the target or an adapter has a macro '{name}'"
        elif top and name in names.declared:
            reason = f"the target or an adapter declares '{name}', too"
        elif name in names.statements and isinstance(declaration, ccode.Macro):
            reason = f"a statement that an adapter needs in setup uses '{name}'"
        else:
            continue
        if taken is None:
            taken = _words(views, sources)
        found[name] = Renaming(declaration, name, _free(name, taken, names), reason)
    return list(found.values())


def hidden_adapters(
    views: Sequence[CodeView], sources: Mapping[str, bytes], names: TargetNames, served: Collection[str]
) -> list[Renaming]:
    """The static functions that have the name of an adapter, which other files of the program call; each changes in its file.

    Args:
        views: a view of each unit.
        sources: path of a unit -> its bytes.
        names: the target's names.
        served: the functions that have an adapter.
    """
    found = [d for view in views for d in view.unit.declarations if isinstance(d, ccode.Function) and d.name in served]
    hiding = [each for each in found if each.definition and each.storage is ccode.Storage.staticStorage]
    taken = _words(views, sources) if hiding else set()
    reason = "an adapter that other files call has the name of a static function"
    return [Renaming(each, str(each.name), _free(str(each.name), taken, names), reason) for each in hiding]


def _words(views: Sequence[CodeView], sources: Mapping[str, bytes]) -> set[str]:
    return {text for view in views for _, _, text in name_tokens(sources[view.unit.path])}


def _free(name: str, taken: set[str], names: TargetNames) -> str:
    """A new name like another one that nothing has; it is taken then."""
    new = f"{name}_"
    while new in taken or new in names.macros | names.declared | names.keywords:
        new += "_"
    taken.add(new)
    return new


def _in_c_alone(macro: ccode.Macro, unit: ccode.SourceUnit) -> bool:
    """Whether a macro is defined only if the text is not compiled as C++."""
    conditions: list[str] = []
    for directive in unit.conditionals:
        if directive.startOffset > macro.startOffset:
            break
        if directive.directive in ("if", "ifdef", "ifndef"):
            conditions.append(f"{directive.directive} {directive.condition or ''}")
        elif directive.directive == "endif" and conditions:
            conditions.pop()
        elif conditions:  # another branch
            conditions[-1] = ""
    return any(_C_ALONE.match(condition) for condition in conditions)


_C_ALONE = re.compile(r"ifndef\s+__cplusplus\b|if\s+!\s*defined\s*+\(?\s*+__cplusplus\b")


def _declarations(views: Iterable[CodeView]) -> Iterator[tuple[ccode.Declaration | ccode.Macro | ccode.Label, bool]]:
    """Every declaration, label and macro of the program, and whether it is visible outside of a function."""
    for view in views:
        yield from ((macro, True) for macro in view.unit.macros if not _in_c_alone(macro, view.unit))
        yield from ((label, False) for label in view.of_kind(ccode.Label))
        top = {id(d) for d in view.unit.declarations}
        for declaration in view.of_kind(ccode.Declaration):
            literal = isinstance(declaration, ccode.EnumerationLiteral) and id(declaration.eContainer()) in top
            yield declaration, id(declaration) in top or literal
