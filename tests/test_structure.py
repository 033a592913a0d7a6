"""The house as design and architecture draw it: rooms, arrows, names, sizes, and what `import robosmi` costs.

Everything here is read from the source text (ast), so that a rule also holds for imports inside functions.
"""

from __future__ import annotations

import ast
import importlib
import inspect
import json
import pkgutil
import re
import statistics
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path

import networkx as nx
import pytest

import robosmi
from tests.source_imports import (
    CONTENT,
    FACES,
    PUBLIC,
    ROOT,
    imported,
    module_name,
    modules,
    names_imported,
    nodes_of_module,
    tree_of,
)

FOUNDATION = (*PUBLIC, "base")
LOW = ("files", "quoting", *FOUNDATION)
ABOVE: dict[str, tuple[str, ...]] = {
    "base": PUBLIC,
    "quoting": FOUNDATION,
    "files": ("quoting", *FOUNDATION),
    "model": LOW,
    "query": ("model", *LOW),
    "generate": ("query", "model", *LOW),
    "validate": ("query", "model", *LOW),
    "transform": ("query", "model", "metamodels", *LOW),
    "report": ("generate", "validate", "transform", "query", "model", *LOW),
    "verify": ("generate", "validate", "transform", "query", "model", *LOW),
    "recommend": ("generate", "validate", "transform", "query", "model", *LOW),
    "chain": ("generate", "validate", "transform", "query", "model", *LOW),
    "corpus": ("generate", "query", "model", *LOW),
    "cli": (
        "api",
        "corpus",
        "chain",
        "report",
        "verify",
        "recommend",
        "generate",
        "validate",
        "transform",
        "query",
        "model",
        *LOW,
    ),
}
"""Room of the framework -> the rooms that it may import (and itself). The foundation's own arrows are a test below."""


CONTENT_ABOVE: dict[str, tuple[str, ...]] = {
    "knowledge": (),
    "queries": ("knowledge",),
    "t2m": ("queries", "knowledge"),
    "constraints": ("queries", "knowledge"),
    "m2m": ("queries", "knowledge"),
    "m2t": ("queries", "knowledge"),  # knowledge for type checkers only, see below
    "verification": ("queries", "knowledge"),
    "chains": ("verification", "m2t", "m2m", "constraints", "t2m", "queries", "knowledge"),
}
"""Room of the content -> the rooms of the content that it may import (and itself)."""

INSIDE: dict[str, dict[str, tuple[str, ...]]] = {
    "robosmi/cli": {"": (), "commands": ("",)},
    "robosmi/model": {
        "elements": (),
        "ecore": ("elements",),
        "xmi": ("ecore", "elements"),
        "": ("xmi", "ecore", "elements"),
        "generator": ("", "ecore", "elements"),
        "comparison": ("", "xmi", "ecore", "elements"),
    },
    "robosmi/query": {"": (), "rules": ("",)},
    "robosmi/verify": {"toolchains": (), "": ("toolchains",), "uploads": ("toolchains",), "traces": ("",)},
    "transformations/chains": {"stages": (), "": ("stages",), "editing": ("", "stages")},
    "transformations/knowledge": {
        "": (),
        "adapters": ("",),
        "cores": ("",),
        "platforms": ("adapters", ""),
        "libraries": ("platforms",),
    },
    "transformations/m2m": {
        "circuits": (),
        "choices": (),
        "adapters": (),
        "language": (),
        "ports": ("choices",),
        "partition": ("ports", "adapters", "language"),
        "widths": ("partition", "language"),
        "sketches": ("widths", "partition"),
        "": ("widths", "partition", "ports", "adapters", "choices", "language"),
    },
    "transformations/m2t": {"circuits": (), "": ("circuits",)},
    "transformations/queries": {
        "macros": (),
        "circuits": (),
        "": ("macros",),
        "programs": ("", "macros"),
        "flows": ("programs", "", "macros"),
        "constants": ("flows", "programs", "", "macros"),
        "ports": ("flows", "", "macros"),
        "portability": ("", "macros"),
        "plans": ("ports", "circuits", ""),
        "resources": ("plans", "constants", "flows", "programs", "", "macros"),
        "reports": ("resources", "plans", "ports", "flows", "programs", ""),
    },
    "transformations/t2m": {
        "": (),
        "eagle": ("",),
        "fritzing": ("",),
        "kicad": ("",),
        "wokwi": ("",),
        "c_source/parsing": (),
        "c_source": ("c_source/parsing",),
    },
    "transformations/verification": {
        "devices": (),
        "engines": (),
        "stack": (),
        "bound_devices": (),
        "": ("bound_devices",),
        "search": ("", "bound_devices"),
        "judgement": ("", "bound_devices"),
    },
}
"""Hall -> its rooms, lowest first -> the rooms of the hall that each may import (and itself); "" has the hall's loose modules."""
LARGE = ("robosmi/cli/commands", "transformations/constraints")
"""Folders that may have more than 25 modules, since each module is one registered thing."""


