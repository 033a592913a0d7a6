"""The syntax of a C or C++ program: files, declarations, statements, expressions, preprocessor. It contains no judgement about any platform.

Generated from ccode.ecore by robosmi metamodels generate. Do not edit.
"""

from __future__ import annotations

from collections.abc import Iterable, MutableSequence
from typing import TYPE_CHECKING, ClassVar

from robosmi.model.strict import Element
from robosmi.model.strict_package import (
    EAttribute,
    EBoolean,
    EDouble,
    EInt,
    ELong,
    EReference,
    EString,
    MetaEClass,
    abstract,
    enumeration,
    find_classifier,
    package,
)

if TYPE_CHECKING:
    from robosmi.model.strict import EnumLiteral
    from robosmi.model.strict_package import Classifier, GeneratedModule

name = "ccode"
nsURI = "http://robosmi.org/ccode/1"
nsPrefix = "ccode"

eClass = package(name, nsURI, nsPrefix)
eClassifiers: dict[str, Classifier] = {}
eSubpackages: list[GeneratedModule] = []
eSuperPackage: GeneratedModule | None = None
getEClassifier = find_classifier(eClassifiers)

if TYPE_CHECKING:

    class Storage(EnumLiteral):
        """Storage class specifier of a declaration (ISO C99 6.7.1)."""

        unspecified: ClassVar[Storage]
        externStorage: ClassVar[Storage]
        staticStorage: ClassVar[Storage]
        registerStorage: ClassVar[Storage]
        autoStorage: ClassVar[Storage]

    class Linkage(EnumLiteral):
        """Where a declaration comes from: the program's own files, a header that was found, or its uses because no header was found."""

        defined: ClassVar[Linkage]
        declaredInHeader: ClassVar[Linkage]
        inferred: ClassVar[Linkage]

    class RecordKind(EnumLiteral):
        """Kind of a record type."""

        structType: ClassVar[RecordKind]
        unionType: ClassVar[RecordKind]
        classType: ClassVar[RecordKind]

    class LoopForm(EnumLiteral):
        """Form of a loop statement."""

        whileLoop: ClassVar[LoopForm]
        doLoop: ClassVar[LoopForm]
        forLoop: ClassVar[LoopForm]

    class SymbolUse(EnumLiteral):
        """How the program uses an undeclared name."""

        called: ClassVar[SymbolUse]
        constantUse: ClassVar[SymbolUse]
        writtenUse: ClassVar[SymbolUse]
        indexedUse: ClassVar[SymbolUse]
        typeUse: ClassVar[SymbolUse]

else:
    Storage = enumeration(
        "Storage",
        {
            "unspecified": 0,
            "externStorage": 1,
            "staticStorage": 2,
            "registerStorage": 3,
            "autoStorage": 4,
        },
    )
    Linkage = enumeration(
        "Linkage",
        {"defined": 0, "declaredInHeader": 1, "inferred": 2},
    )
    RecordKind = enumeration(
        "RecordKind",
        {"structType": 0, "unionType": 1, "classType": 2},
    )
    LoopForm = enumeration("LoopForm", {"whileLoop": 0, "doLoop": 1, "forLoop": 2})
    SymbolUse = enumeration(
        "SymbolUse",
        {
            "called": 0,
            "constantUse": 1,
            "writtenUse": 2,
            "indexedUse": 3,
            "typeUse": 4,
        },
    )


