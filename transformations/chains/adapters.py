"""The chains `adapters list`, `show` and `save`: available adapters, and bodies written by the user that are kept for later.

`save` takes the bodies that were written into placeholders of a generated program and adds them to an adapter file beside the
project file or in the user's data, where later migrations find them before the built-in ones.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from pathlib import Path

from msgspec import Struct

from robosmi import inputs
from robosmi.base.data_text import Json, as_texts
from robosmi.base.quantities import quantity
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import PlatformDataError, SourceError, UsageError, did_you_mean
from robosmi.files.files import free_name, write_atomic
from robosmi.generate.output_paths import Places
from robosmi.generate.text_form import read
from robosmi.metamodels import migration, platform
from robosmi.project import FILE_NAME, default_text, load_project
from robosmi.query import ancestor_of_kind
from robosmi.transformations.chains.stages.models import stored_models
from robosmi.transformations.chains.stages.own_adapters import fault_of_saved
from robosmi.transformations.knowledge.adapters.adapter_checks import parameters_of
from robosmi.transformations.knowledge.adapters.adapter_files import DIRECTIONS, MARK, adapter_file
from robosmi.transformations.knowledge.adapters.adapter_index import ENDING_OF, AdapterIndex, adapter_index, own_folders
from robosmi.transformations.knowledge.adapters.adapter_records import AdapterPiece
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.knowledge.platforms.target_platform import target_facts
from robosmi.transformations.m2t.task_list import RELATIONS
from robosmi.transformations.queries.plans.adapter_needs import AdapterPieces
from robosmi.transformations.queries.reports.written_bodies import Body, bodies
from robosmi.transformations.queries.source_text import ADAPTERS_FILE

_INCLUDE = re.compile(r"^#include\s+(<[^>]+>|\"[^\"]+\")", re.MULTILINE)

_HOW = "write its body into adapters.h of a program that calls it, then: robosmi adapters save OUT"


class AdapterReport(Struct):
    """Adapters as the contract lists them.

    Attributes:
        adapters: function, header, kind, source, status, limits of each; of one that is shown, its text, too.
        findings: what could not be kept.
        written: the adapter files that were written.
    """

    adapters: list[dict[str, Json]] = []
    findings: list[Finding] = []
    written: list[str] = []

    @property
    def result(self) -> dict[str, Json]:
        """The contract's result."""
        return {"adapters": self.adapters} | ({"written": self.written} if self.written else {})

    def lines(self) -> list[str]:
        """What the user reads."""
        lines = []
        for each in self.adapters:
            text = each.get("text")
            lines.append(
                f"{each['header']:16} {each['function']:28} {each['status']:11} {each['kind']:8} {each['source']}".rstrip()
            )
            lines += [f"  {signature}" for signature in as_texts(each.get("signatures", [])) if not text]
            lines += [f"  {_HOW}" for _ in as_texts(each.get("signatures", [])) if each["status"] == "todo"]
            lines += [f"  limit: {limit}" for limit in as_texts(each["limits"])] if text is not None else []
            lines += ["", *str(text).split("\n"), ""] if text else []
        counted = [each for each in self.adapters if each["status"] in ("filled", "care")]
        if self.written:
            lines += [f"saved in {path}" for path in self.written]
        elif not any("text" in each for each in self.adapters):
            lines.append(f"{len(counted)} of {quantity(len(self.adapters), 'function')} have an adapter")
        return lines


def list_adapters(target: str | None = None, source: str | None = None) -> AdapterReport:
    """All functions of the headers that have adapter files, each with the status of its adapter.

    Args:
        target: name of the target; that of the project or the default if None.
        source: name of the source platform, likewise.
    """
    index, api, architecture = _of(target, source)
    rows: list[dict[str, Json]] = []
    for header in index.headers:
        known = _adapters(index, header, architecture)
        first = {piece.name: piece for piece in reversed(known)}
        rows += [_row(index, piece) for _, piece in sorted(first.items())]
        rows += [_row_without(index, header, name) for name in api.functions_of(header) if name not in first]
    return AdapterReport(rows)