def rooms_imported(path: Path) -> Iterator[tuple[str, str]]:
    """Place and room of each import of this package."""
    for line, name in imported(path):
        parts = name.split(".")
        if parts[0] == "robosmi" and len(parts) > 1 and not parts[1].startswith("__"):
            yield f"{path.relative_to(ROOT)}:{line}", parts[1]


@pytest.mark.parametrize("room", ABOVE)
def test_a_room_imports_only_rooms_below_it(room: str) -> None:
    allowed = {room, *ABOVE[room]}
    wrong = [
        f"{place} imports {other}"
        for path in modules(f"robosmi/{room}")
        for place, other in rooms_imported(path)
        if other not in allowed
    ]
    assert wrong == []


def content_rooms_imported(path: Path) -> Iterator[tuple[str, str]]:
    """Place and room of each import of a room of the content."""
    for line, name in imported(path):
        parts = name.split(".")
        if parts[:2] == ["robosmi", "transformations"] and len(parts) > 2:
            yield f"{path.relative_to(ROOT)}:{line}", parts[2]


@pytest.mark.parametrize("room", [room for room in CONTENT_ABOVE if (ROOT / "transformations" / room).is_dir()])
def test_a_room_of_the_content_imports_only_rooms_below_it(room: str) -> None:
    allowed = {room, *CONTENT_ABOVE[room]}
    wrong = [
        f"{place} imports {other}"
        for path in modules(f"transformations/{room}")
        for place, other in content_rooms_imported(path)
        if other not in allowed
    ]
    assert wrong == []


def rooms_of(hall: str) -> dict[str, list[Path]]:
    """The rooms of a hall with the modules that lie directly in them, without packages' own files and faces."""
    rooms: dict[str, list[Path]] = {}
    for path in modules(hall):
        room = path.parent.relative_to(ROOT / hall).as_posix()
        if path.stem != "__init__" and module_name(path) not in FACES:
            rooms.setdefault(room if room != "." else "", []).append(path)
    return rooms


@pytest.mark.parametrize("hall", INSIDE)
def test_a_room_of_a_hall_imports_only_rooms_below_it(hall: str) -> None:
    known, arrows = rooms_of(hall), INSIDE[hall]
    assert set(known) == set(arrows)
    room_of = {module_name(path): room for room, paths in known.items() for path in paths}
    below: set[str] = set()
    wrong = []
    for room, allowed in arrows.items():
        assert set(allowed) <= below, f"{room}: its rooms are above it in the table"
        below.add(room)
        for path in known[room]:
            for line, name in imported(path):
                other = room_of.get(name, room_of.get(name.rpartition(".")[0], room))
                if other != room and other not in allowed:
                    wrong.append(f"{path.relative_to(ROOT)}:{line} imports {name}")
    assert wrong == []