class Program(Element, metaclass=MetaEClass):
    """One program: all source units that are compiled together."""

    name: str = EAttribute(eType=EString, default_value="")
    """Base name of the first source file, without extension."""
    languages: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Languages of the units, e.g. C."""
    includeFolders: MutableSequence[str] = EAttribute(
        eType=EString,
        upper=-1,
        unique=False,
    )
    """Folders of the include search, as given."""
    defines: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Macros defined from outside, NAME or NAME=VALUE."""
    units: MutableSequence[SourceUnit] = EReference(upper=-1, containment=True)
    """The source files, in the order given."""
    externals: MutableSequence[Declaration] = EReference(upper=-1, containment=True)
    """Declarations from outside the units: found in headers, or inferred from uses."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str | None = None,
            languages: Iterable[str] | None = None,
            includeFolders: Iterable[str] | None = None,
            defines: Iterable[str] | None = None,
            units: Iterable[SourceUnit] | None = None,
            externals: Iterable[Declaration] | None = None,
        ) -> None: ...


class SourceUnit(Element, metaclass=MetaEClass):
    """One source file."""

    program: Program | None = EReference()
    """The program it belongs to."""
    path: str = EAttribute(eType=EString, lower=1)
    """Path relative to the model's own folder once saved, else as given."""
    encoding: str = EAttribute(eType=EString, default_value="UTF-8")
    """Encoding of the bytes."""
    digest: str = EAttribute(eType=EString, default_value="")
    """SHA-256 of the bytes, hexadecimal."""
    language: str = EAttribute(eType=EString, default_value="C")
    """C or C++."""
    size: int = EAttribute(eType=EInt)
    """Length in bytes."""
    callsInText: int = EAttribute(eType=EInt)
    """Number of calls found in the token stream (identifier followed by an opening parenthesis, outside declarations and macro definitions)."""
    callsInModel: int = EAttribute(eType=EInt)
    """Number of those calls that are in this model."""
    includes: MutableSequence[Include] = EReference(upper=-1, containment=True)
    """Include directives."""
    macros: MutableSequence[Macro] = EReference(upper=-1, containment=True)
    """Macros that the file defines."""
    macroUses: MutableSequence[MacroUse] = EReference(upper=-1, containment=True)
    """Uses of macros, the file's own and others."""
    declarations: MutableSequence[Declaration] = EReference(upper=-1, containment=True)
    """Declarations at file scope, in text order."""
    comments: MutableSequence[Comment] = EReference(upper=-1, containment=True)
    """Comments, in text order."""
    conditionals: MutableSequence[PreprocessorConditional] = EReference(
        upper=-1,
        containment=True,
    )
    """Conditional directives."""
    unresolved: MutableSequence[UnresolvedCall] = EReference(upper=-1, containment=True)
    """Calls in tokens that the parser lost."""
    problems: MutableSequence[SyntaxProblem] = EReference(upper=-1, containment=True)
    """What the parser reported."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            program: Program | None = None,
            path: str | None = None,
            encoding: str | None = None,
            digest: str | None = None,
            language: str | None = None,
            size: int | None = None,
            callsInText: int | None = None,
            callsInModel: int | None = None,
            includes: Iterable[Include] | None = None,
            macros: Iterable[Macro] | None = None,
            macroUses: Iterable[MacroUse] | None = None,
            declarations: Iterable[Declaration] | None = None,
            comments: Iterable[Comment] | None = None,
            conditionals: Iterable[PreprocessorConditional] | None = None,
            unresolved: Iterable[UnresolvedCall] | None = None,
            problems: Iterable[SyntaxProblem] | None = None,
        ) -> None: ...


@abstract
class Located(Element, metaclass=MetaEClass):
    """Anything with a place in a source file. Offsets count bytes from 0, lines and columns from 1 (columns in bytes)."""

    startOffset: int = EAttribute(eType=EInt)
    """Offset of the first byte."""
    endOffset: int = EAttribute(eType=EInt)
    """Offset after the last byte."""
    line: int = EAttribute(eType=EInt)
    """Line of the first byte."""
    column: int = EAttribute(eType=EInt)
    """Column of the first byte."""
    endLine: int = EAttribute(eType=EInt)
    """Line of the last byte."""
    endColumn: int = EAttribute(eType=EInt)
    """Column after the last byte."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
        ) -> None: ...


class Include(Located):
    """An include directive."""

    header: str = EAttribute(eType=EString, lower=1)
    """The name as written, without its delimiters."""
    system: bool = EAttribute(eType=EBoolean)
    """True for angle brackets, false for quotes."""
    resolvedPath: str = EAttribute(eType=EString, default_value="")
    """Path of the file found, empty if none was found."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            header: str | None = None,
            system: bool | None = None,
            resolvedPath: str | None = None,
        ) -> None: ...


class Macro(Located):
    """A macro definition in a unit."""

    name: str = EAttribute(eType=EString, lower=1)
    """Its name."""
    functionLike: bool = EAttribute(eType=EBoolean)
    """True if it takes parameters."""
    parameters: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Names of its parameters."""
    body: str = EAttribute(eType=EString, default_value="")
    """The replacement text."""
    uses: MutableSequence[MacroUse] = EReference(upper=-1)
    """Where it is used."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            name: str | None = None,
            functionLike: bool | None = None,
            parameters: Iterable[str] | None = None,
            body: str | None = None,
            uses: Iterable[MacroUse] | None = None,
        ) -> None: ...


class MacroUse(Located):
    """A use of a macro."""

    name: str = EAttribute(eType=EString, lower=1)
    """Name of the macro."""
    text: str = EAttribute(eType=EString, default_value="")
    """The use as written, with arguments."""
    functionLike: bool = EAttribute(eType=EBoolean)
    """True if used with arguments."""
    header: str = EAttribute(eType=EString, default_value="")
    """Header that defines the macro if it is not the program's own; empty if unknown."""
    macro: Macro | None = EReference()
    """The program's own macro, if it is one."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            name: str | None = None,
            text: str | None = None,
            functionLike: bool | None = None,
            header: str | None = None,
            macro: Macro | None = None,
        ) -> None: ...


class PreprocessorConditional(Located):
    """An if, ifdef, ifndef, elif, else or endif directive."""

    directive: str = EAttribute(eType=EString, lower=1)
    """The directive's name."""
    condition: str = EAttribute(eType=EString, default_value="")
    """Its condition as written."""
    active: bool = EAttribute(eType=EBoolean)
    """True if the text that it governs was compiled."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            directive: str | None = None,
            condition: str | None = None,
            active: bool | None = None,
        ) -> None: ...


class Comment(Located):
    """A comment."""

    text: str = EAttribute(eType=EString, default_value="")
    """Its text with its delimiters."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            text: str | None = None,
        ) -> None: ...


