"""Generates Python packages from metamodels, with pyecoregen's generator and a template of our own.

`render` returns the files for one or more .ecore files and all that they refer to; it writes nothing. Each EPackage becomes one
file, `<package>/__init__.py`, whose classes derive from `robosmi.model.strict.Element`. The .ecore files remain the source:
generated code is never edited. `robosmi.generate.packages` writes packages where a user's files may lie; run as a module,
this one generates our own packages again, and a test compares.

A valid metamodel may have no Python package. All reasons are reported together, each with its place and what to do. What can be
made differently (an escaped name, a feature left out) is no reason but a note.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

import pyecoregen.ecore as pyecoregen
from jinja2.sandbox import SandboxedEnvironment
from msgspec import Struct, field
from multigen.jinja import JinjaGenerator

from robosmi import inputs, resources
from robosmi.base.template_files import TemplateFiles
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import SourceError
from robosmi.files.commit import update
from robosmi.model.ecore.ecore_description import ECORE, Class, DataType, DescribedElement, Enumeration, Package
from robosmi.model.ecore.ecore_loader import MetamodelError, Problem, load_metamodels
from robosmi.model.ecore.linearise import bases, topological
from robosmi.model.elements.datatypes import ECORE_URI
from robosmi.model.elements.python_names import python_name
from robosmi.model.generator.package_cycles import Cycles
from robosmi.model.generator.package_names import PackageNames
from robosmi.model.generator.package_types import MAP_ENTRY, Notes, is_base
from robosmi.model.generator.package_view import Mixins, PackageView, view_of

MIXINS = "mixins.py"


class PackageRun(Struct, dict=True):
    """The input of one run of the generator: the packages, and the facts that apply to all of them."""

    packages: list[Package]
    mixins: Mixins
    notes: Notes = field(default_factory=Notes)

    def __post_init__(self) -> None:
        classes = [c for p in self.all() for c in p.classifiers if isinstance(c, Class)]
        self.names = PackageNames(self.packages)
        self.bases = bases(topological(classes)[0])
        self.cycles = Cycles(self.packages)

    def all(self) -> Iterator[Package]:
        """The packages with their sub-packages."""
        for root in self.packages:
            yield from root.walk()

    def view(self, package: Package) -> PackageView:
        """The data that the template uses for a package."""
        return view_of(package, self.names, self.bases, self.cycles, self.mixins, self.notes)


class PackageTask(pyecoregen.EcoreTask):
    """One Python file for one EPackage."""

    template_name = "package.py.j2"

    @staticmethod
    def filename_for_element(package: Package) -> str:
        """The name of the file inside the package's folder."""
        return "__init__.py"

    def filtered_elements(self, model: PackageRun) -> Iterator[Package]:
        """The packages that become files."""
        return model.all()


class _Sandboxed(JinjaGenerator):
    """multigen's generator with Jinja's sandbox, reading templates as `template_files` does."""

    def create_environment(self, **kwargs: Any) -> SandboxedEnvironment:
        """The environment that templates run in."""
        return SandboxedEnvironment(loader=TemplateFiles([self.templates_path], found=True), **kwargs)


class PackageGenerator(pyecoregen.EcoreGenerator, _Sandboxed):
    """pyecoregen's generator with our task and template; it gives the files and writes none."""

    def __init__(self, **kwargs: Any) -> None:
        self.templates_path = str(resources.find("templates", "metamodel"))
        super().__init__(**kwargs)
        self.tasks = [PackageTask()]

    def render(self, run: PackageRun) -> dict[str, bytes]:
        """The files of a run: relative path -> bytes."""
        environment = self.create_environment(trim_blocks=True, lstrip_blocks=True, keep_trailing_newline=True)
        made = {}
        for task in self.tasks:
            template = environment.get_template(task.template_name)
            for package in task.filtered_elements(run):
                path = "/".join([*run.names.module(package), task.filename_for_element(package)])
                made[path] = template.render(view=run.view(package)).encode()
        return made


class Rendered(Struct, frozen=True):
    """The result of a generation.

    Attributes:
        files: relative path -> bytes.
        sources: relative path -> the .ecore file.
        findings: what was left out, renamed or could not be expressed.
        classes: number of classes.
    """

    files: dict[str, bytes]
    sources: dict[str, Path]
    findings: list[Finding]
    classes: int


def render(metamodels: Sequence[Path], folder: Path | None = None) -> Rendered:
    """Generate the packages of .ecore files and of all files that they refer to.

    Args:
        metamodels: the .ecore files.
        folder: where the packages will lie, to find the `mixins.py` that persons wrote there; None if there are none.

    Raises:
        SourceError: a file cannot be read, or is no metamodel.
        MetamodelError: it is no valid metamodel, or no Python package can be made of it; all reasons together.
    """
    packages = load_metamodels(metamodels)
    if problems := problems_of(packages):
        raise MetamodelError(problems)
    run = PackageRun(packages, {})
    if folder is not None:
        run.mixins = {path: found for p in run.all() if (found := _mixins(folder, path := "/".join(run.names.module(p))))}
    files = PackageGenerator().render(run)
    sources = {"/".join([*run.names.module(p), "__init__.py"]): p.source for p in run.all()}
    classes = sum(isinstance(c, Class) for p in run.all() for c in p.classifiers)
    return Rendered(files, sources, [*run.notes.findings, *_namespaces(run)], classes)


