"""`Flock`: the migration of models whose metamodel has changed, corresponding to a Flock script.

It makes three passes over the original model in containment order: targets, conservative copy, rules. Types are given as texts,
since either metamodel may lack them, or as types of the models.

The conservative copy takes over a feature if the new class has one of that name and the value conforms to it; all others are
dropped, and only lost enumeration literals are reported. For EMF models only. Source: Rose et al., Model Migration with Epsilon
Flock (ICMT 2010), and measurements (docs/reference/flock.md).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, MutableSet
from typing import TYPE_CHECKING, Any, TypeVar, cast, overload

from robosmi.errors import RobosmiError, RuleError, UsageError, did_you_mean
from robosmi.model.elements.by_name import feature_value
from robosmi.model.elements.driver import Item, TypeHandle, class_of
from robosmi.model.elements.ecore import EClass, EClassifier, EEnum, EEnumLiteral, EObject, EStructuralFeature
from robosmi.model.elements.features import all_features, eclass_of
from robosmi.model.elements.pyecore_internals import set_xmi_id, xmi_id_of
from robosmi.model.elements.structure import feature_names
from robosmi.model.emf import EmfModel
from robosmi.query.collections import Q
from robosmi.query.rules.options import with_options
from robosmi.query.rules.rule_language import RuleBlocks, as_model, failed, run_over, technology
from robosmi.query.rules.settings import Settings
from robosmi.query.rules.verdicts import guarded
from robosmi.query.values import collection_kind
from robosmi.transform.assignment import assign
from robosmi.transform.flock_rules import Mapping, MigrateRule

if TYPE_CHECKING:
    from robosmi.base.functions import Function as AnyFunction
    from robosmi.model.elements.driver import FeatureValue, Item, Kind, Model, Node, Type
    from robosmi.model.elements.dynamic import Dynamic
    from robosmi.query.rules.decorating import Decorator, Function


T = TypeVar("T")

_MOST_NAMES = 40


class Flock(Settings):
    """A migration.

    Args:
        original: the model as it was, of EMF.
        migrated: the model to fill, of the new metamodel; usually empty.
        keep_order: whether references with an opposite keep their order. The engine copies both sides one after the other, which
            changes the order of the first; this is its behaviour and the default.
        lenient: whether a rule about a type, package or feature that the original metamodel lacks is only a warning, as in the
            engine; by default it is an error, since a misspelt name would lose the rule without a word.

    Attributes:
        pre: blocks that run first; `@f.pre` adds one.
        post: blocks that run last.
        warnings: what the last run found odd, in the engine's words.
        left_out: type -> how many of its elements the last run left out because the new metamodel has no such type, or an
            abstract one, though no retyping, deletion or rule is about them. The engine does not tell.

    Raises:
        UsageError: one of the models is none of EMF.
    """

    def __init__(
        self, original: Model | EObject, migrated: Model | EObject, *, keep_order: bool = False, lenient: bool = False
    ) -> None:
        self.original = _emf(original)
        self.migrated = _emf(migrated)
        self.keep_order = keep_order
        self.lenient = lenient
        self.pre = RuleBlocks()
        self.post = RuleBlocks()
        self.warnings: list[str] = []
        self.left_out: Counter[str] = Counter()
        self._mappings: list[Mapping] = []
        self._rules: list[MigrateRule] = []
        self._equivalents: dict[int, tuple[EObject, EObject | None]] = {}
        self.settle(Flock)

    @with_options("a retyping")
    def retype(self, original: Kind, evolved: Kind, *, when: AnyFunction | None = None, strict: bool = False) -> None:
        """Elements of a type become elements of another (Flock `retype A to B when: ...`); the first mapping that fits counts."""
        old, new = _name(original), _name(evolved)
        self._mappings.append(Mapping(f"retype {old} to {new}", old, evolved=new, when=when, strict=strict))

    @with_options("a retyping of a package")
    def retype_package(self, original: str, evolved: str, *, when: AnyFunction | None = None) -> None:
        """Elements of a package become elements of the same type name in another (Flock `retype package a to b`)."""
        self._mappings.append(Mapping(f"retype package {original} to {evolved}", original, True, evolved, when))

    @with_options("a deletion")
    def delete(self, original: Kind, *, when: AnyFunction | None = None, cascade: bool = False, strict: bool = False) -> None:
        """Elements of a type are not migrated (Flock `delete A`); what they contain becomes roots, with `cascade` it goes too."""
        old = _name(original)
        self._mappings.append(Mapping(f"delete {old}", old, when=when, strict=strict, cascade=cascade))

    @with_options("a deletion of a package")
    def delete_package(self, original: str, *, when: AnyFunction | None = None) -> None:
        """Elements of a package are not migrated (Flock `delete package a`)."""
        self._mappings.append(Mapping(f"delete package {original}", original, True, when=when))

    @with_options("a rule of Flock")
    def migrate(
        self, original: Kind, *, ignoring: Iterable[str] = (), when: AnyFunction | None = None, strict: bool = False
    ) -> Decorator:
        """A rule: `@f.migrate("Book") def _(original, migrated): ...`; without a function it only ignores features.

        Args:
            original: type of the original elements, by kind.
            ignoring: features that are not copied.
            when: for which elements.
            strict: whether subtypes are left alone.
        """
        ignored = (ignoring,) if isinstance(ignoring, str) else tuple(ignoring)
        rule = MigrateRule(_name(original), ignored, when, strict)
        self._rules.append(rule)

        def add(body: Function) -> Function:
            rule.body = body
            return body

        return add

    @overload
    def equivalent(self, original: FeatureValue) -> Dynamic: ...
    @overload
    def equivalent(self, original: Item, kind: type[T]) -> T: ...
    def equivalent(self, original: FeatureValue, kind: type[T] | None = None) -> Dynamic | T:
        """What became of an element: its migrated one, None if it has none; of a collection a list without those.

        Elements of other models and plain values are their own equivalent, as in the engine.

        Args:
            original: an element or value, or a collection of them.
            kind: the class that the migrated element is of, so that type checkers know it.

        Raises:
            RuleError: what became of it is not of that class.
        """
        if collection_kind(original) is not None:
            return cast(
                "Dynamic",
                Q([e for e in (self._equivalent(each) for each in cast("Iterable[EObject]", original)) if e is not None]),
            )
        made: Item = self._copy.value(original) if original is not None else None
        if kind is None:
            return cast("Dynamic", made)
        if not isinstance(made, kind):
            message = f"the equivalent of {original!r} is no {kind.__name__}: {made!r}"
            raise RuleError(message, fix="use its present class")
        return made

    def set(self, target: Node, /, **features: FeatureValue) -> None:
        """Set features to the equivalents of values (Flock `migrated.feature ::= original.feature`).

        Raises:
            ModelError: there is no such feature, or one value is given for many, or a collection for one.
        """
        for name, value in features.items():
            assign(target, name, self.equivalent(value), value)

    def _equivalent(self, original: EObject) -> EObject | None:
        found = self._equivalents.get(id(original))
        return found[1] if found is not None else None if self.original.owns(original) else original

    @property
    def _copy(self) -> ConservativeCopy:
        return ConservativeCopy(self._equivalent, self._literal, self.warnings.append)

    def _literal(self, enumeration: str, literal: str) -> EEnumLiteral | None:
        found = self.migrated.metamodel.find(enumeration)
        return next((x for x in found.eLiterals if x.name == literal), None) if isinstance(found, EEnum) else None

    def run(self) -> EmfModel:
        """Migrate: pre blocks, targets, conservative copy, rules, post blocks.

        Returns:
            The migrated model.

        Raises:
            RuleError: a guard or rule raises, a rule names what the original metamodel lacks (unless `lenient`), or a type to
                retype to does not exist or is abstract.
        """
        self.warnings, self.left_out, self._equivalents = [], Counter(), {}
        with run_over([self.original, self.migrated]):
            self.pre.run("pre")
            self._check()
            self._migrate()
            self.post.run("post")
        return self.migrated

    def _migrate(self) -> None:
        elements, unmapped = list(self.original.all_contents()), set[int]()
        for original in elements:
            self._equivalents[id(original)] = (original, self._target(original, unmapped))
        copy = self._copy
        rules = []
        for original in elements:
            rules.append(fitting := self._fitting_rules(original))
            if (migrated := self._equivalents[id(original)][1]) is not None:
                set_xmi_id(migrated, xmi_id_of(original))
                copy.copy(original, migrated, [name for rule in fitting for name in rule.ignoring])
            elif not fitting and id(original) in unmapped:
                self.left_out["::".join(_path(original.eClass))] += 1
        if self.keep_order:
            for old, new in list(self._equivalents.values()):
                if new is not None:
                    restore_order(old, new, self._equivalent)
        for original, fitting in zip(elements, rules, strict=True):
            self._apply(original, fitting)

    def _check(self) -> None:
        """Hold the declarations against both metamodels, before anything is made."""
        for mapping in self._mappings:
            if mapping.package:
                self._check_package(mapping)
                continue
            self._check_type(mapping.what, mapping.original)
            if mapping.evolved is not None and not self._instantiable(mapping.evolved):
                names = [n for n in self.migrated.type_names() if self._instantiable(n)]
                raise RuleError(
                    f"{mapping.what}: the new metamodel has no type '{mapping.evolved}' that can have elements"
                    f"{did_you_mean(mapping.evolved, names)}",
                    fix=f"use one of: {', '.join(names[:_MOST_NAMES])}{' ...' * (len(names) > _MOST_NAMES)}",
                )
        for rule in self._rules:
            what = f"migrate {rule.original}"
            kind = self._check_type(what, rule.original)
            known = feature_names(kind) if kind is not None else ()
            for name in rule.ignoring if kind is not None else ():
                if name not in known:
                    self._unknown(
                        f"The {name} property should be ignored, but there is no {name} property defined for {rule.original} "
                        "in the original metamodel.",
                        f"{what}: the original type has no feature '{name}' to ignore", name, known,
                    )  # fmt: skip

    def _check_type(self, what: str, name: str) -> EClass | None:
        kind = self.original.find_type(name)
        if kind is None:
            self._unknown(
                f"Rule defined for migrating instances of {name}, but no type {name} was found in the original metamodel.",
                f"{what}: the original metamodel has no type '{name}'", name, self.original.type_names(),
            )  # fmt: skip
        return kind

    def _check_package(self, mapping: Mapping) -> None:
        if not self._has_package(mapping.original):
            self._unknown(
                f"Rule defined for migrating members of {mapping.original}, but no package {mapping.original} was found "
                "in the original metamodel.",
                f"{mapping.what}: the original metamodel has no package '{mapping.original}'",
                mapping.original, [str(package.name) for package in self.original.packages],
            )  # fmt: skip

    def _unknown(self, warning: str, message: str, name: str, known: Iterable[str]) -> None:
        """Warn of a name that the original metamodel does not have, in the engine's words, or refuse it."""
        if self.lenient:
            self.warnings.append(warning)
            return
        names = list(known)
        raise RuleError(
            f"{message}{did_you_mean(name, names)}",
            fix=f"use one of: {', '.join(names)}; lenient=True passes over it with a warning, as the engine does",
        )

    def _has_package(self, name: str) -> bool:
        packages = self.original.packages
        for part in name.split("::"):
            found = next((p for p in packages if p.name == part), None)
            if found is None:
                return False
            packages = list(found.eSubpackages)
        return True

    def _instantiable(self, name: str) -> bool:
        kind = self.migrated.find_type(name)
        return kind is not None and not kind.abstract and not kind.interface

    def _target(self, original: EObject, unmapped: MutableSet[int]) -> EObject | None:
        """The new element for an original one; if there is none and no mapping is about it, its `id` is added to `unmapped`."""
        mapping = next((m for m in self._mappings if self._fits(m, original)), None)
        if mapping is None:
            name = "::".join(_path(original.eClass))
        elif mapping.evolved is None:
            return None
        else:
            name = f"{mapping.evolved}::{original.eClass.name}" if mapping.package else mapping.evolved
        if self._instantiable(name):
            return self.migrated.create(name)
        if mapping is None:
            unmapped.add(id(original))
        return None

    def _fits(self, mapping: Mapping, original: EObject) -> bool:
        element: EObject | None = original
        while element is not None:
            typed = _path(element.eClass)[0] == mapping.original if mapping.package else self._is(element, mapping)
            if typed and self._when(mapping.what, mapping.when, element):
                return True
            element = element.eContainer() if mapping.cascade else None
        return False

    def _is(self, element: EObject, construct: Mapping | MigrateRule) -> bool:
        kind = self.original.find_type(construct.original)
        if kind is None:
            return False
        cls = class_of(kind)
        return element.__class__ is cls if construct.strict else isinstance(element, cls)

    def _when(self, what: str, guard: AnyFunction | None, element: EObject) -> bool:
        if guard is None:
            return True
        try:
            return guarded(guard(element))
        except (Exception, SystemExit) as error:
            raise failed(error, f"the guard of '{what}'", guard, element, [self.original]) from error

    def _fitting_rules(self, original: EObject) -> list[MigrateRule]:
        return [r for r in self._rules if self._is(original, r) and self._when(f"migrate {r.original}", r.when, original)]

    def _apply(self, original: EObject, rules: list[MigrateRule]) -> None:
        migrated = self._equivalents[id(original)][1]
        for rule in rules:
            if migrated is None:
                self.warnings.append(
                    f"Rule defined for migrating instances of {'::'.join(_path(original.eClass))} but that type cannot be "
                    "instantiated in the evolved metamodel."
                )
            if rule.body is not None:
                try:
                    rule.body(original, migrated)
                except (Exception, SystemExit) as error:
                    failure = failed(error, f"the rule 'migrate {rule.original}'", rule.body, original, [self.original])
                    if migrated is None and not isinstance(error, RobosmiError):
                        failure.fix = _BECOMES_NOTHING.format(original.eClass.name)
                    raise failure from error


