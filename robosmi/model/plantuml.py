"""PlantUML text: class diagrams of metamodels and object diagrams of models, for documents and papers.

Only text is made; drawing it is PlantUML's. `diagram` makes the Mermaid text of our own metamodels' README.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.elements.by_name import feature_values
from robosmi.model.elements.driver import Model, Node, is_element, name_of, type_of, walk
from robosmi.model.elements.ecore import EClass, EClassifier, EEnum, EObject, EPackage, EStructuralFeature
from robosmi.model.elements.show import known_values, plain
from robosmi.quoting import plantuml

if TYPE_CHECKING:
    from robosmi.model.elements.driver import ItemOrItems


def to_plantuml(source: Any, limit: int = 200) -> str:
    """A class diagram of a metamodel, or an object diagram of a model or of an element with all it contains.

    Args:
        source: a `Metamodel`, a model of any technology, or an element.
        limit: the number of elements after which an object diagram is cut; a note in it says so.
    """
    if isinstance(source, Metamodel):
        lines = _classes(source)
    else:
        lines = _objects(list(source.all_contents() if isinstance(source, Model) else walk(source)), limit)
    return "\n".join(["@startuml", *lines, "@enduml", ""])


def _classes(metamodel: Metamodel) -> list[str]:
    lines = ["hide empty members"]
    links: list[str] = []
    for path, classifier in metamodel.classifiers():
        name = f'"{plantuml(path.replace("::", "."))}"'
        if isinstance(classifier, EEnum):
            lines += [f"enum {name} {{", *(f"  {plantuml(literal.name, begins=True)}" for literal in classifier.eLiterals), "}"]
        elif isinstance(classifier, EClass):
            kind = "interface" if classifier.interface else "abstract class" if classifier.abstract else "class"
            lines.append(f"{kind} {name} {{")
            for feature in classifier.eStructuralFeatures:
                if feature.is_attribute:
                    lines.append(
                        f"  {plantuml(feature.name, begins=True)} : {plantuml(feature.eType.name)}{_bounds(feature, ' [{}]')}"
                    )
                elif not (feature.eOpposite is not None and feature.eOpposite.containment):  # the container's side shows it
                    arrow = "*-->" if feature.containment else "-->"
                    links.append(f'{name} {arrow} "{_bounds(feature)}" "{_path(feature.eType)}" : {plantuml(feature.name)}')
            lines.append("}")
            links += [f'"{_path(base)}" <|-- {name}' for base in classifier.eSuperTypes]
    return lines + links


def _bounds(feature: EStructuralFeature, form: str = "{}") -> str:
    upper = "*" if feature.upperBound < 0 else str(feature.upperBound)
    text = upper if feature.lowerBound == feature.upperBound else f"{feature.lowerBound}..{upper}"
    return "" if form != "{}" and upper == "1" else form.format(text)


def _path(classifier: EClassifier) -> str:
    names = [str(classifier.name)]
    package: EPackage | None = classifier.ePackage
    while package is not None:
        names.append(str(package.name))
        package = package.eSuperPackage
    return plantuml(".".join(reversed(names)))


def _objects(elements: list[Node], limit: int) -> list[str]:
    shown = elements[:limit]
    numbers = {id(element): f"o{number}" for number, element in enumerate(shown, 1)}
    lines: list[str] = []
    links: list[str] = []
    for element in shown:
        number = numbers[id(element)]
        lines.append(f'object ": {plantuml(name_of(type_of(element)))}" as {number} {{')
        for feature, value in known_values(element):
            targets = [x for x in feature_values(element, feature) if is_element(x)]
            if targets:
                others = [x for x in targets if id(x) in numbers and not _is_part(element, feature, x)]
                links += [f"{number} --> {numbers[id(x)]} : {plantuml(feature)}" for x in others]
            elif plain(value) not in (None, "", []):
                lines.append(f"  {plantuml(feature, begins=True)} = {plantuml(_line(plain(value)))}")
        lines.append("}")
    for element in shown:
        container = element.eContainer()
        if container is not None and id(container) in numbers:
            links.append(f"{numbers[id(container)]} *-- {numbers[id(element)]}")
    if len(elements) > limit:
        lines.append(f"note as cut\n  {len(elements) - limit} more elements are not shown\nend note")
    return lines + list(dict.fromkeys(links))


def _is_part(element: Node, name: str, target: Node) -> bool:
    """Whether a feature shows only what contains what, which is drawn once for all."""
    feature = element.eClass.findEStructuralFeature(name) if isinstance(element, EObject) else None
    if feature is None:
        return target.eContainer() is element or element.eContainer() is target
    return bool(feature.containment or (feature.eOpposite is not None and feature.eOpposite.containment))


def _line(value: ItemOrItems) -> str:
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else f"{text[:57]}..."
