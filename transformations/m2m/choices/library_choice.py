"""Decides which library drives which component: the ranking as decisions of the plan (paper 3.3).

A choice is made by a user (flag, project file), by history, or by the ranking if it is sure enough; else it stays open. Every
component that a board pin reaches gets a decision with its candidates, the evidence and who chose. An open choice is closed if it
would change nothing, because the adapters need no library for it. Libraries are ranked by `library_ranking`; the
command line asks the user.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping
from functools import cached_property

from msgspec import Struct

from robosmi.diagnostics import Location
from robosmi.errors import placed
from robosmi.metamodels import ccode, hardware, migration, platform
from robosmi.recommend.component import ComponentQuery
from robosmi.recommend.history import chosen_from_history
from robosmi.recommend.index import LibraryIndex
from robosmi.recommend.ranking import Choices, Ranker, Recommendation
from robosmi.transformations.knowledge.libraries.library_ranking import architecture_facts, library_in, library_index, unsuitable
from robosmi.transformations.knowledge.libraries.library_takes import Takes, library_takes
from robosmi.transformations.knowledge.platforms.target_platform import TargetFacts
from robosmi.transformations.m2m.choices.stored_choices import UserChoice, explain
from robosmi.transformations.queries.circuits.circuit import component_named
from robosmi.transformations.queries.circuits.former_titles import former_title
from robosmi.transformations.queries.plans.plan_adapters import closure, emitted, port_calls

NO_LIBRARY = "none"
"""The choice that a component needs no library."""


def component_query(component: hardware.Component) -> ComponentQuery:
    """The description of a drawn component that a ranker searches with."""
    return ComponentQuery(
        id=component.elementId,
        title=component.partTitle or component.title,
        label=component.title,
        family=component.family,
        tags=tuple(component.tags),
        properties={p.name: p.value for p in component.properties},
        connectors=tuple(c.name for c in component.connectors),
        part_id=component.partId,
    )


class LibraryModels(Struct, dict=True):
    """The target's libraries as model elements, made when they are first asked for.

    Attributes:
        target: the target.
        board: the board that they are for.
        elements: name -> element.
    """

    target: TargetFacts
    board: platform.Board
    elements: dict[str, platform.Library] = {}

    @cached_property
    def takes(self) -> Mapping[str, Takes]:
        """The hardware resources (timers, pins) that each library occupies, by name."""
        return library_takes(self.target.libraries, self.board)

    @cached_property
    def of_core(self) -> Collection[str]:
        """The libraries that the board's core brings; none for the platform's own core, with which those of the index work."""
        made, chip = self.target.own_platform, self.board.microcontroller
        mapped = (each for each in made.boardMappings if each.board is not None and each.board.name == self.board.name)
        if chip is None or any(str(each.boardId).startswith(f"{made.coreName}:") for each in mapped):
            return ()
        return architecture_facts(self.target.libraries).brings.get(str(chip.architecture), ())

    @cached_property
    def index(self) -> LibraryIndex:
        """The index of the target's libraries."""
        return library_index(self.target.libraries)

    def get(self, name: str) -> platform.Library:
        """The model element of a library; the libraries it depends on are made with it.

        Raises:
            UsageError: no library has that name.
        """
        if name not in self.elements:
            facts = library_in(self.index, name)
            name = facts.name  # as the index writes it
            if name not in self.elements:
                takes = self.takes.get(name, Takes())
                self.elements[name] = platform.Library(
                    name=name,
                    version=facts.version,
                    headers=[facts.header],
                    architectures=list(facts.architectures),
                    depends=list(facts.depends),
                    url=facts.library.url,
                    installed=facts.library.installed,
                    timers=list(takes.timers),
                    pins=list(takes.pins),
                    takesWhen=takes.when,
                )
                if name in self.of_core:
                    self.target.own_platform.coreLibraries.append(name)
                for needed in facts.dependencies:
                    self.get(needed.name)
        return self.elements[name]

    def works(self, name: str) -> bool:
        """Whether the target has a library, and nothing is known against it on the board's architecture."""
        chip = self.board.microcontroller
        return not unsuitable(name, self.target.libraries, str(chip.architecture) if chip is not None else "")

    def taken_by(self, library: platform.Library | None) -> list[Takes]:
        """The known hardware resources (timers, pins) that a library and its dependencies occupy."""
        if library is None:
            return []
        return [self.takes[name] for name in (library.name, *library.depends) if name in self.takes]