def test_a_face_only_hands_on_names() -> None:
    """What is new is imported from the room that has it."""
    faces = [path for path in modules("robosmi") if module_name(path) in FACES]
    assert {module_name(path) for path in faces} == set(FACES)
    for path in faces:
        assert {type(node).__name__ for node in tree_of(path).body} == {"Expr", "ImportFrom"}, path
    users = [
        f"{path.relative_to(ROOT)}:{line}"
        for path in modules("robosmi", "transformations")
        if path.name != "__init__.py"  # a package offers the documented names itself
        for line, name in imported(path)
        if not {name, name.rpartition(".")[0]}.isdisjoint(FACES)
    ]
    assert users == []


def test_no_room_has_more_than_25_modules() -> None:
    folders: dict[str, int] = {}
    for path in modules("robosmi", "transformations"):
        if path.name != "__init__.py":
            folder = path.parent.relative_to(ROOT).as_posix()
            folders[folder] = folders.get(folder, 0) + 1
    assert {folder: count for folder, count in folders.items() if count > 25 and folder not in LARGE} == {}


def test_generators_look_nothing_up() -> None:
    """They write what the plan and its models say: no table, no setting, no other file is asked."""
    wrong = [
        f"{path.relative_to(ROOT)}:{line} imports {name}"
        for path in modules("transformations/m2t")
        for line, name in imported(path, run=True)
        if name.startswith(("robosmi.transformations.knowledge", "robosmi.resources", "robosmi.project", "robosmi.inputs"))
    ]
    assert wrong == []


def circles(imports: dict[str, list[tuple[int, str]]]) -> list[list[str]]:
    """The groups of modules that import one another, each as the lines of its imports.

    Args:
        imports: module -> line and full name of what it imports, a module or a name in one.
    """
    graph: nx.MultiDiGraph[str] = nx.MultiDiGraph()
    for module, names in imports.items():
        for line, name in names:
            while name not in imports and "." in name:
                name = name.rpartition(".")[0]
            if name in imports and name != module:
                graph.add_edge(module, name, line=line)
    found = [graph.subgraph(part) for part in nx.strongly_connected_components(graph) if len(part) > 1]
    return [sorted({f"{a}:{data['line']} imports {b}" for a, b, data in part.edges(data=True)}) for part in found]


def test_no_modules_import_one_another() -> None:
    """Imports inside functions and those for type checkers count; what a package runs for its modules does not.

    The one exception is the package itself: for type checkers it names the functions of `robosmi.api`, which imports the others.
    """
    paths = modules("robosmi", "transformations", "metamodels")
    imports = {module_name(path): list(imported(path)) for path in paths}
    imports["robosmi"] = list(imported(ROOT / "robosmi" / "__init__.py", run=True))
    found = circles(imports)
    assert found == [], "\n\n".join("\n".join(lines) for lines in found)


def test_the_search_for_circles_finds_them() -> None:
    inside = ast.parse("def f():\n    from p.b import x")
    for_types = ast.parse("if TYPE_CHECKING:\n    from p import a\nelse:\n    import p.c")
    back = ast.parse("from . import a")
    imports = {
        "p.a": list(names_imported(inside, ["p"], run=True)),
        "p.b": list(names_imported(for_types, ["p"], run=True)),
        "p.c": [],
    }
    assert circles(imports) == []
    assert circles({**imports, "p.c": list(names_imported(back, ["p"], run=True))}) == [
        ["p.a:2 imports p.b", "p.b:4 imports p.c", "p.c:1 imports p.a"]
    ]
    assert circles({**imports, "p.b": list(names_imported(for_types, ["p"], run=False))}) == [
        ["p.a:2 imports p.b", "p.b:2 imports p.a"]
    ]


def test_every_room_of_the_content_has_its_arrows() -> None:
    rooms = {path.name for path in (ROOT / "transformations").iterdir() if (path / "__init__.py").is_file()}
    assert rooms <= set(CONTENT_ABOVE)


