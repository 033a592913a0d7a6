"""Hostile texts into a migration: titles, connectors, parts, file names; no code, link or tag may come of any.

Usage: python -m tests.fuzz.quoting [--inputs N] [--seed N]. Run by hand (`make fuzz`), not by CI. The same seed gives the same
texts. Half of the inputs are drawings with other titles, half stored models with other texts; judges are libclang, a CommonMark
parser and PyYAML.
"""

from __future__ import annotations

import argparse
import random
import sys
import tempfile
import traceback
from collections import Counter
from pathlib import Path

import yaml

from tests.fuzz.costs import Costs, TooLong
from tests.quoting import judges
from tests.quoting.migration import declared_names, plan_with_titles, shape_of, texts_of, with_texts

MARKUP = {"link_open", "image", "html_block", "html_inline"}


def wrong_with(texts: dict[str, str], shape: dict[str, list[str]]) -> str:
    """What is wrong with the files of a sketch; empty for nothing."""
    names = declared_names(texts["line_follower.ino"])
    if shape_of(texts) != shape:
        return "other tokens of code"
    if len(set(names)) != len(names) or any(judges.problems(f"extern int {name};\n", "x.cpp") for name in names):
        return "names"
    if MARKUP & set(judges.markdown_kinds(texts["MIGRATION.md"])):
        return "markup in the report"
    if set(yaml.safe_load(texts["sketch.yaml"])) != {"profiles", "default_profile"}:
        return "sketch.yaml"
    return "what acts on a terminal" if judges.acts_on_terminal("".join(texts.values())) else ""


def main() -> int:
    """The command line; the exit code is 1 when a text did something."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--inputs", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    counts = Counter[str]()
    costs = Costs()
    with tempfile.TemporaryDirectory() as scratch:
        shape = shape_of(texts_of(plan_with_titles(Path(scratch), ())))
        for number in range(arguments.inputs):
            chance = random.Random(f"{arguments.seed} {number}")
            try:
                with costs.input():
                    models = plan_with_titles(Path(scratch), [judges.any_text(chance) for _ in range(7 * (number % 2))])
                    if number % 2 == 0:
                        with_texts(models, lambda chance=chance: judges.any_text(chance))  # type: ignore[misc]
                    wrong = wrong_with(texts_of(models), shape)
            except TooLong as error:
                wrong = f"hang: {error}"
            except Exception:
                traceback.print_exc()
                wrong = "crash"
            counts[wrong or "text"] += 1
            if wrong:
                print(f"input {number} of seed {arguments.seed}: {wrong}")
    bad = sum(counts.values()) - counts["text"]
    print(f"quoting: {arguments.inputs} inputs, {bad} wrong {dict(counts)}; {costs}")
    return int(bad > 0 or costs.over())


if __name__ == "__main__":
    sys.exit(main())
