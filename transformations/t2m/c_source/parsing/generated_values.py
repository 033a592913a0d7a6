"""Reads what gives values to what in a generated program: assignments, initial values, arguments, results, members.

All places that write a thing count, whenever they do.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence

from robosmi.transformations.t2m.c_source.parsing import clang, cursor_kinds as kinds
from robosmi.transformations.t2m.c_source.parsing.clang import Cursor
from robosmi.transformations.t2m.c_source.parsing.generated_names import (
    ADDRESS,
    ASSIGN,
    EXTERN,
    FUNCTIONS,
    POINTERS,
    RECORDS,
    REFERENCES,
    SCOPES,
    STEPS,
    GeneratedNames,
    Key,
    Origin,
    plain,
    unwrapped,
)  # fmt: skip
from robosmi.transformations.t2m.c_source.parsing.generated_program import SKETCH, GeneratedProgram
from robosmi.transformations.t2m.c_source.parsing.generated_tree import GeneratedNode


class GeneratedValues(GeneratedNames):
    """What gives values to what in a generated program.

    Args:
        program: the program.
        functions: functions that are not the program's own, whose calls are listed.

    Attributes:
        given: a thing -> the expressions, other things and origins that it takes its values from.
        calls: each call of one of the functions, with its name and arguments.
        indirect: the calls through pointers, with their arguments.
        taken: those of the functions whose address is taken.
        defined: the program's own functions that have a body.
        elsewhere: variables that are declared, each with its declaration, and defined in no file that was read.
    """

    def __init__(self, program: GeneratedProgram, functions: Collection[str]) -> None:
        super().__init__(program)
        self._functions = functions
        self.given: dict[Key, list[GeneratedNode | Key | Origin]] = {}
        self.calls: list[tuple[GeneratedNode, str, Sequence[GeneratedNode]]] = []
        self.indirect: list[tuple[GeneratedNode, list[GeneratedNode]]] = []
        self.taken: dict[str, None] = {}
        self.defined: set[str] = set()
        self.elsewhere: dict[Key, GeneratedNode] = {}
        self._own_taken: dict[str, None] = {}
        self._defaults: dict[str, dict[int, GeneratedNode]] = {}
        self._own_calls: list[tuple[Cursor, Sequence[GeneratedNode]]] = []
        self._callees: set[int] = set()
        self._references: set[Key] = set()

    def read(self, top: GeneratedNode) -> None:
        """Record what a declaration at the top level and all below it give to what."""
        waiting: list[tuple[GeneratedNode, Key | None]] = [(top, None)]
        while waiting:
            node, function = waiting.pop()
            kind = node.kind
            if kind in SCOPES:
                function = self._function(node)
            elif kind == kinds.LAMBDA_EXPR:
                function = self._lambda(node)
            elif kind in (kinds.VAR_DECL, kinds.FIELD_DECL):
                self._variable(node)
            elif kind == kinds.ENUM_CONSTANT_DECL and node.expressions:
                self.give(self.key(node.cursor), node.expressions[0])
            elif kind == kinds.BINARY_OPERATOR:
                if self.library.getCursorBinaryOperatorKind(node.cursor) == ASSIGN:
                    self._assign(*node.expressions)
            elif kind == kinds.COMPOUND_ASSIGNMENT_OPERATOR:
                self._calculate(node.expressions[:1], node)
            elif kind == kinds.UNARY_OPERATOR:
                if self.library.getCursorUnaryOperatorKind(node.cursor) in STEPS:
                    self._calculate(node.expressions, node)
            elif kind == kinds.RETURN_STMT and function is not None and node.expressions:
                self.give(("result", *function), node.expressions[0])
            elif kind == kinds.CALL_EXPR:
                self._call(node)
            elif kind == kinds.CXX_FOR_RANGE_STMT:
                self._range(node)
            elif kind == kinds.DECL_REF_EXPR:
                self._reference(node)
            waiting.extend((child, function) for child in reversed(node.children))

    def _function(self, node: GeneratedNode) -> Key:
        name = self.unique_name(node.cursor)
        key = ("function", name)
        overridden = clang.overridden(node.cursor) if node.kind == kinds.CXX_METHOD else []
        bases = [self.unique_name(method) for method in overridden]
        self.defined.update(bases)  # a call of one may run this method
        before: GeneratedNode | None = None
        place = 0
        for child in node.children:
            if child.kind == kinds.PARM_DECL:
                self._parameter(child, name, place)
                for base in bases:
                    self.given.setdefault(("parameter", name, place), []).append(("parameter", base, place))
                place += 1
            elif child.kind == kinds.COMPOUND_STMT:
                self.defined.add(name)
            elif before is not None and before.kind == kinds.MEMBER_REF:
                self.give(self.key(self.library.getCursorReferenced(before.cursor)), child)
            before = child
        return key

    def _lambda(self, node: GeneratedNode) -> Key:
        parameters = [child for child in node.children if child.kind == kinds.PARM_DECL]
        if not parameters:
            return ("function", f"lambda {node.cursor.data[0]}")
        operator = self.library.getCursorSemanticParent(parameters[0].cursor)
        name = self.unique_name(operator)
        self.defined.add(name)
        for place, parameter in enumerate(parameters):
            self._parameter(parameter, name, place)
        return ("function", name)

    def _parameter(self, node: GeneratedNode, name: str, place: int) -> None:
        key = ("parameter", name, place)
        self._parameters[node.cursor.data[0]] = key
        if self.library.getCanonicalType(self.library.getCursorType(node.cursor)).kind in REFERENCES:
            self._references.add(key)
        initial = self._initial(node)
        if initial is not None:
            self._defaults.setdefault(name, {})[place] = initial

    def _initial(self, node: GeneratedNode) -> GeneratedNode | None:
        """The node of a declaration's initial value."""
        found = self.library.Cursor_getVarDeclInitializer(node.cursor)
        if found.kind in kinds.INVALID:
            return None
        return next((c for c in node.expressions if c.cursor.data[1] == found.data[1]), None)

    def _variable(self, node: GeneratedNode) -> None:
        key = self.key(node.cursor)
        if self.library.getCanonicalType(self.library.getCursorType(node.cursor)).kind in REFERENCES:
            self._references.add(key)
        if node.kind == kinds.FIELD_DECL:
            if self.library.getFieldDeclBitWidth(node.cursor) < 0 and node.expressions:
                self.give(key, node.expressions[-1])
            return
        initial = self._initial(node)
        if initial is not None:
            self._initialise(key, initial)
        elif self.library.Cursor_getStorageClass(node.cursor) == EXTERN:
            self.elsewhere.setdefault(key, node)
        else:
            self.given.setdefault(key, [])

    def _initialise(self, key: Key, value: GeneratedNode) -> None:
        """Give a variable its initial value; of structures each member, by the order of their declaration."""
        inner = plain(value)
        if inner.kind != kinds.INIT_LIST_EXPR:
            self.give(key, value)
            return
        members = self._members(inner)
        if members is None:
            for each in inner.expressions:
                self._initialise(key, each)
            return
        values = inner.expressions
        for place, each in enumerate(values):
            named = next((c for c in each.children if c.kind == kinds.MEMBER_REF), None)
            if named is not None and each.expressions:
                self._initialise(self.key(self.library.getCursorReferenced(named.cursor)), each.expressions[-1])
            elif len(values) <= len(members) and named is None:
                self._initialise(members[place], each)
            else:  # its braces are left out
                for member in members:
                    self._initialise(member, each)

    def _members(self, list_: GeneratedNode) -> list[Key] | None:
        """The members of the structure that a list in braces gives values to; None for an array or a number."""
        type_ = self.library.getCanonicalType(self.library.getCursorType(list_.cursor))
        declaration = self.library.getTypeDeclaration(type_)
        if declaration.kind not in RECORDS:
            return None
        found: list[Key] = []

        def visitor(cursor: Cursor, parent: Cursor, data: int | None) -> int:
            if cursor.kind == kinds.FIELD_DECL:
                found.append(self.key(cursor))
            return 1

        clang.visit(declaration, visitor)
        return found

    def _assign(self, left: GeneratedNode, right: GeneratedNode) -> None:
        for key in self.targets(left):
            self.give(key, right)

    def _calculate(self, targets: Iterable[GeneratedNode], node: GeneratedNode) -> None:
        for target in targets:
            for key in self.targets(target):
                self.given.setdefault(key, []).append(self.origin("a calculation", node))

    def give(self, key: Key, value: GeneratedNode) -> None:
        """Record that a thing takes a value, and that a pointer to another thing may write it."""
        self.given.setdefault(key, []).append(value)
        inner = plain(value)
        if inner.kind == kinds.UNARY_OPERATOR and self.library.getCursorUnaryOperatorKind(inner.cursor) == ADDRESS:
            inner = inner.expressions[0]
        elif key not in self._references and not self._is_pointer(inner):
            return
        for other in self.targets(inner):
            if other != key:
                self.given.setdefault(other, []).append(key)

    def _is_pointer(self, node: GeneratedNode) -> bool:
        if node.kind not in (kinds.DECL_REF_EXPR, kinds.MEMBER_REF_EXPR):
            return False
        type_ = self.library.getCanonicalType(self.library.getCursorType(node.cursor))
        return type_.kind in POINTERS

    def _range(self, node: GeneratedNode) -> None:
        """Give the variable of a loop over a range the elements of the range."""
        variable = next((c for c in node.children if c.kind == kinds.VAR_DECL), None)
        rest = [c for c in node.children if c is not variable and c.kind in kinds.EXPRESSIONS]
        if variable is not None and rest:
            self.given[self.key(variable.cursor)] = [rest[0]]

    def _call(self, node: GeneratedNode) -> None:
        called = self.library.getCursorReferenced(node.cursor)
        inner = node.expressions
        if called.kind == kinds.CONSTRUCTOR:
            name = self.spelling(called)
            if name in self._functions and not self._is_own(called):
                self.calls.append((node, name, inner))
            else:
                self._own_calls.append((called, inner))
            return
        if not inner:
            return
        callee = unwrapped(inner[0])
        arguments = inner[1:]
        if called.kind in FUNCTIONS and callee.kind in (kinds.DECL_REF_EXPR, kinds.MEMBER_REF_EXPR):
            self._callees.add(id(callee))
            if called.kind == kinds.CXX_METHOD and self.spelling(called) == "operator()":
                arguments = inner[2:]
            foreign = self._outer(called) if called.kind == kinds.FUNCTION_DECL else not self._is_own(called)
            if self.spelling(called) in self._functions and foreign:
                self.calls.append((node, self.spelling(called), arguments))
            else:
                self._own_calls.append((called, arguments))
            return
        overloaded = next((n for n in callee.below() if n.kind == kinds.OVERLOADED_DECL_REF), None)
        if overloaded is not None:
            name = self.spelling(overloaded.cursor)
            if name in self._functions:
                self.calls.append((node, name, arguments))
            return
        self.indirect.append((node, arguments))

    def _is_own(self, function: Cursor) -> bool:
        """Whether a member function is declared in the program's files."""
        file, _ = clang.file_offset(self.library.getCursorLocation(function))
        return clang.file_name(file).startswith(SKETCH)

    def _outer(self, function: Cursor) -> bool:
        return self.library.getCursorSemanticParent(function).kind not in RECORDS

    def _reference(self, node: GeneratedNode) -> None:
        """Record that the address of a function is taken."""
        if id(node) in self._callees:
            return
        found = self.library.getCursorReferenced(node.cursor)
        if found.kind not in FUNCTIONS:
            return
        name = self.spelling(found)
        if name in self._functions and self._outer(found):
            self.taken[name] = None
        else:
            self._own_taken[self.unique_name(found)] = None

    def pass_arguments(self) -> None:
        """Give the parameters of the program's functions the arguments of their calls, when all files are read."""
        for called, arguments in self._own_calls:
            self._pass(self.unique_name(called), arguments)
        most = max((len(arguments) for _, arguments in self.indirect), default=0)
        for name in self._own_taken:
            for place in range(most):
                self.given.setdefault(("parameter", name, place), []).append(("through a pointer", place))
        for _, arguments in self.indirect:
            for place, argument in enumerate(arguments):
                self.give(("through a pointer", place), argument)

    def _pass(self, name: str, arguments: Sequence[GeneratedNode]) -> None:
        given = [a for a in arguments if a.children or a.kind != kinds.UNEXPOSED_EXPR]  # the others stand for default arguments
        for place, argument in enumerate(given):
            if name in self.defined:
                self.give(("parameter", name, place), argument)
            else:
                self._stored_elsewhere(argument)
        for place, initial in self._defaults.get(name, {}).items():
            if place >= len(given):
                self.give(("parameter", name, place), initial)

    def _stored_elsewhere(self, argument: GeneratedNode) -> None:
        """Record that a function of others may write what it is given the address of."""
        inner = plain(argument)
        if inner.kind == kinds.UNARY_OPERATOR and self.library.getCursorUnaryOperatorKind(inner.cursor) == ADDRESS:
            for key in self.targets(inner.expressions[0]):
                self.given.setdefault(key, []).append(self.origin("what another function stores", inner))
