"use strict";
const one = (what, where = document) => where.querySelector(what), all = (what, where = document) => [...where.querySelectorAll(what)];

// --- claims: rows that have the chosen words
const rows = all(".claims tbody tr").map(row => ({row, text: row.textContent.toLowerCase()}));
const chosen = all("#filters select"), words = one("#by-text"), count = one("#count");
function filter() {
  const wanted = words.value.toLowerCase().split(/\s+/).filter(Boolean);
  let shown = 0;
  for (const {row, text} of rows) {
    const fits = chosen.every(box => !box.value || row.dataset[box.dataset.by] === box.value) && wanted.every(word => text.includes(word));
    row.hidden = !fits;
    shown += fits;
  }
  count.textContent = `${shown} of ${rows.length} claims`;
}
["input", "change"].forEach(kind => one("#filters").addEventListener(kind, filter));
one("#filters").addEventListener("reset", () => setTimeout(filter));
one("#filters").addEventListener("submit", event => event.preventDefault());
filter();       // a page that is opened again keeps what was typed

// --- error against cost: panels, series, values of a point
const choice = one("#panel"), panels = all(".panel");
function showPanel() { panels.forEach((panel, number) => { panel.hidden = number !== Number(choice.value); }); }
if (choice) { choice.addEventListener("change", showPanel); showPanel(); }
for (const box of all(".legend input")) {
  const series = one(`#panel-${box.dataset.panel} .series[data-series="${box.dataset.series}"]`);
  const show = () => { series.style.display = box.checked ? "" : "none"; reachable(series.closest("svg")); };
  box.addEventListener("change", show);
  series.style.display = box.checked ? "" : "none";
}
const lines = svg => all(".series", svg).filter(series => series.style.display !== "none").map(series => all(".point", series));
function reachable(svg) {       // one stop for Tab, arrow keys go on from there
  const first = lines(svg)[0]?.[0];
  all(".point[tabindex='0']", svg).forEach(point => point.setAttribute("tabindex", "-1"));
  if (first) first.setAttribute("tabindex", "0");
}
function tell(point) {
  const plot = point.closest(".plot"), tip = one(".tip", plot), [name, values] = split(point.getAttribute("aria-label"));
  tip.replaceChildren(Object.assign(document.createElement("b"), {textContent: name}),
    ...values.map(text => Object.assign(document.createElement("div"), {textContent: text})));
  tip.hidden = false;
  const at = one(".mark", point).getBoundingClientRect(), frame = plot.getBoundingClientRect();
  const x = at.left + at.width/2 - frame.left, y = at.top + at.height/2 - frame.top;
  tip.style.left = `${Math.max(0, Math.min(x + 14, frame.width - tip.offsetWidth - 4))}px`;
  tip.style.top = `${y + tip.offsetHeight + 14 > frame.height ? y - tip.offsetHeight - 14 : y + 14}px`;
}
function split(label) {
  const values = label.split("; "), cut = values[0].lastIndexOf(": ");
  return [values[0].slice(0, cut), [values[0].slice(cut + 2), ...values.slice(1)]];
}
function hush(plot) { const here = one(".point:focus", plot); one(".tip", plot).hidden = true; if (here) tell(here); }
for (const svg of all(".plot svg")) {
  reachable(svg);
  const plot = svg.closest(".plot");
  svg.addEventListener("pointerover", event => { const point = event.target.closest(".point"); if (point) tell(point); });
  svg.addEventListener("pointerout", event => { if (event.target.closest(".point")) hush(plot); });
  svg.addEventListener("focusin", event => { const point = event.target.closest(".point"); if (point) tell(point); });
  svg.addEventListener("focusout", () => { one(".tip", plot).hidden = true; });
  svg.addEventListener("keydown", event => walk(event, svg));
}
function walk(event, svg) {
  const step = {ArrowRight: [0, 1], ArrowLeft: [0, -1], ArrowDown: [1, 0], ArrowUp: [-1, 0]}[event.key], point = event.target.closest(".point");
  if (event.key === "Escape") one(".tip", svg.closest(".plot")).hidden = true;
  if (!step || !point) return;
  event.preventDefault();
  const there = lines(svg), series = there.findIndex(line => line.includes(point)), number = there[series].indexOf(point);
  const line = there[(series + step[0] + there.length) % there.length], next = line[Math.max(0, Math.min(number + step[1], line.length - 1))];
  all(".point[tabindex='0']", svg).forEach(other => other.setAttribute("tabindex", "-1"));
  next.setAttribute("tabindex", "0");
  next.focus();
}

// --- films: they move when they are seen, unless less motion is wanted
const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
for (const button of all(".play")) {
  const film = one(`#film-${button.dataset.film}`);
  let asked = false;
  const play = on => {
    if (!on) return film.pause();
    film.src ||= `data:video/mp4;base64,${one(`#data-${button.dataset.film}`).textContent}`;
    film.play().catch(() => film.pause());      // where the browser cannot or may not
  };
  for (const kind of ["play", "pause"]) film.addEventListener(kind, () => {
    button.setAttribute("aria-pressed", !film.paused);
    button.textContent = film.paused ? "Play" : "Pause";
  });
  button.addEventListener("click", () => { asked = true; play(film.paused); });
  if (!calm) new IntersectionObserver(([seen]) => { if (!asked) play(seen.isIntersecting); }, {threshold: .5}).observe(film);
}

// --- tables: all rows from what is packed into the page
const PAGE = 200;
async function unpack(id) {
  const packed = Uint8Array.from(atob(one(`#data-${id}`).textContent), sign => sign.charCodeAt(0));
  return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"))).text();
}
function parse(text) {
  const rows = [];
  for (const line of text.split("\n").filter(line => line && !line.startsWith("#"))) {
    rows.push([...line.matchAll(/("(?:[^"]|"")*"|[^,]*)(?:,|$)/g)].map(found => found[1].replace(/^"|"$/g, "").replaceAll('""', '"')).slice(0, -1));
  }
  return rows;
}
async function more(button) {
  const table = document.getElementById(button.dataset.table), body = one("tbody", table);
  const rows = parse(await unpack(button.dataset.table)).slice(1), start = body.dataset.all ? body.rows.length : 0;
  if (!start) body.replaceChildren();
  body.dataset.all = "yes";
  for (const row of rows.slice(start, start + PAGE)) {
    const line = body.insertRow();
    for (const cell of row) line.insertCell().textContent = cell;
  }
  one(".rest", table).textContent = `${body.rows.length} of ${rows.length} rows`;
  button.hidden = body.rows.length === rows.length;
}
async function save(button) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([await unpack(button.dataset.table)], {type: "text/csv"}));
  link.download = button.dataset.name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
all(".more").forEach(button => button.addEventListener("click", () => more(button)));
all(".save").forEach(button => button.addEventListener("click", () => save(button)));
function unfold() {
  const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
  if (target?.matches("details")) target.open = true;
}
addEventListener("hashchange", unfold);
unfold();
