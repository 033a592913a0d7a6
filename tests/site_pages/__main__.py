"""`python -m tests.site_pages FOLDER`: build the site into a folder, and check its links (exit 1 if one is broken)."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from importlib.util import find_spec
from pathlib import Path

from tests.site_pages.links import broken
from tests.site_pages.sources import collect, navigation

_SLUGS = "the anchors of headings"
_GITHUB = "!!python/object/apply:pymdownx.slugs.slugify {kwds: {case: lower}}"
"""The function that makes anchors as GitHub does, in the form in which YAML names functions."""


def settings(pages: Path, site: Path) -> dict[str, object]:
    """The settings of MkDocs for a folder of pages: nothing is loaded from another host, and no server is needed."""
    fences = {"custom_fences": [{"name": "mermaid", "class": "mermaid", "format": "pymdownx.superfences.fence_code_format"}]}
    return {
        "site_name": "RoboSMi",
        "docs_dir": str(pages),
        "site_dir": str(site),
        "use_directory_urls": False,
        "theme": {"name": "material", "font": False, "features": ["navigation.sections", "navigation.top"]},
        "plugins": [{"search": {}}],
        "markdown_extensions": [
            "tables",
            {"toc": {"slugify": _SLUGS}},
            "admonition",
            {"pymdownx.superfences": fences},
            "pymdownx.highlight",
        ],
        "validation": {"links": {"not_found": "warn", "anchors": "warn", "unrecognized_links": "warn"}},
        "nav": navigation(pages),
    }


def build(site: Path) -> None:
    """Build the site.

    Raises:
        subprocess.CalledProcessError: MkDocs rejects a page.
    """
    with tempfile.TemporaryDirectory() as place:
        pages = Path(place).resolve() / "pages"
        pages.mkdir()
        collect(pages)
        file = Path(place) / "mkdocs.yml"
        text = json.dumps(settings(pages, site.resolve()), indent=1)  # JSON is YAML
        file.write_text(text.replace(json.dumps(_SLUGS), _GITHUB), encoding="utf-8")
        command = [sys.executable, "-m", "mkdocs", "build", "--quiet", "--strict", "--config-file", str(file)]
        subprocess.run(command, check=True, env=os.environ | {"NO_MKDOCS_2_WARNING": "1"})


def main() -> int:
    """Build and check."""
    site = Path(sys.argv[1])
    if find_spec("material") is None:
        print("Material for MkDocs is not installed; do: pip install '.[docs]'", file=sys.stderr)
        return 4
    try:
        build(site)
    except subprocess.CalledProcessError as error:
        return int(error.returncode)
    faults = list(broken(site))
    for fault in faults:
        print(f"broken link: {fault}", file=sys.stderr)
    pages = len(list(site.rglob("*.html")))
    print(f"{site / 'README.html'}: {pages} pages, {len(faults)} broken links")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