_BECOMES_NOTHING = (
    "elements of {0} become nothing, since the new metamodel has no such type, or they are deleted: "
    'write retype("{0}", NEW), or ask whether there is a migrated element'
)


def _emf(given: Model | EObject) -> EmfModel:
    model = technology(as_model(given))
    if not isinstance(model, EmfModel):
        raise UsageError(f"{model!r} is no EMF model", fix="migrate models whose metamodel is an .ecore")
    return model


def _name(kind: Kind) -> str:
    if isinstance(kind, str):
        return kind
    return "::".join(_path(kind.kind if isinstance(kind, TypeHandle) else kind))


def _path(kind: Type) -> list[str]:
    """The names of the packages of a class from the outermost, and its own."""
    eclass = eclass_of(kind)
    parts, package = [str(eclass.name)], eclass.ePackage
    while package is not None:
        parts.insert(0, str(package.name))
        package = package.eSuperPackage
    return parts


# ---- the conservative copy

_BOXED = {
    "boolean": "java.lang.Boolean", "byte": "java.lang.Byte", "char": "java.lang.Character", "double": "java.lang.Double",
    "float": "java.lang.Float", "int": "java.lang.Integer", "long": "java.lang.Long", "short": "java.lang.Short",
}  # fmt: skip
_OF_ECORE = {
    "EBoolean": "boolean", "EBooleanObject": "boolean", "EByte": "byte", "EByteObject": "byte", "EChar": "char",
    "ECharacterObject": "char", "EDouble": "double", "EDoubleObject": "double", "EFloat": "float", "EFloatObject": "float",
    "EInt": "int", "EIntegerObject": "int", "ELong": "long", "ELongObject": "long", "EShort": "short", "EShortObject": "short",
    "EString": "java.lang.String", "EDate": "java.util.Date", "EBigInteger": "java.math.BigInteger",
    "EBigDecimal": "java.math.BigDecimal",
}  # fmt: skip
NONE: Any = object()
"""Stands for a value that cannot be copied."""


