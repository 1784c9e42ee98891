// The figures of the report, as the command line groups and shows them.

import { byId, element } from "./elements.js";

/** So many columns of figures are many. */
const MANY = 4;

let exact = false;

/** Shows the groups; figures of `pinned`, by key, next to those that differ. */
export function show(verdict, pinned) {
  const before = new Map();
  for (const group of pinned?.figures ?? []) {
    for (const row of group.rows) {
      for (const cell of row.cells) if (cell) before.set(cell.key, cell);
    }
  }
  const place = byId("figures");
  const toggle = element("input", { type: "checkbox", id: "exact", onchange: (event) => {
    exact = event.target.checked;
    show(verdict, pinned);
    byId("exact").focus();
  } });
  toggle.checked = exact;
  place.replaceChildren(
    element("div", { class: "title" }, element("h2", {}, "Figures"),
      element("label", { class: "quiet" }, toggle, " every digit")),
    ...verdict.figures.map((group) => table(group, before)),
  );
}

function table(group, before) {
  const columns = Math.max(1, ...group.rows.map((row) => row.cells.length));
  const names = group.columns.length ? group.columns : Array(columns).fill("");
  const head = element("tr", {}, element("th", { scope: "col" }, group.heading),
    ...names.map((name) => element("th", { scope: "col", class: "figure" }, name || element("span", { class: "hidden" }, "figure"))),
    element("th", { scope: "col", class: "unit" }, element("span", { class: "hidden" }, "unit")));
  const rows = group.rows.map((row) => element("tr", {},
    element("th", { scope: "row" }, row.name),
    ...Array.from({ length: columns }, (_, i) => figure(row.cells[i], before)),
    element("td", { class: "unit" }, row.unit)));
  // Many columns have to be narrow to have room.
  const kinds = ["figures", exact && "exact", columns >= MANY && "many"].filter(Boolean);
  return element("table", { class: kinds.join(" ") },
    element("thead", {}, head), element("tbody", {}, ...rows));
}

function figure(cell, before) {
  if (!cell) return element("td", {});
  const old = before.get(cell.key);
  const differs = old !== undefined && old.exact !== cell.exact;
  return element("td", { class: "figure", "data-key": cell.key, "data-exact": cell.exact, title: `${cell.key} = ${cell.exact}` },
    exact ? cell.exact : cell.shown,
    differs ? element("span", { class: "before", title: "in the pinned design" }, `was ${exact ? old.exact : old.shown}`) : null);
}