def test_every_room_of_the_framework_has_its_arrows() -> None:
    rooms = {path.name for path in (ROOT / "robosmi").iterdir() if (path / "__init__.py").is_file()}
    files = {path.stem for path in (ROOT / "robosmi").glob("*.py")} - {"__init__", "__main__"}
    assert rooms == set(ABOVE)
    assert files == {*PUBLIC, "api"}


def test_the_foundation_imports_nothing_but_itself() -> None:
    paths = [*(ROOT / "robosmi" / f"{name}.py" for name in PUBLIC), *modules("robosmi/base")]
    wrong = [f"{place} imports {other}" for path in paths for place, other in rooms_imported(path) if other not in FOUNDATION]
    assert wrong == []


def test_the_framework_never_imports_content_by_name() -> None:
    wrong = [
        place
        for path in modules("robosmi")
        for place, other in rooms_imported(path)
        if other in ("transformations", "templates", "platform_repo")
    ]
    assert wrong == []


def test_content_does_not_import_the_command_line_or_the_api() -> None:
    wrong = [place for path in modules("transformations") for place, other in rooms_imported(path) if other in ("cli", "api")]
    assert wrong == []


def test_generated_packages_import_pyecore_the_strict_base_and_each_other() -> None:
    allowed = ("robosmi.model.strict", "robosmi.metamodels", "pyecore", "__future__", "collections.abc", "functools", "typing")
    names = [(path, line, name) for path in modules("metamodels") for line, name in imported(path)]
    assert names
    assert [f"{path}:{line} {name}" for path, line, name in names if not name.startswith(allowed)] == []


@pytest.mark.parametrize("folder", ["templates", "platform_repo"])
def test_data_rooms_hold_no_code(folder: str) -> None:
    for path in modules(folder):
        assert [type(node).__name__ for node in tree_of(path).body] == ["Expr"], f"{path}: a docstring and nothing else"


def test_nothing_is_imported_by_the_folders_own_name() -> None:
    names = [(path, line, name.split(".")[0]) for path in modules("robosmi", *CONTENT, "tests") for line, name in imported(path)]
    assert [f"{path.relative_to(ROOT)}:{line}" for path, line, first in names if first in CONTENT] == []


def test_no_platform_board_or_drawing_tool_is_named_in_the_framework() -> None:
    words = re.compile(
        r"propeller|parallax|arduino|fritzing|kicad|wokwi|fqbn|atmega|\bavr\b|\.ino\b|sketch\.yaml|setup/loop", re.IGNORECASE
    )
    found = [
        f"{path.relative_to(ROOT)}:{number}: {line.strip()}"
        for path in modules("robosmi")
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        if words.search(line)
    ]
    assert found == []


def private_names_of_pyecore() -> set[str]:
    """Fields and methods with one leading underscore that pyecore's modules give to their objects."""
    found = set()
    for name in ("ecore", "valuecontainer", "notification", "innerutils", "resources.resource"):
        module = importlib.import_module(f"pyecore.{name}")
        for node in ast.walk(ast.parse(inspect.getsource(module))):
            if isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
                found.add(node.attr)
            elif isinstance(node, ast.ClassDef):
                found |= {part.name for part in node.body if isinstance(part, ast.FunctionDef)}
    return {name for name in found if name.startswith("_") and not name.startswith("__")}


