"""Collects which declarations, parameters, results, array elements and members of a program can exchange values.

It fills `value_flows`. Other uses of a value are collected by `value_uses`, bodies of macros are read by
`queries.ports.port_flows`.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Hashable, Mapping, Sequence
from functools import cached_property

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import ancestor_of_kind
from robosmi.transformations.knowledge.api_facts import PinParameter
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.flows.class_pins import constructor_pins, method_pins
from robosmi.transformations.queries.flows.classes import Classes, OwnFunctions, member_type, shared_names, statics
from robosmi.transformations.queries.flows.cores import handed_over
from robosmi.transformations.queries.flows.listed_values import Initialisers, designates, gone_through, listed_types
from robosmi.transformations.queries.flows.pin_uses import CutNumbers, pin_number
from robosmi.transformations.queries.flows.pointed_calls import called_lambdas
from robosmi.transformations.queries.flows.pointers import (
    gives_access,
    moved_pointer,
    pinless_functions,
    pointed_functions,
    takes_number,
)
from robosmi.transformations.queries.flows.value_flows import Flows, PinArgument, PortPlace
from robosmi.transformations.queries.initialisers import leaves, members_given, record_of
from robosmi.transformations.queries.macros.argument_places import Holders, TokenText, passed_to_macros
from robosmi.transformations.queries.member_records import (
    all_fields,
    has_several_types,
    record_key,
    record_of_member,
    records_of_cast,
    whole_of_member,
)
from robosmi.transformations.queries.own_headers import is_member
from robosmi.transformations.queries.values import calls_of_value

_WRITTEN = re.compile(rb"[0-9']")
"""Matches what a number or character begins with that is written in the text itself, not made by a macro."""
_DIMENSION = re.compile(r"\[\s*(\d+)\s*\]")


class FlowReader:
    """Builds the value flows of one program.

    Args:
        views: a view of each unit.
        sources: path of a unit -> its bytes.
    """

    def __init__(self, views: Sequence[CodeView], sources: Mapping[str, bytes]) -> None:
        self.views = views
        self.flows = Flows()
        self.texts = {view.unit.path: TokenText(sources[view.unit.path]) for view in views}
        self.sources = sources
        self.holders = {view.unit.path: Holders([*view.unit.macros, *view.unit.macroUses]) for view in views}
        self.macros = {str(m.name): m for view in views for m in view.unit.macros}
        self.constants = {} if not views else {n: v for n, v in views[0].api.pin_constants.items() if n not in self.macros}
        """Constant of the platform that is a pin of the board -> its number."""
        self._cut = CutNumbers(views, sources)
        self.classes = Classes(views)
        self.functions = OwnFunctions(views, self.classes)
        self.called = self.functions.called
        self.given: dict[tuple[str, int, int], list[Hashable]] = {}
        """(path of the unit, start, end) of an argument of a macro use -> keys of the macro parameters that it is passed to."""
        self.followed: set[tuple[str, int, int]] = set()
        """The keys of `given` whose argument the code model has an expression for (filled by `value_uses`)."""
        self._known: set[Hashable] = set()
        self._initialisers = Initialisers()
        self._fields: dict[str, dict[Hashable, None]] = {}
        """Name of a member -> the keys of the members of that name."""
        self._unread = 0
        self._defined = {
            str(d.name)
            for v in views
            for d in v.unit.declarations
            if isinstance(d, ccode.Variable) and d.storage is not ccode.Storage.externStorage
        }
        self._static = statics(views)
        self._shared = shared_names(views)
        self._places: dict[int, int] = {}
        """`id` of a parameter -> its place among those of its function."""
        pointed, own = pointed_functions(views)
        known = {str(reference.name): view for reference, view in pointed} if not own else {}
        self.pointed = {p.position: (name, p) for name, view in known.items() for p in self.pins(name, view)}
        """Position -> (function, pin parameter) of platform functions called through pointers, if no own one is."""
        self._other_pointed = bool(known) and any(pinless_functions(views))
        """Whether calls through pointers may reach functions that take another number in a pin's place."""
        for view in views:
            for place, taker in passed_to_macros(view.unit, self.texts[view.unit.path], self.macros):
                self.given.setdefault(place, []).append(taker)

    # ---- what things are

    def key(self, thing: Element | None) -> Hashable:
        """The key of a declaration or expression in the flows; the same one for a thing that several files declare."""
        if isinstance(thing, ccode.Variable) and thing.storage is ccode.Storage.externStorage:
            return self._outer(thing)
        if isinstance(thing, (ccode.Variable, ccode.Function)) and isinstance(
            thing.eContainer(), (ccode.SourceUnit, ccode.Program)
        ):
            if thing.storage is not ccode.Storage.staticStorage:
                of_class = self.classes.around(thing) if isinstance(thing, ccode.Function) and is_member(thing) else None
                return (type(thing).__name__, str(thing.name), *((str(of_class.name),) if of_class is not None else ()))
        elif isinstance(thing, ccode.Parameter):
            function = thing.eContainer()
            if isinstance(function, ccode.Function):
                if id(thing) not in self._places:
                    self._places |= {id(each): place for place, each in enumerate(function.parameters)}
                return ("Parameter", self.key(function), self._places[id(thing)])
        return ("element", id(thing))

    def _outer(self, declared: ccode.Variable) -> Hashable:
        """The key of the variable that an `extern` declaration means, in a block too."""
        unit = ancestor_of_kind(declared, ccode.SourceUnit)
        static = self._static.get((id(unit), str(declared.name)))
        return ("element", id(static)) if static is not None else ("Variable", str(declared.name))

    def value(self, expression: ccode.Located | None) -> Hashable:
        """The key of the thing that an expression takes its value from, such as a variable, a member or a function's result."""
        if expression is None:  # in text that the parser could not read
            self._unread += 1
            return self._once(("unread", self._unread), "it is in text that could not be parsed")
        if not isinstance(expression, ccode.IntegerLiteral) and (left := self._cut.left(expression)) is not None:
            return self._narrowed(expression, left)
        if isinstance(expression, ccode.Cast):
            return self.value(expression.operand)
        if isinstance(expression, ccode.Index):
            return self.value(expression.array)
        if isinstance(expression, ccode.Assignment):
            return self.value(expression.left)
        if isinstance(expression, ccode.Unary) and str(expression.operator) in ("*", "&"):
            return self.value(expression.operand)
        if isinstance(expression, ccode.Unary) and str(expression.operator) in ("++", "--"):
            stepped = self.value(expression.operand)
            self.calculated(stepped, expression)
            return stepped
        if isinstance(expression, ccode.Binary) and str(expression.operator) == ",":
            return self.value(expression.right)
        if isinstance(expression, ccode.Binary) and (array := moved_pointer(expression)) is not None:
            elements = self.value(array)
            self.flows.freeze(elements, f"line {expression.line} calculates where it is")
            return elements
        if isinstance(expression, ccode.NameReference):
            return self._name(expression)
        if isinstance(expression, ccode.Member):
            return self._member(expression)
        if isinstance(expression, ccode.Call):
            return self._result(expression)
        if isinstance(expression, ccode.IntegerLiteral):
            return self._literal(expression)
        if isinstance(expression, ccode.ConstructorCall):
            return self.key(expression)
        key = self.key(expression)
        if not isinstance(expression, ccode.ConditionalExpression):
            self.calculated(key, expression)
        return key

    def calculated(self, key: Hashable, expression: ccode.Located) -> None:
        """Record that computed values enter a flow, so that its numbers cannot be changed in the text."""
        self.flows.freeze(key, f"line {expression.line} calculates it")
        unit = ancestor_of_kind(expression, ccode.SourceUnit)
        if unit is not None and not (isinstance(expression, ccode.Unary) and gives_access(expression.operand)):
            self.flows.of(key).calculated.append((unit, expression))

    def _name(self, reference: ccode.NameReference) -> Hashable:
        target = reference.target
        if isinstance(target, (ccode.Variable, ccode.Parameter)) and not self._is_constant(reference):
            return self.key(target)
        if isinstance(target, ccode.EnumerationLiteral):
            return self._enumerator(target)
        if reference.name in self.macros:
            return ("macro", str(reference.name))
        if self._is_constant(reference):
            return self._constant(reference)
        shared = self._shared.get(str(reference.name))
        if shared is not None:  # declared in a header that the parser did not see
            return self._enumerator(shared) if isinstance(shared, ccode.EnumerationLiteral) else self.key(shared)
        return self._once(("name", str(reference.name)), f"'{reference.name}' is not the program's own")

    def _result(self, call: ccode.Call) -> Hashable:
        if not call.viaMacro and (own := self.called(call)):
            results = [("result", self.key(function)) for function in own]
            for other in results[1:]:
                self.flows.join(results[0], other)
            return results[0]
        name = call.calleeName or "a function"
        return self._once(("element", id(call)), f"'{name}' returns it (line {call.line})")

    def _member(self, member: ccode.Member) -> Hashable:
        if member.object is None and designates(member):
            return self.key(member)
        if member.object is None:  # of the object that a method is called for
            record = self.classes.around(member)
            if record is not None and (owner := self.classes.with_member(record, str(member.name))) is not None:
                return self._field(str(member.name), record_key(owner))
            return self._once(self._field(str(member.name), None), f"'{member.name}' is a member of another class")
        whole = whole_of_member(member)
        return self.value(whole) if whole is not None else self._field(str(member.name), record_of_member(member))

    def _field(self, name: str, record: Hashable | None) -> Hashable:
        """The key of a record's member; a member of an unknown record is joined with all members of its name."""
        key = ("field", name, record)
        known = self._fields.setdefault(name, {})
        if key not in known:
            known[key] = None
            if record is None or record not in self.classes.constructed:
                self.flows.freeze(key, f"'{name}' is a member of a structure")
            if (unknown := ("field", name, None)) in known:
                for other in known:
                    self.flows.join(unknown, other)
        return key

    def loosen(self, record: ccode.Record, why: str) -> None:
        """Let the members of a record, and of the records in it, have any value."""
        for field in all_fields(record):
            self.flows.freeze(self._field(str(field.name), record_key(field.eContainer())), why, computed=True)

    def _cast(self, cast: ccode.Cast) -> None:
        """Join the members at equal positions of two records between whose pointers a cast converts."""
        records = records_of_cast(cast)
        fields = [record.fields for record in records] if records is not None else []
        for one, other in zip(*fields, strict=False):
            keys = [self._field(str(field.name), record_key(field.eContainer())) for field in (one, other)]
            self.flows.join(*keys)
            if one.bitWidth != other.bitWidth:
                self.flows.freeze(keys[0], f"line {cast.line} casts it", computed=True)

    def _narrowed(self, expression: ccode.Located, left: Sequence[int | None]) -> Hashable:
        """The key of what a narrow type leaves of a value."""
        key, unit = ("cut", id(expression)), ancestor_of_kind(expression, ccode.SourceUnit)
        if key not in self._known and unit is not None:
            self._known.add(key)
            self.flows.freeze(key, f"line {expression.line} makes it narrower", computed=None in left)
            for number in (number for number in left if number is not None):
                self.put(key, unit, int(expression.startOffset), int(expression.endOffset), number, expression, "")
        return key

    def _once(self, key: Hashable, why: str) -> Hashable:
        self.flows.freeze(key, why, computed=True)
        return key

    def _literal(self, literal: ccode.IntegerLiteral) -> Hashable:
        key = self.key(literal)
        if key not in self._known:
            self._known.add(key)
            name, within, holder = self._initialisers.constant(literal)
            unit = ancestor_of_kind(literal, ccode.SourceUnit)
            assert unit is not None
            start, end, number = int(literal.startOffset), int(literal.endOffset), int(literal.value)
            if (left := self._cut.left(literal)) is not None:
                number = left[0] or 0
                self.flows.freeze(key, f"line {literal.line} makes it {number}")
            self.put(key, unit, start, end, pin_number(number), holder, name, within)
            if not _WRITTEN.match(self.sources[unit.path], start, end):
                self.flows.freeze(key, f"a macro makes it (line {literal.line})")
        return key

    def _is_constant(self, reference: ccode.NameReference) -> bool:
        """Whether a name is a pin of the board by the platform, and not the program's own."""
        target = reference.target
        own = target is not None and ancestor_of_kind(target, ccode.SourceUnit) is not None
        return str(reference.name) in self.constants and not own and str(reference.name) not in self._shared

    def _constant(self, reference: ccode.NameReference) -> Hashable:
        key = self.key(reference)
        if key not in self._known:
            self._known.add(key)
            name, within, holder = self._initialisers.constant(reference)
            unit = ancestor_of_kind(reference, ccode.SourceUnit)
            assert unit is not None
            start, end = int(reference.startOffset), int(reference.endOffset)
            self.put(key, unit, start, end, self.constants[str(reference.name)], holder, name, within)
            if self.sources[unit.path][start:end] != str(reference.name).encode():
                self.flows.freeze(key, f"a macro makes it (line {reference.line})")
        return key

    def put(
        self, key: Hashable, unit: ccode.SourceUnit, start: int, end: int, value: int, element: ccode.Located, name: str,
        within: str = "",
    ) -> None:  # fmt: skip
        """Record that a number in the text enters the flow of a thing."""
        self.flows.put(key, PortPlace(unit, start, end, value, element, name, within))

    def _enumerator(self, literal: ccode.EnumerationLiteral) -> Hashable:
        key = self.key(literal)
        if key not in self._known:
            self._known.add(key)
            unit = ancestor_of_kind(literal, ccode.SourceUnit)
            if unit is None:
                return self._once(key, f"'{literal.name}' is not the program's own")
            number = pin_number(int(literal.value))
            self.put(key, unit, literal.startOffset, literal.endOffset, number, literal, str(literal.name))
        return key

    # ---- what exchanges values with what

    def follow(self, view: CodeView) -> None:
        """Add the exchanges of values in a unit to the flows."""
        for element in view.elements:
            if isinstance(element, ccode.NameReference):
                self._taken(element)
            elif isinstance(element, ccode.Variable):
                self._variable(element)
            elif isinstance(element, ccode.Function):
                self._unseen_calls(element)
                self._defaults(element)
            elif isinstance(element, ccode.Lambda):
                for parameter in element.parameters:
                    if calls_of_value(element) is None:
                        self.flows.freeze(self.key(parameter), f"a lambda is given it (line {element.line})", computed=True)
                    elif parameter.defaultValue is not None:
                        self._give(self.key(parameter), parameter.defaultValue)
            elif isinstance(element, ccode.Assignment):
                self._assignment(element)
            elif isinstance(element, ccode.Cast):
                self._cast(element)
            elif isinstance(element, ccode.ConditionalExpression):
                self._give(self.key(element), element.whenTrue)
                self._give(self.key(element), element.whenFalse)
            elif isinstance(element, ccode.Return) and element.value is not None:
                self._return(element)
            elif isinstance(element, ccode.Call):
                self._call(element, view)
            elif isinstance(element, ccode.ConstructorCall):
                self._constructed(str(element.className), list(element.arguments), element, view)
            elif isinstance(element, ccode.MemberInitializer):
                self._initial_member(element, view)
            elif isinstance(element, ccode.InitializerList):
                self._listed(element)
            elif isinstance(element, ccode.Field) and element.initializer is not None:
                self._default_member(element)
            elif isinstance(element, ccode.Record) and element.recordKind is ccode.RecordKind.unionType:
                self._one_place(element)
            elif isinstance(element, ccode.For) and element.range is not None and element.declaration is not None:
                why = f"line {element.line} goes through a range with it"
                for key in map(self.key, element.declaration.declarations):
                    self._give(key, element.range) if gone_through(element) else self.flows.freeze(key, why, computed=True)

    def _give(self, taker: Hashable, expression: ccode.Expression | None) -> None:
        """Join the flow of a thing with that of an expression which it is given."""
        self.flows.join(taker, self.value(expression))
        unit = ancestor_of_kind(expression, ccode.SourceUnit) if expression is not None else None
        if unit is not None and expression is not None and self._cut.left(expression) is None:
            self.flows.of(taker).given.append((unit, expression))

    def _taken(self, reference: ccode.NameReference) -> None:
        """Join the parameters of a function that is used as a value with the arguments of all calls through pointers."""
        function = reference.target
        if not isinstance(function, ccode.Function) or not function.definition:
            return
        call = ancestor_of_kind(reference, ccode.Call)
        handed, code = handed_over(call, self.views[0].api) if call is not None else (None, None)
        if code is function and code.parameters:
            parameter = self.key(code.parameters[0])
            self._give(parameter, handed)
            self.flows.freeze(parameter, f"it is passed to '{code.name}' on another core")
            return
        why = f"'{function.name}' is called through a pointer"
        for position, parameter in enumerate(function.parameters):
            self.flows.join(("through a pointer", position), self.key(parameter))
            self.flows.freeze(self.key(parameter), why, computed=True)
        self.flows.freeze(("result", self.key(function)), why)

    def _defaults(self, function: ccode.Function) -> None:
        """Give the parameters of a function their default arguments, which its declaration in a class may have."""
        for position, parameter in enumerate(function.parameters):
            if parameter.defaultValue is not None:
                same = [function] if function.definition else self.classes.definitions(function) or [function]
                for definition in (each for each in same if position < len(each.parameters)):
                    self._give(self.key(definition.parameters[position]), parameter.defaultValue)

    def _unseen_calls(self, function: ccode.Function) -> None:
        """Keep the numbers of what constructors and operators are given, since the code model does not have their calls."""
        around = function.eContainer()
        constructor = isinstance(around, ccode.Record) and function.name == around.name
        hidden = str(function.name).startswith("operator") or (constructor and not self.classes.is_visible(str(function.name)))
        for parameter in function.parameters if hidden else ():
            self.flows.freeze(self.key(parameter), f"'{function.name}' is given it without a call in the text", computed=True)

    def _constructed(
        self,
        name: str,
        arguments: list[ccode.Expression],
        made: ccode.ConstructorCall | ccode.MemberInitializer,
        view: CodeView,
    ) -> None:
        """Join what an object is made with, with the parameters of its class's constructors, or let it end in pins."""
        for function in self.classes.constructors(name, len(arguments)):
            for parameter, argument in zip(function.parameters, arguments, strict=False):
                self._give(self.key(parameter), argument)
        for pin in constructor_pins(self.classes, name, view, arguments):
            if pin.position < len(arguments):
                argument = arguments[pin.position]
                start, end = int(argument.startOffset), int(argument.endOffset)
                self.reach(self.value(argument), PinArgument(view.unit, start, end, name, pin, None, argument, construction=made))

    def _initial_member(self, initial: ccode.MemberInitializer, view: CodeView) -> None:
        """Give a member the value that a constructor initialises it with; a base class is constructed with it."""
        field = self.classes.initialised(initial)
        kind = str(initial.name) if field is None else member_type(field.valueType)
        arguments = list(initial.arguments)
        if field is None or self.classes.constructors(kind, len(arguments)) or constructor_pins(self.classes, kind, view):
            self._constructed(kind, arguments, initial, view)
        elif len(arguments) == 1:
            for value in leaves(arguments[0]):
                self._give(self._field(str(field.name), record_key(field.eContainer())), value)

    def _default_member(self, field: ccode.Field) -> None:
        """Give a member the value that its class declares it with."""
        if record_of(field.valueType) is None:
            for value in leaves(field.initializer):
                self._give(self._field(str(field.name), record_key(field.eContainer())), value)

    def _one_place(self, union: ccode.Record) -> None:
        """Join the members of a union, which are one place in memory."""
        keys = [self._field(str(field.name), record_key(union)) for field in union.fields]
        for key in keys:
            self.flows.join(keys[0], key)
        if has_several_types(union):
            self.loosen(union, "it is a member of a union of several types")

    def _listed(self, values: ccode.InitializerList) -> None:
        """Give the members of a structure what a list without a variable gives them: `(struct led){4, 5}`, `return {4, 5}`.

        Where the text does not say the structure, any with as many members may be meant.
        """
        around = values.eContainer()
        inside = isinstance(around, ccode.Assignment) and isinstance(around.eContainer(), ccode.InitializerList)
        member = self.classes.initialised(around) if isinstance(around, ccode.MemberInitializer) else None
        inside |= member is not None and record_of(member.valueType) is None  # pin{p}
        if inside or isinstance(around, (ccode.Variable, ccode.InitializerList)) or not values.elements:
            return
        types = listed_types(values, self.classes, self.sources, self.called)
        for use in types:
            self._give_members(use, values)
        if not types:
            records = (e for view in self.views for e in view.of_kind(ccode.Record) if len(e.fields) >= len(values.elements))
            for field in (field for record in records for field in record.fields):
                key = self._field(str(field.name), record_key(field.eContainer()))
                self.flows.freeze(key, f"a list may give it a value (line {values.line})", computed=True)

    def _give_members(self, use: ccode.TypeUse | None, values: ccode.InitializerList) -> None:
        """Give the members of a structure, or of an array of them, the values of a list."""
        given = list(members_given(use, values))
        takers = Counter(id(value) for _, value in given)
        for member, value in given:
            key = self._field(str(member.name), record_key(member.eContainer()))
            self._give(key, value)
            if member.bitWidth and takers[id(value)] > 1:
                self.flows.freeze(key, f"a list without braces may give it a value (line {values.line})", computed=True)

    def _variable(self, variable: ccode.Variable) -> None:
        key, use = self.key(variable), variable.valueType
        if isinstance(variable.initializer, ccode.ConstructorCall):
            self.flows.freeze(key, f"'{variable.name}' is constructed (line {variable.line})", computed=True)
            return
        if record_of(use) is not None and variable.initializer is not None:
            if isinstance(variable.initializer, ccode.InitializerList):
                self._give_members(use, variable.initializer)
            else:
                self.flows.freeze(self.value(variable.initializer), f"'{variable.name}' is a structure")
            return
        if variable.initializer is not None:
            given = list(leaves(variable.initializer))
            for inner in given:
                self._give(key, inner)
            sizes = [int(n) for n in _DIMENSION.findall(str(use.arrayDims or ""))] if use is not None else []
            count = 1
            for size in sizes:
                count *= size
            if sizes and len(given) < count and isinstance(variable.initializer, ccode.InitializerList):
                self.flows.freeze(key, f"elements of '{variable.name}' are 0 until they get a value")
            return
        lasting = isinstance(variable.eContainer(), ccode.SourceUnit) or variable.storage is ccode.Storage.staticStorage
        if variable.storage is ccode.Storage.externStorage:
            if variable.name not in self._defined:
                self.flows.freeze(key, f"'{variable.name}' is defined elsewhere", computed=True)
        elif lasting:
            self.flows.freeze(key, f"'{variable.name}' is 0 until it gets a value")

    def _assignment(self, assignment: ccode.Assignment) -> None:
        if isinstance(assignment.eContainer(), ccode.InitializerList):
            return  # a value for a member or element by its name
        left = self.value(assignment.left)
        if str(assignment.operator) != "=":
            self.calculated(left, assignment)
            return
        self._give(left, assignment.right)
        if not isinstance(assignment.left, ccode.NameReference):
            self.flows.freeze(left, f"line {assignment.line} fills it at run time")

    def _return(self, statement: ccode.Return) -> None:
        function = ancestor_of_kind(statement, ccode.Function)
        if function is not None:
            self._give(("result", self.key(function)), statement.value)

    def _call(self, call: ccode.Call, view: CodeView) -> None:
        if call.viaMacro:
            return
        arguments = list(call.arguments)
        lambdas, alone = called_lambdas(call)
        own = [] if alone else self.called(call)
        for taken in [each.parameters for each in lambdas] + [each.parameters for each in own]:
            for parameter, argument in zip(taken, arguments, strict=False):
                self._give(self.key(parameter), argument)
        for each in lambdas if not alone else ():
            for parameter in each.parameters:
                self.flows.freeze(self.key(parameter), f"line {call.line} may call something else with it")
        if alone or own:
            return
        if (method := method_pins(self.classes, call, view)) is not None:
            for pin in method[1]:
                if pin.position < len(arguments):
                    self._pin(method[0], pin, call, view)
            return
        if call.callee is None and call.calleeExpression is not None:
            for position, argument in enumerate(arguments):
                self._give(("through a pointer", position), argument)
            for name, pin in self.pointed.values():
                if pin.position < len(arguments) and takes_number(call, pin.position):
                    self.flows.freeze(self.value(arguments[pin.position]), f"it is given through a pointer (line {call.line})")
                    self._pin(name, pin, call, view, mixed=self._other_pointed)
            return
        parameters = self.pins(str(call.calleeName or ""), view)
        if not parameters:
            self._exchanged(arguments)
        for pin in parameters:
            if pin.position < len(arguments):
                self._pin(str(call.calleeName), pin, call, view)

    def _pin(self, function: str, pin: PinParameter, call: ccode.Call, view: CodeView, *, mixed: bool = False) -> None:
        """Let the flow of a call's argument end in a pin parameter of a platform function."""
        text, arguments = self.texts[view.unit.path], list(call.arguments)
        if call.calleeExpression is not None:  # which may have parentheses of its own
            places = text.last_arguments(int(call.endOffset))
        else:
            places = text.arguments(text.at(int(call.startOffset)))
        argument = arguments[pin.position]
        start, end = int(argument.startOffset), int(argument.endOffset)
        if places is not None and len(places) == len(arguments) and places[pin.position]:
            start, end = places[pin.position][0][1], places[pin.position][-1][2]
        if not text.tokens or view_text(self.sources[view.unit.path], start, end) not in pin.none:
            self.reach(self.value(argument), PinArgument(view.unit, start, end, function, pin, call, argument, mixed=mixed))

    def _exchanged(self, arguments: Sequence[ccode.Expression]) -> None:
        """Join the arguments through which an unknown function may pass values on: pointers, arrays, callbacks."""
        open_ = [a for a in arguments if gives_access(a)]
        for one in open_[1:]:
            self.flows.join(self.value(open_[0]), self.value(one))
        if open_ and any(isinstance(a, ccode.NameReference) and isinstance(a.target, ccode.Function) for a in arguments):
            self.flows.join(("through a pointer", 0), self.value(open_[0]))

    def reach(self, key: Hashable, pin: PinArgument) -> None:
        """Record that a flow ends in an argument that is a pin."""
        self.flows.of(key).arguments.append(pin)
        if not pin.translated and not pin.unplaced:
            self.flows.freeze(key, f"it is the end of a range in '{pin.function}'")

    def pins(self, name: str, view: CodeView) -> Sequence[PinParameter]:
        """The parameters of a function that are pins for the platform or for its adapter; none for any other function."""
        if view.defined(name):
            return ()
        function = view.called().get(name)
        if function is not None and (function.entry is not None or function.calls):
            facts = view.api.pins(name, function.header)
        else:
            entry = view.resolve(name)
            facts = view.api.pins(name, entry.header if entry is not None else "")
        return facts.parameters if facts is not None else ()

    @cached_property
    def _declared(self) -> dict[str, list[Hashable]]:
        """The keys of variables, parameters and enumerators by their names, wherever they are declared."""
        found: dict[str, list[Hashable]] = {}
        for each in (element for view in self.views for element in view.elements):
            if isinstance(each, ccode.EnumerationLiteral):
                found.setdefault(str(each.name), []).append(self._enumerator(each))
            elif isinstance(each, (ccode.Variable, ccode.Parameter)):
                found.setdefault(str(each.name), []).append(self.key(each))
        return found

    def named(self, name: str) -> list[Hashable]:
        """The keys of all that a name may mean in the body of a macro."""
        return [("macro", name)] if name in self.macros else list(dict.fromkeys(self._declared.get(name, ())))


def view_text(data: bytes, start: int, end: int) -> str:
    """The text of a byte range of a unit, without white space around it."""
    return data[start:end].decode("utf-8", errors="replace").strip()
