// Both programs side by side. The server simulates a run; the page plays it: its clock, its parts, its timeline, and its inputs.
// An input that is moved becomes a point of the run at the clock's time, and the run is simulated again with it.
"use strict";
(() => {
  const by = id => document.getElementById(id), section = by("watch");
  if (!section || !("live" in document.body.dataset)) return;
  const FIRST = 5000, LONGEST = 60000, SIDES = ["original", "migrated"], QUIET = 1500, tab = crypto.randomUUID();
  let run = null, at = 0, playing = false, before = 0, asking = 0, loading = 0, compareLater = 0, sound = null, cells = [], controls = [], worded = 0;

  async function ask(about) {
    const reply = await fetch("watch", { method: "POST", headers: { "Content-Type": "application/json" }, cache: "no-store", body: JSON.stringify(about) });
    return reply.json();
  }

  function say(text, state = "") {
    by("watch-status").textContent = text;
    by("watch-status").dataset.state = state;
  }

  // ---- the run

  function moved() {
    return run ? run.inputs.filter(input => input.points.length).map(({ title, setting, points }) => ({ title, setting, points })) : [];
  }

  async function load(about, compare = false) {
    const mine = ++asking;
    clearTimeout(compareLater);
    if (!compare) {
      say(run ? "Simulating ..." : "Compiling and simulating both programs ...", "busy");
      loading = mine;
    }
    let answer;
    try {
      answer = await ask({ ...about, compare, tab, number: mine });
    } catch {
      answer = { state: "refused", message: "The server does not answer. Run robosmi open again and use its new page." };
    }
    if (loading === mine) loading = 0;
    if (mine !== asking || answer.state === "superseded") return false; // another input was moved meanwhile
    if (answer.state !== "done") {
      say(answer.message, "refused");
      stop();
      return false;
    }
    const known = run && run.compared && JSON.stringify(moved()) === JSON.stringify(answer.inputs.filter(i => i.points.length).map(({ title, setting, points }) => ({ title, setting, points }))) ? run : null;
    if (answer.compared && run) answer.seconds = run.seconds; // a comparison runs the original several times
    run = known && !answer.compared ? { ...answer, difference: known.difference, verdict: known.verdict } : answer;
    listCases(answer.cases);
    draw();
    say(described(), "done");
    if (!compare && run.title) compareLater = setTimeout(() => load(asked(run.ms), true), QUIET);
    return true;
  }

  function asked(ms) {
    return { scenario: run && run.scenario && !run.changed ? run.scenario : "", ms, inputs: moved() };
  }

  function described() {
    const speed = run.seconds > 0 ? ` (${(run.ms / 1000 / run.seconds).toFixed(1)} times real time)` : "";
    const ends = Object.entries(run.ended).map(([side, [state, ms]]) => ` The ${side === "migrated" ? "sketch" : "original"} ${state === "crashed" ? "crashed" : "ended"} at ${ms.toFixed(1)} ms.`).join("");
    const engine = `${run.engine} simulated ${(run.ms / 1000).toFixed(1)} s in ${run.seconds.toFixed(1)} s${speed}.${ends}`;
    if (run.why) return `${engine} ${run.why}`;
    if (!run.compared && !("verdict" in run)) return `${engine} Comparing both programs ...`;
    if (run.difference) return `${engine} First difference at ${run.difference.ms.toFixed(1)} ms, ${run.difference.channel}: ${run.difference.message}.`;
    return `${engine} ${run.verdict === "no-difference-found" ? "No difference found." : run.reason || "The comparison could not decide."}`;
  }

  // ---- what is drawn once for each run

  function element(name, attributes, ...inside) {
    const made = ["svg", "path", "line", "circle", "text", "title"].includes(name) ? document.createElementNS("http://www.w3.org/2000/svg", name) : document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    made.append(...inside);
    return made;
  }

  function draw() {
    const rows = run.channels.map(channel => {
      const cells = SIDES.map(side => {
        const dial = element("svg", { viewBox: "0 0 24 24", class: "dial", "aria-hidden": "true" }, element("circle", { cx: 12, cy: 12, r: 10 }), element("line", { x1: 12, y1: 12, x2: 12, y2: 3 }));
        const cell = element("td", { "data-component": channel.component, "data-port": channel.port, "data-side": side, "data-state": "off" }, dial, element("span", {}));
        cell.events = channel.sides[side] || [];
        [cell.dial, cell.said] = cell.children;
        [cell.turns, cell.sounds] = [channel.turns, channel.sounds];
        cell.angle = 0;
        cell.shown = null; // no event, and not yet "nothing yet"
        return cell;
      });
      return element("tr", {}, element("th", { scope: "row" }, `${channel.component} (${channel.port}: ${channel.pins.original} / ${channel.pins.migrated})`), ...cells);
    });
    by("watched").replaceChildren(...rows);
    cells = [...by("watched").querySelectorAll("td")];
    for (const side of SIDES) {
      const box = by(`console-${side}`);
      [box.lines, box.shown] = [run.console[side] || [], 0];
      box.replaceChildren();
    }
    drawInputs();
    drawTimeline();
    show();
  }

  const LEFT = 150, WIDE = 1000, HIGH = 16; // the playhead begins at 15 %, see the stylesheet

  function drawTimeline() {
    const x = ms => LEFT + (WIDE - LEFT) * Math.min(1, ms / run.ms), all = [];
    let y = 20;
    all.push(element("text", { x: LEFT, y: 12, class: "original" }, "original"), element("text", { x: LEFT + 80, y: 12, class: "migrated" }, "sketch"));
    for (const channel of run.channels) {
      all.push(element("text", { x: 0, y: y + HIGH + 4 }, channel.component.slice(0, 24)));
      for (const side of SIDES) {
        let d = "", joined = false;
        const events = channel.sides[side] || [];
        events.forEach((event, n) => {
          const from = x(event[0]).toFixed(1), to = x(n + 1 < events.length ? events[n + 1][0] : run.ms).toFixed(1);
          const top = y + 3, low = y + HIGH - 3;
          if (event[3] === "level") d += `${joined ? "L" : "M"}${from} ${event[1] === "off" ? low : top}H${to}`;
          else d += `M${from} ${top}H${to}V${low}H${from}Z`;
          joined = event[3] === "level";
        });
        all.push(element("path", { d: d || `M${LEFT} ${y + HIGH - 3}H${WIDE}`, class: side }));
        y += HIGH;
      }
      y += 6;
    }
    if (run.difference) {
      const mark = x(run.difference.ms);
      all.push(element("line", { id: "difference", "data-ms": run.difference.ms, x1: mark, x2: mark, y1: 0, y2: y }, element("title", {}, `First difference, ${run.difference.channel}: ${run.difference.message}`)));
    }
    all.push(element("line", { class: "axis", x1: LEFT, x2: WIDE, y1: y, y2: y }));
    const wanted = run.ms / 8, power = 10 ** Math.floor(Math.log10(wanted)), step = [1, 2, 5, 10].find(each => each * power >= wanted) * power;
    for (let n = 0; n * step <= run.ms; n++) {
      const tick = x(n * step), text = `${Number((n * step / 1000).toPrecision(6))} s`;
      all.push(element("line", { class: "axis", x1: tick, x2: tick, y1: y, y2: y + 4 }));
      all.push(element("text", { class: "time", x: tick, y: y + 16, "text-anchor": tick > WIDE - 20 ? "end" : "middle" }, text));
    }
    by("timeline").setAttribute("viewBox", `0 0 ${WIDE} ${y + 20}`);
    by("timeline").replaceChildren(...all);
    by("seek").max = run.ms;
  }

  function drawInputs() {
    const held = document.activeElement && document.activeElement.dataset.input;
    by("inputs").replaceChildren(...run.inputs.map(input => {
      const label = input.title === "console" ? "Type into the serial monitor" : input.setting === "points" ? input.title : `${input.title} ${input.setting}`, own = { "data-input": input.title, "data-setting": input.setting };
      let control;
      if (input.control === "button") control = element("button", { type: "button", ...own, "aria-pressed": "false" }, label);
      else if (input.control === "range") control = element("input", { type: "range", ...own, min: input.least, max: input.most, step: "any" });
      else control = element("input", { type: "text", ...own, maxlength: 100, autocomplete: "off" });
      control.input = input;
      return input.control === "button" ? control : element("label", {}, `${label} `, control, " ", element("output", {}));
    }));
    controls = [...by("inputs").querySelectorAll("[data-input]")];
    const same = held && [...by("inputs").querySelectorAll("[data-input]")].find(each => each.dataset.input === held);
    if (same) same.focus();
  }

  // ---- what changes with the clock

  function count(events) { // of those that have happened
    let low = 0, high = events.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (events[middle][0] <= at) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  function last(events) {
    return events[count(events) - 1];
  }

  const NOTES = ["C", "C#", "D", "D#", "E", "F", "F#", "G", "G#", "A", "A#", "B"];

  function audible(cell, event) {
    return cell.sounds && event && event[3] === "wave" && Number(event[1]) >= 20 && Number(event[1]) < 15000;
  }

  function note(cell, event) { // the nearest one of the scale in which A4 has 440 Hz
    const number = Math.round(12 * Math.log2(Number(event[1]) / 440)) + 57;
    return audible(cell, event) ? ` (${NOTES[number % 12]}${Math.floor(number / 12)})` : "";
  }

  function shownValue(input) {
    const now = last(input.points);
    return now ? now[1] : input.rest;
  }

  function show(passed = 0) {
    by("clock").dataset.ms = at.toFixed(1);
    const now = performance.now(), words = !playing || now - worded >= 100; // lamps and wheels change each frame; texts, as often as one can read them
    if (words) {
      worded = now;
      by("clock").textContent = `${(at / 1000).toFixed(3)} s`;
    }
    if (!run) return;
    let hz = 0;
    for (const cell of cells) {
      const event = last(cell.events), state = event ? event[1] : "off", turning = Boolean(event && event[3] === "pulses");
      if (turning) {
        cell.angle = cell.turns ? cell.angle + Number(state) * passed * 0.0036 : Number(state) - 90;
        const turned = `rotate(${(cell.angle % 360).toFixed(0)}deg)`;
        if (cell.dial.style.transform !== turned) cell.dial.style.transform = turned;
      }
      if (audible(cell, event) && cell.dataset.side === "migrated") hz = Number(state);
      if (words && cell.shown !== event) {
        cell.shown = event;
        cell.said.textContent = event ? `${event[2]}${note(cell, event)}` : "nothing yet";
      }
      if (cell.dataset.state === state && cell.turning === turning) continue;
      cell.dataset.state = state;
      cell.turning = turning;
      cell.classList.toggle("turning", turning);
      if (cell.dataset.side === "migrated" && by("circuit")) {
        for (const part of by("circuit").querySelectorAll("[data-symbol]")) if (part.dataset.component === cell.dataset.component) part.dataset.state = state;
      }
    }
    for (const side of words ? SIDES : []) {
      const box = by(`console-${side}`), printed = count(box.lines);
      if (box.shown !== printed) {
        if (printed < box.shown) box.replaceChildren(...[...box.children].slice(0, printed));
        else box.append(...box.lines.slice(box.shown, printed).map(line => element("div", {}, line[1])));
        box.shown = printed;
        box.scrollTop = box.scrollHeight;
      }
    }
    for (const control of controls) {
      const value = shownValue(control.input);
      if (control.shown === value) continue;
      control.shown = value;
      if (control.type === "range" && control !== document.activeElement) control.value = value;
      if (control.type === "range") control.nextElementSibling.textContent = `${value} ${control.input.unit}`.trim();
      if (control.type === "button") control.setAttribute("aria-pressed", String(value === 1));
    }
    const there = Math.min(1, at / run.ms);
    by("playhead").style.transform = `translateX(${(there * (WIDE - LEFT) / WIDE * 100).toFixed(2)}cqw)`;
    if (words) by("seek").value = at;
    tone(playing ? hz : 0);
  }

  function tone(hz) {
    if (!by("sound").checked || !hz) {
      if (sound) sound.gain.gain.value = 0;
      return;
    }
    if (!sound) {
      const context = new AudioContext(), wave = context.createOscillator(), gain = context.createGain();
      wave.type = "square";
      wave.connect(gain).connect(context.destination);
      wave.start();
      sound = { wave, gain };
    }
    sound.wave.frequency.value = hz;
    sound.gain.gain.value = 0.05;
  }

  function frame(now) {
    if (!playing) return;
    const passed = (now - before) * Number(by("speed").value), end = run.ms;
    before = now;
    at = Math.min(end, at + passed);
    show(passed);
    if (at >= end && !loading) pause(); // else the clock waits at the end for the longer run
    else requestAnimationFrame(frame);
  }

  function play() {
    playing = true;
    before = performance.now();
    section.dataset.playing = "true";
    by("pause").textContent = "Pause";
    requestAnimationFrame(frame);
  }

  function pause() {
    playing = false;
    delete section.dataset.playing;
    by("pause").textContent = atEnd() ? "Simulate longer" : "Continue";
    show();
  }

  function atEnd() {
    return run && at >= run.ms && run.ms < LONGEST && !(run.scenario && !run.changed);
  }

  async function go() {
    if (atEnd() && !(await load(asked(Math.min(LONGEST, 2 * run.ms))))) return;
    play();
  }

  function stop() {
    pause();
    section.querySelector("[data-run]").dataset.run = "stopped";
    section.querySelector("[data-run]").textContent = "Run";
    for (const each of section.querySelectorAll("[data-when-running]")) each.disabled = true;
  }

  async function start() {
    const button = section.querySelector("[data-run]"), name = by("case").value;
    button.dataset.run = "running";
    button.textContent = "Stop";
    at = 0;
    run = null;
    if (!(await load(name ? { scenario: name } : { ms: FIRST, inputs: [] }))) return;
    if (button.dataset.run !== "running") return;
    for (const each of section.querySelectorAll("[data-when-running]")) each.disabled = false;
    play();
  }

  function move(control, value) {
    const input = control.input, now = Math.round(at * 10) / 10, ended = !playing && at >= run.ms;
    input.points = [...input.points.filter(point => point[0] < now), [now, value]];
    run.changed = true;
    const ms = Math.min(LONGEST, Math.max(run.ms, now + FIRST));
    load({ scenario: "", ms, inputs: moved() }).then(longer => { if (longer && ended) play(); });
  }

  function step() {
    pause();
    let next = Infinity;
    for (const channel of run.channels) for (const side of SIDES) for (const event of channel.sides[side] || []) if (event[0] > at + 0.001) {
      next = Math.min(next, event[0]);
      break;
    }
    at = Math.min(run.ms, next);
    show();
  }

  function listCases(names) {
    const chosen = by("case").value;
    by("case").replaceChildren(element("option", { value: "" }, "inputs by hand"), ...names.map(name => element("option", { value: name }, name)));
    by("case").value = names.includes(chosen) ? chosen : "";
  }

  async function save() {
    by("save-status").textContent = "Saving ...";
    const name = by("case-name").value.trim(), unnamed = { state: "refused", message: "Give the test case a name." };
    const answer = name ? await ask({ ...asked(Math.max(100, run.ms)), save: name }).catch(() => ({ state: "refused", message: "The server does not answer." })) : unnamed;
    const unsure = answer.state === "done" && run.compared && !run.difference && run.verdict !== "no-difference-found" && run.reason;
    by("save-status").textContent = unsure ? `${answer.message} It decides nothing: ${run.reason}.` : answer.message;
    by("save-status").dataset.state = answer.state;
    if (answer.cases) listCases(answer.cases);
  }

  section.addEventListener("click", event => {
    const target = event.target.closest("button");
    if (!target) return;
    if ("run" in target.dataset) target.dataset.run === "running" ? (++asking, clearTimeout(compareLater), say("Stopped."), stop()) : start();
    else if (target.id === "pause") playing ? pause() : go();
    else if (target.id === "step") step();
    else if (target.id === "save") save();
    else if ("input" in target.dataset) move(target, shownValue(target.input) === 1 ? 0 : 1);
  });

  section.addEventListener("input", event => {
    if (event.target.id !== "seek" || !run) return;
    at = Number(event.target.value);
    show();
  });

  section.addEventListener("change", event => {
    const control = event.target;
    if (control.id === "case" && run && section.querySelector("[data-run]").dataset.run === "running") start();
    if (!("input" in control.dataset) || !run) return;
    if (control.type === "range") move(control, Number(control.value));
    else if (control.type === "text" && control.value) {
      move(control, `${control.value}\r`);
      control.value = "";
    }
  });

  ask({ list: true }).then(answer => { if (answer.cases) listCases(answer.cases); }, () => {});
  section.dataset.ready = "true";
})();
