"""The statements of a generated package that run when its classes are defined: types of references, opposites, operations.

They are for pyecore alone; type checkers read the annotations. Whether they run at once or wait for other packages is
`package_cycles`' decision.
"""

from __future__ import annotations

from collections.abc import Sequence

from robosmi.model.ecore_description import Class, DataType, Feature, Operation, Package, is_known
from robosmi.model.package_cycles import Cycles
from robosmi.model.package_members import ClassMembers
from robosmi.model.package_names import PackageNames, Scope
from robosmi.model.package_types import PARTS, is_feature_map, pyecore_type
from robosmi.model.source_text import assignment, call, imports, string


class Links:
    """The statements of one package.

    Attributes:
        waits: the relative modules that it waits for; empty if it waits for none.
        decorator: the line before the function that waits; empty if there is none.
        imports: import lines.
        statements: the statements.
    """

    def __init__(self, package: Package, names: PackageNames, scope: Scope, cycles: Cycles) -> None:
        self._package, self._names, self._scope = package, names, scope
        self._heads: list[str] = []
        self._types: list[str] = []
        self._opposites: list[str] = []
        self._operations: list[str] = []
        self._seen: set[Feature] = set()
        waits = [scope.relative(other) for other in cycles.waits_for(package)]
        self._indent = "        " if waits else "    "
        self.decorator = (
            call(f"@{scope.symbol(PARTS, 'linked')}", ["__name__", *(string(w) for w in waits)], "    ") if waits else ""
        )
        self.imports: list[str] = []
        self.statements: list[str] = []

    def _class(self, cls: Class) -> str:
        return self._scope.classifier(cls, "link", inside=False)

    def add_class(self, cls: Class, late_bases: list[Class] | None, mixin: bool, members: ClassMembers) -> None:
        """Take in a class, supertypes before subclasses.

        Args:
            cls: the class.
            late_bases: its Python bases, if they can be set only now.
            mixin: whether it has a mixin of the person's as its first base.
            members: its members.
        """
        own = self._names[cls]
        if late_bases is not None:
            bases = [self._scope.symbol(".mixins", f"{own}Mixin")] if mixin else []
            bases += [self._late(base) for base in late_bases if not is_known(base)]
            self._heads.append(call(self._scope.symbol(PARTS, "inherit", "link"), [own, *bases], self._indent))
            if late_bases != cls.supertypes:
                order = ", ".join(self._late(base) for base in cls.supertypes if not is_known(base))
                self._heads.append(f"{self._scope.symbol(PARTS, 'supertypes', 'link')}({order})({own})")
        for feature in cls.features:
            if is_feature_map(feature):
                continue
            place = f"{own}.{self._names[feature]}"
            if feature.is_reference:
                self._types.append(assignment(f"{place}.eType", self._type(feature), self._indent))
            self._opposite(feature, place)
        for attribute, default in members.late:
            place = f"{own}.{self._names[attribute]}"
            kind = pyecore_type(attribute.classifier, self._scope, "link")
            self._types.append(assignment(f"{place}.eType", kind, self._indent))
            if default is not None:
                self._types.append(assignment(f"{place}.{default[0]}", default[1], self._indent))
        if cls.operations:
            made = [self._operation(operation) for operation in cls.operations]
            self._operations.append(call(self._scope.symbol(PARTS, "operations", "link"), [own, *made], self._indent))

    def _late(self, base: Class) -> str:
        """An expression for a base class by its full path, since its plain name is used for something else in the module."""
        if base.package is self._package:
            return self._names[base]
        module = self._scope.relative(base.package)
        return self._scope.symbol(f"{module}", self._names[base], "link")

    def _type(self, feature: Feature) -> str:
        kind = feature.classifier
        if isinstance(kind, Class) and not is_known(kind):
            return self._class(kind)
        return pyecore_type(kind, self._scope, "link")

    def _opposite(self, feature: Feature, place: str) -> None:
        other = feature.opposite
        if other is None or other.opposite is not feature or other in self._seen:
            return
        mine, theirs = feature.owner.package, other.owner.package
        if mine is not theirs and (theirs.path, str(theirs.source)) < (mine.path, str(mine.source)):
            return  # the other package says it
        self._seen.add(feature)
        value = f"{self._class(other.owner)}.{self._names[other]}"
        self._opposites.append(assignment(f"{place}.eOpposite", value, self._indent))

    def _operation(self, operation: Operation) -> str:
        scope = self._scope
        arguments, parameters = [string(operation.name)], list[str]()
        if operation.type is not None:
            arguments.append(pyecore_type(operation.classifier, scope, "link"))
        indent = self._indent + "    "
        for parameter in operation.parameters:
            kind = pyecore_type(parameter.classifier, scope, "link")
            upper = [f"upper={parameter.upper}"] if parameter.upper != 1 else []
            parts = [string(parameter.name), kind, *upper]
            parameters.append(call(scope.symbol(PARTS, "EParameter", "link"), parts, f"{indent}        "))
        if parameters:
            arguments.append(call("params=", parameters, f"{indent}    ", brackets="[]"))
        if operation.upper != 1:
            arguments.append(f"upper={operation.upper}")
        return call(scope.symbol(PARTS, "EOperation", "link"), arguments, indent)

    def finish(self, datatypes: Sequence[DataType]) -> None:
        """Put the statements together.

        Args:
            datatypes: the enumerations and data types of the package.
        """
        scope = self._scope
        registered = [
            f"{scope.symbol(PARTS, 'classifier', 'link')}(__name__, {scope.classifier(kind, 'link', inside=False)})"
            for kind in datatypes
        ]
        inner = []
        if self._package.subpackages:
            modules = [self._names[package] for package in self._package.subpackages]
            scope.used("link")["."] = {(name, name) for name in modules}
            inner.append(call(scope.symbol(PARTS, "subpackages", "link"), ["__name__", *modules], self._indent))
        self.statements = [*self._heads, *self._types, *self._opposites, *self._operations, *registered, *inner]
        needed = {
            module: wanted
            for module, found in scope.used("link").items()
            if (wanted := {pair for pair in found if pair not in scope.used("run").get(module, set())})
        }
        self.imports = imports(needed, self._indent)