class UnresolvedCall(Located):
    """A call in the text for which the parser made no call expression."""

    name: str = EAttribute(eType=EString, lower=1)
    """The called name."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            name: str | None = None,
        ) -> None: ...


class SyntaxProblem(Located):
    """A message of the parser that is not about a missing declaration."""

    message: str = EAttribute(eType=EString, default_value="")
    """The parser's message."""
    fatal: bool = EAttribute(eType=EBoolean)
    """True if text was lost by it."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            message: str | None = None,
            fatal: bool | None = None,
        ) -> None: ...


class TypeUse(Element, metaclass=MetaEClass):
    """A type as used in a declaration."""

    spelling: str = EAttribute(eType=EString, lower=1)
    """The type as written."""
    canonical: str = EAttribute(eType=EString, default_value="")
    """The type with typedefs resolved."""
    bits: int = EAttribute(eType=EInt)
    """Width on the source platform in bits; 0 if it has none or it is unknown."""
    signed: bool = EAttribute(eType=EBoolean)
    """True for a signed arithmetic type of the source platform."""
    pointerDepth: int = EAttribute(eType=EInt)
    """Number of pointer levels."""
    arrayDims: str = EAttribute(eType=EString, default_value="")
    """Array dimensions as written, e.g. [4][2], empty for none."""
    constant: bool = EAttribute(eType=EBoolean)
    """True for a const-qualified type."""
    declaration: Declaration | None = EReference()
    """The type's declaration, if the program has it."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            spelling: str | None = None,
            canonical: str | None = None,
            bits: int | None = None,
            signed: bool | None = None,
            pointerDepth: int | None = None,
            arrayDims: str | None = None,
            constant: bool | None = None,
            declaration: Declaration | None = None,
        ) -> None: ...


@abstract
class Declaration(Located):
    """A named declaration."""

    name: str = EAttribute(eType=EString, default_value="")
    """Its name; empty for an unnamed record or enumeration."""
    linkage: Linkage = EAttribute(eType=Linkage, default_value=Linkage.defined)
    """Where it comes from."""
    header: str = EAttribute(eType=EString, default_value="")
    """Header that declares it, empty for the program's own and for inferred ones."""
    comment: str = EAttribute(eType=EString, default_value="")
    """The comment directly before it or after it on its line, with delimiters."""
    references: MutableSequence[NameReference] = EReference(upper=-1)
    """Where its name is used."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            name: str | None = None,
            linkage: Linkage | None = None,
            header: str | None = None,
            comment: str | None = None,
            references: Iterable[NameReference] | None = None,
        ) -> None: ...


class Function(Declaration):
    """A function: definition, prototype or external."""

    storage: Storage = EAttribute(eType=Storage)
    """Storage class."""
    variadic: bool = EAttribute(eType=EBoolean)
    """True if it is variadic."""
    definition: bool = EAttribute(eType=EBoolean)
    """True if it has a body here."""
    signature: str = EAttribute(eType=EString, default_value="")
    """The declarator as written, from the return type to the closing parenthesis (the paper's raw signature)."""
    returnType: TypeUse | None = EReference(containment=True)
    """Type of its result."""
    parameters: MutableSequence[Parameter] = EReference(upper=-1, containment=True)
    """Its parameters."""
    body: Block | None = EReference(containment=True)
    """Its body, if this is the definition."""
    calls: MutableSequence[Call] = EReference(upper=-1)
    """Where it is called."""
    virtual: bool = EAttribute(eType=EBoolean)
    """True for a virtual member function of C++."""
    pure: bool = EAttribute(eType=EBoolean)
    """True for a pure virtual member function of C++ (= 0), which derived classes implement."""
    initializers: MutableSequence[MemberInitializer] = EReference(
        upper=-1,
        containment=True,
    )
    """Member initialisers of a constructor."""
    templateParameters: MutableSequence[TemplateParameter] = EReference(
        upper=-1,
        containment=True,
    )
    """Template parameters; empty if it is no C++ template."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            name: str | None = None,
            linkage: Linkage | None = None,
            header: str | None = None,
            comment: str | None = None,
            references: Iterable[NameReference] | None = None,
            storage: Storage | None = None,
            variadic: bool | None = None,
            definition: bool | None = None,
            signature: str | None = None,
            returnType: TypeUse | None = None,
            parameters: Iterable[Parameter] | None = None,
            body: Block | None = None,
            calls: Iterable[Call] | None = None,
            virtual: bool | None = None,
            pure: bool | None = None,
            initializers: Iterable[MemberInitializer] | None = None,
            templateParameters: Iterable[TemplateParameter] | None = None,
        ) -> None: ...


class Parameter(Declaration):
    """A parameter of a function."""

    valueType: TypeUse | None = EReference(containment=True)
    """Its type."""
    defaultValue: Expression | None = EReference(containment=True)
    """Its default argument."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            name: str | None = None,
            linkage: Linkage | None = None,
            header: str | None = None,
            comment: str | None = None,
            references: Iterable[NameReference] | None = None,
            valueType: TypeUse | None = None,
            defaultValue: Expression | None = None,
        ) -> None: ...


