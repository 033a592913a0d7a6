"""Python packages from metamodels: pyecoregen's generator with templates of our own.

pyecoregen's own output loses enumeration values, bounds and relative imports and takes any name; ours keeps them, has
annotations, and derives its classes from `robosmi.model.strict.Element`. One package is one file,
`<package>/__init__.py`. What Python cannot say as it stands (keywords as names) is refused, not renamed. The .ecore
files stay the truth: generated code is never edited, and a test generates it again and compares.
"""

from __future__ import annotations

import keyword
import os
from pathlib import Path
from typing import Any

import pyecoregen.ecore as pyecoregen
from pyecore import ecore
from pyecore.resources import URI, ResourceSet

from robosmi import resources
from robosmi.errors import ModelError

GENMODEL = "http://www.eclipse.org/emf/2002/GenModel"
PYTHON_TYPES = {
    "EString": "str",
    "EInt": "int",
    "ELong": "int",
    "EShort": "int",
    "EBoolean": "bool",
    "EDouble": "float",
    "EFloat": "float",
}


def documentation(element: ecore.EModelElement) -> str:
    """The GenModel documentation of a metamodel element, or an empty text."""
    annotation = element.getEAnnotation(GENMODEL)
    return str(annotation.details.get("documentation", "")) if annotation else ""


class PackageTask(pyecoregen.EcoreTask):
    """One Python file for one EPackage."""

    template_name = "package.py.j2"
    element_type = ecore.EPackage

    @staticmethod
    def filename_for_element(package: ecore.EPackage) -> str:
        """The name of the file inside the package's folder."""
        return "__init__.py"

    def create_template_context(self, element: ecore.EPackage, **kwargs: Any) -> dict[str, Any]:
        """What the template sees: the package, its classes with supertypes first, and what it needs of other packages."""
        classes = [c for c in element.eClassifiers if isinstance(c, ecore.EClass)]
        ordered: list[ecore.EClass] = []
        while len(ordered) < len(classes):
            ready = [
                c for c in classes if c not in ordered and all(s.ePackage is not element or s in ordered for s in c.eSuperTypes)
            ]
            ordered.append(ready[0])
        references = [r for c in classes for r in c.eReferences]
        return dict(
            super().create_template_context(element=element, **kwargs),
            package=element,
            classes=ordered,
            enums=[c for c in element.eClassifiers if isinstance(c, ecore.EEnum)],
            supertype_imports=_imports(element, [s for c in classes for s in c.eSuperTypes]),
            reference_imports=_imports(element, [r.eType for r in references]),
            attribute_imports=_imports(
                element, [a.eType for c in classes for a in c.eAttributes if isinstance(a.eType, ecore.EEnum)]
            ),
            datatypes=sorted({a.eType.name for c in classes for a in c.eAttributes if not isinstance(a.eType, ecore.EEnum)}),
            has_many=any(f.many for c in classes for f in c.eStructuralFeatures),
        )


def _imports(package: ecore.EPackage, classifiers: list[Any]) -> dict[str, list[str]]:
    """Relative module -> sorted names, for classifiers of other packages than Ecore and this one."""
    depth = 1
    parent = package.eSuperPackage
    while parent:
        depth, parent = depth + 1, parent.eSuperPackage
    found: dict[str, set[str]] = {}
    for classifier in classifiers:
        owner = classifier.ePackage
        if owner is not package and not _is_ecore(classifier):
            path = pyecoregen.EcoreTask.folder_path_for_package(owner).replace(os.sep, ".")
            found.setdefault("." * (depth + 1) + path, set()).add(classifier.name)
    return {module: sorted(names) for module, names in sorted(found.items())}


def _is_ecore(classifier: Any) -> bool:
    return getattr(classifier.ePackage, "nsURI", None) == ecore.nsURI or classifier.ePackage is None


class PackageGenerator(pyecoregen.EcoreGenerator):
    """pyecoregen's generator with our task and templates."""

    def __init__(self, **kwargs: Any) -> None:
        self.templates_path = str(resources.find("templates", "metamodel"))
        super().__init__(**kwargs)
        self.tasks = [PackageTask()]
        for task in self.tasks:
            task.environment = self.create_environment(trim_blocks=True, lstrip_blocks=True, keep_trailing_newline=True)
            task.global_context = self.create_global_context()

    def create_environment(self, **kwargs: Any) -> Any:
        """pyecoregen's environment with our filters."""
        environment = super().create_environment(**kwargs)
        environment.filters.update(
            documentation=documentation,
            annotation=_annotation,
            parameter=_parameter,
            arguments=_arguments,
            supertypes=_supertypes,
            all_features=_all_features,
        )
        return environment