class ConservativeCopy:
    """Copies features between elements of two metamodels.

    Args:
        equivalent: element of the original model -> its equivalent, None if it has none, itself if it is of another model.
        literal: enumeration and literal by name -> the literal of the new metamodel, or None.
        warn: receives warnings.
    """

    def __init__(
        self,
        equivalent: Callable[[EObject], EObject | None],
        literal: Callable[[str, str], EEnumLiteral | None],
        warn: Callable[[str], None],
    ) -> None:
        self._equivalent = equivalent
        self._literal = literal
        self._warn = warn

    def copy(self, original: EObject, migrated: EObject, ignored: Iterable[str]) -> None:
        """Copy all features that both elements' classes have, but the ignored ones, in the order of the original class."""
        new = {f.name: f for f in all_features(migrated.eClass)}
        skipped = set(ignored)
        for feature in all_features(original.eClass):
            wanted = new.get(feature.name)
            if wanted is None or feature.name in skipped or feature.derived or wanted.derived or not wanted.changeable:
                continue
            value = self._fitting(self._copied(feature, feature_value(original, feature.name)), feature, wanted)
            if value is NONE:
                continue
            if wanted.many:
                values = getattr(migrated, wanted.name)
                values.clear()
                values.extend(value)
            else:
                setattr(migrated, wanted.name, value)

    def _copied(self, feature: EStructuralFeature, value: Any) -> Any:
        if feature.many:
            return [c for c in (self.value(v) for v in value) if c is not None]
        return self.value(value)

    def value(self, value: Any) -> Any:
        """One value as the new model has it: equivalents of elements, literals of the same name, others as they are."""
        if isinstance(value, EEnumLiteral):
            enumeration = value.eContainer()
            literal = self._literal(enumeration.name, value.name) if isinstance(enumeration, EEnum) else None
            if literal is None:
                self._warn(f"Could not find in migrated metamodel an enumeration value equivalent to: {value.name}")
            return literal
        return self._equivalent(value) if isinstance(value, EObject) else value

    def _fitting(self, value: Any, feature: EStructuralFeature, wanted: EStructuralFeature) -> Any:
        """The value in the new feature's form, or NONE."""
        if feature.many:
            upper = wanted.upperBound if wanted.upperBound >= 0 else len(value)
            if not wanted.many or not wanted.lowerBound <= len(value) <= upper:
                return NONE
            return value if all(_is_instance(v, feature, wanted) for v in value) else NONE
        if value is None or not _is_instance(value, feature, wanted):
            return NONE
        return [value] if wanted.many else value


