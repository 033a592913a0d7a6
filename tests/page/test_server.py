"""The server of the page: it answers its own page on this machine and nobody else, and nothing beyond the folder is touched."""

from __future__ import annotations

import http.client
import json
import os
import re
import shutil
import socket
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack
from pathlib import Path
from threading import Thread
from typing import Any

import pytest

import robosmi
from robosmi.errors import UsageError
from robosmi.report import page_server
from robosmi.report.page_server import MOST, MOST_WAITING, PageServer
from robosmi.transformations.chains.page import PlanPage, changed
from tests.running import run, tree

PROGRAM = '#include "simpletools.h"\nint eye = 3;\nint main() { while (1) { high(eye); pause(5); } }\n'


@pytest.fixture
def out(restored: Callable[[str, Callable[[Path], None]], Path]) -> Path:
    """A migration of a small program."""

    def fill(folder: Path) -> None:
        (folder / "blink").mkdir()
        (folder / "blink" / "blink.c").write_text(PROGRAM)
        robosmi.migrate([folder / "blink" / "blink.c"], folder / "blink" / "out")

    return restored("page of blink", fill) / "blink" / "out"


@pytest.fixture
def server(out: Path) -> Iterator[PageServer]:
    """Its page, served."""
    made = PageServer(PlanPage(out))
    Thread(target=made.serve_forever, kwargs={"poll_interval": 0.02}, daemon=True).start()
    yield made
    made.shutdown()
    made.server_close()


def asked(
    server: PageServer, path: str, body: bytes | None = None, headers: Mapping[str, str] | None = None, method: str = ""
) -> tuple[int, dict[str, str], bytes]:
    """The answer to one request; it comes from the page itself unless the headers say otherwise."""
    connection = http.client.HTTPConnection("127.0.0.1", server.server_address[1], timeout=20)
    own = {"Origin": server.url.rpartition(f"/{server.token}")[0], "Content-Type": "application/json"} if body is not None else {}
    connection.request(method or ("POST" if body is not None else "GET"), path, body, {**own, **(headers or {})})
    reply = connection.getresponse()
    text = reply.read()
    connection.close()
    return reply.status, {name.lower(): value for name, value in reply.getheaders()}, text


def test_the_page_is_sent_with_a_policy_and_holds_no_address_of_another_host(server: PageServer) -> None:
    status, headers, text = asked(server, f"/{server.token}/")
    assert status == 200
    policy = headers["content-security-policy"]
    assert policy.startswith("default-src 'none'; script-src 'nonce-")
    assert "unsafe" not in policy
    assert policy.partition("nonce-")[2].partition("'")[0].encode() in text
    assert (headers["x-content-type-options"], headers["referrer-policy"]) == ("nosniff", "no-referrer")
    assert b"http://" not in text.replace(b"http://www.w3.org/", b"")
    assert b"https://" not in text


@pytest.mark.parametrize("path", ["/", "/state", "/x/", "/{token}", "//{token}x/", "/../{token}/"])
def test_without_the_word_in_the_address_there_is_nothing(path: str, server: PageServer) -> None:
    assert asked(server, path.format(token=server.token))[0] == 403


@pytest.mark.parametrize("path", ["choose", "../blink.c", "models/plan.xmi", "%2e%2e/blink.c", "page.js"])
def test_no_file_is_served(path: str, server: PageServer) -> None:
    status, _, text = asked(server, f"/{server.token}/{path}")
    assert status == 404
    assert b"simpletools" not in text


@pytest.mark.parametrize("host", ["evil.example", "127.0.0.1", "127.0.0.1:1", "evil.example:{port}", ""])
def test_a_request_to_another_host_is_refused(host: str, server: PageServer) -> None:
    headers = {"Host": host.format(port=server.server_address[1])}
    assert asked(server, f"/{server.token}/", headers=headers)[0] == 403
    assert asked(server, f"/{server.token}/state", headers=headers)[0] == 403
    assert asked(server, f"/{server.token}/undo", b"{}", headers)[0] == 403


