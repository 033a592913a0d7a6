"""The shipped index: what the paper and our measurement of it say must come out again; look-up of libraries; speed."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from robosmi.errors import PlatformDataError, UsageError
from robosmi.recommend.component import ComponentQuery
from robosmi.recommend.index import LibraryIndex
from robosmi.recommend.ranking import Recommendation
from robosmi.recommend.tfidf import Postings, score_headers, words
from robosmi.transformations.knowledge.libraries import library_ranking, library_ranking as device_knowledge
from robosmi.transformations.knowledge.libraries.library_ranking import (
    device_ranker,
    libraries_by_header,
    library_by_name,
    library_index,
    tfidf_ranker,
)
from tests.recommend.labelled import Labelled

SERVO = "Basic Servo"
DHT = "DHT22 Temperature and Humidity Sensor"
PAPER_LIBRARIES = {  # bundled with the IDE of the paper's time, and the one for the DHT
    *("EEPROM", "Esplora", "Ethernet", "Firmata", "GSM", "LiquidCrystal", "Robot_Control", "Robot_Motor", "SD", "SPI", "Servo"),
    *("SoftwareSerial", "Stepper", "TFT", "WiFi", "Wire", "DHT sensor library"),
}


def _paper(query: ComponentQuery) -> Recommendation:
    return tfidf_ranker().rank(query)


class _Some:
    """A part of the headers of an index as a collection of its own."""

    def __init__(self, index: LibraryIndex, headers: set[int]) -> None:
        self.index, self.headers, self.documents = index, headers, len(headers)

    def postings(self, term: str) -> Postings:
        pairs = [pair for pair in zip(*self.index.postings(term), strict=True) if pair[0] in self.headers]
        return [header for header, _ in pairs], [tf for _, tf in pairs]


@pytest.mark.parametrize(
    ("title", "library", "file", "rank"), [(SERVO, "Servo", "Servo.h", 4), (DHT, "DHT sensor library", "DHT.h", 38)]
)
def test_rank_of_the_papers_headers_among_the_1739(title: str, library: str, file: str, rank: int) -> None:
    index = library_index()
    headers = [index.header(number) for number in range(index.documents)]
    paper = {index.names().index(name) for name in PAPER_LIBRARIES}
    fixed = {header.id for header in headers if header.library in paper}
    files = {headers[number].file.lower() for number in fixed}
    rest = {h.id for h in headers if h.library not in paper and h.main and h.file.lower() not in files}
    assert (len(fixed), len(rest)) == (85, 1654)
    scores = score_headers(_Some(index, fixed | rest), words(title))
    own = next(h.id for h in headers if h.file == file and index.library(h.library).name == library)
    assert 1 + sum(score > scores[own] for score in scores.values()) == rank


@pytest.mark.parametrize(("title", "library", "rank"), [(SERVO, "Servo", 7), (DHT, "DHT sensor library", 10)])
def test_rank_of_the_papers_libraries_among_the_1609(title: str, library: str, rank: int) -> None:
    candidates = _paper(ComponentQuery("1", title)).candidates
    assert [candidate.library for candidate in candidates].index(library) + 1 == rank
    assert next(c.header for c in candidates if c.library == library) == library.split()[0] + ".h"


def test_firmata_goes_before_servo_because_of_boards_h() -> None:
    """The paper's own failure (section 5): Servo.h only second, behind Firmata's Boards.h."""
    candidates = _paper(ComponentQuery("1", SERVO)).candidates
    firmata = next(number for number, candidate in enumerate(candidates) if candidate.library == "Firmata")
    assert firmata < 6
    assert "in Boards.h" in candidates[firmata].reasons[0]
    assert candidates[firmata].header == "Firmata.h"


def test_figures_of_the_papers_formula(data: Labelled) -> None:
    """An independent implementation over title words gave top-1 .663 (63 of 95), top-5 .832, MRR .734, nDCG@5 .547.

    Top-1 is .684 here: two queries of 95 more, one of them by the order of ties (.674 with ties in the order of the
    facts). Its abstention had a tuned threshold; the paper has none, so that is not compared.
    """
    figures = data.score([_paper(query) for query in data.components])
    assert figures["top5"] == pytest.approx(0.832, abs=0.001)
    assert figures["top1"] == pytest.approx(0.684, abs=0.001)
    assert figures["top1"] == pytest.approx(63 / 95, abs=2.01 / 95)
    assert figures["mrr"] == pytest.approx(0.734, abs=0.02)
    assert figures["ndcg5"] == pytest.approx(0.547, abs=0.02)


def test_library_by_name() -> None:
    servo = library_by_name("Servo")
    assert (servo.name, servo.header, servo.depends, servo.unknown) == ("Servo", "Servo.h", (), ())
    assert servo.version
    assert "avr" in servo.architectures
    assert library_by_name("servo").name == "Servo"
    dht = library_by_name("DHT sensor library")
    assert (dht.header, dht.depends) == ("DHT.h", ("Adafruit Unified Sensor",))


@pytest.mark.parametrize(("name", "hint"), [("Servoo", "did you mean 'Servo'?"), ("DHT.h", "belongs to 'DHT sensor library'")])
def test_unknown_library(name: str, hint: str) -> None:
    with pytest.raises(UsageError) as caught:
        library_by_name(name)
    assert hint in caught.value.message


def test_libraries_by_header() -> None:
    assert libraries_by_header("Servo.h")[0].name == "Servo"
    assert libraries_by_header("nothing.h") == ()
    found = libraries_by_header("DHT.h")
    assert found[0].name == "DHT sensor library"
    assert len(found) == len({library.name for library in found}) > 1


@pytest.fixture
def own_project(tiny: LibraryIndex, tmp_path: Path) -> Path:
    """A project folder with an index of its own."""
    folder = tmp_path / "project/.robosmi/platform_repo/arduino/libraries"
    folder.mkdir(parents=True)
    shutil.copy(tiny.path, folder / "index.sqlite")
    return tmp_path / "project"


def test_dependencies_are_closed_and_rings_end(own_project: Path) -> None:
    kit = library_by_name("Motor Kit", project=own_project)
    assert [library.name for library in kit.dependencies] == ["Base", "Base Sensor"]
    assert kit.unknown == ("Nowhere",)
    assert kit.depends == ("Base", "Base Sensor", "Nowhere")


def test_a_project_brings_its_own_index(own_project: Path, tiny_facts: Path) -> None:
    query = ComponentQuery("1", "twin")
    ranked = device_ranker(project=own_project).rank(query)
    assert {c.library for c in ranked.candidates} == set(library_index(project=own_project).names())
    assert len(tfidf_ranker(project=own_project).rank(query).candidates) == 3
    assert library_index(project=own_project) is library_index(project=own_project)
    path = own_project / ".robosmi/platform_repo/arduino/libraries/index.sqlite"
    before = library_index(project=own_project)
    os.utime(path, ns=(1, 1))
    assert library_index(project=own_project) is not before, "a file that changed is opened anew"
    with pytest.raises(PlatformDataError, match="no 'other/libraries"):
        library_index("other", own_project)


def _best_ms(work: Callable[[], object], times: int = 7) -> float:
    def once() -> float:
        start = time.process_time()
        work()
        return (time.process_time() - start) * 1000

    return min(once() for _ in range(times))


def test_times_within_the_budget() -> None:
    """Opened in 60 ms, asked in 15 ms (processor time, best of some runs: other work may be on this machine)."""
    titles = [SERVO, "QTI Sensor", "LCD screen", DHT, "Motor Driver 1A Dual TB6612FNG"]
    queries = [ComponentQuery(str(n), title) for n, title in enumerate(titles)]

    def opened() -> None:
        library_ranking._opened.cache_clear()
        library_ranking._device_ranker.cache_clear()
        device_knowledge._knowledge.cache_clear()
        device_ranker(architecture="avr")

    def asked() -> None:
        library_ranking._device_ranker.cache_clear()
        ranker = device_ranker(architecture="avr")
        for query in queries:
            ranker.rank(query, limit=10)

    assert _best_ms(opened) < 60
    assert _best_ms(asked) < 15 * len(queries)


def test_ranking_is_not_imported_before_it_is_wanted() -> None:
    code = "import robosmi, robosmi.recommend, robosmi.recommend.history, sys; print('sqlite3' in sys.modules)"
    root = Path(__file__).resolve().parents[2]
    done = subprocess.run([sys.executable, "-c", code], cwd=root, capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"


def test_a_library_of_a_persons_own_table_that_the_index_lacks_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    table = tmp_path / ".robosmi" / "platform_repo" / library_ranking.default_library_platform() / device_knowledge.USUAL
    table.parent.mkdir(parents=True)
    monkeypatch.chdir(tmp_path)
    table.write_text("device,libraries\nlamp,Servo\nbadge,Servo|Servoo\n")
    with pytest.raises(PlatformDataError, match=r"the index has no library 'Servoo' \(did you mean 'Servo'\?\)") as told:
        device_ranker()
    assert told.value.location is not None
    assert (told.value.location.path, told.value.location.line) == (str(table), 3)
    table.write_text("device,libraries\nlamp,Servo\n")
    assert device_ranker().knowledge.usual["lamp"] == ("Servo",)