def test_pyecores_private_names_are_in_one_module_only() -> None:
    """Where our own classes have a private name of that spelling, it is theirs on `self` and `cls` alone."""
    private = private_names_of_pyecore()
    assert {"_container", "_isset", "_value", "_name", "_get", "_inverse_rels", "_wrapped"} <= private
    wrong = []
    for path in written_by_hand():
        if path.name == "pyecore_internals.py":
            continue
        nodes = nodes_of_module(path)
        own = {node.name for node in nodes if isinstance(node, ast.FunctionDef)}
        own |= {n.attr for n in nodes if isinstance(n, ast.Attribute) and is_of_self(n) and isinstance(n.ctx, ast.Store)}
        for node in nodes:
            if isinstance(node, ast.Attribute) and node.attr in private and node.attr not in own:
                wrong.append(f"{path.relative_to(ROOT)}:{node.lineno}: {node.attr}")
            elif isinstance(node, ast.Constant) and node.value in private - own:
                wrong.append(f"{path.relative_to(ROOT)}:{node.lineno}: {node.value!r}")
        if "pyecore.innerutils" in {name for _, name in imported(path)}:
            wrong.append(f"{path.relative_to(ROOT)}: innerutils")
    assert wrong == []


def is_of_self(node: ast.Attribute) -> bool:
    """Whether an attribute is read or written as `self.x` or `cls.x`."""
    return isinstance(node.value, ast.Name) and node.value.id in ("self", "cls")


def written_by_hand() -> list[Path]:
    """The modules of the product that no generator writes."""
    return modules("robosmi", "transformations")


def test_no_module_is_longer_than_600_lines_and_half_have_150_at_most() -> None:
    lengths = {str(path.relative_to(ROOT)): len(path.read_text(encoding="utf-8").splitlines()) for path in written_by_hand()}
    assert {name: length for name, length in lengths.items() if length > 600} == {}
    assert statistics.median(lengths.values()) <= 150


def test_a_module_is_run_behind_all_that_it_defines() -> None:
    """Run with `python -m`, what stands behind `if __name__ == "__main__"` does not exist yet."""
    programs = [path for path in modules("robosmi", "transformations") if '__name__ == "__main__"' in path.read_text("utf-8")]
    assert len(programs) > 5
    wrong = [path for path in programs if "__main__" not in ast.unparse(tree_of(path).body[-1])]
    assert wrong == []


NAMED = re.compile(rf"`((?:robosmi|{'|'.join(CONTENT_ABOVE)})(?:[./][A-Za-z_]\w*)+)`")
"""A module, or a name in one, as texts call it: with its room, by points or as a path."""


def is_there(name: str, texts: dict[str, str]) -> bool:
    """Whether a module has this name, or one whose name this begins with has the last part of it.

    Args:
        name: as in `NAMED`, with points.
        texts: name of each module -> its text.
    """
    full = name if name.startswith("robosmi.") else f"robosmi.transformations.{name}"
    parts = full.split(".")
    owners = (".".join(parts[:count]) for count in range(len(parts) - 1, 1, -1))
    owner = next((each for each in owners if each in texts), "")
    return full in texts or (owner != "" and re.search(rf"\b{parts[-1]}\b", texts[owner]) is not None)


def test_texts_in_modules_name_only_modules_that_exist() -> None:
    texts = {module_name(path): path.read_text(encoding="utf-8") for path in modules("robosmi", *CONTENT)}
    named = [(module, name) for module, text in texts.items() for name in NAMED.findall(text)]
    assert len(named) > 100
    wrong = [
        f"{module}: {name}"
        for module, name in named
        if not name.endswith(".toml") and not is_there(name.removesuffix(".py").replace("/", "."), texts)
    ]
    assert wrong == []
    assert not is_there("m2m.cpp_incompatibilities", texts), "it is in m2m.language"


def test_every_module_says_what_lives_in_it() -> None:
    assert [str(path) for path in modules("robosmi", *CONTENT, "tests") if not ast.get_docstring(tree_of(path))] == []