@pytest.mark.parametrize("origin", ["http://evil.example", "null", "", "https://127.0.0.1:{port}", "http://127.0.0.1:1"])
def test_a_change_that_comes_from_elsewhere_is_refused(origin: str, server: PageServer, out: Path) -> None:
    before = tree(out)
    body = json.dumps({"id": "port:eye", "value": "D4", "plan": server.content.now()}).encode()
    headers = {"Origin": origin.format(port=server.server_address[1])}
    assert asked(server, f"/{server.token}/choose", body, headers)[0] == 403
    assert tree(out) == before


@pytest.mark.parametrize(
    ("body", "headers"),
    [
        (b"no json", {}),
        (b"[1]", {}),
        (b"[" * 40_000, {}),
        (b"{}", {"Content-Type": "text/plain"}),
        (b"{}", {"Content-Type": "application/x-www-form-urlencoded"}),
        (b"{}", {"Content-Length": "-1"}),
        (b"{}", {"Content-Length": "9" * 5000}),
        (b"x" * (MOST + 1), {}),
    ],
)
def test_a_request_of_another_form_is_refused(body: bytes, headers: dict[str, str], server: PageServer, out: Path) -> None:
    before = tree(out)
    assert asked(server, f"/{server.token}/choose", body, headers)[0] == 400
    assert tree(out) == before


@pytest.mark.parametrize(
    "about",
    [
        {"id": "port:eye", "value": "D99"},
        {"id": "port:nose", "value": "D4"},
        {"id": "port:eye", "value": "D4" * 1000},
        {"id": "port:eye", "value": "../../x"},
        {"id": ["port:eye"], "value": {"a": 1}},
        {},
    ],
)
def test_what_cannot_be_chosen_is_refused_with_a_reason(about: dict[str, Any], server: PageServer, out: Path) -> None:
    before = tree(out.parent)
    asked(server, f"/{server.token}/")
    body = json.dumps({**about, "plan": server.content.now()}).encode()
    status, _, text = asked(server, f"/{server.token}/choose", body)
    answer = json.loads(text)
    assert (status, answer["state"]) == (200, "refused")
    assert answer["message"].startswith("Not done: ")
    assert tree(out.parent) == before


@pytest.mark.parametrize("method", ["PUT", "DELETE", "OPTIONS", "PATCH"])
def test_there_are_no_other_methods(method: str, server: PageServer) -> None:
    assert asked(server, f"/{server.token}/", method=method)[0] == 501


def test_connections_that_send_nothing_do_not_pile_up(server: PageServer) -> None:
    place = ("127.0.0.1", server.server_address[1])
    with ExitStack() as open_sockets:
        idle = [open_sockets.enter_context(socket.create_connection(place, timeout=5)) for _ in range(MOST_WAITING + 8)]
        assert [each.recv(1) for each in idle[:8]] == [b""] * 8
        assert asked(server, f"/{server.token}/state")[0] == 200


