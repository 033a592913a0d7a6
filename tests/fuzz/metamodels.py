"""Metamodels from strangers: whatever names, documentation and default values say, the generated packages are inert.

Usage: python -m tests.fuzz.metamodels [--metamodels N] [--seed N]. By hand (`make fuzz`); the test run has a few
(`tests/model/generator/test_hostile.py`). The judges are Python's own parser and importer: a package imports, loads nothing but
RoboSMi and the standard types, and calls nothing but what it loads from there. The same seed gives the same metamodels.
"""

from __future__ import annotations

import argparse
import ast
import random
import subprocess
import sys
import tempfile
import traceback
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from xml.sax.saxutils import quoteattr

from tests.fuzz.costs import Costs, TooLong

CANARY = "robosmi-was-here"
"""Name of a file that a stranger's code would create in the current folder."""
TEXTS = (
    '"""', "'''", '"', "'", "\\", '\\"""', f'"""\nopen("{CANARY}", "w")\n"""', f"'''\nopen('{CANARY}', 'w')\n'''", "\n", "\r",
    "\t", "\x85", "\u2028", "\u202e", "\ufeff", "#", "# coding: utf-7", "{{ 7*7 }}", "{% raw %}", "a b", "é", "௰", "①", "²", "·",
    "x\u0301", "ª", "ﬁ", "𝔘", "🙂", "٣", "__class__", "__init__", "__debug__", "_int", "None", "class", "match", "import os",
    "os", f");open('{CANARY}','w')#", f"'+open('{CANARY}','w').name+'", "\\N{BULLET}", "\\u0041", "\\x", "%s", "{0}", "..",
    "../../x", "/etc/passwd", "-", "self", "int", "print", "eClass", "Element", "TYPE_CHECKING", "Any", "robosmi", "typing",
    "mixins", "linked", "␛0000", "␛000a", "␛", "9" * 5000, "x" * 60, "_", "1e400", "true",
)  # fmt: skip
_TYPES = ("EString", "EInt", "EBoolean", "EDouble", "EChar", "EBigDecimal", "EDate", "EByteArray", "EJavaObject", "ELong")
_ECORE = "ecore:EDataType http://www.eclipse.org/emf/2002/Ecore#//"
_HEAD = (
    '<?xml version="1.0" encoding="UTF-8"?>\n<ecore:EPackage xmi:version="2.0" xmlns:xmi="http://www.omg.org/XMI" '
    'xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xmlns:ecore="http://www.eclipse.org/emf/2002/Ecore"'
)
_STATEMENTS = (
    ast.Expr, ast.Assign, ast.AnnAssign, ast.ClassDef, ast.FunctionDef, ast.If, ast.Import, ast.ImportFrom, ast.Raise, ast.Pass,
)  # fmt: skip
_MODULES = ("robosmi.model.", "typing", "collections.abc", "datetime", "decimal", "builtins", "__future__")


def metamodel(seed: int) -> str:
    """The .ecore file of a seed: every name, text and default value is plain or hostile."""
    chance = random.Random(seed)

    def text() -> str:
        return "".join(chance.choice(TEXTS) for _ in range(chance.choice((1, 1, 1, 2, 3))))

    def quoted(value: str) -> str:
        return quoteattr(value, {"\n": "&#10;", "\r": "&#13;", "\t": "&#9;", "\x85": "&#133;"})

    def name(plain: str) -> str:
        return f"name={quoted(text() if chance.random() < 0.5 else plain)}"

    def said() -> str:
        source = "http://www.eclipse.org/emf/2002/GenModel"
        return f'<eAnnotations source="{source}"><details key="documentation" value={quoted(text())}/></eAnnotations>'

    def attribute(plain: str) -> str:
        default = f"defaultValueLiteral={quoted(chance.choice((text(), '5', 'true', '1e5', 'NaN')))}"
        kind, upper = chance.choice(_TYPES), chance.choice((1, -1, 5))
        return (
            f'<eStructuralFeatures xsi:type="ecore:EAttribute" {name(plain)} eType="{_ECORE}{kind}" {default} '
            f'upperBound="{upper}">{said()}</eStructuralFeatures>'
        )

    def classifier(kind: str, plain: str, rest: str, inner: str = "") -> str:
        return f'<eClassifiers xsi:type="ecore:{kind}" {name(plain)} {rest}>{inner}</eClassifiers>'

    literals = "".join(f'<eLiterals {name(f"l{n}")} value="{n}" literal={quoted(text())}/>' for n in range(3))
    java = quoted(chance.choice((text(), "os.system", "java.lang.Integer", "builtins.eval")))
    typed = "".join(
        f'<eStructuralFeatures xsi:type="ecore:EAttribute" {name(f"t{n}")} eType="#//@eClassifiers.{n}" '
        f"defaultValueLiteral={quoted(text())}/>"
        for n in range(2)
    )
    operation = (
        f'<eOperations {name("operation")}>{said()}<eParameters {name("first")} eType="{_ECORE}EString"/>'
        f'<eParameters {name("second")} eType="#//@eClassifiers.3"/></eOperations>'
    )
    reference = (
        f'<eStructuralFeatures xsi:type="ecore:EReference" {name("others")} upperBound="-1" containment="true" '
        'eType="#//@eClassifiers.3"/>'
    )
    first = said() + attribute("a1") + attribute("a2") + typed + reference + operation
    inner = classifier("EClass", "Third", 'eSuperTypes="#//@eClassifiers.2"')
    uri = f"nsURI={quoted(text())} nsPrefix={quoted(text())}"
    return "".join((
        f"{_HEAD} {name('outer')} {uri}>",
        said(),
        classifier("EEnum", "Kind", "", said() + literals),
        classifier("EDataType", "Data", f"instanceClassName={java}"),
        classifier("EClass", "First", "", first),
        classifier("EClass", "Second", 'eSuperTypes="#//@eClassifiers.2"', said() + attribute("a3")),
        f"<eSubpackages {name('inner')} {uri}>{inner}</eSubpackages></ecore:EPackage>\n",
    ))  # fmt: skip


