"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const names = data.names, programs = data.programs, SIZE = 100;
  const byId = new Map(programs.map((row) => [row[0], row]));
  const $ = (id) => document.getElementById(id);
  const make = (tag, text) => { const made = document.createElement(tag); if (text !== undefined) made.textContent = text; return made; };
  const shown = (value, digits) => value === null || value === undefined ? "" : typeof value === "number" && digits !== undefined ? value.toFixed(digits) : String(value);
  const empty = (value) => value === null || value === undefined || value === "";
  const order = (a, b, down) => empty(a) || empty(b) ? empty(a) - empty(b) : (down ? -1 : 1) * compared(a, b);
  const compared = (a, b) => a === b ? 0 : typeof a === "number" && typeof b === "number" ? a - b : String(a).localeCompare(String(b), "en", { numeric: true });

  // Each program's text is made when a filter first asks for it.
  const texts = new Map();
  const textOf = (row) => {
    let text = texts.get(row);
    if (text === undefined) {
      const more = row[7];
      const words = [row[0], row[1], more.m, ...Object.entries(more.l).flat()];
      for (const call of more.c) words.push(names[call[0]], names[call[1]]);
      for (const finding of more.f) words.push(names[finding[0]], names[finding[2]]);
      texts.set(row, text = words.join("\n").toLowerCase());
    }
    return text;
  };

  let found = programs.slice(), at = 0, key = 0, down = false;
  const body = $("table").tBodies[0];
  const show = () => {
    const pages = Math.max(1, Math.ceil(found.length / SIZE));
    at = Math.min(at, pages - 1);
    const rows = document.createDocumentFragment();
    for (const row of found.slice(at * SIZE, (at + 1) * SIZE)) {
      const line = make("tr"), name = make("td"), link = make("a", row[0]);
      link.href = "#program=" + encodeURIComponent(row[0]);
      name.append(link);
      line.append(name, make("td", row[1]), make("td", shown(row[2], 2)), make("td", shown(row[3], 0)), make("td", shown(row[4])), make("td", shown(row[5])), make("td", shown(row[6])));
      rows.append(line);
    }
    body.replaceChildren(rows);
    $("count").textContent = `${found.length} of ${programs.length} programs`;
    $("page").textContent = `page ${at + 1} of ${pages}`;
    $("back").disabled = at === 0;
    $("on").disabled = at >= pages - 1;
  };
  const select = () => {
    const words = $("words").value.toLowerCase().split(/\s+/).filter(Boolean), state = $("state").value;
    found = programs.filter((row) => (!state || row[1] === state) && (!words.length || words.every((word) => textOf(row).includes(word))));
    found.sort((a, b) => order(a[key], b[key], down));
    at = 0;
    show();
  };
  $("words").addEventListener("input", select);
  $("state").addEventListener("change", select);
  $("filter").addEventListener("submit", (event) => event.preventDefault());
  $("back").addEventListener("click", () => { at -= 1; show(); });
  $("on").addEventListener("click", () => { at += 1; show(); });

  const sorted = (head, chosen, descending) => {
    for (const each of head.cells) each.removeAttribute("aria-sort");
    chosen.setAttribute("aria-sort", descending ? "descending" : "ascending");
  };
  const withButton = (cell, act) => {
    const button = make("button", cell.textContent);
    button.type = "button";
    button.addEventListener("click", act);
    cell.replaceChildren(button);
  };
  const head = $("table").tHead.rows[0];
  for (const cell of head.cells) {
    withButton(cell, () => {
      const chosen = Number(cell.dataset.key);
      down = chosen === key ? !down : chosen > 1;
      key = chosen;
      sorted(head, cell, down);
      select();
    });
  }
  for (const table of document.querySelectorAll("table.sortable")) {
    const row = table.tHead.rows[0];
    [...row.cells].forEach((cell, column) => withButton(cell, () => {
      const descending = cell.getAttribute("aria-sort") === "ascending";
      const value = (line) => { const text = line.cells[column].textContent; return text !== "" && !isNaN(text) ? Number(text) : text; };
      const lines = [...table.tBodies[0].rows].sort((a, b) => order(value(a), value(b), descending));
      table.tBodies[0].append(...lines);
      sorted(row, cell, descending);
    }));
  }

  const tableOf = (title, heads, lines) => {
    if (!lines.length) return [];
    const table = make("table"), first = table.createTHead().insertRow(), rows = table.createTBody();
    for (const each of heads) first.append(make("th", each));
    for (const line of lines) { const row = rows.insertRow(); for (const value of line) row.append(make("td", shown(value))); }
    return [make("h3", title), table];
  };
  const section = () => {
    const match = /^#program=(.*)$/.exec(location.hash), place = $("section");
    let name = null;
    try { name = match && decodeURIComponent(match[1]); } catch { name = null; }
    const row = name !== null ? byId.get(name) : undefined;
    place.hidden = row === undefined;
    if (row === undefined) return;
    const more = row[7], parts = [make("h2", row[0])];
    const facts = [["State", row[1] + (more.s ? ` at the step ${more.s}` : "")], ["Why", more.m], ["File", more.p], ["Seconds", shown(row[2], 2)], ["Added memory (MB)", shown(row[3], 0)], ["Tasks", row[5]], ["Open choices", row[6]], ...Object.entries(more.l)];
    if (more.k) facts.push(["Compiles", `${more.k[0] ? more.k[1] === 0 || more.k[1] === false ? "yes, does not fit" : "yes" : "no"}${more.k[2] !== null ? `, ${more.k[2]} bytes of flash, ${more.k[3]} bytes of RAM` : ""} (${more.k[4]})`]);
    if (more.v) facts.push(["Verdict", `${more.v[0]}${more.v[1] !== null ? `, ${more.v[1]} of ${more.v[2]} outputs compared` : ""}`]);
    parts.push(...tableOf("Result", ["", ""], facts.filter((fact) => fact[1] !== null && fact[1] !== undefined && fact[1] !== "")));
    if (more.r) { const line = make("p"), link = make("a", "Report of the migration"); link.href = more.r; line.append(link); parts.push(line); }
    const bodies = { "-1": "not known", 0: "missing", 1: "there" };
    parts.push(...tableOf("Calls", ["Function", "Header", "Body", "Calls", "First line"], more.c.map((call) => [names[call[0]], names[call[1]], bodies[call[2]], call[3], call[4]])));
    parts.push(...tableOf("Errors and warnings", ["Rule", "Severity", "Message", "Findings", "First line"], more.f.map((each) => [names[each[0]], names[each[1]], names[each[2]], each[3], each[4]])));
    place.replaceChildren(...parts);
    place.scrollIntoView();
  };
  window.addEventListener("hashchange", section);
  select();
  section();
  document.body.dataset.ready = "true";
})();