@pytest.mark.parametrize("method", ["GET", "POST"])
def test_a_request_that_comes_byte_by_byte_is_ended(method: str, server: PageServer, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(page_server, "PATIENCE", 0.1)
    host = server.url.split("/")[2]
    head = f"{method} /{server.token}/undo HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\n"
    body = "Content-Type: application/json\r\nContent-Length: 9000\r\n\r\n" if method == "POST" else "X: "
    slow = socket.create_connection(("127.0.0.1", server.server_address[1]), timeout=20)
    slow.sendall((head + body).encode())
    end, ended = time.monotonic() + 5, False
    while not ended and time.monotonic() < end:
        time.sleep(0.01)
        try:
            slow.sendall(b"x")
        except OSError:
            ended = True
    slow.close()
    assert ended


def test_a_choice_changes_the_folder_and_the_project_file_and_nothing_else(server: PageServer, out: Path) -> None:
    beside = {name: data for name, data in tree(out.parent).items() if not name.startswith("out/")}
    body = json.dumps({"id": "port:eye", "value": "D4", "plan": server.content.now()}).encode()
    answer = json.loads(asked(server, f"/{server.token}/choose", body)[2])
    assert answer["state"] == "saved", answer["message"]
    after = {name: data for name, data in tree(out.parent).items() if not name.startswith("out/")}
    assert set(after) - set(beside) == {"robosmi.toml"}
    assert {name: after[name] for name in beside} == beside


def test_a_project_file_that_changes_is_another_state_and_is_shown_on_the_reloaded_page(server: PageServer, out: Path) -> None:
    page = asked(server, f"/{server.token}/")[2].decode()
    shown = dict(re.findall(r'data-(plan|settings)="([^"]*)"', page[page.index("<body") :]))
    assert json.loads(asked(server, f"/{server.token}/state")[2]) == shown
    (out.parent / "robosmi.toml").write_text('[[accept]]\nrule = "RS240"\nelement = "*"\nreason = "tiny"\n')
    now = json.loads(asked(server, f"/{server.token}/state")[2])
    assert now["plan"] == shown["plan"]
    assert now["settings"] not in ("", shown["settings"])
    assert f'data-settings="{now["settings"]}"' in asked(server, f"/{server.token}/")[2].decode()


def test_a_kept_edit_is_said_with_the_choice(out: Path) -> None:
    sketch = out / "blink" / "blink.ino"
    sketch.write_text(f"// mine\n{sketch.read_text()}")
    page = PlanPage(out)
    page.document(live=True, nonce="n")
    done = page.act("choose", {"id": "port:eye", "value": "D4", "plan": page.now()})
    assert done["state"] == "saved"
    assert " Your edit of the generated text is kept" in done["message"]
    assert sketch.read_text().startswith("// mine")


def test_what_is_said_of_a_choice_that_is_open_again(server: PageServer, out: Path) -> None:
    said = []
    for value in ("D4", ""):
        about = {"id": "port:eye", "value": value, "why": "", "plan": server.content.now()}
        said.append(json.loads(asked(server, f"/{server.token}/choose", json.dumps(about).encode())[2])["message"])
    project = out.parent / "robosmi.toml"
    assert said == [
        f"Saved in the plan and in {project}: port:eye = D4.",
        f"Saved in the plan and in {project}: port:eye is open again.",
    ]


@pytest.mark.parametrize(("why", "said"), [("", ""), ("seen on the board", ": seen on the board")])
def test_who_chose_is_said_once(why: str, said: str, out: Path) -> None:
    page = PlanPage(out)
    answer = page.act("choose", {"id": "port:eye", "value": "D4", "why": why, "plan": page.now()})
    assert answer["state"] == "saved", answer["message"]
    assert re.search(rf"Current: <strong>D4</strong>, decided by you on [-\w:]+{said}</p>", page.sections["decide"])
    texts = (*page.sections.values(), PlanPage(out).document(live=False, nonce="n"), (out / "blink" / "MIGRATION.md").read_text())
    assert not [text for text in texts if "chosen by a person" in text]


@pytest.mark.skipif(os.name == "nt", reason="links need rights there")
def test_a_link_in_the_folder_leads_to_no_text_from_elsewhere(out: Path, tmp_path: Path) -> None:
    (tmp_path / "secret").write_text("the secret")
    sketch = out / "blink" / "blink.ino"
    sketch.unlink()
    sketch.symlink_to(tmp_path / "secret")
    outcome = run("report", out, "-o", tmp_path / "report.html")
    assert outcome.code == 3
    assert not (tmp_path / "report.html").exists()


@pytest.mark.skipif(os.name == "nt", reason="links need rights there")
@pytest.mark.parametrize("what", ["the plan", "the models' folder", "the picture", "the record"])
def test_no_link_in_the_folder_shows_another_migration(what: str, out: Path, tmp_path: Path) -> None:
    other = out.parent / "other"
    shutil.copytree(out, other)
    names = {"the plan": "models/plan.xmi", "the models' folder": "models", "the picture": "models/verification.svg"}
    place = out / names.get(what, ".robosmi.json")
    if what == "the models' folder":
        shutil.rmtree(place)
    else:
        place.unlink(missing_ok=True)
    place.symlink_to(other / place.relative_to(out))
    outcome = run("report", out, "-o", tmp_path / "report.html")
    assert outcome.code == 3, outcome.err
    assert "link" in outcome.err
    assert run("open", out, "--no-browser", "--json").code == 3


def test_templates_in_the_folder_are_not_run(out: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (out / "templates" / "page").mkdir(parents=True)
    for name in ("page.html.j2", "section.html.j2"):
        (out / "templates" / "page" / name).write_text("taken over")
        (out / "templates" / name).write_text("taken over")
    monkeypatch.chdir(out)
    assert "taken over" not in PlanPage(out).document(live=True, nonce="n")


def test_a_port_in_use_is_said(server: PageServer, out: Path) -> None:
    with pytest.raises(UsageError, match="cannot be used"):
        PageServer(PlanPage(out), server.server_address[1])


def test_a_damaged_plan_is_said_on_the_page(server: PageServer, out: Path) -> None:
    (out / "models" / "plan.xmi").write_text("no plan")
    status, _, text = asked(server, f"/{server.token}/")
    assert status == 409
    assert b"plan.xmi" in text
    body = json.dumps({"id": "port:eye", "value": "D4", "plan": "x"}).encode()
    assert json.loads(asked(server, f"/{server.token}/choose", body)[2])["state"] in ("stale", "refused")


def test_two_requests_at_once_are_done_one_after_the_other(server: PageServer, out: Path) -> None:
    body = json.dumps({"id": "port:eye", "value": "D4", "plan": server.content.now()}).encode()
    states: list[str] = []
    ask = lambda: states.append(json.loads(asked(server, f"/{server.token}/choose", body)[2])["state"])  # noqa: E731
    threads = [Thread(target=ask) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert sorted(states) == ["saved", "stale", "stale"]


def test_two_robots_have_two_servers_and_each_keeps_its_own_choices(out: Path, tmp_path: Path) -> None:
    shutil.copytree(out.parent, tmp_path / "other", ignore=shutil.ignore_patterns("out"))
    robosmi.migrate([tmp_path / "other" / "blink.c"], tmp_path / "other" / "out")
    outs = {"D4": out, "D9": tmp_path / "other" / "out"}
    servers = {pin: PageServer(PlanPage(place)) for pin, place in outs.items()}
    answers: dict[str, Any] = {}

    def choose(pin: str) -> None:
        server = servers[pin]
        Thread(target=server.serve_forever, kwargs={"poll_interval": 0.02}, daemon=True).start()
        about = {"id": "port:eye", "value": pin, "plan": server.content.now()}
        answers[pin] = json.loads(asked(server, f"/{server.token}/choose", json.dumps(about).encode())[2])

    threads = [Thread(target=choose, args=(pin,)) for pin in servers]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert {pin: answer["state"] for pin, answer in answers.items()} == {"D4": "saved", "D9": "saved"}
    for pin, place in outs.items():
        assert f'eye = "{pin}"' in (place.parent / "robosmi.toml").read_text()
        assert asked(servers[pin], f"/{next(s for p, s in servers.items() if p != pin).token}/")[0] == 403
        servers[pin].shutdown()
        servers[pin].server_close()


def test_choices_of_one_page_make_the_folder_that_choices_of_many_make(out: Path, tmp_path: Path) -> None:
    shutil.copytree(out.parent, tmp_path / "copy")
    copy, page = tmp_path / "copy" / "out", PlanPage(out)
    for at, value in enumerate(["D4", "D9", "", "none", "D9"]):
        for each in (page, PlanPage(copy)):
            about = {"id": "port:eye", "value": value, "why": f"try {at}", "plan": each.now()}
            assert each.act("choose", about)["state"] == "saved"
        assert plain(out) == plain(copy)
        fresh = PlanPage(out)
        fresh.document(live=True, nonce="n")
        assert fresh.sections == page.sections
    (out / "models" / "code.xmi").write_bytes((out / "models" / "code.xmi").read_bytes() + b"\n")
    answer = page.act("choose", {"id": "port:eye", "value": "D4", "plan": page.now()})
    assert (answer["state"], "digest" in answer["message"]) == ("refused", True)


def test_of_a_section_only_the_pieces_that_changed_are_sent() -> None:
    section = '<h2>{}</h2><div data-piece class="chunk">\n<div>{}</div>\n</div><!---->\n<div data-piece>b</div><!---->\n'
    assert changed(section.format("t", "a"), section.format("t", "&lt;div data-piece&gt;")) == [
        (0, "\n<div>&lt;div data-piece&gt;</div>\n")
    ]
    assert changed(section.format("t", "a"), section.format("u", "a")) == section.format("u", "a")
    assert changed(section.format("t", "a"), "none") == "none"


def plain(out: Path) -> dict[str, str]:
    """The files of a folder, without time stamps and what depends on them."""
    times = re.compile(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ")
    return {path.name: times.sub("", path.read_text("utf-8")) for path in (out / "models").iterdir() if path.is_file()} | {
        path.name: path.read_text("utf-8") for path in (out / "blink").iterdir()
    }


@pytest.mark.skipif(os.name == "nt", reason="links need rights there")
@pytest.mark.parametrize(
    ("linked", "words"),
    [
        *((linked, ["choose", "OUT", "eye=D4"]) for linked in ("models", "models/plan.xmi", "blink", "blink/blink.ino")),
        *((linked, ["wiring", "OUT", "--as", "csv", "-o", "made.csv"]) for linked in ("models", "models/plan.xmi")),
    ],
)
def test_no_command_follows_a_link_out_of_the_folder(
    words: list[str], linked: str, out: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (out / linked).rename(tmp_path / "outside")
    (out / linked).symlink_to(tmp_path / "outside")
    before = tree(tmp_path / "outside") if (tmp_path / "outside").is_dir() else (tmp_path / "outside").read_bytes()
    outcome = run(*[out if word == "OUT" else word for word in words])
    assert outcome.code == 3, outcome.err
    assert (tree(tmp_path / "outside") if (tmp_path / "outside").is_dir() else (tmp_path / "outside").read_bytes()) == before
    assert (out / linked).is_symlink()
    assert "link" in outcome.err
    assert not (tmp_path / "made.csv").exists()
    assert not (out.parent / "robosmi.toml").exists()


def test_a_page_with_nothing_on_it_says_so(out: Path, tmp_path: Path) -> None:
    text = PlanPage(out).document(live=False, nonce="n")
    assert text.count("No drawing given: this is what the program uses, by the names of its ports. With a drawing") == 1
    (tmp_path / "nothing.c").write_text("int main() { return 0; }\n")
    robosmi.migrate([tmp_path / "nothing.c"], tmp_path / "empty")
    text = PlanPage(tmp_path / "empty").document(live=False, nonce="n")
    assert "No choices; the program calls no platform function." in text
    assert "No decisions yet." in text
    assert "0 of 0" not in text


@pytest.mark.parametrize(("parts", "lazily"), [(41, True), (5, False)])
def test_a_browser_lays_out_a_long_list_where_it_is_seen(out: Path, tmp_path: Path, parts: int, lazily: bool) -> None:
    table = tmp_path / "pins.csv"
    table.write_text("pin,part,title\n" + "".join(f"D{number % 10 + 2},Gizmo,gizmo {number}\n" for number in range(parts)))
    robosmi.migrate([out.parent / "blink.c"], out, hardware=table)
    text = PlanPage(out).document(live=True, nonce="n")
    assert text.count('data-choice="role') == parts
    assert bool(re.search(r'class="choices[^"]* many\b', text)) == lazily
    assert ".many > .choice { content-visibility: auto" in text
