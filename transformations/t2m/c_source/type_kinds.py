"""Kinds of types that the reader of C tells apart (`CXTypeKind` of libclang), by the names that its Python package has."""

from __future__ import annotations

BOOL = 3
CHAR_U = 4
CHAR_S = 13
SCHAR = 14
SHORT = 16
INT = 17
LONG = 18
LONGLONG = 19
INT128 = 20
FLOAT = 21
DOUBLE = 22
LONGDOUBLE = 23
POINTER = 101
RECORD = 105
ENUM = 106
TYPEDEF = 107
FUNCTIONNOPROTO = 110
FUNCTIONPROTO = 111
CONSTANTARRAY = 112
VECTOR = 113
INCOMPLETEARRAY = 114
VARIABLEARRAY = 115
AUTO = 118
ELABORATED = 119