class _OfTarget(Struct, frozen=True):
    """The history of choices restricted to libraries that work on the target; others were chosen for another board."""

    history: Choices
    models: LibraryModels

    def choices(self, part_id: str, title: str) -> dict[str, int]:
        return self._known(self.history.choices(part_id, title))

    def choices_for_model(self, model: str) -> dict[str, int]:
        return self._known(self.history.choices_for_model(model))

    def _known(self, counts: Mapping[str, int]) -> dict[str, int]:
        return {name: count for name, count in counts.items() if self.models.works(name)}


def choose_libraries(
    circuit: hardware.Circuit,
    components: Iterable[hardware.Component],
    chosen: Mapping[str, str],
    ranker: Ranker,
    models: LibraryModels,
    history: Choices,
    limit: int,
    sure: float = 1.0,
    stored: Mapping[tuple[str, str], UserChoice] | None = None,
    places: Mapping[str, Location] | None = None,
) -> list[migration.LibraryChoice]:
    """A decision for each component.

    Args:
        circuit: the drawing.
        components: the components that need a decision.
        chosen: COMPONENT (title or `#model_index`) -> library, as persons said.
        ranker: ranks libraries.
        models: where library elements are made.
        history: earlier choices.
        limit: how many candidates a decision keeps.
        sure: the confidence from which on the ranking's own answer is taken.
        stored: (elementId, title) -> what the user chose in a stored plan, behind `chosen`; what no longer fits is passed over.
        places: component, as `chosen` has it -> where that is said, for messages.

    Raises:
        UsageError: a component or library does not exist, or a title is ambiguous.
    """
    by_person = {}
    for name, library in chosen.items():
        with placed((places or {}).get(name)):
            by_person[component_named(circuit, name).elementId] = library
            if library and library.lower() != NO_LIBRARY:
                library_in(models.index, library)
    usable = _OfTarget(history, models)
    ranked: dict[tuple[object, ...], Recommendation] = {}  # like parts are ranked once

    def rank(query: ComponentQuery, weigh_history: bool) -> Recommendation:
        key = (
            query.part_id, query.title, query.family, query.tags, tuple(query.properties.items()), query.connectors,
            weigh_history,
        )  # fmt: skip
        if key not in ranked:
            ranked[key] = ranker.rank(query, usable if weigh_history else None, limit)
        return ranked[key]

    kept = {
        identity: said
        for (identity, title), said in (stored or {}).items()
        if any(c.elementId == identity and title in (c.title, former_title(c)) for c in circuit.components)
        and (said.value == NO_LIBRARY or models.index.library_named(said.value) is not None)
    }
    by_person = {**{identity: said.value for identity, said in kept.items()}, **by_person}
    listed = list(components)
    listed += [c for c in circuit.components if c.elementId in by_person and c not in listed]
    made = [_decide(c, by_person.get(c.elementId), rank, models, usable, sure) for c in listed]
    for choice in made:
        if choice.component is not None:
            explain(choice, kept.get(choice.component.elementId))
    return made


