"""What the template of a generated package shows: a package as texts, all decisions made.

One `PackageView` for one EPackage. Names come from `package_names`, types from `package_types`; here they become the lines of a
module. No file is read or written.

`ClassMembers` has the members of one class: features, constructor, operations, and what type checkers need for them. To type
checkers, a feature or operation is `Any` if the metamodel redefines it with another type or a class inherits it from two sides.

`Links` has the statements that run when the classes are defined: types of references, opposites, operations. They are for pyecore
alone; type checkers read the annotations. `package_cycles` decides whether they run at once or wait for other packages.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence

from msgspec import Struct

from robosmi.diagnostics import Severity
from robosmi.model.ecore.ecore_description import (
    Class,
    DataType,
    DescribedElement,
    Enumeration,
    Feature,
    Operation,
    Package,
    Typed,
    is_known,
)
from robosmi.model.ecore.linearise import topological
from robosmi.model.ecore.source_text import assignment, call, docstring, imports, string
from robosmi.model.elements.python_names import python_name
from robosmi.model.generator.package_cycles import Cycles
from robosmi.model.generator.package_names import PackageNames, Scope
from robosmi.model.generator.package_types import (
    PARTS,
    STRICT,
    Notes,
    annotation,
    base_name,
    default_value,
    is_base,
    is_feature_map,
    is_typed,
    may_be_none,
    pyecore_type,
    type_name,
)

Mixins = Mapping[str, Mapping[str, frozenset[str]]]
"""Module path with slashes -> name of a class -> names that the person's `mixins.py` defines for it."""

_FLAGS = {"ordered": True, "unique": True, "changeable": True} | dict.fromkeys(
    ("derived", "transient", "volatile", "unsettable"), False
)
"""Flag of a feature -> its default in Ecore."""


class ClassView(Struct):
    """A class as texts: the lines before it, `class X(Y):`, its docstring, what it holds."""

    decorators: list[str]
    header: str
    documentation: str
    members: ClassMembers


class EnumerationView(Struct):
    """An enumeration as texts: its name, literals and the call that makes it."""

    name: str
    documentation: str
    base: str
    literals: list[tuple[str, str]]
    made: str


class PackageView(Struct):
    """A package as texts, made by `view_of`."""

    constants: list[str]
    documentation: str
    package_call: str
    enumerations: list[EnumerationView]
    datatypes: list[str]
    classes: list[ClassView]
    links: Links
    standard_imports: list[str] = []
    own_imports: list[str] = []
    package_imports: list[str] = []
    typing_imports: list[str] = []
    later: list[str] = []
    data_aliases: list[str] = []
    class_aliases: list[str] = []
    symbols: dict[str, str] = {}


def view_of(
    package: Package, names: PackageNames, bases: Mapping[Class, list[Class]], cycles: Cycles, mixins: Mixins, notes: Notes
) -> PackageView:
    """The view of one package.

    Args:
        package: the package.
        names: the Python names of the run.
        bases: Python's bases of each class (`linearise`).
        cycles: who waits for whom.
        mixins: what persons wrote beside generated packages.
        notes: takes what the user should know.
    """
    scope = Scope(package, names)
    own_mixins = mixins.get("/".join(names.module(package)), {})
    symbols = {"Classifier": scope.symbol(PARTS, "Classifier", "typing")}
    symbols["GeneratedModule"] = scope.symbol(PARTS, "GeneratedModule", "typing")
    symbols["package"] = scope.symbol(PARTS, "package")
    symbols["find_classifier"] = scope.symbol(PARTS, "find_classifier")
    links = Links(package, names, scope, cycles)
    enumerations = [_enumeration(e, scope, names) for e in package.classifiers if isinstance(e, Enumeration)]
    datatypes = [
        _data_type(d, scope, names) for d in package.classifiers if isinstance(d, DataType) and not isinstance(d, Enumeration)
    ]
    if any(e.literals for e in enumerations):
        symbols["ClassVar"] = scope.symbol("typing", "ClassVar")
    ordered = [c for c in topological([c for c in package.classifiers if isinstance(c, Class)])[0] if c.package is package]
    classes = []
    for cls in ordered:
        mixin = own_mixins.get(f"{names[cls]}Mixin")
        late = any(cycles.supertype_is_late(package, base.package) for base in bases[cls])
        members = ClassMembers(cls, scope, names, cycles, mixin or frozenset(), notes)
        header = _header(cls, bases[cls], late, mixin is not None, scope, names)
        classes.append(
            ClassView(
                _decorators(cls, bases[cls], late, scope, names),
                header,
                docstring(cls.documentation or cls.name, "    "),
                members,
            )
        )
        links.add_class(cls, bases[cls] if late else None, mixin is not None, members)
    _note_names(package, names, notes)
    links.finish([*(e for e in package.classifiers if isinstance(e, DataType))])
    origin = f"Generated from {package.source.name} by robosmi metamodels generate. Do not edit."
    symbols["TYPE_CHECKING"] = scope.symbol("typing", "TYPE_CHECKING")
    return PackageView(
        constants=[
            assignment("name", string(package.name), ""),
            assignment("nsURI", string(package.uri), ""),
            assignment("nsPrefix", string(package.prefix), ""),
        ],
        documentation=docstring(f"{package.documentation or package.name}\n\n{origin}", ""),
        package_call=f"{symbols['package']}(name, nsURI, nsPrefix)",
        enumerations=enumerations,
        datatypes=datatypes,
        classes=classes,
        links=links,
        symbols=symbols,
        data_aliases=[f"{alias} = {names[c]}" for c, alias in scope.aliases.items() if isinstance(c, DataType)],
        class_aliases=[f"{alias} = {names[c]}" for c, alias in scope.aliases.items() if isinstance(c, Class)],
        **_imports(scope, bases, ordered, cycles),
    )