OPENS: dict[str, str] = {
    "transformations/t2m/c_source/parsing/clang.py": "only the null device",
    "robosmi/inputs.py": "it is the place",
    "robosmi/base/user_cache.py": "asks who has written what it reads",
    "robosmi/cli/streams.py": "opens the null device in place of a stream that is closed",
    "robosmi/cli/commands/lsp.py": "doubles its own output, which the server closes",
    "robosmi/cli/landlock.py": "names a folder to the kernel, and can read nothing by it",
    "robosmi/files/directory_fd.py": "writes, and holds folders open",
    "robosmi/files/files.py": "writes",
    "robosmi/files/sqlite_files.py": "changes bytes of the file that it has just written",
    "robosmi/base/file_locks.py": "opens files and folders to lock them, and reads nothing by it",
    "robosmi/verify/uploads/serial_ports.py": "opens serial ports, which are no files to be read",
    "robosmi/verify/uploads/upload.py": "writes to the drive of a board, which takes no file under another name",
    "robosmi/corpus/store.py": "writes",
    "robosmi/corpus/worker.py": "hands on its own output, which it has before a library can print there",
    "robosmi/files/zip_archive.py": "reads an archive that is in memory",
    "transformations/t2m/fritzing/drawing_model.py": "writes an archive in memory",
}
"""Modules that may call what opens files, and why; all others ask `robosmi.inputs`."""


def opening_calls(path: Path) -> Iterator[str]:
    """Calls in a module that open a file by its path, whatever they are reached through."""
    for node in nodes_of_module(path):
        if not isinstance(node, ast.Call):
            continue
        called = ast.unparse(node.func)
        own = called in ("reader.open", "self.open")  # a method of ours: it opens a model, and asks `inputs` for the bytes
        opens = called == "open" or (
            isinstance(node.func, ast.Attribute) and node.func.attr in OPENING and not called.startswith("inputs.")
        )
        if opens and not own:
            yield f"{path.relative_to(ROOT)}:{node.lineno}: {called}"


OPENING = frozenset(["open", "fdopen", "read_bytes", "read_text", "fromfile", "open_binary", "open_text", "ZipFile"])


def test_only_one_module_opens_files_for_reading() -> None:
    found = {path: list(opening_calls(path)) for path in written_by_hand()}
    calls = {path.relative_to(ROOT).as_posix(): calls for path, calls in found.items() if calls}
    assert [call for name, of_module in calls.items() if name not in OPENS for call in of_module] == []
    assert set(OPENS) - set(calls) == set(), "a module that opens nothing needs no leave"


def test_the_search_for_opening_calls_finds_them() -> None:
    module = ROOT / "robosmi" / "inputs.py"
    assert {call.rpartition(" ")[2] for call in opening_calls(module)} == {"os.open", "os.fdopen"}


def test_no_two_public_classes_have_one_name() -> None:
    """Generated packages apart: there a name is the metamodel's."""
    places: dict[str, list[str]] = {}
    for path in written_by_hand():
        for node in tree_of(path).body:
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                places.setdefault(node.name, []).append(str(path.relative_to(ROOT)))
    assert {name: found for name, found in places.items() if len(found) > 1} == {}


def is_overload(node: ast.AST) -> bool:
    """Whether it is one of several signatures of a function, which has its docstring at the last one."""
    return any(isinstance(d, ast.Name) and d.id == "overload" for d in getattr(node, "decorator_list", []))


def public_definitions(body: list[ast.stmt], within: str) -> Iterator[tuple[str, ast.AST]]:
    """Public functions and classes of a body, and public methods of public classes."""
    for node in body:
        if (
            isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef))
            and not node.name.startswith("_")
            and not is_overload(node)
        ):
            yield f"{within}.{node.name}", node
            if isinstance(node, ast.ClassDef):
                yield from public_definitions(node.body, f"{within}.{node.name}")


def test_every_public_function_and_class_has_a_docstring() -> None:
    found = [
        (name, node)
        for path in written_by_hand()
        for name, node in public_definitions(tree_of(path).body, str(path.relative_to(ROOT)))
    ]
    assert len(found) > 200
    silent = [
        name
        for name, node in found
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)) and not ast.get_docstring(node)
    ]
    assert silent == []


