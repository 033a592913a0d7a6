"""`EVL`: a module of constraints, corresponding to an EVL file.

It contains contexts, constraints without context, pre and post blocks and included modules, and runs them on models. It can be
written without any model (contexts refer to classes or names) and run on any number of models, one after the other.

`Evaluation` is one run over models. The order is that of Epsilon's engine: contexts in order of declaration, their elements in
containment order, and for each element the constraints in order. The result of a check is cached, and used once some
`satisfies` has requested the constraint. Findings are a set of (constraint, element, message). Source: Kolovos et al., The
Epsilon Book, chapter 5, and measurements (docs/reference/evl.md).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, overload

from robosmi.diagnostics import Location, Severity
from robosmi.errors import InternalError, RuleError, UsageError, did_you_mean
from robosmi.model.elements.driver import Model, TypeHandle
from robosmi.model.elements.feature_errors import ONE_LOAD
from robosmi.model.elements.ordering import post_order
from robosmi.query.rules.deep_recursion import LEVELS, in_thread
from robosmi.query.rules.options import with_options
from robosmi.query.rules.rule_language import (
    Given,
    RuleBlocks,
    RuleType,
    as_model,
    called,
    failed,
    option_value,
    other_load,
    place_of,
    rule_type,
    run_over,
)
from robosmi.query.rules.settings import Settings
from robosmi.query.rules.verdicts import guarded, verdict_of
from robosmi.validate.constraint import Constrained, Constraint, Context, E, Fail, Fix, R
from robosmi.validate.findings import ApplicableFix, Applied, Unsatisfied, Validation

if TYPE_CHECKING:
    from robosmi.base.functions import Function
    from robosmi.model.elements.driver import DynamicNode, Item
    from robosmi.query.rules.decorating import Decorator
    from robosmi.query.values import Answer


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


class _State:
    """A constraint in one evaluation: its functions and cached results.

    Until some `satisfies` asks for it, only failures are stored: an element of a finished context that is not among them
    satisfies the constraint. `results` has all results after that, and those of constraints with a guard or `terminate` from
    the start.
    """

    __slots__ = ("check", "constraint", "depended_on", "done", "failed", "guard", "kind", "recorded", "results")

    def __init__(self, constraint: Constraint, kind: RuleType | None, done: set[Any]) -> None:
        self.constraint = constraint
        self.kind = kind
        self.check = constraint.check if kind is not None else _of_nothing(constraint.check)
        self.guard = constraint.guard if kind is not None or constraint.guard is None else _of_nothing(constraint.guard)
        self.recorded = constraint.guard is not None or constraint.terminate
        self.done = set() if self.recorded or constraint.lazy else done
        self.failed: set[Any] = set()
        self.results: dict[Any, bool] = {}
        self.depended_on = False

    def verdict(self, element: Any) -> Any:
        """The result of the check for an element.

        Raises:
            UsageError: the check returns no truth value, such as a text or a collection. `return holds or "message"` and
                `return holds, "message"` would always satisfy the constraint, since a text and a tuple are true.
        """
        verdict = self.check(element)
        return verdict_of(
            verdict,
            "whether the constraint holds",
            'write `return holds or Fail("message")`; compare what is to be there (`b.name != ""`); call what is a method',
        )

    def applies(self, element: Answer) -> bool:
        """Whether the constraint applies to an element: it has no guard, or its guard is true."""
        return self.guard is None or guarded(self.guard(element))

    def answer(self, element: Answer) -> bool | None:
        """The cached result for an element; None if it has to be evaluated."""
        if not self.depended_on:
            return None
        if element in self.results:
            return self.results[element]
        return element not in self.failed if element in self.done else None

    def requested(self) -> None:
        """Use cached results from now on, since some `satisfies` asks for this constraint."""
        self.depended_on = self.recorded = True


def _of_nothing(function: Callable[[], Any]) -> Callable[[Any], Any]:
    return lambda _: function()


class Evaluation:
    """The evaluation of constraints on some models.

    Args:
        contexts: in the order in which they are evaluated.
        models: the models.

    Raises:
        UnknownTypeError: a context is about a type that no model has.
    """

    def __init__(self, contexts: Sequence[Constrained], models: list[Model]) -> None:
        self.models = models
        self.result = Validation(models)
        self._contexts: list[tuple[Constrained, RuleType | None, list[_State], set[Any]]] = []
        self._named: dict[str, list[_State]] = {}
        self._asked: dict[tuple[_State, Any], None] = {}
        self._found: set[tuple[Constraint, Any, str]] = set()
        for context in contexts:
            first = context.constraints[0].check if context.constraints else None
            about = f"the context {context.name}"
            kind = rule_type(context.kind, models, about, first) if context.kind is not None else None
            if kind is not None and (model := other_load(kind, models)) is not None:
                raise RuleError(
                    f"{about} is about another load of the metamodel that the model {model.name} has",
                    location=place_of(first) if first is not None else None, fix=ONE_LOAD,
                )  # fmt: skip
            done: set[Any] = set()
            states = [_State(c, kind, done) for c in context.constraints]
            self._contexts.append((context, kind, states, done))
            for state in states:
                self._named.setdefault(state.constraint.name, []).append(state)

    def run(self) -> None:
        """Evaluate all constraints that are not lazy.

        Raises:
            RuleError: a guard, a check, a message or a fix's title or guard raises; the findings so far stay.
        """
        for context, kind, states, done in self._contexts:
            if not context.lazy:
                self._sweep(self._elements(context, kind), [s for s in states if not s.constraint.lazy], done)

    def _elements(self, context: Constrained, kind: RuleType | None) -> Iterator[Any]:
        if kind is None:
            yield None
            return
        elements = kind.instances(exact=False)
        if context.guard is None:
            yield from elements
            return
        for element in elements:
            try:
                included = guarded(context.guard(element))
            except (Exception, SystemExit) as error:
                raise failed(error, f"the guard of the context {context.name}", context.guard, element, self.models) from error
            if included:
                yield element

    def _sweep(self, elements: Iterator[Any], states: list[_State], done: set[Any]) -> None:
        for element in elements:
            ended = False
            for state in states:
                try:
                    if state.recorded:
                        if not state.applies(element):
                            continue
                        if state.answer(element) is not None:
                            continue  # its failure was reported on request
                        verdict = state.verdict(element)
                        state.results[element] = bool(verdict)
                    else:
                        verdict = state.verdict(element)
                except (RuleError, InternalError):
                    raise  # of a requested constraint
                except (Exception, SystemExit) as error:
                    raise self._failed(error, state, element) from error
                if not verdict:
                    state.failed.add(element)
                    self._report(state, element, verdict)
                    ended |= state.constraint.terminate
            done.add(element)
            if ended:
                states = [s for s in states if not (s.constraint.terminate and s.failed)]

    def _failed(self, error: BaseException, state: _State, element: Any) -> Exception:
        constraint, raised_at = state.constraint, error.__traceback__
        raised = raised_at and raised_at.tb_next
        frames = []
        while raised is not None:
            frames.append(raised.tb_frame.f_code)
            raised = raised.tb_next
        in_guard = _State.applies.__code__ in frames
        function = constraint.guard if in_guard and constraint.guard is not None else constraint.check
        what = f"the {'guard' if in_guard else 'check'} of {constraint.name}"
        if isinstance(error, TypeError) and str(error).startswith("exceptions must derive from"):
            error = UsageError("it raises what is no exception", fix="a check returns what it finds: write `return Fail(...)`")
            error.__traceback__ = raised_at
        return failed(error, what, function, element, self.models)

    def _report(self, state: _State, element: Any, verdict: Any) -> None:
        constraint = state.constraint
        result = verdict if isinstance(verdict, Fail) else Fail()
        what: tuple[str, Any] = ("the message", constraint.message)
        try:
            message = result.message if result.message is not None else option_value(constraint.message, element)
            default = message is None
            message = f"Invariant {constraint.name} result for {element!r}" if default else str(message)
            key = (constraint, element, message)
            if key in self._found:
                return
            self._found.add(key)
            what = ("the advice", constraint.advice)
            advice = option_value(constraint.advice, element)
            found = Unsatisfied(constraint, element, message, default, dict(result.extras), advice=advice)
            self.result.unsatisfied.append(found)
            for fix in (*result.fixes, *constraint.fixes):
                what = ("a fix's guard or title", fix.guard if callable(fix.guard) else fix.title)
                if option_value(fix.guard, element):
                    found.fixes.append(ApplicableFix(fix, found, self.models))
        except (Exception, SystemExit) as error:
            function = what[1] if callable(what[1]) else constraint.check
            raise failed(error, f"{what[0]} of {constraint.name}", function, element, self.models) from error

    def satisfies(self, element: Any, name: Any) -> bool:
        """Whether an element satisfies a constraint; an element for which the constraint's guard is false does not.

        Args:
            element: the element; None satisfies nothing.
            name: the constraint's name, or its function.

        Raises:
            UsageError: there is no such constraint for the element, or constraints ask for each other in a circle.
        """
        if element is None:
            return False
        state = self._state_named(name, element)
        if state.kind is None:
            element = None
        if (known := state.answer(element)) is not None:
            return known
        if (state, element) in self._asked:
            circle = ", ".join(dict.fromkeys(s.constraint.name for s, _ in self._asked))
            raise UsageError(
                f"constraints ask for each other in a circle: {circle}", fix="remove one of these calls of satisfies"
            )
        self._asked[state, element] = None
        try:
            return bool(self._ask(state, element) if len(self._asked) % LEVELS else in_thread(self._ask, state, element))
        except (RuleError, InternalError):
            raise
        except (Exception, SystemExit) as error:
            raise self._failed(error, state, element) from error
        finally:
            self._asked.pop((state, element), None)

    def _ask(self, state: _State, element: Any) -> bool:
        if not state.applies(element):
            state.requested()
            return False
        verdict = state.verdict(element)
        state.results[element] = bool(verdict)
        if not verdict:
            self._report(state, element, verdict)
        state.requested()
        return bool(verdict)

    def _state_named(self, name: Any, element: Any) -> _State:
        if callable(name):
            named = [s for states in self._named.values() for s in states if s.constraint.check is name]
            name = called(name)
        else:
            named = self._named.get(name, [])
        for state in named:
            if state.kind is None or state.kind.has(element):
                return state
        if not named:
            raise UsageError(
                f"there is no constraint '{name}'{did_you_mean(str(name), self._named)}",
                fix=f"use one of: {', '.join(self._named)}",
            )
        contexts = ", ".join(s.constraint.context.name for s in named)
        raise UsageError(
            f"the constraint '{name}' is about {contexts}, not about {element!r}", fix="ask for one of its own context"
        )