class Variable(Declaration):
    """A variable, global or local."""

    storage: Storage = EAttribute(eType=Storage)
    """Storage class."""
    initialised: bool = EAttribute(eType=EBoolean)
    """True if it has an initialiser."""
    shared: bool = EAttribute(eType=EBoolean)
    """True if the declaration statement declares other names too."""
    valueType: TypeUse | None = EReference(containment=True)
    """Its type."""
    initializer: Expression | None = EReference(containment=True)
    """Its initial value."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            name: str | None = None,
            linkage: Linkage | None = None,
            header: str | None = None,
            comment: str | None = None,
            references: Iterable[NameReference] | None = None,
            storage: Storage | None = None,
            initialised: bool | None = None,
            shared: bool | None = None,
            valueType: TypeUse | None = None,
            initializer: Expression | None = None,
        ) -> None: ...


class Field(Declaration):
    """A member of a record."""

    bitWidth: int = EAttribute(eType=EInt)
    """Width of a bit field, 0 for an ordinary member."""
    valueType: TypeUse | None = EReference(containment=True)
    """Its type."""
    initializer: Expression | None = EReference(containment=True)
    """Default member initialiser, if there is one."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            name: str | None = None,
            linkage: Linkage | None = None,
            header: str | None = None,
            comment: str | None = None,
            references: Iterable[NameReference] | None = None,
            bitWidth: int | None = None,
            valueType: TypeUse | None = None,
            initializer: Expression | None = None,
        ) -> None: ...


class Typedef(Declaration):
    """A typedef."""

    aliased: TypeUse | None = EReference(containment=True)
    """The type it names."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            name: str | None = None,
            linkage: Linkage | None = None,
            header: str | None = None,
            comment: str | None = None,
            references: Iterable[NameReference] | None = None,
            aliased: TypeUse | None = None,
        ) -> None: ...


class Record(Declaration):
    """A struct, union or class."""

    recordKind: RecordKind = EAttribute(eType=RecordKind)
    """Its kind."""
    fields: MutableSequence[Field] = EReference(upper=-1, containment=True)
    """Its members."""
    methods: MutableSequence[Function] = EReference(upper=-1, containment=True)
    """Its member functions."""
    bases: MutableSequence[TypeUse] = EReference(upper=-1, containment=True)
    """Its base classes."""
    staticMembers: MutableSequence[Variable] = EReference(upper=-1, containment=True)
    """Its static data members."""
    templateParameters: MutableSequence[TemplateParameter] = EReference(
        upper=-1,
        containment=True,
    )
    """Template parameters; empty if it is no C++ template."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            name: str | None = None,
            linkage: Linkage | None = None,
            header: str | None = None,
            comment: str | None = None,
            references: Iterable[NameReference] | None = None,
            recordKind: RecordKind | None = None,
            fields: Iterable[Field] | None = None,
            methods: Iterable[Function] | None = None,
            bases: Iterable[TypeUse] | None = None,
            staticMembers: Iterable[Variable] | None = None,
            templateParameters: Iterable[TemplateParameter] | None = None,
        ) -> None: ...


class Enumeration(Declaration):
    """An enumeration."""

    literals: MutableSequence[EnumerationLiteral] = EReference(
        upper=-1,
        containment=True,
    )
    """Its constants."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            name: str | None = None,
            linkage: Linkage | None = None,
            header: str | None = None,
            comment: str | None = None,
            references: Iterable[NameReference] | None = None,
            literals: Iterable[EnumerationLiteral] | None = None,
        ) -> None: ...


class EnumerationLiteral(Declaration):
    """A constant of an enumeration."""

    value: int = EAttribute(eType=ELong)
    """Its value."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            name: str | None = None,
            linkage: Linkage | None = None,
            header: str | None = None,
            comment: str | None = None,
            references: Iterable[NameReference] | None = None,
            value: int | None = None,
        ) -> None: ...