def acts(source: bytes) -> Iterator[str]:
    """What a generated module executes besides describing its metamodel."""
    tree = ast.parse(source)
    loaded = {"__name__"}
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom):
            if node.level == 0 and not str(node.module).startswith(_MODULES):
                yield f"it loads {node.module}"
            loaded |= {alias.asname or alias.name for alias in node.names}
        elif isinstance(node, ast.Import):
            yield f"it loads {[alias.name for alias in node.names]}"
        elif isinstance(node, ast.stmt) and not isinstance(node, _STATEMENTS):
            yield f"line {node.lineno}: a statement {type(node).__name__}"
    for node in ast.walk(tree):
        if isinstance(node, ast.Call):
            called = node.func.func if isinstance(node.func, ast.Call) else node.func
            if not isinstance(called, ast.Name) or called.id not in {*loaded, "float", "NotImplementedError", "type"}:
                yield f"line {node.lineno}: it calls {ast.unparse(called)}"


def faults(made: dict[str, bytes], folder: Path) -> list[str]:
    """What is wrong with generated packages.

    Args:
        made: relative path -> bytes.
        folder: an empty folder.
    """
    found: list[str] = []
    for name, source in made.items():
        path = (folder / "out" / name).resolve()
        if not path.is_relative_to(folder.resolve() / "out"):
            return [f"it would lie at {name}"]
        try:
            found += [f"{name}: {act}" for act in acts(source)]
        except (SyntaxError, ValueError) as error:
            found.append(f"{name}: {error}")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(source)
    if found:
        return found
    (folder / "out" / "__init__.py").touch()
    modules = sorted("out." + name.rpartition("/")[0].replace("/", ".") for name in made)
    code = f"import importlib\nfor module in {modules!r}: importlib.import_module(module)"
    done = subprocess.run([sys.executable, "-c", code], cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode:
        found.append(f"it cannot be imported: {done.stderr.strip().splitlines()[-1]}")
    return [*found, *(["code of the metamodel ran"] if (folder / CANARY).exists() else [])]


def check(seed: int, folder: Path, costs: Costs | None = None) -> str:
    """The result for a metamodel: "inert", "refused" with a message, or what is wrong."""
    from robosmi.errors import RobosmiError
    from robosmi.model.generator.codegen import render

    path = folder / "hostile.ecore"
    path.write_text(metamodel(seed), encoding="utf-8")
    try:
        with (costs or Costs()).input():
            made = render([path]).files
    except RobosmiError:
        return "refused"
    except (Exception, TooLong):
        return traceback.format_exc()
    return "\n".join(faults(made, folder)) or "inert"


def main() -> int:
    """The command line; the exit code is 1 when a package was not inert."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--metamodels", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1, help="of the first metamodel")
    arguments = parser.parse_args()
    states, costs = Counter[str](), Costs()
    for seed in range(arguments.seed, arguments.seed + arguments.metamodels):
        with tempfile.TemporaryDirectory() as scratch:
            said = check(seed, Path(scratch), costs)
        states[said if said in ("inert", "refused") else "wrong"] += 1
        if said not in ("inert", "refused"):
            print(f"{seed}: {said.strip().splitlines()[-1][:200]}", file=sys.stderr)
    print(f"metamodels: {states.total()} hostile ones: {dict(states)}; {costs}")
    return int(states["wrong"] > 0 or costs.over())


if __name__ == "__main__":
    sys.exit(main())