def _header(cls: Class, bases: list[Class], late: bool, mixin: bool, scope: Scope, names: PackageNames) -> str:
    arguments = [scope.symbol(".mixins", f"{names[cls]}Mixin")] if mixin else []
    own = [base for base in bases if is_base(base)]
    when = "typing" if late else "run"
    arguments += [base_name(base, scope, when) for base in own] or [scope.symbol(STRICT, "Element")]
    if late or not own:
        arguments.append(f"metaclass={scope.symbol(PARTS, 'MetaEClass')}")
    return call(f"class {names[cls]}", arguments, "", ":")


def _decorators(cls: Class, bases: list[Class], late: bool, scope: Scope, names: PackageNames) -> list[str]:
    found = []
    if cls.interface:
        found.append(f"@{scope.symbol(PARTS, 'interface')}")
    elif cls.abstract:
        found.append(f"@{scope.symbol(PARTS, 'abstract')}")
    if names[cls] != cls.name:
        found.append(f"@{scope.symbol(PARTS, 'named')}({string(cls.name)})")
    own = [base for base in cls.supertypes if is_base(base)]
    if not late and own != [base for base in bases if is_base(base)]:
        arguments = [base_name(base, scope) for base in own]
        found.append(call(f"@{scope.symbol(PARTS, 'supertypes')}", arguments, ""))
    return found


def _enumeration(kind: Enumeration, scope: Scope, names: PackageNames) -> EnumerationView:
    arguments = [string(kind.name), _mapping([(x.name, str(x.value)) for x in kind.literals])]
    texts = [(x.name, string(x.text)) for x in kind.literals if x.text != x.name]
    renamed = [(x.name, string(names[x])) for x in kind.literals if names[x] != x.name]
    if texts:
        arguments.append(f"texts={_mapping(texts)}")
    if renamed:
        arguments.append(f"names={_mapping(renamed)}")
    made = call(f"{names[kind]} = {scope.symbol(PARTS, 'enumeration')}", arguments, "    ")
    base = scope.symbol(STRICT, "EnumLiteral", "typing")
    literal = scope.classifier(kind) if kind.literals else ""
    return EnumerationView(
        names[kind],
        docstring(kind.documentation or kind.name, "        "),
        base,
        [(names[x], literal) for x in kind.literals],
        made,
    )


def _mapping(pairs: list[tuple[str, str]]) -> str:
    line = "{" + ", ".join(f"{string(key)}: {value}" for key, value in pairs) + "}"
    if len(line) <= 70:
        return line
    return "{\n" + "".join(f"            {string(key)}: {value},\n" for key, value in pairs) + "        }"


def _data_type(kind: DataType, scope: Scope, names: PackageNames) -> str:
    arguments = [string(kind.name)] + ([string(kind.instance_class)] if kind.instance_class else [])
    return call(f"{names[kind]} = {scope.symbol(PARTS, 'datatype')}", arguments, "")


def _imports(scope: Scope, bases: Mapping[Class, list[Class]], classes: list[Class], cycles: Cycles) -> dict[str, list[str]]:
    run, typing = dict(scope.used("run")), dict(scope.used("typing"))
    late = {
        scope.classifier(base, "typing", inside=False)
        for cls in classes
        if any(cycles.supertype_is_late(scope.package, base.package) for base in bases[cls])
        for base in bases[cls]
        if base.package is not scope.package and not is_known(base)
    }
    late -= {name for found in run.values() for _, name in found}  # defined all the same, for a class that is not late
    only_typing = {module: found - run.get(module, set()) for module, found in typing.items()}
    standard = {m: f for m, f in run.items() if not m.startswith((".", "robosmi"))}
    for module in [m for m in only_typing if not m.startswith((".", "robosmi"))]:
        standard[module] = standard.get(module, set()) | only_typing.pop(module)
    return {
        "standard_imports": imports({m: f for m, f in standard.items() if f}),
        "own_imports": imports({m: f for m, f in run.items() if m.startswith("robosmi") and f}),
        "package_imports": imports({m: f for m, f in run.items() if m.startswith(".") and f}),
        "typing_imports": imports({m: f for m, f in only_typing.items() if f}, "    "),
        "later": sorted(late),
    }


def _note_names(package: Package, names: PackageNames, notes: Notes) -> None:
    """Note each name that has another form in Python."""
    elements: list[tuple[DescribedElement, str]] = [(package, package.path)]
    for classifier in package.classifiers:
        elements.append((classifier, classifier.path))
        inner: list[DescribedElement] = []
        if isinstance(classifier, Enumeration):
            inner += classifier.literals
        elif isinstance(classifier, Class):
            inner += [*classifier.features, *classifier.operations]
        elements += [(element, f"{classifier.path}.{element.name}") for element in inner]
    for element, path in elements:
        if names[element] != element.name:
            message, fix = f"'{path}' is called '{names[element]}' in Python", "use that name in Python code"
            notes.add("RS602", Severity.info, element, path, message, fix)


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
            bases += [self._late(base) for base in late_bases if is_base(base)]
            self._heads.append(call(self._scope.symbol(PARTS, "inherit", "link"), [own, *bases], self._indent))
            if late_bases != cls.supertypes:
                order = ", ".join(self._late(base) for base in cls.supertypes if is_base(base))
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
        if is_known(base):
            return base_name(base, self._scope, "link")
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
