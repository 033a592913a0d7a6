"""The chain `targets`: what programs can be moved to, and what a result for each target is proven by on this machine.

Nothing is compiled or run. A target is proven by what RoboSMi can do with its programs: run them on a simulated microcontroller,
run them on this computer with a model of the Arduino API, compile them, or neither.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from robosmi.base.data_text import Json
from robosmi.base.trust import acting
from robosmi.errors import RobosmiError
from robosmi.plugins import content
from robosmi.transformations.knowledge.board_models import not_simulated
from robosmi.transformations.knowledge.platforms.target_platform import TargetFacts, target_facts, target_names
from robosmi.transformations.verification.jobs import api_facts
from robosmi.verify.simulation import Engine, engine_names
from robosmi.verify.toolchains.recipes import InstalledBoard
from robosmi.verify.toolchains.toolchain_data import Toolchain, load_toolchains
from robosmi.verify.toolchains.tools import find_installed

AT_THE_PINS, COMPILED_ONLY, NOT_COMPILED = "simulated at the pins", "compiled only", "not compiled here"
COMPILED_AT_API, AT_API = "compiled, judged at the Arduino API", "judged at the Arduino API, not compiled here"
"""What a target is proven by. The strongest is at the pins; the two at the API come next; the first: programs compile."""
PROOFS = {AT_THE_PINS: "simulated", COMPILED_AT_API: "api", AT_API: "api", COMPILED_ONLY: "compiled", NOT_COMPILED: "none"}
"""The same in one word, for programs."""


class KnownTarget(NamedTuple):
    """A target.

    Attributes:
        name, title: its name, and that of its board.
        proven_by: one of the texts above.
        core: `installed`, `stand-in` or `missing`: what programs for it are compiled with.
        engine: the installed simulator that runs its programs; None if none does.
        missing: what to install for a stronger proof; empty if nothing is known.
        full_name: of its board in the platform's tools; empty if it has none.
        not_simulated: what of the board no simulator has; empty for nothing of note.
    """

    name: str
    title: str
    proven_by: str
    core: str
    engine: str | None
    missing: str
    full_name: str = ""
    not_simulated: str = ""

    def to_json(self) -> dict[str, Json]:
        """The contract's form."""
        return {
            "name": self.name, "board": self.title, "proven_by": self.proven_by, "core": self.core, "engine": self.engine,
            "missing": [self.missing] if self.missing else [], "title": self.title, "fqbn": self.full_name or None,
            "proof": PROOFS[self.proven_by], "installed": self.core == "installed", "not_simulated": self.not_simulated or None,
        }  # fmt: skip


class TargetTable(NamedTuple):
    """All targets."""

    known: Sequence[KnownTarget]

    @property
    def result(self) -> dict[str, Any]:
        """The contract's part of the document."""
        return {"targets": [target.to_json() for target in self.known]}

    def lines(self) -> list[str]:
        """The text for the user."""
        width = max((len(target.name) for target in self.known), default=0)
        titles = max((len(target.title) for target in self.known), default=0)
        found = []
        for target in self.known:
            with_what = "stand-in for the core" if target.core == "stand-in" else ""
            engine = target.engine if target.proven_by == AT_THE_PINS else ""
            more = ", ".join(filter(None, (engine, with_what)))
            found.append(f"{target.name:{width}}  {target.title:{titles}}  {target.proven_by}{f' ({more})' if more else ''}")
            if target.not_simulated and target.proven_by == AT_THE_PINS:
                found.append(f"{'':{width}}  not simulated: {target.not_simulated}")
            if target.missing and target.proven_by != AT_THE_PINS:
                found.append(f"{'':{width}}  do: {target.missing}")
        return found


def targets(project: Path | None = None) -> TargetTable:
    """All targets of a project, by name.

    Args:
        project: the project folder; the current folder if None.

    Raises:
        PlatformDataError: the repository's data is damaged.
        SourceError: found data that names programs is not trusted.
    """
    with acting(project):  # tools are asked for their versions
        return _table(project)


def _table(project: Path | None) -> TargetTable:
    toolchains = {toolchain.name: toolchain for toolchain in load_toolchains(project)}
    tools = {name: _tools(toolchain) for name, toolchain in toolchains.items()}
    engines: list[Engine] = [content("engine", name)() for name in engine_names()]
    facts = [target_facts(name, project) for name in target_names(project)]
    return TargetTable(
        [
            _known(each, toolchains, tools, engines)._replace(
                full_name=next(iter(_full_names(each)), ""), not_simulated=not_simulated(each.board, project)
            )
            for each in facts
        ]
    )


def _full_names(facts: TargetFacts) -> tuple[str, ...]:
    """The names of a target's board in the platform's tools, the preferred one first."""
    made = facts.model.platform
    mapping = next((each for each in made.boardMappings if each.board is facts.board_model), None) if made is not None else None
    return tuple(str(name) for name in (mapping.boardId, *mapping.otherIds) if name) if mapping is not None else ()


def _tools(toolchain: Toolchain) -> str:
    """What to install for a toolchain to compile; empty if it can."""
    try:
        find_installed(toolchain)
    except RobosmiError as error:
        return str(error.fix or error.message)
    return ""


def _known(facts: TargetFacts, toolchains: dict[str, Toolchain], tools: dict[str, str], engines: Sequence[Engine]) -> KnownTarget:
    model, board = facts.model, facts.board_model
    toolchain = toolchains.get(str(model.toolchain.name)) if model.toolchain is not None else None
    core, missing = "missing", ""
    if toolchain is not None and toolchain.architecture == facts.architecture:
        missing = tools[toolchain.name]
        core = "missing" if missing else "installed"
    elif toolchain is not None:
        core, missing = _of_its_core(facts, toolchain)
    mcu = str(board.microcontroller.name) if board.microcontroller is not None else ""
    serving = [engine for engine in engines if engine.serves(mcu)]
    ready = next((engine.name for engine in serving if engine.missing() is None), None)
    if ready is not None and api_facts(mcu) is not None:
        return KnownTarget(facts.target, str(board.title), AT_API if core == "missing" else COMPILED_AT_API, core, ready, missing)
    if core == "missing":
        return KnownTarget(facts.target, str(board.title), NOT_COMPILED, core, None, missing)
    if ready is None:
        advice = "; or ".join(str(engine.missing()) for engine in serving)
        return KnownTarget(facts.target, str(board.title), COMPILED_ONLY, core, None, advice)
    return KnownTarget(facts.target, str(board.title), AT_THE_PINS, core, ready, missing)


def _of_its_core(facts: TargetFacts, toolchain: Toolchain) -> tuple[str, str]:
    """What builds programs for a board by its own core, and what to install."""
    try:
        found: InstalledBoard | None = content("query", "installed_board")(_full_names(facts), toolchain)
    except RobosmiError as error:
        return "missing", str(error.fix or error.message)
    if found is None:
        return "missing", ""
    return ("stand-in", found.install) if found.stand_in else ("installed", "")
