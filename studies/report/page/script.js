"use strict";
const one = (what, where = document) => where.querySelector(what), all = (what, where = document) => [...where.querySelectorAll(what)];

// --- claims: those of the chosen paper, place and verdict that have the words; a place in the words is one, not a text
const PLACE = /(?:\b(RR98|KHP95),?\s+)?\b(Eq|Fig|Sec)s?\b\.?\s*(\d+|[IVX]+(?:\s[AB])?)(?![\w-])/gi;
const form = one("#search"), choices = all("select", form), phrase = one("#phrase");
const claims = all(".claims tbody tr").map(row => ({row, text: row.textContent.toLowerCase(), at: row.dataset.at.split("; ")}));
function asked() {
  const places = [];
  const rest = phrase.value.replace(PLACE, (_, paper = "", kind, number) => (places.push(`${paper} ${kind}. ${number}`.toLowerCase()), " "));
  return {places, words: rest.toLowerCase().split(/\s+/).filter(Boolean)};
}
function chosen({row, at}) {
  return choices.every(box => !box.value || (box.dataset.by === "at" ? at.includes(box.value) : row.dataset[box.dataset.by] === box.value));
}
function search() {
  const {places, words} = asked(), active = Boolean(places.length || words.length || choices.some(box => box.value));
  for (const claim of claims) {
    claim.row.hidden = !(chosen(claim) && words.every(word => claim.text.includes(word))
      && places.every(place => claim.at.some(name => name.toLowerCase().endsWith(place))));
  }
  for (const study of all(".study")) {
    const left = one(".claims tbody tr:not([hidden])", study), fold = one(".claims", study);
    study.hidden = active && !left;
    if (fold) fold.open = active;
  }
  document.body.classList.toggle("searching", active);
  one("#count").textContent = `${claims.filter(claim => !claim.row.hidden).length} of ${claims.length} claims`;
}
["input", "change"].forEach(kind => form.addEventListener(kind, search));
form.addEventListener("reset", () => setTimeout(search));
form.addEventListener("submit", event => event.preventDefault());
form.hidden = false;
search();       // a page that is opened again keeps what was typed

// --- figures: a click makes them as wide as the page, and back
for (const link of all(".zoom")) link.addEventListener("click", event => {
  event.preventDefault();
  const large = link.closest("figure").classList.toggle("large");
  link.setAttribute("aria-expanded", large);
  one("details", link.closest("figure")).open = large;
  link.scrollIntoView({block: "nearest", inline: "start"});
});

// --- links: what they lead to is unfolded, and shown even if a search has hidden it
function unfold() {
  const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
  if (!target) return;
  if (!target.getClientRects().length && document.body.classList.contains("searching")) { form.reset(); search(); }
  for (let fold = target; fold; fold = fold.parentElement) if (fold.matches("details")) fold.open = true;
  target.scrollIntoView({inline: "center"});
}
addEventListener("hashchange", unfold);
unfold();