class ExternalSymbol(Declaration):
    """A name without a declaration that is no function: a constant, a register, a variable or a type of a platform."""

    use: SymbolUse = EAttribute(eType=SymbolUse)
    """How the program uses it, the strongest use found."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            name: str | None = None,
            linkage: Linkage | None = None,
            header: str | None = None,
            comment: str | None = None,
            references: Iterable[NameReference] | None = None,
            use: SymbolUse | None = None,
        ) -> None: ...


class Namespace(Declaration):
    """A namespace of C++."""

    declarations: MutableSequence[Declaration] = EReference(upper=-1, containment=True)
    """Its declarations."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            name: str | None = None,
            linkage: Linkage | None = None,
            header: str | None = None,
            comment: str | None = None,
            references: Iterable[NameReference] | None = None,
            declarations: Iterable[Declaration] | None = None,
        ) -> None: ...


class TemplateParameter(Declaration):
    """A parameter of a C++ template: a type, or a value if it has a type itself."""

    valueType: TypeUse | None = EReference(containment=True)
    """Type of the value; missing for a parameter that is a type."""
    defaultValue: Expression | None = EReference(containment=True)
    """Its default value."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            name: str | None = None,
            linkage: Linkage | None = None,
            header: str | None = None,
            comment: str | None = None,
            references: Iterable[NameReference] | None = None,
            valueType: TypeUse | None = None,
            defaultValue: Expression | None = None,
        ) -> None: ...


class MemberInitializer(Located):
    """The initialisation of a member or of a base class before a constructor runs."""

    name: str = EAttribute(eType=EString, default_value="")
    """The member or the base class."""
    arguments: MutableSequence[Expression] = EReference(upper=-1, containment=True)
    """The values of the initialiser."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            name: str | None = None,
            arguments: Iterable[Expression] | None = None,
        ) -> None: ...


@abstract
class Statement(Located):
    """A statement."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
        ) -> None: ...


class Block(Statement):
    """A compound statement."""

    statements: MutableSequence[Statement] = EReference(upper=-1, containment=True)
    """Its statements."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            statements: Iterable[Statement] | None = None,
        ) -> None: ...


class If(Statement):
    """A selection by condition."""

    initial: Statement | None = EReference(containment=True)
    """C++: the statement before the condition, as in if (int a = f(); a > 2)."""
    declaration: DeclarationStatement | None = EReference(containment=True)
    """C++: the variable that the condition declares, as in if (int a = f()); the condition is then its name."""
    condition: Expression | None = EReference(containment=True)
    """The condition."""
    thenBranch: Statement | None = EReference(containment=True)
    """Taken when true."""
    elseBranch: Statement | None = EReference(containment=True)
    """Taken when false."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            initial: Statement | None = None,
            declaration: DeclarationStatement | None = None,
            condition: Expression | None = None,
            thenBranch: Statement | None = None,
            elseBranch: Statement | None = None,
        ) -> None: ...


@abstract
class Loop(Statement):
    """A loop."""

    form: LoopForm = EAttribute(eType=LoopForm)
    """Its form."""
    endless: bool = EAttribute(eType=EBoolean)
    """True if the condition is absent or a constant other than zero."""
    declaration: DeclarationStatement | None = EReference(containment=True)
    """C++: the variable that the condition declares, as in while (int a = f()), the condition being its name; of a loop over a range the variable for each of its elements."""
    condition: Expression | None = EReference(containment=True)
    """The condition, if written."""
    body: Statement | None = EReference(containment=True)
    """The body."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            form: LoopForm | None = None,
            endless: bool | None = None,
            declaration: DeclarationStatement | None = None,
            condition: Expression | None = None,
            body: Statement | None = None,
        ) -> None: ...


class While(Loop):
    """A while loop."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            form: LoopForm | None = None,
            endless: bool | None = None,
            declaration: DeclarationStatement | None = None,
            condition: Expression | None = None,
            body: Statement | None = None,
        ) -> None: ...


class DoWhile(Loop):
    """A do loop."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            form: LoopForm | None = None,
            endless: bool | None = None,
            declaration: DeclarationStatement | None = None,
            condition: Expression | None = None,
            body: Statement | None = None,
        ) -> None: ...


