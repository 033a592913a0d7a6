"""`ModelMerge`: the three-way merge of models: what both made of a base, in one model, or the conflicts between them.

As in EMF Compare and git, what only one of the two changed is taken, and what both changed in the same way, too. A conflict is a
value, a place or an order that both changed in different ways, and an element that one removed and the other changed.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from robosmi.base.quantities import quantity
from robosmi.diagnostics import Finding, Location
from robosmi.errors import ModelError
from robosmi.model.comparison.comparison import opened_models, refuse_others
from robosmi.model.comparison.conflicts import ConflictList, Side, lines_of
from robosmi.model.comparison.merged_features import FeaturesMerge
from robosmi.model.comparison.merged_model import MergeDecisions, merge_into
from robosmi.model.comparison.merged_places import PlacesMerge
from robosmi.model.comparison.versions import A, B, ThreeModels
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.elements.driver import Model
from robosmi.model.emf import EmfModel
from robosmi.model.session import Paths
from robosmi.model.xmi.xmi_reader import FOREIGN

_SIDES: Mapping[str | None, int | None] = {"a": A, "b": B, None: None}


class ModelMerge:
    """The merge of two edited copies of a model.

    Args:
        base: what both were made from.
        a: the first; it becomes the merged model, unless there are conflicts and no side is to win them.
        b: the second.
        take: the side that wins the conflicts, if any.
        is_as_read: whether `a` was just read from its file, so that conflicts have their lines in it.

    Attributes:
        conflicts: what both changed in different ways: removed elements, moved ones, contents, then values.
        findings: the same as findings, after what was odd in the files.

    Raises:
        ModelError: the models are of different metamodels, or of copies of one.
    """

    def __init__(self, base: EmfModel, a: EmfModel, b: EmfModel, take: Side | None = None, *, is_as_read: bool = False) -> None:
        refuse_others(base, a)
        refuse_others(base, b)
        self._take = _SIDES[take]
        self._model = a
        self._three = ThreeModels(base, a, b)
        self._refuse_copies(b)
        merged, conflicts = MergeDecisions(self._take or A), ConflictList(self._three)
        PlacesMerge(self._three, conflicts, merged, self._take).decide()
        FeaturesMerge(self._three, conflicts, merged).decide()
        self.conflicts = conflicts.all
        reported = [
            each.finding(place, take) for each, place in zip(self.conflicts, _places(a, conflicts, is_as_read), strict=True)
        ]
        self.findings: list[Finding] = [*base.findings, *a.findings, *b.findings, *reported]
        self._done = take is not None or not self.conflicts
        if self._done:
            merge_into(a, self._three, merged)

    def __repr__(self) -> str:
        return f"<ModelMerge: {quantity(len(self.conflicts), 'conflict')}>"

    @property
    def model(self) -> EmfModel:
        """The merged model: the first one, with what the second changed.

        Raises:
            ModelError: there are conflicts, and no side was to win them.
        """
        if not self._done:
            raise ModelError(
                f"the models have {quantity(len(self.conflicts), 'conflict')}, so there is no merged model",
                location=Location(str(self._model.path)) if self._model.path is not None else None,
                fix="solve the conflicts in the models, or merge with take='a' or take='b'",
            )
        return self._model

    def _refuse_copies(self, b: EmfModel) -> None:
        pair = next((each for each in self._three.all if each.elements[A] is not None and each.elements[B] is not None), None)
        if pair is not None and type(pair.elements[A]) is not type(pair.elements[B]):
            raise ModelError(
                "the models have two copies of a metamodel, so elements of one cannot go into the other",
                location=Location(str(b.path)) if b.path is not None else None,
                fix="open the models in one Session, or give their files",
            )


def merge(
    base: str | Path | Model,
    a: str | Path | Model,
    b: str | Path | Model,
    take: Side | None = None,
    metamodel: Paths | Metamodel = (),
) -> ModelMerge:
    """Merge what two models made of one.

    Args:
        base: what both were made from, a model of EMF or its file: XMI, JSON or .ecore.
        a: the first; given as a model, it becomes the merged one.
        b: the second.
        take: the side that wins conflicts.
        metamodel: .ecore files of models that are given as files, or a `Metamodel`; the built-in metamodels if none.

    Raises:
        SourceError: a file cannot be read.
        ModelError: a model contradicts its metamodel, they are of different ones, or one is no model of EMF.
    """
    first, second, third = opened_models((base, a, b), metamodel)
    return ModelMerge(first, second, third, take, is_as_read=not isinstance(a, Model))


def _places(a: EmfModel, conflicts: ConflictList, is_as_read: bool) -> list[Location | None]:
    """Where the first model has what is in conflict: file and line, of a model without a file nothing."""
    if a.path is None:
        return [None] * len(conflicts.all)
    is_plain = is_as_read and not any(finding.rule == FOREIGN for finding in a.findings)  # else children would be miscounted
    lines = lines_of(conflicts.in_a, a.path) if is_plain and conflicts.all else [None] * len(conflicts.all)
    return [Location(str(a.path), line) for line in lines]
