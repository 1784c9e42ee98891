// Keys and gestures, and a tour for who sees the page for the first time.

import * as dialogs from "./dialogs.js";
import { byId, element } from "./elements.js";

const KEYS = [
  ["Everywhere", [
    ["Ctrl+Z, Ctrl+Shift+Z", "undo, redo"], ["Ctrl+S", "save"], ["?", "these keys"], ["Tab", "next number, point or button"],
  ]],
  ["A number", [
    ["↑ ↓", "step; with Shift ten times, with Alt a tenth"], ["Enter", "take what is typed: 2*1.5, 1/8 in, pi/9 rad"], ["drag its name", "change it"],
    ["F4, or ∿ next to it", "how goals and paths respond to it"],
    ["F1, or a tap on its name", "what it is, and its range"],
  ]],
  ["The drawing", [
    ["All, and a gear's name", "zoom to that gear"],
    ["← → ↑ ↓, or drag", "move the view"], ["+ −, wheel, or two fingers", "zoom"], ["0, or double-click", "show everything"], ["Space", "play or pause"],
  ]],
  ["A point of the drawing", [
    ["drag, or ← → ↑ ↓", "move it"], ["Insert, or double-click on the curve", "add a point of a B-spline"], ["Delete", "delete a point of a B-spline"],
  ]],
  ["Composing a machine", [
    ["B D S G C P K T", "add a body, dyad, slider, gear pair, cam, point, corner, goal"], ["V", "select a part: rename, copy, delete"],
    ["click, or choose from the lists", "pick points and bodies"], ["0 … 9", "type the first length"], ["Esc", "leave the tool"],
  ]],
  ["Points in a table", [
    ["Insert, Ctrl+Delete", "add a point after this one, delete this one"], ["Ctrl+V", "take cells of a spreadsheet"],
  ]],
  ["The input, below the drawing", [["← →", "turn by a degree"], ["Page up, Page down", "turn by ten degrees"]]],
  ["Curves", [
    ["point at one", "read all of them there"], ["click, or drag across", "move the machine there"],
    ["drag along the axis", "zoom; double-click shows the whole cycle"], ["Enlarge", "one chart over the whole width"],
  ]],
  ["Borders between the panes", [
    ["drag, or ← →", "move; double-click for the usual width"],
  ]],
];

/** What to look at, its name, and what there is to know of it. */
const STEPS = [
  ["#form", "Numbers", "The numbers of the design. Type one, step it with the arrow keys, or drag its name. A formula such as 2*1.5 or a unit such as 1/8 in is possible. The essential numbers come first."],
  ["#stage", "Drawing", "The machine to scale. Drag to move the view, turn the wheel to zoom. Blue points can be dragged, too, or moved with the arrow keys."],
  [".transport", "Motion", "Play the machine, or move it through its cycle with the slider."],
  ["#verdict", "Goals and findings", "Goals are updated while a point is dragged. The status is that of the worst finding below it. Figures come last."],
  ["#charts", "Curves", "Point at one curve to read all of them. Drag along the axis to zoom. Each can be saved as CSV, SVG or PNG."],
  [".bar .tools", "Tools", "Undo, store a design for comparison, search for a better one, copy a link, export files, save. The button ? lists the keys and starts this tour."],
];
const SEEN = "centrode-tour";

/** Whether somebody has seen the tour: a cookie, since the program has another port, and so another storage, each time. */
const seen = () => document.cookie.split("; ").includes(`${SEEN}=seen`);

/** Shows the keys. */
async function keys() {
  const rows = (list) => list.map(([key, words]) => element("tr", {}, element("th", { scope: "row" }, key), element("td", {}, words)));
  const answer = dialogs.ask("Keys and gestures", [
    element("div", { class: "keys" }, ...KEYS.map(([place, list]) => element("table", {}, element("caption", {}, place), element("tbody", {}, ...rows(list))))),
  ], [["tour", "Take the tour"], ["close", "Close", "main"]]);
  // Its first button, which has the focus, is below the list.
  byId("dialog").scrollTop = 0;
  if (await answer === "tour") tour();
}

/** Leads through the page; ends with its last step, by Skip or by the Escape key. */
function tour() {
  byId("tour")?.remove();
  const before = document.activeElement;
  let at = 0;
  const title = element("h2", { id: "tour-title" });
  const words = element("p", {});
  const back = element("button", { type: "button", onclick: () => go(at - 1) }, "Back");
  const next = element("button", { type: "button", class: "main", onclick: () => go(at + 1) });
  const skip = element("button", { type: "button", onclick: () => end() }, "Skip");
  const card = element("div", { id: "tour", role: "dialog", "aria-labelledby": "tour-title", "aria-describedby": "tour-words", onkeydown: (event) => {
    if (event.key === "Escape") end();
  } }, title, element("div", { id: "tour-words", role: "status" }, words), element("div", { class: "buttons" }, skip, back, next));
  const unmark = () => document.querySelector(".toured")?.classList.remove("toured");
  const end = () => {
    unmark();
    card.remove();
    document.cookie = `${SEEN}=seen; path=/; max-age=31536000; samesite=strict`;
    if (before?.isConnected) before.focus({ preventScroll: true });
  };
  const go = (step) => {
    if (step === STEPS.length) {
      end();
      return;
    }
    at = step;
    const [place, name, told] = STEPS[at];
    unmark();
    const target = document.querySelector(place);
    // In a narrow window it may lie behind another tab.
    const pane = target.closest("[role=tabpanel]");
    if (pane) document.querySelector(`#tabs [aria-controls=${pane.id}]`)?.click();
    target.classList.add("toured");
    target.scrollIntoView({ block: "nearest" });
    title.textContent = `${at + 1} of ${STEPS.length}: ${name}`;
    words.textContent = told;
    back.disabled = at === 0;
    skip.hidden = at === STEPS.length - 1;
    next.textContent = skip.hidden ? "Done" : "Next";
    next.focus({ preventScroll: true });
  };
  document.body.append(card);
  go(0);
}

/** Starts the button and the key, and the tour at the first visit. */
export function start() {
  byId("keys").addEventListener("click", keys);
  addEventListener("keydown", (event) => {
    const typing = event.target.matches?.("input:not([type=range], [type=checkbox]), textarea, select");
    if (event.key !== "?" || event.ctrlKey || event.metaKey || typing || byId("dialog").open) return;
    event.preventDefault();
    keys();
  });
  if (!seen()) tour();
}
