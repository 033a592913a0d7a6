"""Names of modules, public names and test files are made of the field's words, not of the project's own (docs/glossary.md)."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

from tests.source_imports import FACES, ROOT, module_name, modules, tree_of

WORDS = """
adopted anything asked asking asks bare behind beside border borders built deep doing doubt doubts drawn earlier elsewhere erl
foresee foresees foresight gen held hold holder holding holds judged judging keep keeping keeps kept lean leeway made making
mend mended mending mends offered offers out racy refused refuses renewed said say saying says seen shut tell telling tells told
unasked unsaid wanted wants want
"""
PRIVATE = frozenset(WORDS.split())
"""Words that a name may not have: the field has a term for each."""
PHRASES = ("by_hand", "exact_texts", "excess_values", "in_order", "open_folder", "places_of_rest", "quick_ecore", "second_look",
           "turning_points", "way_marks")  # fmt: skip
"""Groups of ordinary words that the field has a term for."""
ORDINARY = ("built_in", "deep_recursion", "left_out", "put_out", "time_out", "read_out", "out_of")
"""Groups with a word of the list in its ordinary meaning."""
MOST = 10


def listed() -> dict[str, str]:
    """The words that may stay -> the reason."""
    lines = (ROOT / "tests/private_words.txt").read_text(encoding="utf-8").splitlines()
    return dict(line.split(maxsplit=1) for line in lines if line and not line.startswith("#"))


def private(name: str) -> frozenset[str]:
    """The private words and phrases in a name, in any spelling."""
    words = re.findall(r"[A-Z]+(?![a-z])|[A-Z][a-z]*|[a-z]+|[0-9]+", name)
    spelt = f"_{'_'.join(words).lower()}_"
    for ordinary in ORDINARY:
        spelt = spelt.replace(f"_{ordinary}_", "_")
    return PRIVATE.intersection(spelt.split("_")) | {phrase for phrase in PHRASES if f"_{phrase}_" in spelt}


def is_rule(node: ast.stmt) -> bool:
    """Whether a definition is a constraint: its name is the name of a rule, which users see and suppress."""
    decorators = node.decorator_list if isinstance(node, ast.FunctionDef | ast.ClassDef) else []
    return any(re.search(r"\b(constraint|critique)\b", ast.unparse(decorator)) for decorator in decorators)


def public_names(path: Path) -> Iterator[str]:
    """The public functions, classes, constants and methods of a module."""
    for node in tree_of(path).body:
        if isinstance(node, ast.ClassDef):
            yield node.name
            if not node.name.startswith("_"):
                yield from (part.name for part in node.body if isinstance(part, ast.FunctionDef | ast.AsyncFunctionDef))
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            yield from () if is_rule(node) else (node.name,)
        elif isinstance(node, ast.Assign | ast.AnnAssign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            yield from (target.id for target in targets if isinstance(target, ast.Name))


def named() -> Iterator[tuple[str, str]]:
    """Each name that the rule is for, and where it is."""
    for path in modules("robosmi", "transformations"):
        where = path.relative_to(ROOT).as_posix()
        if module_name(path) not in FACES:
            yield path.stem, where
        yield from ((name, where) for name in public_names(path) if not name.startswith("_"))
    for path in modules("tests"):
        if path.parent.parent != ROOT / "tests" / "epsilon" / "ports":  # named as the engine's cases
            yield path.stem, path.relative_to(ROOT).as_posix()


def test_names_have_the_words_of_the_field() -> None:
    allowed = listed()
    wrong = [
        f"{where}: {name} ({', '.join(sorted(words))})" for name, where in named() if (words := private(name) - set(allowed))
    ]
    assert wrong == []


def test_at_most_ten_private_words_stay_each_used_and_with_its_reason() -> None:
    words = listed()
    used = {word for name, _ in named() for word in private(name)}
    assert len(words) <= MOST
    assert set(words) <= used
    assert all(len(reason.split()) > 3 for reason in words.values())


def test_words_are_found_in_every_spelling() -> None:
    assert private("kept_program") == private("KeptProgram") == private("KEPT") == {"kept"}
    assert private("by_hand") == {"by_hand"}
    assert private("TurningPoints") == {"turning_points"}
    assert private("built_in") == private("left_out_text") == private("generator") == private("output_paths") == set()
    assert private("rebuilt_in") == set()
    assert private("built_program") == {"built"}
