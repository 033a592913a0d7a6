"""The members of one generated class as texts: features, constructor, operations, and what type checkers need for them.

To type checkers, a feature or operation is `Any` if the metamodel redefines it with another type or a class inherits it from two
sides. Names and types are decided elsewhere (`package_names`, `package_types`).
"""

from __future__ import annotations

from collections.abc import Hashable

from msgspec import Struct

from robosmi.diagnostics import Severity
from robosmi.model.ecore.ecore_description import Class, Feature, Operation, Typed, is_known
from robosmi.model.ecore.source_text import call, docstring, string
from robosmi.model.elements.python_names import python_name
from robosmi.model.generator.package_cycles import Cycles
from robosmi.model.generator.package_names import PackageNames, Scope
from robosmi.model.generator.package_types import (
    PARTS,
    Notes,
    annotation,
    default_value,
    is_feature_map,
    is_typed,
    may_be_none,
    pyecore_type,
    type_name,
)

_FLAGS = {"ordered": True, "unique": True, "changeable": True} | dict.fromkeys(
    ("derived", "transient", "volatile", "unsettable"), False
)
"""Flag of a feature -> its default in Ecore."""


class FeatureText(Struct):
    """A feature: `name: type = EAttribute(...)`, and its documentation."""

    line: str
    documentation: str


