"""The page of an output folder's plan: its sections as HTML, and the user's actions on it.

It edits only through `choose`, `undo` and `generate`, and reads only the output folder. Access and serving are handled by
`robosmi.report.page_server`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from robosmi import inputs, templates
from robosmi.base.data_text import Json
from robosmi.base.quantities import quantity
from robosmi.errors import RobosmiError, SourceError, StoppedError, UsageError
from robosmi.files.commit import update
from robosmi.files.files import digest
from robosmi.files.recovery import at_work
from robosmi.generate import Gen
from robosmi.generate.manifest import Manifest
from robosmi.generate.output_paths import Places
from robosmi.generate.undo import undo
from robosmi.metamodels import migration
from robosmi.model.elements.compact_slots import collector_at_rest
from robosmi.plugins import content
from robosmi.project import FILE_NAME, Accepted
from robosmi.transformations.chains.accept import accept, project_findings
from robosmi.transformations.chains.choose import STAYS, choose
from robosmi.transformations.chains.generate import generate
from robosmi.transformations.chains.stages.edited_plan import STORED
from robosmi.transformations.chains.stages.models import FOLDER, MigrationModels, stored_models
from robosmi.transformations.chains.stages.sources import project_folder
from robosmi.transformations.m2t import page_sections
from robosmi.transformations.m2t.first_screen import Counted, works
from robosmi.transformations.m2t.program_files import REPORT
from robosmi.transformations.m2t.task_list import PICTURE
from robosmi.transformations.queries.plans.choices import choices
from robosmi.transformations.queries.plans.plan import open_choices
from robosmi.transformations.queries.reports.work import Work
from robosmi.transformations.queries.reports.written_bodies import AS_BYTES, task_key, ticks, with_ticks
from robosmi.transformations.verification.judgement.stored_verdict import set_verdict, stored_verdict

SECTIONS = {
    "works": "What works", "wiring": "Circuit", "decide": "Decide", "write": "Write", "check": "Check", "watch": "Watch",
    "verdict": "Verdict", "code": "Code", "history": "History",
}  # fmt: skip
"""The sections in order, with their headings."""
_BESIDE = ("works", "wiring", "decide")
"""The first sections: on a wide screen the circuit stays beside the others."""
Row = tuple[str, ...]
"""The displayed form of a finding, or of a line of code."""
Rows = tuple[str, bool, tuple[Row, ...]]
"""Groups of rows that a browser lays out together, after the name of their section and whether the page is live."""
_CODE = (".ino", ".h", ".cpp", ".c")
_POLICY = "default-src 'none'; img-src data:; style-src 'nonce-{nonce}'; script-src 'nonce-{nonce}'; base-uri 'none'"
_KEPT = "RS512"
"""The rule for an edit of the sketch that was kept."""
_LONGEST = 300
"""Characters of a value or a reason that a page may send."""


class PlanPage:
    """The page of one output folder.

    Args:
        output: the folder.
        source: a source of the program, beside which robosmi.toml lies, where that is not known.
        engine: name of the simulator that runs the program; the first that is installed if None.
        shown: the names of the sections of the page.

    Attributes:
        plan: the digest of the plan that the sections were made of.
        settings: the digest of robosmi.toml at that time; empty if there was none.
        sections: name -> HTML.
        acceptable: rule and element of each finding that the user may say is on purpose.
    """

    def __init__(
        self, output: Path, source: Path | None = None, *, engine: str | None = None, shown: Sequence[str] = tuple(SECTIONS)
    ) -> None:
        self.output, self.source, self.shown = output, source, shown
        self._watched: Any = None
        self._engine = engine
        self.plan, self.settings, self.sections, self.facts = "", "", dict[str, str](), dict[str, Any]()
        self._held: MigrationModels | None = None
        self._project: Path | None = None
        self._templates = Gen(templates=_built_in())
        self._shown, self._rows = dict[Rows, str](), dict[Rows, str]()
        self.acceptable = set[tuple[str, str]]()

    def now(self) -> str:
        """The digest of the currently stored plan; empty if there is none."""
        try:
            data = Places(self.output).read(STORED)
            return digest(data) if data is not None else ""
        except RobosmiError:
            return ""

    def state(self) -> dict[str, str]:
        """The digests of the currently stored plan and of the current robosmi.toml."""
        return {"plan": self.now(), "settings": self._settings_now()}

    def _settings_now(self) -> str:
        try:
            return digest(inputs.read_bytes(self._project, inputs.SETTINGS)) if self._project is not None else ""
        except (OSError, RobosmiError):
            return ""

    def _is_current(self) -> bool:
        """Whether the sections show the stored plan, as the current robosmi.toml judges it."""
        return (self.plan, self.settings) == (self.now(), self._settings_now())

    def document(self, *, live: bool, nonce: str) -> str:
        """The page as a whole.

        Args:
            live: whether a server answers what is chosen on it.
            nonce: the word by which its style and script are told from any others.

        Raises:
            SourceError, ModelError: the plan cannot be read.
        """
        if not live or not self.sections or not self._is_current():
            self._make(stored_models(self.output), live=live)
        sections = [(name, SECTIONS[name], self.sections[name]) for name in self.shown]
        groups = [
            ("first", [each for each in sections if each[0] in _BESIDE]),
            ("others", [each for each in sections if each[0] not in _BESIDE]),
        ]
        return str(
            self._templates.text(
                "page.html.j2", live=live, decides="decide" in self.shown, plan=self.plan,
                settings=self.settings, head=_head(live, nonce),
                foot=_script(nonce), sections=sections, groups=groups, **self.facts,
            )
        )  # fmt: skip

    def act(self, what: str, about: Mapping[str, Json]) -> dict[str, Any]:
        """Do what the user asks for on the page.

        Args:
            what: `choose` (id, value, why), `undo`, `tick` (tick, done) or `accept` (rule, element, reason; an empty one takes it
                back), each with the digests of the plan and of robosmi.toml (settings) that the page shows.
            about: these values.

        Returns:
            `state` (saved, stale or refused), `message`, the digest of the plan as it is stored `now`, and the page as it
            now is: `plan`, `settings`, `sections` that have changed since the page was shown (as `changed` says), `open`,
            `decided`, `progress`, `result` with its `result_state`, `command` and `diff`.
        """
        before, shown = ((self.plan, self.settings), dict(self.sections)), str(about.get("plan", ""))
        settings = str(about.get("settings", self.settings))
        state, message, command, changes = "saved", "", "", ""
        try:
            with collector_at_rest():
                message, command, changes = self._do(what, about, shown)
        except StoppedError as error:
            state, message = "stale" if shown != self.now() else "refused", _told(error)
        except RobosmiError as error:
            state, message = "refused", _told(error)
        try:
            if (state, what) != ("saved", "choose") and not self._is_current():
                self._make(stored_models(self.output))
        except RobosmiError as error:
            return {"state": "refused", "message": _told(error), "now": self.now()}
        same = before[1] if (shown, settings) == before[0] else {}
        return {
            "state": state, "message": message, "plan": self.plan, "settings": self.settings, "now": self.plan,
            "command": command, "diff": changes,
            "sections": {
                name: changed(same[name], text) if name in same else text
                for name, text in self.sections.items() if same.get(name) != text and name in self.shown
            },
            **{name: self.facts[name] for name in ("open", "decided", "progress", "result_state", "result")},
        }  # fmt: skip

    def watch(self, about: Mapping[str, Json]) -> dict[str, Any]:
        """Run the original and the migrated program side by side; see `watch.WatchedFolder.answer`."""
        if self._watched is None:
            self._watched = content("chain", "watch")(self.output, self._engine)  # few pages run a program
        answer: dict[str, Any] = self._watched.answer(about)
        return answer

    def _do(self, what: str, about: Mapping[str, Json], shown: str) -> tuple[str, str, str]:
        """Perform the action; returns the message, the equivalent command, and the diff."""
        if what == "choose":
            identity, value, why = (str(about.get(name, "")) for name in ("id", "value", "why"))
            if not identity or max(len(identity), len(value), len(why)) > _LONGEST:
                raise UsageError("not a choice of this plan", fix="load the page again")
            read = partial(self._read, now=shown)
            done = choose(self.output, {identity: value}, why=why, source=self.source, seen=shown, read=read)
            done.models.settled = True
            self._make(done.models, known=done.counted)
            where = f" and in {done.updated_project}" if done.project is not None else ""
            told = [n.message for n in (*done.models.notes, *done.findings) if n.rule in (STAYS, _KEPT)]
            notes = "".join(f" {message[:1].upper()}{message[1:]}." for message in dict.fromkeys(told))
            now = f"= {value}" if value else "is open again"
            return f"Saved in the plan{where}: {identity} {now}.{notes}", done.command, done.diff
        if what == "accept":
            return self._accept(about, shown)
        with at_work(self.output):
            if self.now() != shown:
                raise StoppedError(
                    "the plan was changed elsewhere; nothing was done", fix="check the updated page, then try again"
                )
            if what == "undo":
                back = undo(self.output, 1, staying=STORED)  # undo, pressed again, takes back the run before
                files = quantity(len(back.restored) + len(back.removed), "file")
                return f"Undone: {'; '.join([*back.runs, f'{files} restored'])}.", f"robosmi undo {self.output} --steps 1", ""
            if what == "tick":
                self._tick(str(about.get("tick", "")), done=about.get("done") is True)
                return "Saved in the plan and in MIGRATION.md.", "", ""
        raise UsageError(f"unknown request '{what}'", fix="load the page again")

    def _accept(self, about: Mapping[str, Json], shown: str) -> tuple[str, str, str]:
        """Store that findings are on purpose, or that they are no longer."""
        accepted = Accepted(*(str(about.get(name, "")).strip() for name in ("rule", "element", "reason")))
        row = accepted.rule, accepted.element
        if max(map(len, (*row, accepted.reason))) > _LONGEST or row not in self.acceptable:
            raise UsageError("not a finding of this page", fix="load the page again")
        accept(self.output, accepted, source=self.source, seen=shown)
        self._make(stored_models(self.output))
        said = f"on purpose: {accepted.reason}" if accepted.reason else "no longer on purpose"
        which = f"every {accepted.rule}" if accepted.element == "*" else f"{accepted.rule} of {accepted.element}"
        return f"Saved in robosmi.toml: {which} is {said}.", "", ""

    def _read(self, folder: Path, now: str) -> MigrationModels:
        """The models of a folder whose plan has this digest; cached by the page while the files are unchanged."""
        held, self._held = self._held, None
        if held is None or self.plan != now:
            return stored_models(folder)
        places = Places(folder)
        if any(digest(places.read(f"{FOLDER}/{entry.path}") or b"") != entry.digest for entry in held.plan.inputs):
            return stored_models(folder)
        held.notes.clear()
        return held

    def _tick(self, key: str, *, done: bool) -> None:
        """Tick an item of the report's list for the bench, and record it in the plan."""
        models = stored_models(self.output)
        places, name = Places(self.output), f"{models.plan.name}/{REPORT}"
        text = (places.look(name) or b"").decode("utf-8", AS_BYTES)
        wanted = tuple(key.split(" ", 1))
        found = ticks(text)
        if all(tick.key != wanted for tick in found):
            raise StoppedError(f"{REPORT} no longer has this line", fix="generate again")
        ticked = {tick.key for tick in found if tick.done} - {wanted} | ({wanted} if done else set())
        update(self.output, {name: with_ticks(text, ticked).encode("utf-8", AS_BYTES)}, seen=places.seen)
        generate(self.output / STORED, self.output)

    def _make(self, models: MigrationModels, *, live: bool = True, known: Counted | None = None) -> None:
        """Render the sections of a stored plan; `known` are the counts of the run that stored it."""
        plan, files = models.plan, models.files
        self._held = models
        self._take_ticks(plan)
        texts = self._texts(plan.name)
        said = stored_verdict(self.output, plan.name)
        set_verdict(plan, said)
        drawn = Places(self.output).read(f"{FOLDER}/{PICTURE}") or b""
        picture = drawn.decode("utf-8", "replace") if said is not None and said.picture else ""
        place, _ = project_folder(self.output, plan, self.source)
        self._project = place / FILE_NAME if place is not None else None
        self.settings = self._settings_now()
        findings = project_findings(models, self.output, self.source)
        check = page_sections.check(plan, findings)
        self.acceptable = {(row[0], row[4]) for group in check["groups"] for chunk in group["chunks"] for row in chunk if row[4]}
        first = page_sections.works(plan, files, known, findings)
        values: dict[str, dict[str, Any]] = {
            "works": first,
            "decide": page_sections.decide(plan, files, str(self.output)),
            "write": page_sections.write(plan, texts),
            "check": check,
            "code": page_sections.side_by_side(plan, files, texts),
            "wiring": page_sections.wiring(plan, files, findings),
            "watch": {},
            "verdict": page_sections.verdict(plan, picture, models.places),
            "history": page_sections.history(plan),
        }
        self._shown, self._rows = self._rows, {}
        self.sections = {
            name: str(
                self._templates.text(
                    "section.html.j2",
                    name=name,
                    live=live,
                    output=str(self.output),
                    written=partial(self._written, live=live),
                    **given,
                )
            )
            for name, given in values.items()
        }
        left, total, work = len(open_choices(plan)), len(choices(plan)), Work(plan)
        calls = work.calls["total"]
        made = f"{total - left} of {total} decided, {left} open" if total else "No choices"
        ready = f"{work.working} of {calls} calls are ready" if calls else works(plan, work)
        self.facts = {
            "title": f"{plan.name}: moved to {plan.board.title if plan.board is not None else 'its target'}",
            "open": left, "decided": total - left,
            "progress": f"{made}; {ready}.",
            "result_state": first["state"], "result": first["result"],
        }  # fmt: skip
        self.plan = self.now()

    def _written(self, name: str, rows: Sequence[Row], *, live: bool) -> str:
        """The rows of a section as HTML, reusing the HTML of unchanged rows."""
        key = name, live, tuple(rows)
        text = self._shown.get(key) or str(self._templates.text("rows.html.j2", name=name, rows=rows, live=live))
        self._rows[key] = text
        return text

    def _take_ticks(self, plan: migration.MigrationPlan) -> None:
        """Mark tasks as done that are ticked in the current report, even if no run has processed it yet."""
        there = Places(self.output).read(f"{plan.name}/{REPORT}")
        listed = {tick.key: tick.done for tick in ticks((there or b"").decode("utf-8", AS_BYTES))}
        for task in (*plan.tasks, *plan.checks):
            task.done = listed.get(task_key(str(task.rule), str(task.message)), bool(task.done))

    def _texts(self, name: str) -> dict[str, str]:
        """The current files of the generated program."""
        places, listed = Places(self.output), Manifest.load(self.output).files
        mine = sorted(
            (n for n in listed if n.startswith(f"{name}/") and n.endswith(_CODE)), key=lambda n: (not n.endswith(".ino"), n)
        )
        return {n: data.decode("utf-8", "replace") for n in mine if (data := places.read(n)) is not None}