def _all_features(eclass: ecore.EClass) -> list[Any]:
    """Features of supertypes first, in Ecore's order."""
    result: list[Any] = []
    for base in eclass.eSuperTypes:
        result += [f for f in _all_features(base) if f not in result]
    return result + list(eclass.eStructuralFeatures)


def _supertypes(eclass: ecore.EClass) -> str:
    return ", ".join(s.name for s in eclass.eSuperTypes) or "Element, metaclass=MetaEClass"


def _type_name(feature: Any) -> str:
    if isinstance(feature, ecore.EAttribute) and not isinstance(feature.eType, ecore.EEnum):
        return PYTHON_TYPES.get(feature.eType.name, "Any")
    return "Element" if _is_ecore(feature.eType) else str(feature.eType.name)


def _optional(feature: Any) -> bool:
    if isinstance(feature, ecore.EReference):
        return True
    return feature.eType.name == "EString" and feature.defaultValueLiteral is None


def _annotation(feature: Any) -> str:
    name = _type_name(feature)
    if feature.many:
        return f"MutableSequence[{name}]"
    return f"{name} | None" if isinstance(feature, ecore.EReference) or (_optional(feature) and feature.lowerBound == 0) else name


def _parameter(feature: Any) -> str:
    name = _type_name(feature)
    return f"{feature.name}: Iterable[{name}] | None = None" if feature.many else f"{feature.name}: {name} | None = None"


def _arguments(feature: Any) -> str:
    """The arguments of the feature's EAttribute or EReference."""
    arguments = [] if isinstance(feature, ecore.EReference) else [f"eType={feature.eType.name}"]
    if feature.lowerBound:
        arguments.append(f"lower={feature.lowerBound}")
    if feature.upperBound != 1:
        arguments.append(f"upper={feature.upperBound}")
    for flag, default in (("ordered", True), ("unique", True), ("changeable", True), ("derived", False), ("transient", False)):
        if getattr(feature, flag) != default:
            arguments.append(f"{flag}={not default}")
    for flag in ("containment", "iD"):
        if getattr(feature, flag, False):
            arguments.append(f"{flag}=True")
    if feature.defaultValueLiteral is not None and isinstance(feature, ecore.EAttribute):
        value = feature.eType.from_string(feature.defaultValueLiteral)
        text = f"{feature.eType.name}.{value.name}" if isinstance(feature.eType, ecore.EEnum) else repr(value)
        arguments.append(f"default_value={text}")
    return ", ".join(arguments)


def check_profile(package: ecore.EPackage) -> None:
    """Refuse what cannot become Python as it stands.

    Raises:
        ModelError: a name is a Python keyword or used twice in the package.
    """
    seen: set[str] = set()
    for classifier in package.eClassifiers:
        inner = [f.name for f in getattr(classifier, "eStructuralFeatures", ())] + [
            x.name for x in getattr(classifier, "eLiterals", ())
        ]
        for name in [classifier.name, *inner]:
            if keyword.iskeyword(name) or not name.isidentifier():
                raise ModelError(
                    f"'{package.name}.{classifier.name}': '{name}' cannot be a Python name", fix="rename it in the .ecore file"
                )
        if classifier.name in seen:
            raise ModelError(f"the package '{package.name}' has two classifiers '{classifier.name}'", fix="rename one of them")
        seen.add(classifier.name)


def generate(metamodel: Path, folder: Path) -> list[Path]:
    """Generate the Python package(s) of one .ecore file.

    Args:
        metamodel: the .ecore file; files it refers to must lie where it says.
        folder: where the package folders are made; it must be a Python package itself if packages refer to each other.

    Returns:
        The files written.

    Raises:
        ModelError: the file is no metamodel, or uses names that Python cannot say.
    """
    try:
        root = ResourceSet().get_resource(URI(str(metamodel))).contents[0]
    except Exception as error:  # pyecore raises what it likes: KeyError, ValueError, lxml's own
        raise ModelError(
            f"'{metamodel}' cannot be read as a metamodel: {error}", fix="open it in Eclipse, or validate it"
        ) from error
    if not isinstance(root, ecore.EPackage):
        raise ModelError(f"'{metamodel}' holds a {type(root).__name__}, not an EPackage", fix="give an .ecore file")
    packages = [root, *(p for p in root.eAllContents() if isinstance(p, ecore.EPackage))]
    for package in packages:
        check_profile(package)
    folder.mkdir(parents=True, exist_ok=True)
    PackageGenerator().generate(root, str(folder))
    return [folder / pyecoregen.EcoreTask.folder_path_for_package(p) / "__init__.py" for p in packages]


if __name__ == "__main__":  # python -m robosmi.model.codegen: our own packages anew
    for source in sorted(resources.built_in("metamodels").glob("*.ecore")):
        generate(source, source.parent)
