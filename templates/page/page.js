// The page of a plan. All that it shows comes from the server as escaped text; it only sends what the user chooses, one after the other.
"use strict";
(() => {
  const body = document.body, by = id => document.getElementById(id), live = "live" in body.dataset;
  let waiting = Promise.resolve(), noticed = null; // the plan and settings that look() has told of

  function say(state, text) {
    by("status").dataset.state = state;
    by("status").textContent = text;
  }

  // ---- what the user chooses

  function what(about) {
    return "undo" in about ? "undo" : "tick" in about ? "the tick" : "rule" in about ? `${about.rule} of ${about.element}` : about.value ? `${about.id} = ${about.value}` : `${about.id} reopened`;
  }

  async function send(path, about) {
    let answer;
    try {
      const reply = await fetch(path, {
        method: "POST", headers: { "Content-Type": "application/json" }, cache: "no-store",
        body: JSON.stringify({ ...about, plan: body.dataset.plan, settings: body.dataset.settings }),
      });
      answer = await reply.json();
    } catch {
      say("offline", `Not saved: ${what(about)}. The server does not answer. The plan has all changes saved before. Run robosmi open again and continue on its new page.`);
      back(about);
      return;
    }
    if (answer.sections) show(answer);
    if (answer.state !== "saved") back(about);
    noticed = answer.state === "refused" ? `${answer.now} ${answer.settings ?? body.dataset.settings}` : null;
    say(answer.state, answer.state === "saved" && about.value && !answer.open ? `${answer.message} ${done()}` : answer.message);
  }

  function back(about) {
    if ("tick" in about) for (const box of document.querySelectorAll("[data-tick]")) if (box.dataset.tick === about.tick) box.checked = !about.done;
  }

  function show(answer) {
    const held = document.activeElement, choice = held && held.closest("[data-choice]");
    const key = choice ? [choice.dataset.choice, held.dataset.option] : null, y = choice ? held.getBoundingClientRect().top : 0;
    for (const [name, text] of Object.entries(answer.sections)) {
      if (typeof text === "string") by(name).innerHTML = text;
      else {
        const pieces = by(name).querySelectorAll("[data-piece]");
        for (const [at, part] of text) pieces[at].innerHTML = part;
      }
    }
    body.dataset.plan = answer.plan;
    body.dataset.settings = answer.settings;
    by("result").dataset.result = answer.result_state;
    by("result").textContent = `${answer.result}.`;
    by("progress").dataset.open = answer.open;
    by("progress").dataset.decided = answer.decided;
    by("progress").textContent = answer.progress;
    by("done").hidden = !answer.command && !answer.diff;
    by("command").textContent = answer.command;
    by("diff").textContent = answer.diff;
    if (key && !held.isConnected) { // what was just decided stays unfolded, and under the person's eyes
      const same = [...document.querySelectorAll("[data-option]")].find(
        b => b.dataset.option === key[1] && b.closest("[data-choice]").dataset.choice === key[0]);
      if (same) {
        const its = same.closest("details");
        if (its) its.open = true;
        same.focus({ preventScroll: true });
        scrollBy(0, same.getBoundingClientRect().top - y);
      }
    }
    pick(wire, false);
    enlarge();
  }

  function queue(path, about) {
    waiting = waiting.then(() => send(path, about));
  }

  // ---- the circuit: a wire, and the question that is about it

  let wire = "", full = false;

  function pick(pins, scroll = true) {
    const circuit = by("circuit"), wanted = pins.split(" ").filter(Boolean);
    wire = pins;
    if (!circuit) return;
    let first = null;
    for (const each of circuit.querySelectorAll("[data-pin]")) {
      const its = wanted.some(pin => each.dataset.pin.split(" ").includes(pin));
      each.classList.toggle("picked", its);
      if (its && !first && !each.classList.contains("hit")) first = each;
    }
    circuit.classList.toggle("picking", Boolean(first));
    for (const facts of by("wire-facts").children) facts.hidden = wanted.length !== 1 || facts.dataset.wire !== wanted[0];
    const known = wanted.length === 1 && [...by("wire").options].some(option => option.value === wanted[0]);
    by("wire").value = known ? wanted[0] : "";
    if (first && scroll) {
      const place = first.getBoundingClientRect(), frame = circuit.getBoundingClientRect();
      circuit.scrollBy(place.left + place.width / 2 - frame.left - frame.width / 2, place.top + place.height / 2 - frame.top - frame.height / 2);
    }
  }

  function enlarge() {
    const circuit = by("circuit");
    if (!circuit) return;
    circuit.classList.toggle("full", full);
    document.querySelector("[data-zoom]").setAttribute("aria-pressed", String(full));
    for (const each of circuit.querySelectorAll(".wire[data-pin]:not(.hit)")) { // a wire is thin: what is near it counts as it
      if (each.nextElementSibling && each.nextElementSibling.classList.contains("hit")) continue;
      const near = each.cloneNode(true);
      near.classList.add("hit");
      each.after(near);
    }
  }

  function done() {
    return `No open question. ${by("next-step") ? by("next-step").textContent : ""}`;
  }

  function nextOpen() {
    const all = [...document.querySelectorAll(".choice.open")], here = document.activeElement && document.activeElement.closest(".choice.open");
    const next = all[all.indexOf(here) + 1] || all[0];
    if (!next) {
      say("saved", done());
      return;
    }
    next.scrollIntoView({ block: "nearest" });
    next.querySelector("[data-option]").focus();
  }

  document.addEventListener("focusin", event => {
    const choice = event.target.closest("[data-choice]");
    if (choice) pick(event.target.dataset.pin || choice.dataset.pins);
  });

  // ---- on purpose

  function onPurpose(button) {
    const about = { rule: button.dataset.accept, element: button.dataset.element };
    if ("reason" in button.dataset) queue("accept", { ...about, reason: "" });
    else if (!button.nextElementSibling) {
      button.after(by("accept-form").content.cloneNode(true));
      const form = button.nextElementSibling;
      form.addEventListener("submit", event => {
        event.preventDefault();
        queue("accept", { ...about, reason: form.querySelector("input").value });
      });
      form.querySelector("input").focus();
    } else button.nextElementSibling.remove();
  }

  // ---- the other side of a line

  function linked(line) {
    for (const old of document.querySelectorAll(".linked")) old.classList.remove("linked");
    const others = line.dataset.to.split(" ").filter(Boolean).map(by).filter(Boolean);
    for (const each of [line, ...others]) each.classList.add("linked");
    if (others.length) others[0].scrollIntoView({ block: "nearest" });
    const places = others.map(o => `line ${o.id.split("-")[1]}`).join(", ");
    by("origin").textContent = `Line ${line.id.split("-")[1]}: ${line.dataset.why || "no decision"}${places ? "; counterpart: " + places : ""}`;
  }

  document.addEventListener("click", event => {
    const at = event.target.closest("[data-option], [data-undo], [data-next-open], [data-zoom], [data-accept], .choice, .code > div, #circuit [data-pin]");
    if (!at) return;
    if (at.closest("#circuit")) pick(at.dataset.pin.split(" ")[0], false);
    else if ("nextOpen" in at.dataset) nextOpen();
    else if ("zoom" in at.dataset) full = !full, enlarge();
    else if ("accept" in at.dataset) onPurpose(at);
    else if ("choice" in at.dataset) pick(at.dataset.pins);
    else if ("undo" in at.dataset) queue("undo", { undo: true });
    else if ("option" in at.dataset) queue("choose", { id: at.closest("[data-choice]").dataset.choice, value: at.dataset.option, why: by("why").value });
    else linked(at);
  });

  document.addEventListener("keydown", event => {
    if (event.altKey && event.code === "KeyN") {
      event.preventDefault();
      nextOpen();
      return;
    }
    const side = event.target.closest(".side");
    if (!side || !["ArrowUp", "ArrowDown"].includes(event.key) || event.target !== side) return;
    const lines = [...side.querySelectorAll(".code > div")], now = lines.findIndex(line => line.classList.contains("linked"));
    const next = lines[now + (event.key === "ArrowDown" ? 1 : -1)];
    if (next) {
      event.preventDefault();
      linked(next);
      next.scrollIntoView({ block: "nearest" });
    }
  });

  document.addEventListener("change", event => {
    if (event.target.id === "wire") pick(event.target.value);
    if (live && "tick" in event.target.dataset) queue("tick", { tick: event.target.dataset.tick, done: event.target.checked });
  });

  // ---- whether the server is there, and the plan is the one that is shown

  async function look() {
    const state = by("status").dataset.state;
    try {
      const now = await (await fetch("state", { cache: "no-store" })).json();
      const word = `${now.plan} ${now.settings}`;
      if (word === `${body.dataset.plan} ${body.dataset.settings}`) {
        if (state === "offline") say("saved", "The server answers again. All changes saved.");
        else if (noticed !== null && state === "stale") say("saved", "The plan matches this page again. All changes saved.");
        noticed = null;
      } else if (word !== noticed) {
        noticed = word;
        if (!now.plan) say("stale", "The plan is missing or not readable, so changes cannot be saved. Put it back, or run robosmi open on its new folder.");
        else if (state !== "stale") say("stale", `${now.plan === body.dataset.plan ? "robosmi.toml" : "The plan"} was changed elsewhere. Reload the page to see the changes.`);
      }
    } catch {
      if (state !== "offline") say("offline", "The server does not answer. The plan has all saved changes. To continue, run robosmi open again and use its new page.");
    }
  }

  if (live) setInterval(() => { waiting = waiting.then(look); }, 2000);
  enlarge();
  body.dataset.ready = "true";
})();