def test_every_finding_rule_of_the_code_has_its_page_and_no_other() -> None:
    quoted = re.compile(r"[\"'](RS\d{3})[\"']")
    in_code = {rule for path in written_by_hand() for rule in quoted.findall(path.read_text(encoding="utf-8"))}
    data = [toml.stem for toml in (ROOT / "platform_repo" / "rules").glob("*.toml")]
    described = [
        rule
        for name in data
        for rule in tomllib.loads((ROOT / "platform_repo" / "rules" / f"{name}.toml").read_text(encoding="utf-8"))
        if rule != "title"
    ]
    assert len(described) == len(set(described))
    assert set(described) == in_code


def test_pyproject_lists_every_folder_with_python_files() -> None:
    listed = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["setuptools"]["packages"]
    folders = {path.parent.relative_to(ROOT).parts for path in modules("robosmi", *CONTENT)}
    names = {".".join(parts if parts[0] == "robosmi" else ("robosmi", *parts)) for parts in folders}
    assert len(listed) == len(set(listed))
    assert set(listed) == names | {"robosmi.docs.examples"}, "and what the command demo installs"


IMPORT = """
import json, sys, time
before = set(sys.modules)
start = time.perf_counter()
import robosmi
seconds = time.perf_counter() - start
json.dump({"seconds": seconds, "modules": sorted({name.partition(".")[0] for name in set(sys.modules) - before})}, sys.stdout)
"""


def fresh_import() -> tuple[float, set[str]]:
    """Seconds that `import robosmi` takes in a new process, and the top-level modules that it loads."""
    done = subprocess.run([sys.executable, "-c", IMPORT], capture_output=True, text=True, check=True, cwd=ROOT)
    measured = json.loads(done.stdout)
    return measured["seconds"], set(measured["modules"])


def test_importing_the_package_is_light() -> None:
    runs = [fresh_import() for _ in range(5)]
    assert min(seconds for seconds, _ in runs) < 0.150
    assert runs[0][1] & {"pyecore", "lxml", "clang", "networkx", "jinja2", "sqlite3"} == set()


def test_no_module_makes_data_classes() -> None:
    found = [
        f"{path.relative_to(ROOT)}:{line}"
        for path in modules("robosmi", "transformations")
        for line, name in imported(path)
        if name.partition(".")[0] == "dataclasses"
    ]
    assert found == [], "records are structs (docs/decisions/records-are-structs.md)"


def test_public_names_can_be_imported_and_are_no_submodules() -> None:
    submodules = {module.name for module in pkgutil.iter_modules(robosmi.__path__)}
    assert "cli" in submodules
    assert set(robosmi.__all__) & submodules == set()
    assert all(callable(getattr(robosmi, name)) for name in robosmi.__all__)
    assert set(robosmi.__all__) <= set(dir(robosmi))


def test_the_python_interface_has_the_functions_of_the_contract() -> None:
    promised = {
        "load_code", "load_hardware", "load_model", "save_model", "recommend_libraries", "plan_migration", "generate_sketch",
        "compile_sketch", "verify_migration", "check_model", "migrate",
    }  # fmt: skip
    assert promised <= set(robosmi.__all__)


def test_an_unknown_public_name_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="has no attribute 'migrat'"):
        _ = robosmi.migrat


def test_modules_about_one_platform_are_used_by_no_other() -> None:
    """What makes the data of one platform is a tool of its own: whatever serves all platforms lies elsewhere."""
    platforms = {path.parent.name.replace("-", "_") for path in (ROOT / "platform_repo").glob("*/platform.toml")}
    named = {path.stem for path in modules("transformations") if path.stem.partition("_")[0] in platforms}
    assert "propeller_facts" in named
    imports = re.compile(r"^\s*(?:from|import)\s+robosmi\.transformations.*", re.MULTILINE)
    users = [
        f"{path.relative_to(ROOT)}: {line}"
        for path in modules("transformations")
        for line in imports.findall(path.read_text(encoding="utf-8"))
        if named & set(re.findall(r"\w+", line))
    ]
    assert users == []