def changed(before: str, after: str) -> str | list[tuple[int, str]]:
    """The changed part of a section: its changed pieces by their indices, or the whole text if anything around them changed."""
    (around, inside), (new_around, new_inside) = _pieces(before), _pieces(after)
    if around != new_around:
        return after
    return [(at, new) for at, new in enumerate(new_inside) if new != inside[at]]


def _pieces(section: str) -> tuple[list[str], list[str]]:
    """Split a section into the text around its pieces and the content of each; displayed text contains no tags."""
    first, *rest = section.split("<div data-piece")
    around, inside = [first], list[str]()
    for piece in rest:
        tag, _, text = piece.partition(">")
        content, _, behind = text.partition("</div><!---->")
        around += [tag, behind]
        inside.append(content)
    return around, inside


def report_page(output: Path, nonce: str) -> str:
    """The page of an output folder for reading without a server.

    Raises:
        SourceError, ModelError: it holds no plan, or one that cannot be read.
    """
    if not (output / STORED).is_file():
        raise SourceError("this folder has no plan", fix="give the output folder of a migration")
    return PlanPage(output).document(live=False, nonce=nonce)


def _told(error: RobosmiError) -> str:
    place = f" (in {error.location})" if error.location is not None else ""
    return f"Not done: {error.message}{place}.{f' What to do: {error.fix}.' if error.fix else ''}"


def _built_in() -> dict[str, str]:
    """The built-in templates only: a template of the folder that the page is about is never run."""
    return {name: _text(name) for name in ("page.html.j2", "section.html.j2", "rows.html.j2")}


def _head(live: bool, nonce: str) -> str:
    """The page's style, and, for a page that is not served, the content security policy."""
    policy = f'<meta http-equiv="Content-Security-Policy" content="{_POLICY.format(nonce=nonce)}">'
    return f'{"" if live else policy}<style nonce="{nonce}">\n{_text("page.css")}</style>'


def _script(nonce: str) -> str:
    return f'<script nonce="{nonce}">\n{_text("page.js")}{_text("watch.js")}</script>'


def _text(name: str) -> str:
    return inputs.read_text(Path(templates.__file__).parent / "page" / name, inputs.DATA)