def show_adapter(name: str, target: str | None = None, source: str | None = None) -> AdapterReport:
    """The adapters of a function with their texts, the effective one first; for a function without one, what has to be written.

    Raises:
        UsageError: the source platform has no function of that name.
    """
    index, api, architecture = _of(target, source)
    header, _, function = name.rpartition("/")
    pieces = [
        piece
        for each in ([header] if header else index.headers)
        for piece in _adapters(index, each, architecture)
        if piece.name == function
    ]
    if not pieces and (without := [h for h in ([header] if header else index.headers) if function in api.functions_of(h)]):
        return AdapterReport([_row_without(index, each, function) | _to_write(api, each, function) for each in without])
    if not pieces:
        known = {piece.name for each in index.headers for group in index.of(each) for piece in group if piece.kind == "adapter"}
        raise UsageError(
            f"unknown adapter '{name}'{did_you_mean(function, sorted(known))}", fix="list them: robosmi adapters list"
        )
    return AdapterReport([_row(index, piece) | _whole(index, piece) for piece in pieces])


def _of(target: str | None, source: str | None) -> tuple[AdapterIndex, ApiIndex, str]:
    """The adapter files, the source platform and the target's architecture that apply in the current folder."""
    settings = load_project(Path())
    facts = target_facts(target or settings.target or default_text("migrate", "target"))
    api = ApiIndex.load(source or settings.source_platform or default_text("migrate", "source_platform"))
    beside = settings.path.parent if settings.path is not None else None
    return adapter_index(facts.platform, api.name, beside=beside, language=facts.language), api, facts.architecture


def _adapters(index: AdapterIndex, header: str, architecture: str) -> list[AdapterPiece]:
    """The adapters of a header on an architecture, the effective one of each function first."""
    pieces = [piece for group in index.of(header) for piece in group if piece.kind == "adapter"]
    return [piece for piece in pieces if not piece.architectures or architecture in piece.architectures]


def _row(index: AdapterIndex, piece: AdapterPiece) -> dict[str, Json]:
    return {
        "function": piece.name, "header": piece.header, "kind": RELATIONS.get(piece.relation, ""), "source":
        index.owner_of(piece), "status": "care" if piece.limits else "filled", "limits": list(piece.limits),
    }  # fmt: skip


def _row_without(index: AdapterIndex, header: str, name: str) -> dict[str, Json]:
    """The table row of a function without an adapter."""
    reason = index.unsupported(header)
    state = "unsupported" if reason else "todo"
    return {"function": name, "header": header, "kind": "", "source": "", "status": state, "limits": [reason] if reason else []}


def _to_write(api: ApiIndex, header: str, name: str) -> dict[str, Json]:
    """The known facts about a function without an adapter."""
    return {
        "signatures": [api.signature(name, api.declared(header)[name])], "fidelity": "", "needs": [], "mcus": [],
        "architectures": [], "path": None, "line": None, "text": "",
    }  # fmt: skip


_FOREIGN = "leave it in the program, or write adapters/NAME.cpp by hand for the header NAME.h"


_PORT = "//# port: CONSTANT = LIBRARY.NAME NUMBER digital out"


def _whole(index: AdapterIndex, piece: AdapterPiece) -> dict[str, Json]:
    known = AdapterPieces(index)  # names are looked up, no variant is chosen
    needs = ["/".join(known.key(name, piece.header) or [name]) for name in piece.needs]
    return {
        "signatures": list(piece.signatures), "fidelity": piece.fidelity, "needs": needs, "mcus": list(piece.mcus),
        "architectures": list(piece.architectures), "path": piece.location.path, "line": piece.location.line,
        "text": piece.text,
    }  # fmt: skip


