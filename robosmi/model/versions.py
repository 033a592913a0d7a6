"""Models of older versions of a metamodel: they are migrated when they are read, so that all else sees the current version.

A step from one version to the next is content, found in the registry (kind "model migration", name = the old namespace URI): an
object with `packages()`, the old metamodels, and a call that gives the new roots for old ones. A step that is registered for
several namespaces migrates the models of all of them together, with the references between them. Current files cost nothing: the
steps are looked at only when a file names a namespace that nobody knows. What a step does is `robosmi.transform.migration`'s
business.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Protocol

from robosmi.diagnostics import Location
from robosmi.errors import ModelError, RuleError
from robosmi.model.ecore.metamodels import Metamodels
from robosmi.model.elements.by_name import feature_values
from robosmi.model.elements.ecore import DynamicEObject, EObject, Package
from robosmi.model.elements.features import all_features, as_package, is_computed
from robosmi.model.xmi.xmi_reader import UnreadableModelError, read_models
from robosmi.plugins import load, registry

KIND = "model migration"


class Migration(Protocol):
    """A step from an older version of a metamodel to a newer one."""

    def into(self, metamodels: Metamodels) -> Migration:
        """The same step, into these metamodels where it names no newer version itself."""

    def packages(self) -> list[Package]:
        """The packages of the older version."""

    def __call__(self, roots: Mapping[Path, EObject]) -> dict[Path, DynamicEObject]:
        """The roots of models in the newer version, by the files of the older ones."""


def read_current(path: Path, metamodels: Metamodels, *, inside: Path | None = None) -> dict[Path, DynamicEObject]:
    """As `read_models`, but roots of older versions are migrated to the current one.

    Args:
        path: the .xmi file.
        metamodels: the metamodels in their current version.
        inside: as for `read_models`.

    Returns:
        Absolute path -> root element; the given file comes first.

    Raises:
        SourceError: a file cannot be read, or a rule of a migration raises.
        ModelError: a file contradicts its metamodel, or a model refers into one that is migrated without it.
    """
    try:
        return read_models(path, metamodels, inside=inside)
    except UnreadableModelError:
        steps = _steps(metamodels)
        if not steps:
            raise
        older = dict.fromkeys(package for step in steps.values() for package in step.packages())
        roots = read_models(path, Metamodels([*metamodels.packages, *older]), inside=inside)
    current, replaced = _current(roots, steps)
    for file, root in current.items():
        if (wrong := _reference_into(root, replaced)) is not None:
            raise ModelError(
                f"{wrong!r} refers into a model of an older version of its metamodel",
                location=Location(str(file)),
                fix="make the models again with the tool that wrote them",
            )
    return current


def migrated(path: Path, metamodels: Metamodels, refused: UnreadableModelError) -> DynamicEObject:
    """The root of a file that could not be read, since it is of an older version of one of the metamodels.

    Args:
        path: the .xmi file.
        metamodels: the metamodels in their current version; what was registered without a newer version migrates into these.
        refused: why it could not be read; raised again where no step is registered for what the file is of.

    Raises:
        SourceError, ModelError: as `read_current`.
    """
    names = registry().entries.get(KIND, {})
    if not any(uri in text for uri in names for _, text in refused.problems):
        raise refused
    return next(iter(read_current(path, metamodels).values()))


def _steps(metamodels: Metamodels) -> dict[str, Migration]:
    """The steps that are registered, by the older namespaces; those that name no newer version lead to these metamodels."""
    into: dict[int, Migration] = {}
    found: dict[str, Migration] = {}
    for uri, target in registry().entries.get(KIND, {}).items():
        step: Migration = load(target)
        found[uri] = into.setdefault(id(step), step.into(metamodels))
    return found


def _current(roots: dict[Path, DynamicEObject], steps: dict[str, Migration]) -> tuple[dict[Path, DynamicEObject], list[EObject]]:
    """The roots in their current versions, and those that were replaced; models of one namespace are migrated together."""
    current = dict(roots)
    replaced: list[EObject] = []
    seen: set[str] = set()
    while pending := {file: uri for file, root in current.items() if (uri := _namespace(root)) in steps and uri not in seen}:
        step = steps[next(iter(pending.values()))]
        older = {file: current[file] for file, uri in pending.items() if steps[uri] is step}
        seen |= {pending[file] for file in older}
        replaced += older.values()
        try:
            current |= step(older)
        except RuleError as error:
            error.fix = "; ".join(each for each in (error.fix, _other_version(step, steps)) if each)
            raise
    return current, replaced


def _other_version(step: Migration, steps: Mapping[str, Migration]) -> str:
    """What to do if a step that names no newer version was to lead to one of those from which other steps lead on."""
    if (into := getattr(step, "assumed", None)) is None:
        return ""
    names = _types(step)
    between = [uri for uri, other in steps.items() if other is not step and not names.isdisjoint(_types(other))]
    if not between:
        return ""
    own = next(uri for uri, other in steps.items() if other is step)
    advice = f"if it leads to '{between[0]}', write ModelMigration(OLD, rules, Metamodel.load(FILE)) with its file"
    return f"the step of '{own}' leads to {into}; {advice}"


def _types(step: Migration) -> set[str]:
    """The names of the types of a step's older version."""
    return {str(each.name) for package in step.packages() for each in as_package(package).eClassifiers}


def _namespace(root: EObject) -> str:
    return str(root.eClass.ePackage.nsURI)


def _reference_into(root: EObject, replaced: list[EObject]) -> EObject | None:
    """An element of a model that refers to one of those that were replaced, or None."""
    from robosmi.model.elements.structure import root_of, walk

    for element in walk(root):
        for feature in all_features(element.eClass):
            if feature.is_reference and not feature.containment and not is_computed(feature):
                targets = [x for x in feature_values(element, feature.name) if isinstance(x, EObject)]
                if any(root_of(target) is one for target in targets for one in replaced):
                    return element
    return None
