"""The made files of the source platform: the same facts make the same files."""

from __future__ import annotations

from pathlib import Path

from robosmi import resources
from robosmi.transformations.knowledge.platforms.api_spelling import tidy
from robosmi.transformations.t2m import propeller_facts


def test_made_again_they_are_the_same(shared: Path, tmp_path: Path) -> None:
    own = resources.built_in("platform_repo") / propeller_facts.PLATFORM
    for path in propeller_facts.write(shared / "propeller", tmp_path):
        assert path.read_bytes() == (own / path.name).read_bytes()


def test_signatures_are_in_one_spelling() -> None:
    assert tidy("(void (* func)(void *),size_t  n,...)") == "(void (*func)(void *), size_t n, ...)"
    assert tidy("const char * ") == "const char *"