def _decide(
    component: hardware.Component,
    said: str | None,
    rank: Callable[[ComponentQuery, bool], Recommendation],
    models: LibraryModels,
    history: Choices,
    sure: float,
) -> migration.LibraryChoice:
    query = component_query(component)
    refused = said is not None and said.lower() == NO_LIBRARY
    # The user's choice ignores the history, so that a run after it was recorded makes the same plan again.
    recommendation = rank(query, not said)
    by, why = migration.ChosenBy.nobody, ""
    name = said
    if said:
        by, why = migration.ChosenBy.person, "by flag or in the project file"
    elif earlier := chosen_from_history(query.part_id, query.title, history):
        name, by, why = earlier, migration.ChosenBy.history, "chosen before for this part"
    elif 0 < recommendation.confidence >= sure:
        by = migration.ChosenBy.rule
        name, why = _by_rule(recommendation)
        refused = name == NO_LIBRARY
    library = models.get(name) if name and not refused else None
    options = _options(recommendation)
    if library is not None and all(o.label != library.name for o in options):
        options.append(migration.Option(label=library.name, reasons=[why]))
    by_ranking = by in (migration.ChosenBy.nobody, migration.ChosenBy.rule)
    return migration.LibraryChoice(
        component=component,
        chosen=library,
        candidates=[models.get(o.label) for o in options],
        recommendation=recommendation.decision,
        confidence=recommendation.confidence if by_ranking else 1.0,
        chosenBy=by,
        evidence=[*([why] if why else []), *(str(taken) for taken in models.taken_by(library))],
        # a ranker without a confidence cannot tell that a part without candidates needs no library
        open=not name and (recommendation.decision != "none" or recommendation.confidence > 0),
        choice=library.name if library is not None else NO_LIBRARY if refused else "",
        options=options,
    )


def _by_rule(recommendation: Recommendation) -> tuple[str, str]:
    """The choice that a sufficiently sure ranking implies: a library or none, and the reasons as text."""
    if not recommendation.candidates:  # the target has no libraries
        return NO_LIBRARY, "; ".join(recommendation.reasons)
    first = recommendation.candidates[0]
    if recommendation.decision == "library":
        return first.library, "; ".join([*first.reasons[:1], *recommendation.reasons])
    helper = f"; {first.library} is the one" if recommendation.decision == "optional" else ""
    return NO_LIBRARY, "; ".join(recommendation.reasons) + helper


def _options(recommendation: Recommendation) -> list[migration.Option]:
    return [
        migration.Option(label=c.library, score=round(c.score, 6), reasons=list(c.reasons)) for c in recommendation.candidates
    ]


_READY = (migration.AdapterStatus.filled, migration.AdapterStatus.care)


def close_idle_choices(plan: migration.MigrationPlan) -> None:
    """Choose no library for a component if no body is left to write that may use one, and no adapter uses a candidate.

    Where all functions have adapters with bodies, this holds for each component. Else it holds for those at whose ports all
    calls have.
    """
    idle = [(choice, part) for choice in plan.libraryChoices if choice.open and (part := choice.component) is not None]
    if not idle:
        return
    ready = {str(use.name): use.adapter for use in plan.adapterUses if use.adapter is not None and use.status in _READY}
    complete = len(plan.adapterUses) > 0 and all(str(use.name) in ready for use in plan.adapterUses)
    used = _libraries(emitted(plan)) if complete else set()
    for choice, part in idle:
        candidates = {str(library.name) for library in choice.candidates}
        names = list(dict.fromkeys(str(call.calleeName) for call in _calls(plan, part)))
        served = [ready[name] for name in names if name in ready]
        if names and len(served) == len(names) and _libraries(closure(served)).isdisjoint(candidates):
            why = f"the functions used here need none: {', '.join(names)}"
        elif complete and used.isdisjoint(candidates):
            why = "no function that the program calls needs one"
        else:
            continue
        choice.chosenBy, choice.open, choice.choice = migration.ChosenBy.rule, False, NO_LIBRARY
        choice.evidence.append(why)


def _libraries(pieces: Iterable[platform.Adapter]) -> set[str]:
    return {str(name) for piece in pieces for name in piece.libraries}


def _calls(plan: migration.MigrationPlan, component: hardware.Component) -> list[ccode.Call]:
    """The platform calls at the ports of a component; empty if one of these ports is open or has no known call."""
    found: list[ccode.Call] = []
    for binding in plan.portBindings:
        connections = [each for each in (binding.connection, binding.answer) if each is not None]
        if any(each.component is component for each in connections):
            calls = port_calls(plan, binding)
            if binding.open or not calls:
                return []
            found += calls
    return found
