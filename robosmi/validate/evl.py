"""`EVL`: a module of constraints, corresponding to an EVL file.

It contains contexts, constraints without context, pre and post blocks and included modules, and runs them on models. It can be
written without any model (contexts refer to classes or names) and run on any number of models, one after the other.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, overload

from robosmi.diagnostics import Location, Severity
from robosmi.model.elements.driver import Model, TypeHandle
from robosmi.model.elements.ordering import post_order
from robosmi.query.rules.options import with_options
from robosmi.query.rules.rule_language import Given, RuleBlocks, as_model, run_over
from robosmi.query.rules.settings import Settings
from robosmi.validate.constraint import Constrained, Constraint, Context, E, Fix, R
from robosmi.validate.evaluation import Evaluation
from robosmi.validate.findings import ApplicableFix, Applied, Unsatisfied, Validation

if TYPE_CHECKING:
    from robosmi.base.functions import Function
    from robosmi.model.elements.driver import DynamicNode, Item
    from robosmi.query.rules.decorating import Decorator


class EVL(Settings):
    """Constraints on models.

    Args:
        models: handles or root elements; `run` may be given others.

    Attributes:
        pre: blocks that run before all checks; `@v.pre` adds one.
        post: blocks that run after all fixes.
        contexts: the contexts declared here, in order.
    """

    def __init__(self, *models: Given) -> None:
        self.models: list[Model] = [as_model(m) for m in models]
        self.pre = RuleBlocks()
        self.post = RuleBlocks()
        self.contexts: list[Constrained] = []
        self._constraints: Context[DynamicNode] = Context(None)
        self._critiques: Context[DynamicNode] = Context(None)
        self._included: list[EVL] = []
        self._evaluation: Evaluation | None = None
        self.settle(EVL)

    @overload
    def context(
        self, kind: type[E], *, guard: Callable[[E], bool] | None = None, lazy: bool = False, name: str | None = None
    ) -> Context[E]: ...
    @overload
    def context(
        self, kind: str | TypeHandle, *, guard: Function | None = None, lazy: bool = False, name: str | None = None
    ) -> Context[DynamicNode]: ...
    @with_options("a context")
    def context(
        self,
        kind: type[E] | str | TypeHandle,
        *,
        guard: Callable[[E], bool] | None = None,
        lazy: bool = False,
        name: str | None = None,
    ) -> Context[E]:
        """A context: constraints on the elements of a type and its subtypes.

        Args:
            kind: a type of a model (`M.Book`), a class, or a name ("Book", "M!Book").
            guard: for which elements its constraints are evaluated.
            lazy: whether its constraints are evaluated only where `satisfies` asks.
            name: how reports name it; the type's name if None.
        """
        made: Context[E] = Context(kind, guard, lazy, name)
        self.contexts.append(made)
        made.lies_among(self.contexts)
        return made

    @overload
    def constraint(self, check: Callable[[], R], /) -> Callable[[], R]: ...
    @overload
    def constraint(
        self,
        /,
        *,
        name: str | None = None,
        guard: Callable[[], bool] | None = None,
        lazy: bool = False,
        message: str | Callable[[], str] | None = None,
        fixes: Sequence[Fix] = (),
        severity: Severity | None = None,
        id: str | None = None,
        advice: str | Callable[[], str] | None = None,
        location: Callable[[], Location | None] | None = None,
        terminate: bool = False,
    ) -> Decorator: ...
    def constraint(self, check: Any = None, /, **options: Any) -> Any:
        """Add a constraint without context: it is evaluated once, after all contexts, and its function has no parameter."""
        add = self._constraints.constraint(**options)
        return add if check is None else add(check)

    @overload
    def critique(self, check: Callable[[], R], /) -> Callable[[], R]: ...
    @overload
    def critique(
        self,
        /,
        *,
        name: str | None = None,
        guard: Callable[[], bool] | None = None,
        lazy: bool = False,
        message: str | Callable[[], str] | None = None,
        fixes: Sequence[Fix] = (),
        severity: Severity | None = None,
        id: str | None = None,
        advice: str | Callable[[], str] | None = None,
        location: Callable[[], Location | None] | None = None,
        terminate: bool = False,
        info: bool = False,
    ) -> Decorator: ...
    def critique(self, check: Any = None, /, **options: Any) -> Any:
        """Add a critique without context: evaluated once, after all constraints without context."""
        add = self._critiques.critique(**options)
        return add if check is None else add(check)

    def include(self, other: EVL) -> None:
        """Import another module: its pre blocks, contexts and post blocks come before those of this one."""
        self._included.append(other)

    def modules(self) -> list[EVL]:
        """The included modules, those that they include before them, and this one last; each once."""
        return list(post_order([self], lambda module: module._included))

    def declared(self) -> Iterator[Constraint]:
        """The constraints and critiques of this module and of those that it includes, with and without context."""
        for module in self.modules():
            for context in (*module.contexts, module._constraints, module._critiques):
                yield from context.constraints

    def run(self, *models: Given, fix: str | Callable[[Unsatisfied], ApplicableFix | None] | None = None) -> Validation:
        """Validate: pre blocks, all checks, fixes if requested, post blocks.

        Args:
            models: handles or root elements; those of the constructor if none.
            fix: "first" or "last" to perform that fix of every finding, or a function that chooses one.

        Raises:
            RuleError: a block or a function of a constraint raises; what was found until then is in `unsatisfied`.
            UnknownTypeError: a context is about a type that no model has.
        """
        modules = self.modules()
        evaluation = self._start(modules, [as_model(m) for m in models])
        with run_over(evaluation.models):
            for module in modules:
                module.pre.run("pre")
            evaluation.run()
            if fix is not None:
                evaluation.result.apply(fix)
            for module in modules:
                module.post.run("post")
        return evaluation.result

    def _start(self, modules: list[EVL], models: list[Model]) -> Evaluation:
        used = models or [m for module in reversed(modules) for m in module.models]
        contexts = []
        for module in modules:
            contexts += [*module.contexts, *(c for c in (module._constraints, module._critiques) if c.constraints)]
        evaluation = Evaluation(contexts, list(dict.fromkeys(used)))
        for module in modules:
            module._evaluation = evaluation
        return evaluation

    def _current(self) -> Evaluation:
        return self._evaluation or self._start(self.modules(), [])

    def satisfies(self, element: Item, *names: str | Function) -> bool:
        """Whether an element satisfies all these constraints, named or given as functions; what fails is reported.

        Raises:
            UsageError: there is no such constraint for the element, or constraints ask for each other in a circle.
        """
        return all(self._current().satisfies(element, name) for name in names)

    satisfies_all = satisfies

    def satisfies_one(self, element: Item, *names: str | Function) -> bool:
        """Whether an element satisfies at least one of these constraints.

        Raises:
            UsageError: there is no such constraint for the element, or constraints ask for each other in a circle.
        """
        return any(self._current().satisfies(element, name) for name in names)

    @property
    def unsatisfied(self) -> list[Unsatisfied]:
        """What the last run found, also of one that ended with an error."""
        return self._evaluation.result.unsatisfied if self._evaluation is not None else []

    @property
    def fixed(self) -> list[Applied]:
        """The fixes that the last run performed."""
        return self._evaluation.result.fixed if self._evaluation is not None else []

    @property
    def result(self) -> Validation | None:
        """The result of the last run, also of one that ended with an error."""
        return self._evaluation.result if self._evaluation is not None else None