def _namespaces(run: PackageRun) -> Iterable[Finding]:
    """Findings on packages that model files could not name."""
    seen: dict[str, Package] = {}
    for package in run.all():
        if package.uri in seen or not package.uri:
            why = f"the namespace of '{seen[package.uri].path}'" if package.uri else "no namespace"
            yield Finding(
                "RS605", Severity.warning, f"the package '{package.path}' has {why}: models cannot be read with it",
                package.location, package.path, "give it an nsURI of its own in the .ecore file",
            )  # fmt: skip
        seen.setdefault(package.uri, package)


def _mixins(folder: Path, module: str) -> dict[str, frozenset[str]]:
    """The classes of a package's `mixins.py`: name -> the names that it defines."""
    path = folder / module / MIXINS
    if not path.is_file():
        return {}
    try:
        tree = ast.parse(inputs.read_bytes(path, inputs.OUTPUT))
    except (SyntaxError, ValueError) as error:
        raise SourceError(
            f"the file is no Python: {error}",
            location=Location(str(path), error.lineno if isinstance(error, SyntaxError) else None),
            fix="correct it",
        ) from error
    found = {}
    for node in tree.body:
        if isinstance(node, ast.ClassDef):
            names = {n.name for n in node.body if isinstance(n, (ast.FunctionDef, ast.AsyncFunctionDef))}
            names |= {t.id for n in node.body if isinstance(n, ast.Assign) for t in n.targets if isinstance(t, ast.Name)}
            found[node.name] = frozenset(names)
    return found


def generate_built_in() -> None:
    """Generate the built-in packages again."""
    folder = resources.built_in("metamodels")
    update(folder, render(sorted(folder.glob("*.ecore"))).files)


# ---- why no package can be made

_REPAIR = "correct it in the .ecore file"
_LONGEST = 200
"""Bytes of a package's name, which is that of a folder; file systems take 255."""


def problems_of(packages: Sequence[Package]) -> list[Problem]:
    """All reasons against generating these packages.

    Args:
        packages: the outermost packages.
    """
    found = [*_packages(packages)]
    classes = []
    for root in packages:
        for package in root.walk():
            if len(python_name(package.name or "_").encode("utf-8", "replace")) > _LONGEST:
                found.append(
                    Problem(
                        "a name is too long", package.location, f"a package has a name of more than {_LONGEST} bytes: "
                        f"'{package.name[:40]}...'", f"shorten it: {_REPAIR}",
                    )
                )  # fmt: skip
            found += _twice("package", "sub-package", package.subpackages)
            found += _twice("package", "classifier", package.classifiers)
            for classifier in package.classifiers:
                if isinstance(classifier, Enumeration):
                    found += _twice(f"enumeration '{classifier.path}'", "literal", classifier.literals)
                if isinstance(classifier, Class):
                    classes.append(classifier)
                    found += _class(classifier)
    found += [
        Problem(
            "a class inherits from itself", c.location, f"'{c.path}' inherits from itself", "remove the circle in the .ecore file"
        )
        for c in topological(classes)[1]
    ]
    return found


def _packages(packages: Sequence[Package]) -> Iterator[Problem]:
    seen: dict[str, Package] = {}
    for package in packages:
        if package.uri == ECORE_URI:
            yield Problem(
                "the metamodel is Ecore itself", package.location, f"'{package.name}' is Ecore itself, which pyecore has already",
                "use pyecore.ecore",
            )  # fmt: skip
        other = seen.setdefault(package.name, package)
        if other is not package:
            yield Problem(
                "two packages have one name", package.location,
                f"'{package.source}' and '{other.source}' both have an outermost package '{package.name}'",
                "generate them into different folders, or rename one",
            )  # fmt: skip


def _twice(owner: str, what: str, elements: Sequence[DescribedElement]) -> Iterator[Problem]:
    seen: set[str] = set()
    for element in elements:
        if element.name in seen:
            yield Problem(
                f"a {owner.split()[0]} has two {what}s of one name",
                element.location,
                f"the {owner} has two {what}s '{element.name}'",
                f"rename one of them: {_REPAIR}",
            )
        seen.add(element.name)


def _class(cls: Class) -> Iterator[Problem]:
    yield from _twice(f"class '{cls.path}'", "feature", cls.features)
    for base in cls.supertypes:
        if base.name != "EObject" and not is_base(base):
            yield Problem(
                "a class inherits from one of Ecore's own", cls.location,
                f"'{cls.path}' inherits from {base.package.name}.{base.name}, which pyecore keeps for metamodels",
                "load the .ecore file instead: Metamodel.load; or inherit from EModelElement, ENamedElement or EObject",
            )  # fmt: skip
    for feature in cls.features:
        kind = feature.classifier
        if kind is None:
            yield Problem(
                "a feature has no type", feature.location, f"'{feature.path}' has no type", f"give it an eType: {_REPAIR}"
            )
        elif feature.is_reference and isinstance(kind, DataType):
            yield Problem(
                "a feature has the wrong kind of type", feature.location,
                f"the reference '{feature.path}' has the data type '{kind.name}'", f"make it an EAttribute: {_REPAIR}",
            )  # fmt: skip
        elif (
            not feature.is_reference and not isinstance(kind, DataType) and not (kind.package is ECORE and kind.name == MAP_ENTRY)
        ):
            yield Problem(
                "a feature has the wrong kind of type", feature.location,
                f"the attribute '{feature.path}' has the class '{kind.name}'", f"make it an EReference: {_REPAIR}",
            )  # fmt: skip


if __name__ == "__main__":
    generate_built_in()
