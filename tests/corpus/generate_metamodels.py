"""Try the generator of Python packages on a folder of .ecore files, and say what became of each.

    python tests/corpus/generate_metamodels.py FOLDER [--list FILE] [--check N] [--keep DIR]

Each file with other bytes than those before is read with what it refers to, generated, generated again (same bytes?), imported,
compared with its description (classes, features, bounds, opposites, supertypes, literals), and one element of each concrete
class is made. `mypy --strict` and `ruff format` see every N-th. The files are not part of the project.
Exit code 1 if anything crashed. A file that is refused is named with its reason; a crash is anything else that fails.
"""

from __future__ import annotations

import argparse
import hashlib
import importlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import traceback
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from robosmi.errors import RobosmiError
from robosmi.files.commit import update
from robosmi.model.ecore.ecore_description import Class, Enumeration, Package, is_known
from robosmi.model.ecore.ecore_loader import MetamodelError, load_metamodels
from robosmi.model.generator.codegen import Rendered, render
from robosmi.model.generator.package_names import PackageNames
from robosmi.model.generator.package_types import is_feature_map


def distinct(paths: list[Path]) -> Iterator[Path]:
    """The files with other bytes than those before."""
    seen: set[bytes] = set()
    for path in paths:
        digest = hashlib.sha256(path.read_bytes()).digest()
        if digest not in seen:
            seen.add(digest)
            yield path


def differences(packages: list[Package], base: str) -> Iterator[str]:
    """Where the imported packages are not what the metamodel says."""
    names = PackageNames(packages)
    for root in packages:
        for package in root.walk():
            module = importlib.import_module(".".join([base, *names.module(package)]))
            if (module.nsURI, module.name, module.eClass.name) != (package.uri, package.name, package.name):
                yield f"{package.path}: other name or namespace"
            if {c.name for c in module.eClass.eClassifiers} != {c.name for c in package.classifiers}:
                yield f"{package.path}: other classifiers"
            if [p.name for p in module.eClass.eSubpackages] != [p.name for p in package.subpackages]:
                yield f"{package.path}: other sub-packages"
            for classifier in package.classifiers:
                made = getattr(module, names[classifier])
                if isinstance(classifier, Class):
                    yield from class_differences(classifier, made, names)
                elif isinstance(classifier, Enumeration):
                    found = [(x.name, x.value, x.literal or x.name) for x in made.eLiterals]
                    if found != [(x.name, x.value, x.text) for x in classifier.literals]:
                        yield f"{classifier.path}: other literals"
                    for literal in classifier.literals:
                        if made.from_string(literal.text) is None or getattr(made, names[literal]).name != literal.name:
                            yield f"{classifier.path}: {literal.name} is not found"


def class_differences(cls: Class, made: Any, names: PackageNames) -> Iterator[str]:
    """Where an imported class is not what the metamodel says."""
    eclass = made.eClass
    if (eclass.name, eclass.abstract) != (cls.name, cls.abstract or cls.interface):
        yield f"{cls.path}: other name, or abstract"
    if [b.name for b in eclass.eSuperTypes] != [b.name for b in cls.supertypes if not is_known(b)]:
        yield f"{cls.path}: other supertypes {[b.name for b in eclass.eSuperTypes]}"
    wanted = [f for f in cls.features if not is_feature_map(f)]
    if [f.name for f in eclass.eStructuralFeatures] != [f.name for f in wanted]:
        yield f"{cls.path}: other features"
        return
    if Counter(o.name for o in eclass.eOperations) != Counter(o.name for o in cls.operations):
        yield f"{cls.path}: other operations"
    for feature, found in zip(wanted, eclass.eStructuralFeatures, strict=True):
        facts = (
            found.lowerBound,
            found.upperBound,
            bool(found.ordered),
            bool(found.unique),
            bool(found.derived),
            bool(found.transient),
        )
        if facts != (feature.lower, feature.upper, feature.ordered, feature.unique, feature.derived, feature.transient):
            yield f"{feature.path}: other bounds or flags"
        kind = feature.classifier
        if (
            kind is not None
            and not is_known(kind)
            and getattr(found.eType, "eClass", found.eType).name not in (kind.name, "EEnum", "EDataType")
        ):
            yield f"{feature.path}: other type {found.eType}"
        other = feature.opposite
        if other is not None and other.opposite is feature and (found.eOpposite is None or found.eOpposite.name != other.name):
            yield f"{feature.path}: other opposite"


def construct(packages: list[Package], base: str) -> int:
    """Make an element of each concrete class, by its Python name; the number of elements."""
    names, count = PackageNames(packages), 0
    for root in packages:
        for package in root.walk():
            module = importlib.import_module(".".join([base, *names.module(package)]))
            for classifier in package.classifiers:
                if isinstance(classifier, Class) and not classifier.abstract and not classifier.interface:
                    made = getattr(module, names[classifier])()
                    count += 1
                    for feature in classifier.all_features():
                        if not is_feature_map(feature) and not feature.derived:
                            made.eGet(feature.name)
                            getattr(made, names[feature])
    return count