class For(Loop):
    """A for loop."""

    initial: Statement | None = EReference(containment=True)
    """Its first clause."""
    step: Expression | None = EReference(containment=True)
    """Its third clause."""
    range: Expression | None = EReference(containment=True)
    """C++: what a loop over a range goes through, as in for (int a : values); such a loop has neither condition nor step."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            form: LoopForm | None = None,
            endless: bool | None = None,
            declaration: DeclarationStatement | None = None,
            condition: Expression | None = None,
            body: Statement | None = None,
            initial: Statement | None = None,
            step: Expression | None = None,
            range: Expression | None = None,
        ) -> None: ...


class Switch(Statement):
    """A selection by value."""

    initial: Statement | None = EReference(containment=True)
    """C++: the statement before the value, as in switch (int a = f(); a)."""
    declaration: DeclarationStatement | None = EReference(containment=True)
    """C++: the variable that is declared as the value, as in switch (int a = f()); the value is then its name."""
    selector: Expression | None = EReference(containment=True)
    """The value."""
    body: Statement | None = EReference(containment=True)
    """The body with its case labels."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            initial: Statement | None = None,
            declaration: DeclarationStatement | None = None,
            selector: Expression | None = None,
            body: Statement | None = None,
        ) -> None: ...


class Case(Statement):
    """A case label and its statement."""

    constant: Expression | None = EReference(containment=True)
    """The constant."""
    statement: Statement | None = EReference(containment=True)
    """The labelled statement."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            constant: Expression | None = None,
            statement: Statement | None = None,
        ) -> None: ...


class Default(Statement):
    """A default label and its statement."""

    statement: Statement | None = EReference(containment=True)
    """The labelled statement."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            statement: Statement | None = None,
        ) -> None: ...


class Break(Statement):
    """A break."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
        ) -> None: ...


class Continue(Statement):
    """A continue."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
        ) -> None: ...


class Return(Statement):
    """A return."""

    value: Expression | None = EReference(containment=True)
    """The value, if any."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            value: Expression | None = None,
        ) -> None: ...


class Goto(Statement):
    """A goto."""

    labelName: str = EAttribute(eType=EString, default_value="")
    """Name of the label."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            labelName: str | None = None,
        ) -> None: ...


class Label(Statement):
    """A label and its statement."""

    name: str = EAttribute(eType=EString, default_value="")
    """Its name."""
    statement: Statement | None = EReference(containment=True)
    """The labelled statement."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            name: str | None = None,
            statement: Statement | None = None,
        ) -> None: ...


class ExpressionStatement(Statement):
    """An expression as a statement."""

    expression: Expression | None = EReference(containment=True)
    """The expression."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            expression: Expression | None = None,
        ) -> None: ...


class DeclarationStatement(Statement):
    """A declaration as a statement."""

    declarations: MutableSequence[Declaration] = EReference(upper=-1, containment=True)
    """What it declares."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            declarations: Iterable[Declaration] | None = None,
        ) -> None: ...


class EmptyStatement(Statement):
    """A lone semicolon."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
        ) -> None: ...


class UnknownStatement(Statement):
    """A statement of a kind that the reader does not analyse."""

    text: str = EAttribute(eType=EString, default_value="")
    """The statement as written."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            text: str | None = None,
        ) -> None: ...


@abstract
class Expression(Located):
    """An expression."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
        ) -> None: ...


class Call(Expression):
    """A function call."""

    calleeName: str = EAttribute(eType=EString, default_value="")
    """The called name as the user wrote it, empty for a computed callee."""
    viaMacro: bool = EAttribute(eType=EBoolean)
    """True if the call stands in the body of one of the program's own macros that is used here."""
    callee: Function | None = EReference()
    """The called function."""
    arguments: MutableSequence[Expression] = EReference(upper=-1, containment=True)
    """The arguments."""
    calleeExpression: Expression | None = EReference(containment=True)
    """The callee, if it is computed."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            calleeName: str | None = None,
            viaMacro: bool | None = None,
            callee: Function | None = None,
            arguments: Iterable[Expression] | None = None,
            calleeExpression: Expression | None = None,
        ) -> None: ...


class NameReference(Expression):
    """A use of a name."""

    name: str = EAttribute(eType=EString, lower=1)
    """The name as written."""
    target: Declaration | None = EReference()
    """The declaration that it refers to."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            name: str | None = None,
            target: Declaration | None = None,
        ) -> None: ...


class Member(Expression):
    """A member of a record."""

    name: str = EAttribute(eType=EString, default_value="")
    """Name of the member."""
    arrow: bool = EAttribute(eType=EBoolean)
    """True for access through a pointer."""
    object: Expression | None = EReference(containment=True)
    """The record."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            name: str | None = None,
            arrow: bool | None = None,
            object: Expression | None = None,
        ) -> None: ...


class Index(Expression):
    """An array element."""

    array: Expression | None = EReference(containment=True)
    """The array."""
    index: Expression | None = EReference(containment=True)
    """The index."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            array: Expression | None = None,
            index: Expression | None = None,
        ) -> None: ...


