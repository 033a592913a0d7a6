"""Parses signatures given as text: the return type, the name, and the types and names of the parameters.

Only declarators as this project writes them are read; the code model's parser reads C at large. Adapters' signatures in a plan
are typed (`queries.adapter_signature`).
"""

from __future__ import annotations

import re

from robosmi.metamodels import ccode
from robosmi.transformations.queries.expression_type import ARITHMETIC, FunctionType

_WORD = re.compile(r"[A-Za-z_]\w*")
_TAGGED = frozenset({"struct", "union", "enum", "const", "volatile"})
_DIMENSION = re.compile(r"\[[^]]*\]")
_HEAD = re.compile(r"^(?P<returns>(?>.*?[\s*](?=[A-Za-z_]\w*\()))(?P<name>\w+)\((?P<rest>.*)\)$", re.DOTALL)


def split(parameters: str) -> list[str]:
    """The parameters of a parameter list, without `void` and `...`."""
    parts, depth = [""], 0
    for character in parameters:
        depth += (character in "([") - (character in ")]")
        if character == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += character
    return [p.strip() for p in parts if p.strip() not in ("", "...", "void")]


def split_signature(signature: str) -> tuple[str, str, list[str]]:
    """Return type, name and parameters of a signature; empty if the text is no signature."""
    found = _HEAD.match(signature.strip())
    return (found["returns"].strip(), found["name"], split(found["rest"])) if found else ("", "", [])


def parameter_name(parameter: str) -> str:
    """The name of a parameter as declared."""
    if "(*" in parameter:
        return parameter.partition("(*")[2].partition(")")[0].strip()
    words = parameter.partition("[")[0].replace("*", " ").split()
    return words[-1] if words else ""


def parameter_type(parameter: str) -> str:
    """The type of a parameter as declared, without its name."""
    name = parameter_name(parameter)
    if "(*" in parameter:
        return parameter.replace(f"(*{name})", "(*)", 1)
    head, bracket, dimensions = parameter.partition("[")
    return f"{head.rstrip().removesuffix(name).rstrip()}{' ' if bracket else ''}{bracket}{dimensions}"


def type_names(spelling: str) -> list[str]:
    """The words of a written type that can name types: neither sizes of arrays nor names of a function pointer's parameters.

    >>> type_names("void (*)(struct task *par, int)")
    ['void', 'struct', 'task', 'int']
    """
    head, _, rest = _DIMENSION.sub(" ", spelling).partition("(")
    words = _WORD.findall(head)
    for parameter in split(rest.rpartition("(")[2].rstrip(") ")):
        own = _WORD.findall(parameter)
        named = len(own) > 1 and own[-1] not in ARITHMETIC and own[-2] not in _TAGGED
        words += own[:-1] if named else own
    return words


def declare(spelling: str, name: str) -> str:
    """Declare a name with a type: `int *` and `p` give `int *p`, `int [4]` and `p` give `int p[4]`."""
    spelling = spelling.strip()
    if "(*" in spelling:
        place = spelling.index("(*") + 2
        return f"{spelling[:place]}{name}{spelling[place:]}"
    if spelling.endswith(")") and "(" in spelling:  # a function as a parameter is a pointer to it
        returned, _, taken = spelling.partition("(")
        return f"{returned.rstrip()} (*{name})({taken}"
    base, bracket, dimensions = spelling.partition("[")
    base = base.rstrip()
    gap = "" if base.endswith("*") or not name else " "
    return f"{base}{gap}{name}{bracket}{dimensions}"


def function_type(signature: str) -> FunctionType:
    """The return type and the parameter types of a signature."""
    returns, _, parameters = split_signature(signature)
    return FunctionType(returns, tuple(parameter_type(p) for p in parameters))


def nothing(returned: str) -> str:
    """The expression that a placeholder returns for a return type (`0`, `{}`); empty for void."""
    words = returned.replace("const ", "").replace("volatile ", "").split()
    if returned.strip() == "void" or not words:
        return ""
    return "0" if "*" in returned or words[0] in ARITHMETIC else "{}"


def declared_parameters(function: ccode.Function) -> str:
    """The parameters of a function as C++ writes them in its list, empty for none."""
    shown = [
        declare(f"{p.valueType.spelling} {p.valueType.arrayDims or ''}" if p.valueType is not None else "int", p.name)
        for p in function.parameters
    ]
    return ", ".join([*shown, *(["..."] if function.variadic else [])])
