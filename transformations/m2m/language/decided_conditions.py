"""Fixes preprocessor conditions that the target would decide differently (`#ifdef ARDUINO`, `#if INT_MAX > 40000`).

What was compiled on the source is what the program means, so such a condition is replaced by its value there (0 or 1), with the
original text as a comment. Conditions on the program's own macros, and on macros that nobody defines, stay as they are.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.platforms.target_names import TargetNames
from robosmi.transformations.knowledge.replacements import Replacement
from robosmi.transformations.m2m.language.shared_names import linkage
from robosmi.transformations.m2m.language.text_change import Change
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.source_text import SourceText

RULE = "decided-condition"
_BRANCHES = ("if", "ifdef", "ifndef", "elif", "elifdef", "elifndef")
_WORD = re.compile(r"(?<![\w.'\"])[A-Za-z_]\w*")
_OF_WIDTHS = re.compile(
    r"(?:U?(?:CHAR|SHRT|INT|LONG|LLONG)|SCHAR|SIZE|U?INT(?:PTR|MAX|\d+))_(?:MAX|MIN)|__\w+_MAX__|__SIZEOF_\w+__"
)
"""Macros for sizes and limits of types, which differ between microcontrollers."""
_OF_LANGUAGE = frozenset({
    "__cplusplus", "__STDC_VERSION__", "__CHAR_UNSIGNED__", "true", "and", "and_eq", "bitand", "bitor", "compl", "not", "not_eq",
    "or", "or_eq", "xor", "xor_eq",
})  # fmt: skip
"""Names that a condition of C++ reads differently, and that depend on the sign of plain char."""
_OF_PLACE = frozenset({"__LINE__", "__COUNTER__", "__INCLUDE_LEVEL__"})
"""Macros whose value follows from where the text stands."""
_CHARACTER = re.compile(r"'(?:\\(?>x[0-9a-fA-F]++|[0-7]++|.)|[^'\\])++'")


def decided_conditions(views: Sequence[CodeView], sources: Mapping[str, bytes], names: TargetNames) -> Iterator[Change]:
    """Find the directives whose condition has to keep the value it had on the source.

    Args:
        views: a view of each unit.
        sources: path of a unit -> its bytes.
        names: the target's names.
    """
    bodies = {str(m.name): str(m.body or "") for view in views for m in view.unit.macros}
    for view in views:
        asked = list(_asked(view.unit))
        linked = [change.element for change in linkage(view, sources[view.unit.path], {})] if asked else []
        for directive in asked:
            words = _words(str(directive.condition or ""), bodies)
            foreign = [word for word in words if word not in bodies and _differs(word, view, names)]
            texts = [str(directive.condition or ""), *(bodies[word] for word in words if word in bodies)]
            foreign += [text for each in texts for text in _CHARACTER.findall(each) if _has_sign(text)]
            if foreign and directive not in linked:
                reason = f"'{foreign[0]}' differs on the target: the condition keeps its result from the source"
                yield Change(directive, RULE, "", reason)


def _asked(unit: ccode.SourceUnit) -> Iterator[ccode.PreprocessorConditional]:
    """The directives whose conditions were evaluated on the source; those in excluded text were not."""
    around: list[bool] = []  # of each open condition, whether the text around it was compiled
    compiled: list[bool] = []  # of each, whether its branch is
    for directive in unit.conditionals:
        if directive.directive in ("if", "ifdef", "ifndef"):
            around.append(all(compiled))
            compiled.append(bool(directive.active))
        elif directive.directive == "endif":
            if compiled:
                around.pop()
                compiled.pop()
            continue
        elif compiled:
            compiled[-1] = bool(directive.active)
        if directive.directive in _BRANCHES and around and around[-1]:
            yield directive


def _words(condition: str, bodies: dict[str, str]) -> list[str]:
    """The names in a condition, including those in the bodies of the program's macros that it uses."""
    pending, seen = [condition], dict[str, None]()
    while pending:
        for word in _WORD.findall(pending.pop()):
            if word not in seen and word != "defined":
                seen[word] = None
                if word in bodies:
                    pending.append(bodies[word])
    return list(seen)


def _differs(word: str, view: CodeView, names: TargetNames) -> bool:
    """Whether a name that the program does not define may be a different macro on the target than on the source."""
    if word in _OF_LANGUAGE | _OF_PLACE or (word in names.macros and word not in names.same) or _OF_WIDTHS.fullmatch(word):
        return True
    if word in {str(define).partition("=")[0] for define in view.api.settings["parser"].get("defines", [])}:
        return True
    entry = view.resolve(word)
    return entry is not None and entry.kind != "function" and view.api.kind_of(entry) == "platform"


def _has_sign(character: str) -> bool:
    """Whether a character constant of a condition has another value where plain char has a sign, or `int` fewer bits."""
    inner = character[1:-1]
    escape = re.fullmatch(r"\\(?:x([0-9a-fA-F]+)|([0-7]+))", inner)
    if escape is not None:
        return int(escape[1] or escape[2], 16 if escape[1] else 8) > 127
    return (len(inner) > 1 and not re.fullmatch(r"\\.", inner)) or not inner.isascii()


def as_decided(directive: ccode.PreprocessorConditional, text: SourceText) -> list[Replacement]:
    """The change, as (first byte, byte after the last, new text), that replaces the condition by its value on the source."""
    start, end = int(directive.startOffset), int(directive.endOffset)
    word = "elif" if str(directive.directive).startswith("elif") else "if"
    said = " ".join(text.data[start:end].decode("utf-8", "replace").replace("\\\n", " ").replace("\\\r\n", " ").split())
    shown = said.removeprefix("#").strip().replace("/*", "").replace("*/", "")
    return [Replacement(start, end, f"#{word} {int(bool(directive.active))} /* {shown} */")]
