// The page of a plan. All that it shows comes from the server as escaped text; it only sends what a person chooses, one after the other.
"use strict";
(() => {
  const body = document.body, by = id => document.getElementById(id), live = "live" in body.dataset;
  let waiting = Promise.resolve(), noticed = null; // the plan that look() has told of

  function say(state, text) {
    by("status").dataset.state = state;
    by("status").textContent = text;
  }

  // ---- what a person chooses

  function what(about) {
    return "undo" in about ? "undo" : "tick" in about ? "the tick" : about.value ? `${about.id} = ${about.value}` : `${about.id} reopened`;
  }

  async function send(path, about) {
    let answer;
    try {
      const reply = await fetch(path, {
        method: "POST", headers: { "Content-Type": "application/json" }, cache: "no-store",
        body: JSON.stringify({ ...about, plan: body.dataset.plan }),
      });
      answer = await reply.json();
    } catch {
      say("offline", `Not saved: ${what(about)}. The server does not answer. The plan has all changes saved before. Run robosmi open again and continue on its new page.`);
      back(about);
      return;
    }
    if (answer.sections) show(answer);
    if (answer.state !== "saved") back(about);
    noticed = answer.state === "refused" ? answer.now : null;
    say(answer.state, answer.message);
  }

  function back(about) {
    if ("tick" in about) for (const box of document.querySelectorAll("[data-tick]")) if (box.dataset.tick === about.tick) box.checked = !about.done;
  }

  function show(answer) {
    const held = document.activeElement, choice = held && held.closest("[data-choice]");
    const key = choice ? [choice.dataset.choice, held.dataset.option] : null;
    for (const [name, text] of Object.entries(answer.sections)) {
      if (typeof text === "string") by(name).innerHTML = text;
      else {
        const pieces = by(name).querySelectorAll("[data-piece]");
        for (const [at, part] of text) pieces[at].innerHTML = part;
      }
    }
    body.dataset.plan = answer.plan;
    by("progress").dataset.open = answer.open;
    by("progress").dataset.decided = answer.decided;
    by("progress").textContent = answer.progress;
    by("done").hidden = !answer.command && !answer.diff;
    by("command").textContent = answer.command;
    by("diff").textContent = answer.diff;
    if (key && !held.isConnected) {
      const same = [...document.querySelectorAll("[data-option]")].find(
        b => b.dataset.option === key[1] && b.closest("[data-choice]").dataset.choice === key[0]);
      if (same) same.focus();
    }
  }

  function queue(path, about) {
    waiting = waiting.then(() => send(path, about));
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
    const at = event.target.closest("[data-option], [data-undo], .code > div");
    if (!at) return;
    if ("undo" in at.dataset) queue("undo", { undo: true });
    else if ("option" in at.dataset) queue("choose", { id: at.closest("[data-choice]").dataset.choice, value: at.dataset.option, why: by("why").value });
    else linked(at);
  });

  document.addEventListener("keydown", event => {
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
    if (live && "tick" in event.target.dataset) queue("tick", { tick: event.target.dataset.tick, done: event.target.checked });
  });

  // ---- whether the server is there, and the plan is the one that is shown

  async function look() {
    const state = by("status").dataset.state;
    try {
      const now = await (await fetch("state", { cache: "no-store" })).json();
      if (now.plan === body.dataset.plan) {
        if (state === "offline") say("saved", "The server answers again. All changes saved.");
        else if (noticed !== null && state === "stale") say("saved", "The plan matches this page again. All changes saved.");
        noticed = null;
      } else if (now.plan !== noticed) {
        noticed = now.plan;
        if (!now.plan) say("stale", "The plan is missing or not readable, so changes cannot be saved. Put it back, or run robosmi open on its new folder.");
        else if (state !== "stale") say("stale", "The plan was changed elsewhere. Reload the page to see the changes.");
      }
    } catch {
      if (state !== "offline") say("offline", "The server does not answer. The plan has all saved changes. To continue, run robosmi open again and use its new page.");
    }
  }

  if (live) setInterval(() => { waiting = waiting.then(look); }, 2000);
  body.dataset.ready = "true";
})();