def save_adapters(output: Path, whose: str) -> AdapterReport:
    """Save the adapter bodies that the user wrote in a generated program.

    Args:
        output: the output folder of a migration.
        whose: `user` or `project`.

    Raises:
        SourceError: the folder has no plan, or there is no project file for `project`, or a link leads out of its folder.
        PlatformDataError: an adapter file that is there is wrong, or a body makes none or does not compile.
    """
    plan = stored_models(output).plan
    folder = _folder(output, whose)
    ending = ENDING_OF[str(plan.target.language) if plan.target is not None else "C++"]
    places, sketch = Places(output), str(plan.name)
    names = [f"{sketch}/{path.name}" for path in _sources(output / sketch)]
    texts = [read(places.read(name) or b"").text for name in names]
    found = {name: (body, text) for text in reversed(texts) for name, body in bodies(text).items() if not body.open}
    told, wanted = AdapterReport(), dict[tuple[str, str], migration.AdapterUse]()
    for use in plan.adapterUses:
        name = str(use.targetName or use.name)
        if use.adapter is not None or name not in found:
            continue
        header = ancestor_of_kind(use.function, platform.Header) if use.function is not None else None
        if header is None:
            message = f"'{use.name}' is not a function of a known header, so its body cannot be saved"
            told.findings.append(Finding("RS528", Severity.warning, message, Location(str(output)), fix=_FOREIGN))
            continue
        wanted[str(header.name), str(use.name)] = use
    files = _files(wanted, found, folder, ending, whose, plan)
    while files and (fault := fault_of_saved(files, wanted.keys(), folder, plan)) is not None:
        header_name, function, said = fault
        message, place = f"the body of '{function}' does not compile alone: {said}", Location(str(output))
        del wanted[header_name, function]
        outside = f"; put what it uses of the sketch into '{header_name.removesuffix('.h')}{ending}' as a helper"
        if pin := next((str(each.name) for each in plan.connections if f"'{each.name}'" in said), None):
            outside = f"; '{pin}' is a pin of this sketch; declare the adapter file's own constant, for example {_PORT}"
        if not wanted:
            fix = f"correct it in the sketch, or leave it there; nothing was saved{outside}"
            raise PlatformDataError(message, location=place, fix=fix)
        fix = f"correct it in the sketch and save again, or leave it there; it was not saved{outside}"
        told.findings.append(Finding("RS528", Severity.error, message, place, fix=fix))
        files = _files(wanted, found, folder, ending, whose, plan)
    told.adapters += [
        {
            "function": function,
            "header": header_name,
            "kind": RELATIONS["semantic"],
            "source": whose,
            "status": "filled",
            "limits": [],
        }
        for header_name, function in wanted
    ]
    for path, text in files.items():
        _refuse_links(path, whose)
        path.parent.mkdir(parents=True, exist_ok=True)
        before = inputs.read_text(path, inputs.DATA) if path.is_file() else ""
        if before.strip() and not text.startswith(before.rstrip()):  # another body of a function stands there
            kept = free_name(path.parent, f"{path.name}.orig")
            write_atomic(path.parent / kept, before.encode())
            message = f"the file had other bodies of the saved functions; the old file is now '{kept}'"
            told.findings.append(Finding("RS528", Severity.info, message, Location(str(path)), fix="copy back what you need"))
        write_atomic(path, text.encode())
    told.written = [str(path) for path in files]
    if not files and not told.findings:
        message = "the program has no body of yours"
        told.findings.append(
            Finding("RS528", Severity.info, message, Location(str(output)), fix="write one in adapters.h, then save it")
        )
    return told


def _files(
    wanted: Mapping[tuple[str, str], migration.AdapterUse],
    found: Mapping[str, tuple[Body, str]],
    folder: Path,
    ending: str,
    whose: str,
    plan: migration.MigrationPlan,
) -> dict[Path, str]:
    """The texts of the adapter files after adding some bodies.

    Args:
        wanted: header and function of each -> its use in the plan.
        found: name in the sketch -> its body, and the text that has it.
        folder: where the files go.
        ending: of their names.
        whose: `user` or `project`.
        plan: the plan of the program.
    """
    files: dict[Path, str] = {}
    for (header, _), use in wanted.items():
        path = folder / f"{header.removesuffix('.h')}{ending}"
        _refuse_links(path, whose)
        before = files[path] if path in files else _existing(path, header)
        files[path] = _with_piece(path, before, use, *found[str(use.targetName or use.name)], plan)
    for path, text in files.items():
        adapter_file(path, text)
    return files