def _is_instance(value: Item, feature: EStructuralFeature, wanted: EStructuralFeature) -> bool:
    """Whether a value of one feature is an instance of another one's type, as Java's classes have it."""
    kind = wanted.eType
    if isinstance(kind, EEnum):
        return isinstance(value, EEnumLiteral) and value.eContainer() is kind
    if wanted.is_reference:
        return isinstance(value, class_of(kind))
    if isinstance(value, (EEnumLiteral, EObject)) or isinstance(feature.eType, EEnum):
        return False
    return _java_class(kind) in (_java_class(feature.eType), "java.lang.Object")


def _java_class(datatype: EClassifier) -> str:
    name = datatype.instanceClassName or _OF_ECORE.get(datatype.name, "java.lang.Object")
    return _BOXED.get(name, name)


def restore_order(original: EObject, migrated: EObject, equivalent: Callable[[EObject], EObject | None]) -> None:
    """Give the many-valued references of an element the order of the original, where copying their opposites changed it."""
    for feature in all_features(migrated.eClass):
        if not (feature.is_reference and feature.many and feature.eOpposite and not feature.derived):
            continue
        old: Any = getattr(original, feature.name, None)
        if collection_kind(old) is None:
            continue
        values = getattr(migrated, feature.name)
        wanted = [e for e in (equivalent(x) for x in old) if e is not None]
        if list(values) != wanted and len(values) == len(wanted) and {id(x) for x in values} == {id(x) for x in wanted}:
            values.items[:] = wanted
            values.map.update({element: index for index, element in enumerate(wanted)})
