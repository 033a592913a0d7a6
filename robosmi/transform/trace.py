"""`Trace`: what a transformation made from what, looked up both ways at once, in memory or as a model of metamodels/trace.ecore.

Looking up costs the same however long the trace is. Links of generated text are the generator's. Nothing here runs a rule.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator
from typing import TYPE_CHECKING, Any, TypeVar, cast, overload

from robosmi.errors import ModelError
from robosmi.model.elements.driver import Model, is_element
from robosmi.model.elements.ecore import DynamicEObject, EObject
from robosmi.model.elements.pyecore_internals import own_resource_of
from robosmi.model.elements.structure import root_of
from robosmi.query.values import key

if TYPE_CHECKING:
    from robosmi.metamodels import trace
    from robosmi.model.elements.driver import Item, Node
    from robosmi.model.elements.dynamic import Dynamic

_BY_VALUE = (int, float, bool)


T = TypeVar("T")


class Link:
    """One application of a rule.

    Attributes:
        rule: name of the rule.
        sources: what it read; in ETL one element or value.
        targets: what it made, in the order of the rule's targets.
        step: step of a method, or "".
    """

    __slots__ = ("rule", "sources", "step", "targets")

    def __init__(self, rule: str, sources: tuple[Item, ...], targets: list[Node], step: str = "") -> None:
        self.rule = rule
        self.sources = sources
        self.targets = cast("list[Dynamic]", targets)
        self.step = step

    @property
    def source(self) -> Dynamic:
        """The first source, in ETL the only one; None if there is none."""
        return cast("Dynamic", self.sources[0] if self.sources else None)

    def __repr__(self) -> str:
        return f"<{self.rule}: {', '.join(repr(x) for x in self.sources)} -> {', '.join(repr(x) for x in self.targets)}>"


class Trace:
    """The links of one run.

    Args:
        step: step of a method that the rules of the run belong to.

    Attributes:
        links: all links in the order in which they were made.
    """

    def __init__(self, step: str = "") -> None:
        self.step = step
        self.links: list[Link] = []
        self._by_source: dict[Hashable, list[Link]] = {}
        self._by_target: dict[int, list[Link]] = {}
        self._indexed = 0
        self._of_other_copies: _OtherCopies | None = None

    def add(self, rule: str, source: Item, targets: list[Node]) -> Link:
        """Record that a rule made the targets from the one source."""
        made = Link(rule, (source,), targets, self.step)
        self.links.append(made)
        if source.__class__ in _BY_VALUE:
            place = key(source)
        else:
            place = source
        row = self._by_source.get(place)
        if row is None:
            self._by_source[place] = [made]
        else:
            row.append(made)
        return made

    def link(self, rule: str, step: str, sources: Iterable[Item], targets: Iterable[Node]) -> None:
        """Record that a rule made the targets from several sources.

        Args:
            rule: its name.
            step: the step of the method.
            sources: what was read; sources that are None are left out.
            targets: what was made.
        """
        made = Link(rule, tuple(s for s in sources if s is not None), list(targets), step)
        self.links.append(made)
        for source in made.sources:
            self._by_source.setdefault(key(source) if source.__class__ in _BY_VALUE else source, []).append(made)

    def take(self, other: Trace) -> None:
        """Append the links of another trace, of another step of the same method."""
        for link in other.links:
            self.link(link.rule, link.step, link.sources, link.targets)

    def links_from(self, source: Item) -> list[Link]:
        """The links of a source, in order; do not change the list.

        Raises:
            ModelError: the trace is a stored one, and of another copy of the source's model.
        """
        found = self._by_source.get(key(source) if source.__class__ in _BY_VALUE else source)
        if found is None and self._of_other_copies is not None:
            self._of_other_copies.refuse(source)
        return found or []

    def links_to(self, target: Node) -> list[Link]:
        """The links that made a target, in order; do not change the list.

        Raises:
            ModelError: the trace is a stored one, and of another copy of the target's model.
        """
        for link in self.links[self._indexed :]:
            for made in link.targets:
                self._by_target.setdefault(id(made), []).append(link)
        self._indexed = len(self.links)
        found = self._by_target.get(id(target))
        if found is None and self._of_other_copies is not None:
            self._of_other_copies.refuse(target)
        return found or []

    @overload
    def equivalents(self, source: Item) -> list[Dynamic]: ...
    @overload
    def equivalents(self, source: Item, kind: type[T]) -> list[T]: ...
    def equivalents(self, source: Item, kind: type[T] | None = None) -> list[Dynamic] | list[T]:
        """Everything that was made from a source, in the order it was made; of a class alone if one is given."""
        if kind is not None:
            found: list[T] = []
            for link in self.links_from(source):
                found += [target for target in link.targets if isinstance(target, kind)]
            return found
        return cast("list[Dynamic]", [target for link in self.links_from(source) for target in link.targets])

    def origins(self, target: Node) -> list[Dynamic]:
        """Everything that a target was made from."""
        return cast("list[Dynamic]", [source for link in self.links_to(target) for source in link.sources])

    def __len__(self) -> int:
        return len(self.links)

    def __iter__(self) -> Iterator[Link]:
        """The links grouped by source, sources in the order of first mention (ETL's `transTrace.transformations`)."""
        seen: set[int] = set()
        for row in self._by_source.values():
            for link in row:
                if len(link.sources) == 1:
                    yield link
                elif id(link) not in seen:
                    seen.add(id(link))
                    yield link

    def to_model(self) -> trace.Trace:
        """The links as a trace model, in the order they were made.

        Sources and targets that are no EMF elements (texts, elements of other technologies) have no place in a model and are
        left out of it.
        """
        from robosmi.metamodels import trace

        links = [
            trace.TraceLink(rule=x.rule, step=x.step, sources=_elements(x.sources), targets=_elements(x.targets))
            for x in self.links
        ]
        return trace.Trace(links=links)

    @classmethod
    def of_model(cls, model: trace.Trace | DynamicEObject | Model) -> Trace:
        """A trace model, read from a file perhaps, to be looked up both ways.

        Args:
            model: its root element, or the model with it. A file is opened in the `Session` of the models that it is about, or
                the elements of the trace are others than theirs.

        Raises:
            ModelError: the model has no trace as its root.
        """
        made = cls()
        made._of_other_copies = _OtherCopies(made.links)
        for link in _root(model).links:
            made.link(link.rule, link.step, link.sources, link.targets)
        return made


def _elements(values: Iterable[Any]) -> list[Any]:
    return [v for v in values if is_element(v) and hasattr(v, "eClass")]


class _OtherCopies:
    """Whose models a stored trace is about, so that a question about another copy of one is not answered by "nothing".

    Args:
        links: the links of the trace.
    """

    def __init__(self, links: list[Link]) -> None:
        self.links = links
        self._counted = -1
        self._models: dict[int, str] = {}

    def refuse(self, element: Item) -> None:
        """Refuse an element of a model that none of the trace's elements is in, although one has a model of its kind.

        Raises:
            ModelError: it is so.
        """
        if not isinstance(element, EObject) or (resource := own_resource_of(root_of(element))) is None:
            return
        if self._counted != len(self.links):
            self._counted = len(self.links)
            ends = (one for link in self.links for one in (*link.sources, *link.targets) if isinstance(one, EObject))
            self._models = {id(own_resource_of(root) or root): _kind(root) for one in ends for root in [root_of(one)]}
        if id(resource) not in self._models and _kind(root_of(element)) in self._models.values():
            raise ModelError(
                f"the trace is about other models than that of {element!r}, or about another copy of it",
                fix="open the models and then the trace in one Session: session.open_model(file)",
            )


def _kind(root: EObject) -> str:
    return f"{root.eClass.ePackage.nsURI}#{root.eClass.name}"


def _root(model: trace.Trace | DynamicEObject | Model) -> trace.Trace | DynamicEObject:
    if not isinstance(model, Model):
        return model
    found = [one for one in model.all_contents() if isinstance(one, DynamicEObject) and one.eClass.name == "Trace"]
    if len(found) != 1:
        raise ModelError(f"the model has {len(found)} traces, not one", fix="give the element: Trace.of_model(element)")
    return found[0]