class Unary(Expression):
    """An operator with one operand."""

    operator: str = EAttribute(eType=EString, default_value="")
    """The operator."""
    postfix: bool = EAttribute(eType=EBoolean)
    """True if it follows the operand."""
    operand: Expression | None = EReference(containment=True)
    """The operand."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            operator: str | None = None,
            postfix: bool | None = None,
            operand: Expression | None = None,
        ) -> None: ...


class Binary(Expression):
    """An operator with two operands."""

    operator: str = EAttribute(eType=EString, default_value="")
    """The operator."""
    left: Expression | None = EReference(containment=True)
    """The left operand."""
    right: Expression | None = EReference(containment=True)
    """The right operand."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            operator: str | None = None,
            left: Expression | None = None,
            right: Expression | None = None,
        ) -> None: ...


class Assignment(Expression):
    """An assignment, plain or compound."""

    operator: str = EAttribute(eType=EString, default_value="")
    """The operator."""
    left: Expression | None = EReference(containment=True)
    """What is assigned to."""
    right: Expression | None = EReference(containment=True)
    """The value."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            operator: str | None = None,
            left: Expression | None = None,
            right: Expression | None = None,
        ) -> None: ...


class ConditionalExpression(Expression):
    """A conditional expression (a ? b : c)."""

    condition: Expression | None = EReference(containment=True)
    """The condition."""
    whenTrue: Expression | None = EReference(containment=True)
    """The value when true."""
    whenFalse: Expression | None = EReference(containment=True)
    """The value when false."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            condition: Expression | None = None,
            whenTrue: Expression | None = None,
            whenFalse: Expression | None = None,
        ) -> None: ...


class Cast(Expression):
    """An explicit conversion."""

    target: TypeUse | None = EReference(containment=True)
    """The type converted to."""
    operand: Expression | None = EReference(containment=True)
    """The operand."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            target: TypeUse | None = None,
            operand: Expression | None = None,
        ) -> None: ...


class SizeOf(Expression):
    """The size of a type or value."""

    measured: TypeUse | None = EReference(containment=True)
    """The type, if one is written."""
    operand: Expression | None = EReference(containment=True)
    """The operand, if one is written."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            measured: TypeUse | None = None,
            operand: Expression | None = None,
        ) -> None: ...


class IntegerLiteral(Expression):
    """An integer constant."""

    text: str = EAttribute(eType=EString, lower=1)
    """As written."""
    radix: int = EAttribute(eType=EInt, default_value=10)
    """2, 8, 10 or 16."""
    value: int = EAttribute(eType=ELong)
    """Its value."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            text: str | None = None,
            radix: int | None = None,
            value: int | None = None,
        ) -> None: ...


class FloatingLiteral(Expression):
    """A floating constant."""

    text: str = EAttribute(eType=EString, lower=1)
    """As written."""
    value: float = EAttribute(eType=EDouble)
    """Its value."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            text: str | None = None,
            value: float | None = None,
        ) -> None: ...


class CharacterLiteral(Expression):
    """A character constant."""

    text: str = EAttribute(eType=EString, lower=1)
    """As written."""
    value: int = EAttribute(eType=EInt)
    """Its value."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            text: str | None = None,
            value: int | None = None,
        ) -> None: ...


class StringLiteral(Expression):
    """A string."""

    text: str = EAttribute(eType=EString, lower=1)
    """As written."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            text: str | None = None,
        ) -> None: ...


class InitializerList(Expression):
    """A list in braces."""

    elements: MutableSequence[Expression] = EReference(upper=-1, containment=True)
    """Its elements."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            elements: Iterable[Expression] | None = None,
        ) -> None: ...


class UnknownExpression(Expression):
    """An expression of a kind that the reader does not analyse."""

    text: str = EAttribute(eType=EString, default_value="")
    """The expression as written."""
    body: Block | None = EReference(containment=True)
    """The statements within it, of GNU C's statement expression."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            text: str | None = None,
            body: Block | None = None,
        ) -> None: ...


class ConstructorCall(Expression):
    """The construction of an object from values in parentheses or braces, after the name of its class or of a variable."""

    className: str = EAttribute(eType=EString, default_value="")
    """The class."""
    arguments: MutableSequence[Expression] = EReference(upper=-1, containment=True)
    """The arguments of the constructor."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            className: str | None = None,
            arguments: Iterable[Expression] | None = None,
        ) -> None: ...


class Lambda(UnknownExpression):
    """A C++ lambda: its text, its parameters, and the statements of its body."""

    parameters: MutableSequence[Parameter] = EReference(upper=-1, containment=True)
    """Its parameters."""
    captures: MutableSequence[Variable] = EReference(upper=-1, containment=True)
    """The variables of its own that its captures declare: `[k = n + 1]`, `[&k = n]`."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            startOffset: int | None = None,
            endOffset: int | None = None,
            line: int | None = None,
            column: int | None = None,
            endLine: int | None = None,
            endColumn: int | None = None,
            text: str | None = None,
            body: Block | None = None,
            parameters: Iterable[Parameter] | None = None,
            captures: Iterable[Variable] | None = None,
        ) -> None: ...