def _pins(use: migration.AdapterUse, body: Body, plan: migration.MigrationPlan) -> list[str]:
    """The parameters that are pins, as text for the marker `pin`."""
    header = ancestor_of_kind(use.function, platform.Header) if use.function is not None else None
    if header is None or plan.source is None:
        return []
    facts = ApiIndex.of(plan.source).pins(str(use.name), str(header.name))
    names = parameters_of(body.text, body.name)
    return [
        f"{names[pin.position]} digital {pin.direction}"
        for pin in (facts.parameters if facts is not None else ())
        if pin.position < len(names) and names[pin.position] and pin.direction in DIRECTIONS
    ]


def _folder(output: Path, whose: str) -> Path:
    """The folder that the adapter files are written to.

    Raises:
        SourceError: there is no project file around the output folder or in the current one.
    """
    if whose == "user":
        return next(folder for folder, kept in own_folders(None).items() if kept == "user")
    near = [*output.resolve().parents, Path.cwd()]
    beside = next((folder for folder in near if (folder / FILE_NAME).is_file()), None)
    if beside is None:
        message = f"no {FILE_NAME} in the current folder or above the program"
        raise SourceError(
            message, location=Location(str(output)), fix=f"create an empty {FILE_NAME} next to the source, or use --as user"
        )
    return next(folder for folder, kept in own_folders(beside).items() if kept == "project")


def _refuse_links(path: Path, whose: str) -> None:
    """Make sure that nothing outside of a project is read or written as its adapter file; a user's own folder may be a link.

    Raises:
        SourceError: its folder lies outside of the project's, by a link, or the file is a link.
    """
    if whose == "project":
        Places(path.parent.parent, "project's folder").read(f"{path.parent.name}/{path.name}")


def _sources(sketch: Path) -> Iterable[Path]:
    """The texts of a generated program, the file of its adapters first."""
    paths = sorted(path for path in sketch.glob("*") if path.suffix in (".h", ".ino", ".c", ".cpp"))
    return sorted(paths, key=lambda path: path.name != ADAPTERS_FILE)


def _existing(path: Path, header: str) -> str:
    if path.is_file():
        return inputs.read_text(path, inputs.DATA)
    return f"{MARK} header {header}\n// Written by hand, for calls of functions of {header}.\n"


def _with_piece(path: Path, before: str, use: migration.AdapterUse, body: Body, text: str, plan: migration.MigrationPlan) -> str:
    """The text of an adapter file with a body added as a piece, or replacing the piece of the same name."""
    head = [f"{MARK} adapter {use.name}", f"{MARK}   for: {use.signature}", f"{MARK}   kind: semantic"]
    head += [f"{MARK}   name: {use.targetName}"] if use.targetName not in ("", use.name) else []
    words = set(body.code)
    pieces = list(plan.target.adapters) if plan.target is not None else []
    needs = {f"{p.sourceHeader}/{p.name}" for p in pieces if str(p.targetName or p.name) in words and p.name != use.name}
    head += [f"{MARK}   needs: {' '.join(sorted(needs))}"] if needs else []
    given = _INCLUDE.findall(text[: text.find(body.text)])
    shipped = {str(header) for piece in pieces for header in piece.includes}
    own = [
        header
        for header in dict.fromkeys(given)
        if header not in shipped and header.startswith("<") and "Arduino.h" not in header
    ]
    head += [f"{MARK}   include: {' '.join(own)}"] if own else []
    head += [f"{MARK}   pin: {pin}" for pin in _pins(use, body, plan)]
    head += [f"{MARK}   fidelity: written by hand for {plan.name}"]
    lines = [line for line in body.text.split("\n") if not line.startswith("//")]
    if not {"static", "inline"} & set(body.code[:2]):
        lines[0] = f"{'static inline' if path.suffix == ENDING_OF['C'] else 'inline'} {lines[0]}"
    piece = "\n".join([*head, *lines]) + "\n"
    known = next((each for each in adapter_file(path, before).pieces if each.name == use.name and not each.mcus), None)
    if known is None:
        return f"{before.rstrip()}\n\n{piece}"
    rows = before.split("\n")
    first = (known.location.line or 1) - 1
    last = next((n for n in range(first + 1, len(rows)) if re.match(rf"{re.escape(MARK)} \S", rows[n])), len(rows))
    return "\n".join([*rows[:first], *piece.split("\n"), *rows[last:]])