class ClassMembers:
    """The members of a class.

    Args:
        cls: the class.
        scope: the names of its module.
        names: the names of the run.
        cycles: which packages wait for others.
        written: names that the person's mixin defines; operations among them get no stub.
        notes: takes what could not be said.

    Attributes:
        features: the features, in Ecore's order, without feature maps.
        operations: the stubs of the operations, one text each.
        parameters: the constructor's keyword parameters.
        conflicts: lines for type checkers alone.
        late: attributes whose type or default cannot be there when the class is defined.
    """

    def __init__(
        self, cls: Class, scope: Scope, names: PackageNames, cycles: Cycles, written: frozenset[str], notes: Notes
    ) -> None:
        self._cls, self._scope, self._names, self._cycles, self._notes = cls, scope, names, cycles, notes
        inherited = _keys(cls, names)
        self.features: list[FeatureText] = []
        self.late: list[tuple[Feature, tuple[str, str] | None]] = []
        defined: set[str] = set()
        for feature in cls.features:
            if is_feature_map(feature):
                notes.add(
                    "RS601", Severity.warning, feature, feature.path,
                    f"'{feature.path}' is a feature map, which is not supported: it is left out",
                    "use a metamodel without mixed content, or read such models without the generated package",
                )  # fmt: skip
                continue
            if names[feature] in defined:
                continue
            others = inherited.get(names[feature], set()) - {_key(feature)}
            if names[feature] in inherited:
                notes.add(
                    "RS604", Severity.warning, feature, feature.path,
                    f"'{feature.path}' hides an inherited feature or operation of that name",
                    "rename one of them in the .ecore file",
                )  # fmt: skip
            defined.add(names[feature])
            self.features.append(self._feature(feature, bool(others)))
        self.operations: list[str] = []
        for name, same in self._grouped(defined).items():
            defined.add(name)
            if name not in written:
                keys = inherited.get(name, set()) | {_key(o) for o in same}
                self.operations.append(self._operation(name, same, len(keys) > 1))
        self.parameters = self._parameters(inherited)
        self.conflicts = self._conflicts(inherited, defined | written) if len(cls.supertypes) > 1 else []

    def _feature(self, feature: Feature, untyped: bool) -> FeatureText:
        scope, name, kind = self._scope, self._names[feature], feature.classifier
        arguments = [] if name == feature.name else [f"name={string(feature.name)}"]
        default = None
        if not feature.is_reference:
            late = kind is not None and not is_known(kind) and self._cycles.data_type_is_late(scope.package, kind.package)
            default = default_value(feature, scope, self._names, self._notes, "link" if late else "run")
            if late:
                self.late.append((feature, default))
                default = None
            else:
                arguments.append(f"eType={pyecore_type(kind, scope)}")
        if feature.lower:
            arguments.append(f"lower={feature.lower}")
        if feature.upper != 1:
            arguments.append(f"upper={feature.upper}")
        arguments += [f"{flag}={not usual}" for flag, usual in _FLAGS.items() if getattr(feature, flag) != usual]
        if feature.is_reference and feature.containment:
            arguments.append("containment=True")
        if not feature.is_reference and feature.is_id:
            arguments.append("iD=True")
        if default is not None:
            arguments.append(f"{default[0]}={default[1]}")
        shown = scope.symbol("typing", "Any") if untyped else annotation(feature, scope, feature.default)
        made = scope.symbol(PARTS, "EReference" if feature.is_reference else "EAttribute")
        return FeatureText(
            call(f"{name}: {shown} = {made}", arguments, "    "), docstring(feature.documentation or feature.name, "    ")
        )

    def _parameters(self, inherited: dict[str, set[Hashable]]) -> list[str]:
        found: dict[str, str] = {}
        own = {self._names[feature]: _key(feature) for feature in self._cls.features}
        for feature in self._cls.all_features():
            if is_feature_map(feature):
                continue
            name, kind = self._names[feature], type_name(feature.classifier, self._scope)
            if len(inherited.get(name, set()) | ({own[name]} if name in own else set())) > 1:
                shown = self._scope.symbol("typing", "Any")
            elif feature.many:
                shown = f"{self._scope.symbol('collections.abc', 'Iterable')}[{kind}] | None"
            else:
                shown = f"{kind} | None" if is_typed(feature.classifier) else kind
            found[name] = f"{name}: {shown} = None"
        return list(found.values())

    def _grouped(self, defined: set[str]) -> dict[str, list[Operation]]:
        found: dict[str, list[Operation]] = {}
        for operation in self._cls.operations:
            if self._names[operation] not in defined:
                found.setdefault(self._names[operation], []).append(operation)
        return found

    def _operation(self, name: str, same: list[Operation], untyped: bool) -> str:
        scope, first = self._scope, same[0]
        if untyped:
            any_type = scope.symbol("typing", "Any")
            parameters, result = ["self", f"*args: {any_type}", f"**kwargs: {any_type}"], any_type
        else:
            parameters, taken = ["self"], {"self"}
            for number, parameter in enumerate(first.parameters, 1):
                own = python_name(parameter.name or f"argument{number}", (), taken)
                taken.add(own)
                parameters.append(f"{own}: {annotation(parameter, scope)}")
            result = "None" if first.type is None else annotation(first, scope)
        text = docstring("\n\n".join(o.documentation for o in same if o.documentation) or first.name, "        ")
        head = call(f"def {name}", parameters, "    ", f" -> {result}:")
        cls = self._names[self._cls]
        reason = string(
            f"{cls}.{name} is not written: define it in class {cls}Mixin of mixins.py, and generate the package again"
        )
        raised = call(f"raise {scope.symbol('builtins', 'NotImplementedError')}", [reason], "        ")
        return f"{head}\n        {text}\n        {raised}"

    def _conflicts(self, inherited: dict[str, set[Hashable]], defined: set[str]) -> list[str]:
        several = [name for name, keys in inherited.items() if len(keys) > 1 and name not in defined]
        return [f"{name}: {self._scope.symbol('typing', 'Any')}" for name in several]


def _keys(cls: Class, names: PackageNames) -> dict[str, set[Hashable]]:
    """Python name -> the declarations of the ancestors under that name."""
    found: dict[str, set[Hashable]] = {}
    for base in cls.ancestors():
        for feature in base.features:
            found.setdefault(names[feature], set()).add(_key(feature))
        for operation in base.operations:
            found.setdefault(names[operation], set()).add(_key(operation))
    return found


def _key(typed: Typed) -> Hashable:
    """A key that is equal for members that a type checker considers the same."""
    own = (typed.classifier, typed.many, may_be_none(typed, typed.default if isinstance(typed, Feature) else None))
    if isinstance(typed, Operation):
        return ("operation", *own, *((p.name, _key(p)) for p in typed.parameters))
    return own