def attempt(path: Path, folder: Path, base: str) -> tuple[str, Rendered | None, int]:
    """Try one file: the outcome, the generated package, and the number of elements created."""
    try:
        rendered = render([path])
    except MetamodelError as error:
        return f"refused: {error.problems[0].kind}", None, 0
    except RobosmiError as error:
        return f"refused: {error.message.split(':')[0].split(chr(39))[0].strip()}", None, 0
    if render([path]).files != rendered.files:
        raise AssertionError("generated twice, it differs")
    update(folder / base, rendered.files)
    packages = load_metamodels([path])
    for name in sorted({".".join([base, *Path(file).parent.parts]) for file in rendered.files}):
        importlib.import_module(name)
    if found := list(differences(packages, base)):
        raise AssertionError(f"{len(found)} differences: {'; '.join(found[:3])}")
    return "generated", rendered, construct(packages, base)


def main() -> int:
    """Try all files and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--list", type=Path, help="a file with the paths to try, one a line, instead of all in the folder")
    parser.add_argument("--check", type=int, default=10, metavar="N", help="type-check and format-check every N-th (0: none)")
    parser.add_argument("--keep", type=Path, help="keep the generated packages here")
    parser.add_argument("-v", "--verbose", action="store_true", help="show where a crash happened")
    options = parser.parse_args()
    paths = (
        [Path(p) for p in options.list.read_text().split("\n") if p] if options.list else sorted(options.folder.rglob("*.ecore"))
    )
    work = options.keep or Path(tempfile.mkdtemp(prefix="robosmi-metamodels-"))
    work.mkdir(parents=True, exist_ok=True)
    sys.path.insert(0, str(work))
    outcomes, rules, checked = Counter[str](), Counter[str](), list[str]()
    classes = elements = 0
    started = time.perf_counter()
    for number, path in enumerate(distinct([p for p in paths if p.is_file()])):
        base = f"m{number:05}"
        before = set(sys.modules)
        try:
            outcome, rendered, made = attempt(path, work, base)
        except Exception as error:
            outcome, rendered, made = "CRASHED", None, 0
            print(f"CRASHED {base} {path}: {type(error).__name__}: {str(error)[:300]}", flush=True)
            if options.verbose:
                traceback.print_exc()
        for name in set(sys.modules) - before:
            if name.startswith(base):
                del sys.modules[name]
        outcomes[outcome] += 1
        if outcome.startswith("refused"):
            print(f"{outcome}: {path}", flush=True)
        if rendered is not None:
            classes, elements = classes + rendered.classes, elements + made
            rules.update({f"{f.rule} {f.severity.name}" for f in rendered.findings})
            if options.check and number % options.check == 0:
                checked.append(base)
    print(
        f"\n{sum(outcomes.values())} tried in {time.perf_counter() - started:.0f} s, {classes} classes, {elements} elements made"
    )
    for outcome, count in outcomes.most_common():
        print(f"{count:6} {outcome}")
    for rule, count in sorted(rules.items()):
        print(f"{count:6} metamodels with findings {rule}")
    if checked:
        tools(work, checked)
    if options.keep is None:
        shutil.rmtree(work)
    return int("CRASHED" in outcomes)


def tools(work: Path, checked: list[str]) -> None:
    """Print what mypy and ruff report about some of the packages, with their default configuration."""
    root = Path(__file__).resolve().parents[2]
    ruff = shutil.which("ruff") or str(Path(sys.executable).with_name("ruff"))
    for title, command in (
        ("mypy --strict", [sys.executable, "-m", "mypy", "--strict", "--config-file=", "--follow-imports=silent",
                           "--explicit-package-bases", *checked]),
        ("ruff format", [ruff, "format", "--isolated", "--check", *checked]),
        ("ruff check", [ruff, "check", "--isolated", "--select", "E4,E7,E9,F,I", "--output-format", "concise", *checked]),
    ):  # fmt: skip
        environment = {"MYPYPATH": str(root), "PATH": "/usr/bin"}
        done = subprocess.run(command, cwd=work, capture_output=True, text=True, check=False, env=environment)
        lines = [line for line in done.stdout.splitlines() if re.search(r"\bm\d{5}/", line)]
        bad = {found[0] for line in lines if (found := re.search(r"\bm\d{5}\b", line))}
        print(f"{title}: {len(checked) - len(bad)} of {len(checked)} metamodels without a message")
        print("\n".join(f"  {line}" for line in lines[:40]))
        if done.returncode and not lines:
            print(done.stdout[-2000:], done.stderr[-2000:])


if __name__ == "__main__":
    sys.exit(main())