if not TYPE_CHECKING:  # pyecore's descriptors, which the annotations above hide
    from robosmi.model.strict_package import classifier

    Program.units.eType = SourceUnit
    Program.externals.eType = Declaration
    SourceUnit.program.eType = Program
    SourceUnit.includes.eType = Include
    SourceUnit.macros.eType = Macro
    SourceUnit.macroUses.eType = MacroUse
    SourceUnit.declarations.eType = Declaration
    SourceUnit.comments.eType = Comment
    SourceUnit.conditionals.eType = PreprocessorConditional
    SourceUnit.unresolved.eType = UnresolvedCall
    SourceUnit.problems.eType = SyntaxProblem
    Macro.uses.eType = MacroUse
    MacroUse.macro.eType = Macro
    TypeUse.declaration.eType = Declaration
    Declaration.references.eType = NameReference
    Function.returnType.eType = TypeUse
    Function.parameters.eType = Parameter
    Function.body.eType = Block
    Function.calls.eType = Call
    Function.initializers.eType = MemberInitializer
    Function.templateParameters.eType = TemplateParameter
    Parameter.valueType.eType = TypeUse
    Parameter.defaultValue.eType = Expression
    Variable.valueType.eType = TypeUse
    Variable.initializer.eType = Expression
    Field.valueType.eType = TypeUse
    Field.initializer.eType = Expression
    Typedef.aliased.eType = TypeUse
    Record.fields.eType = Field
    Record.methods.eType = Function
    Record.bases.eType = TypeUse
    Record.staticMembers.eType = Variable
    Record.templateParameters.eType = TemplateParameter
    Enumeration.literals.eType = EnumerationLiteral
    Namespace.declarations.eType = Declaration
    TemplateParameter.valueType.eType = TypeUse
    TemplateParameter.defaultValue.eType = Expression
    MemberInitializer.arguments.eType = Expression
    Block.statements.eType = Statement
    If.initial.eType = Statement
    If.declaration.eType = DeclarationStatement
    If.condition.eType = Expression
    If.thenBranch.eType = Statement
    If.elseBranch.eType = Statement
    Loop.declaration.eType = DeclarationStatement
    Loop.condition.eType = Expression
    Loop.body.eType = Statement
    For.initial.eType = Statement
    For.step.eType = Expression
    For.range.eType = Expression
    Switch.initial.eType = Statement
    Switch.declaration.eType = DeclarationStatement
    Switch.selector.eType = Expression
    Switch.body.eType = Statement
    Case.constant.eType = Expression
    Case.statement.eType = Statement
    Default.statement.eType = Statement
    Return.value.eType = Expression
    Label.statement.eType = Statement
    ExpressionStatement.expression.eType = Expression
    DeclarationStatement.declarations.eType = Declaration
    Call.callee.eType = Function
    Call.arguments.eType = Expression
    Call.calleeExpression.eType = Expression
    NameReference.target.eType = Declaration
    Member.object.eType = Expression
    Index.array.eType = Expression
    Index.index.eType = Expression
    Unary.operand.eType = Expression
    Binary.left.eType = Expression
    Binary.right.eType = Expression
    Assignment.left.eType = Expression
    Assignment.right.eType = Expression
    ConditionalExpression.condition.eType = Expression
    ConditionalExpression.whenTrue.eType = Expression
    ConditionalExpression.whenFalse.eType = Expression
    Cast.target.eType = TypeUse
    Cast.operand.eType = Expression
    SizeOf.measured.eType = TypeUse
    SizeOf.operand.eType = Expression
    InitializerList.elements.eType = Expression
    UnknownExpression.body.eType = Block
    ConstructorCall.arguments.eType = Expression
    Lambda.parameters.eType = Parameter
    Lambda.captures.eType = Variable
    Program.units.eOpposite = SourceUnit.program
    Macro.uses.eOpposite = MacroUse.macro
    Declaration.references.eOpposite = NameReference.target
    Function.calls.eOpposite = Call.callee
    classifier(__name__, Storage)
    classifier(__name__, Linkage)
    classifier(__name__, RecordKind)
    classifier(__name__, LoopForm)
    classifier(__name__, SymbolUse)
