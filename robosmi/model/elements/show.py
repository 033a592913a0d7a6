"""Models and elements for people to look at: a tree as text, rows for tables and pandas, HTML for notebooks.

Any technology's, through `driver`. Nothing is written and nothing recurses; long outputs are cut and say so. Diagrams are
`plantuml`'s.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TypeAlias, TypeVar

from robosmi.base.quantities import quantity
from robosmi.model.elements.by_name import feature_value
from robosmi.model.elements.driver import (
    Item,
    ItemOrItems,
    Kind,
    Model,
    ModelElement,
    Node,
    contents_of,
    features_of,
    is_element,
    label,
    name_of,
    type_of,
)
from robosmi.model.elements.ecore import EClass, EClassifier, EEnum, EEnumLiteral
from robosmi.model.elements.feature_errors import NotComputedError
from robosmi.model.elements.html_table import html_table, tree_html
from robosmi.quoting import html_attribute, terminal

K = TypeVar("K")
V = TypeVar("V")
Plain: TypeAlias = "Item | list[Item]"
"""A number, a text or a list of them."""


def tree(root: Model | Node, limit: int = 200) -> str:
    """A model or an element with all it contains, one line each, indented by what contains it, for a terminal.

    Args:
        root: a model or an element.
        limit: the number of lines after which it is cut; the last line says how many are left out.
    """
    tops = [x for x in root.all_contents() if x.eContainer() is None] if isinstance(root, Model) else [root]
    pending = [(top, 0) for top in reversed(tops)]
    lines: list[str] = []
    left = 0
    while pending:
        element, depth = pending.pop()
        if len(lines) < limit:
            lines.append(f"{'  ' * depth}{terminal(label(element))}")
        else:
            left += 1
        pending.extend((child, depth + 1) for child in reversed(contents_of(element)))
    return "\n".join([*lines, f"... and {left} more"] if left else lines)


def rows(source: Model | Iterable[Node], kind: Kind | None = None) -> list[dict[str, Plain]]:
    """Elements as dicts, ready for `pandas.DataFrame`: `id`, `type`, and every feature, with elements by their ids.

    Args:
        source: a model, or elements of one.
        kind: with a model, the type whose instances are wanted (also by name); all elements if None.
    """
    if isinstance(source, Model):
        elements: Iterable[Node] = source.all_contents() if kind is None else source.all_of_kind(kind)
        identity = source.id_of
    else:
        elements, identity = source, _reference
    found = []
    for element in elements:
        row: dict[str, Plain] = {"id": identity(element), "type": name_of(type_of(element))}
        row |= dict(_features(element))
        found.append(row)
    return found


def known_values(element: Node) -> Iterator[tuple[str, ItemOrItems]]:
    """The features of an element with their values, without those that nothing computes."""
    for name in features_of(element):
        try:
            yield name, feature_value(element, name)
        except NotComputedError:
            continue


def _features(element: Node) -> Iterator[tuple[str, Plain]]:
    return ((name, plain(value)) for name, value in known_values(element))


def _reference(element: Node) -> str:
    from robosmi.model.elements.fragments import fragment_of

    return fragment_of(element, []) if hasattr(element, "eClass") else label(element)


def plain(value: ItemOrItems) -> Plain:
    """A feature's value as numbers, texts and lists: elements by their ids, literals by their names."""
    if isinstance(value, EEnumLiteral):
        return str(value.name)
    if is_element(value):
        return _reference(value)
    if isinstance(value, (str, bytes, Mapping, ModelElement)) or not isinstance(value, (Sequence, Iterable)):
        return value
    return [x.name if isinstance(x, EEnumLiteral) else _reference(x) if is_element(x) else x for x in value]


def classifiers_html(classifiers: Iterable[tuple[str, EClassifier]]) -> str:
    """The classes and enumerations of a metamodel with their features and literals, as HTML.

    Args:
        classifiers: each with its path (`Metamodel.classifiers`).
    """
    lines = []
    for path, classifier in classifiers:
        if isinstance(classifier, EClass):
            inner = [str(feature.name) for feature in classifier.eStructuralFeatures]
        else:
            inner = [str(literal.name) for literal in classifier.eLiterals] if isinstance(classifier, EEnum) else []
        lines.append((path, ", ".join(inner)))
    return html_table(("type", "features"), lines)


def element_html(element: Node) -> str:
    """An element as HTML: what is registered for its class (kind `view`), else its features and what it contains.

    Args:
        element: of a model of any technology.
    """
    kind = type_of(element)
    if isinstance(kind, EClass) and kind.ePackage is not None:
        from robosmi.plugins import content, registry

        name = f"{kind.ePackage.nsURI}#{kind.name}"
        if name in registry().entries.get("view", {}):
            return str(content("view", name)(element))
    said = [x for x in _features(element) if x[1] not in (None, "", [])]
    table, inner = html_table(("feature", "value"), said), tree_html(contents_of(element), label, contents_of)
    return f"<p>{html_attribute(label(element))}</p>{table}{inner}"


def pairs_html(pairs: Mapping[K, V], head: tuple[str, str] = ("key", "value"), limit: int = 50) -> str:
    """A mapping as HTML: an entry a line."""
    left = f"<p>... and {len(pairs) - limit} more</p>" if len(pairs) > limit else ""
    return html_table(head, [[_said(each) for each in pair] for pair in list(pairs.items())[:limit]]) + left


def _said(value: V) -> V | str:
    return label(value) if is_element(value) else value


def items_html(items: Sequence[V], limit: int = 50) -> str:
    """A collection as HTML: elements with the features of the first, other values one a line."""
    shown = list(items[:limit])
    left = f"<p>... and {len(items) - limit} more</p>" if len(items) > limit else ""
    elements = [x for x in shown if is_element(x)]
    if not elements or len(elements) < len(shown):
        return html_table((f"{quantity(len(items), 'item')}",), [[x] for x in shown]) + left
    names = [name for name, value in _features(elements[0]) if not isinstance(value, list)]
    lines = [[label(x), *(dict(_features(x)).get(name, "") for name in names)] for x in elements]
    return html_table((f"{quantity(len(items), 'element')}", *names), lines) + left
