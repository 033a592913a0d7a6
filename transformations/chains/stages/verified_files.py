"""The files that a verification writes: new scenarios and a picture beside the models, and a requested trace.

A file that cannot be written, as on a full disk, costs nothing of the verdict: it is reported as a finding.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from msgspec.structs import replace

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import SourceError, StoppedError
from robosmi.files.files import refuse_link, write_atomic
from robosmi.files.run_lock import alone
from robosmi.transformations.verification.judgement.scenario_verdicts import ComparedScenario
from robosmi.transformations.verification.judgement.stored_verdict import StoredVerdict
from robosmi.transformations.verification.search.stored_search import FILE, StoredSearch, scenarios_digest
from robosmi.verify.scenario import Scenario, read_scenario
from robosmi.verify.simulation import PinTrace
from robosmi.verify.traces.trace_picture import trace_svg
from robosmi.verify.traces.vcd import vcd_text
from robosmi.verify.traces.verdict import SearchEnd

UNWRITTEN = "RS902"
"""The rule of a file that cannot be written."""
_MAKE_ROOM = "free space there, or make the folder writable, then run again"


class VerifiedFiles:
    """What a verification has written, and what it could not write.

    Attributes:
        written: path and kind of each file.
        lost: a finding for each kind of file that cannot be written.
    """

    def __init__(self) -> None:
        self.written: list[tuple[Path, str]] = []
        self.lost: list[Finding] = []

    def store_scenarios(self, scenarios: Sequence[Scenario], folder: Path) -> None:
        """Write each new scenario to a file beside the models, but for those that another run has stored meanwhile."""
        if scenarios:
            self._attempt("the scenarios cannot be stored", folder, _MAKE_ROOM, lambda: self._scenarios(scenarios, folder))

    def store_search(self, search: str, racy: int, racy_counts: Sequence[bytes], folder: Path, told: SearchEnd) -> None:
        """Write what a search came to beside its scenarios; the arguments are those of `StoredSearch`."""
        self._attempt(
            "the record of the search cannot be stored", folder / FILE, _MAKE_ROOM,
            lambda: self._search(search, racy, racy_counts, folder, told),
        )  # fmt: skip

    def _search(self, search: str, racy: int, racy_counts: Sequence[bytes], folder: Path, told: SearchEnd) -> None:
        with alone(folder.parent.parent):
            stored = sorted(folder.glob("*.toml"))
            if stored:
                record = StoredSearch(search, scenarios_digest(stored), racy, sorted(set(racy_counts)), told)
                self._write(folder / FILE, record.text(), "search")

    def _scenarios(self, scenarios: Sequence[Scenario], folder: Path) -> None:
        with alone(folder.parent.parent):
            stored = {_played(read_scenario(path)) for path in folder.glob("*.toml")}
            for scenario in scenarios:
                if _played(scenario) in stored:
                    continue
                number = 1
                while (path := folder / f"generated_{number:02}.toml").exists():
                    number += 1
                folder.mkdir(exist_ok=True)
                self._write(path, scenario.text(), "scenario")

    def store_verdict(self, path: Path, record: StoredVerdict) -> None:
        """Write the record of the verdict beside the models."""
        self._attempt("the verdict cannot be stored", path, _MAKE_ROOM, lambda: self._replace(path, record.to_bytes()))

    def write_picture(self, path: Path, shown: ComparedScenario) -> None:
        """Draw both sides of a scenario into a picture beside the models."""
        told = shown.told
        pairs = {name: (seen[0][0], shown.target[name]) for name, seen in shown.runs.channels.items() if name in shown.target}
        difference = None if told.first is None else (told.first.at_ms, told.first.channel, told.first.message)
        title = f"{told.scenario.name}: {told.verdict.replace('-', ' ')}"
        text = trace_svg(title, pairs, told.scenario.horizon_ms, difference)
        self._attempt("the picture cannot be stored", path, _MAKE_ROOM, lambda: self._write(path, text, "picture"))

    def write_vcd(self, path: Path, name: str, source: PinTrace, target: PinTrace) -> None:
        """Write the traces of both sides of a scenario.

        Args:
            path: the file.
            name: the scenario's name.
            source: what the original did.
            target: what the migrated program did.
        """
        text = vcd_text({"source": source, "target": target}, name)
        self._attempt("the trace cannot be written", path, "give another file", lambda: self._write(path, text, "vcd"))

    def _write(self, path: Path, text: str, kind: str) -> None:
        self._replace(path, text.encode())
        self.written.append((path, kind))

    def _replace(self, path: Path, data: bytes) -> None:
        refuse_link(path)
        write_atomic(path, data)

    def _attempt(self, what: str, path: Path, fix: str, write: Callable[[], None]) -> None:
        try:
            write()
        except OSError as error:
            self._lose(f"{what}: {error.strerror or error}", Location(str(path)), fix)
        except (SourceError, StoppedError) as error:
            self._lose(f"{what}: {error.message}", error.location or Location(str(path)), fix)

    def _lose(self, message: str, place: Location, fix: str) -> None:
        self.lost.append(Finding(UNWRITTEN, Severity.error, message, place, fix=fix))


def _played(scenario: Scenario) -> str:
    """What happens in a scenario, whatever it is called."""
    return replace(scenario, name="").text()
