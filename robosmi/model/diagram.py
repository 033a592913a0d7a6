"""Class diagrams of metamodels as Mermaid text, and the README of the built-in ones that shows them.

`python -m robosmi.model.diagram` writes the README anew; a test compares. Mermaid is text that code hosts draw, so the
diagram needs no tool and cannot fall behind unseen.
"""

from __future__ import annotations

from pathlib import Path

from robosmi import resources
from robosmi.base.quantities import quantity
from robosmi.model.ecore.ecore_loader import GENMODEL
from robosmi.model.elements.ecore import EClass, EModelElement, EPackage

ORDER = ("ccode", "hardware", "platform", "migration", "trace")

INTRODUCTION = """# The metamodels

Five metamodels are the interfaces between the parts of RoboSMi: the program (`ccode`), the drawing (`hardware`), the facts
about platforms (`platform`), the decisions (`migration`, the migration plan), and the origin of every result (`trace`). The
`.ecore` files are written by hand and are authoritative; the package beside each is generated (`make metamodels`) and never
edited. Eclipse EMF accepts all five. `robosmi metamodels export DIR` exports them. Every class and feature is documented in
its `.ecore`.

Facts and decisions are separate: `ccode` and `hardware` have only what a file says, and do not depend on the target. The plan
refers to them and copies nothing. The diagrams below show classes, containments (filled) and references; attributes are in
the `.ecore`.
"""


def documentation(element: EModelElement) -> str:
    """The GenModel documentation of an element of a metamodel (a pyecore object), or an empty text."""
    annotation = element.getEAnnotation(GENMODEL)
    return str(annotation.details.get("documentation", "")) if annotation else ""


def to_mermaid(package: EPackage) -> str:
    """The classes of an EPackage with their inheritance, containments and references.

    Args:
        package: an EPackage; references to other packages are shown with the other class's name.
    """
    lines = ["classDiagram"]
    for eclass in package.eClassifiers:
        if not isinstance(eclass, EClass):
            continue
        if eclass.abstract:
            lines += [f"  class {eclass.name} {{", "    <<abstract>>", "  }"]
        elif not eclass.eReferences and not eclass.eSuperTypes:
            lines.append(f"  class {eclass.name}")
        lines += [f"  {base.name} <|-- {eclass.name}" for base in eclass.eSuperTypes]
        for reference in eclass.eReferences:
            if reference.eOpposite is not None and reference.eOpposite.containment:
                continue  # the container's side shows it
            many = ' "*"' if reference.many else ' "0..1"'
            arrow = "*--" if reference.containment else "-->"
            lines.append(f"  {eclass.name} {arrow}{many} {reference.eType.name} : {reference.name}")
    return "\n".join(lines)


def readme() -> str:
    """The README of the built-in metamodels."""
    from pyecore.resources import URI, ResourceSet

    folder = resources.built_in("metamodels")
    parts = [INTRODUCTION]
    for name in ORDER:
        package = ResourceSet().get_resource(URI(str(folder / f"{name}.ecore"))).contents[0]
        classes = [c for c in package.eClassifiers if hasattr(c, "eReferences")]
        features = sum(len(c.eStructuralFeatures) for c in classes)
        counted = f"{quantity(len(classes), 'class', 'classes')}, {quantity(features, 'feature')}"
        parts.append(
            f"## {name}\n\n{documentation(package)}\n\nNamespace `{package.nsURI}`, {counted}.\n\n"
            f"```mermaid\n{to_mermaid(package)}\n```\n"
        )
    return "\n".join(parts)


if __name__ == "__main__":
    Path(resources.built_in("metamodels") / "README.md").write_text(readme(), encoding="utf-8")
