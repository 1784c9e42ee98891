// Several designs side by side: pictures at one position of their cycles, and goals in columns.

import * as dialogs from "./dialogs.js";
import { byId, element } from "./elements.js";
import { Painter, Scene } from "./painter.js";

/** Most designs that are kept to be compared. */
const MOST = 4;

/** A picture of a design that is kept. */
class View extends Painter {
  constructor(snapshot, name) {
    super(element("canvas", { role: "img", "aria-label": name }));
    this.scene = new Scene(snapshot.picture);
  }

  draw(share) {
    this.measureBy(this.canvas);
    this.frame([16, 16]);
    this.clear();
    this.axes(this.parts(share * this.scene.motion.cycle));
  }
}

export class Compare {
  /** `now()` is the snapshot that is shown, `take(text)` takes the text of another. */
  constructor(now, take) {
    Object.assign(this, { now, take, kept: [] });
    byId("compare").addEventListener("click", () => this.show());
  }

  /** Keeps the design that is shown; one that is kept already is not kept again. */
  keep() {
    const snapshot = this.now();
    if (!snapshot.picture || this.kept.some(({ text }) => text === snapshot.text)) return;
    this.kept.push(snapshot);
  }

  /** The designs next to each other, the one that is shown last. */
  async show() {
    const table = element("div", { class: "compared" });
    const place = element("input", { type: "range", min: "0", max: "1", step: "any", value: "0", id: "compare-place", oninput: () => turn() });
    let views = [];
    const turn = () => views.forEach((view) => view.draw(Number(place.value)));
    const keep = element("button", { type: "button", class: "main", id: "compare-keep", onclick: () => {
      this.keep();
      fill();
    } }, "Keep this design");
    const fill = () => {
      const now = this.now();
      const known = this.kept.some(({ text }) => text === now.text);
      keep.disabled = known || this.kept.length >= MOST || !now.picture;
      const all = [...this.kept.map((snapshot, i) => ({ snapshot, name: `Kept ${i + 1}`, kept: true })), ...(known || !now.picture ? [] : [{ snapshot: now, name: "Now", kept: false }])];
      views = all.map(({ snapshot, name }) => new View(snapshot, name));
      const goals = new Map();
      for (const { snapshot } of all) for (const goal of snapshot.verdict?.goals ?? []) goals.set(goal.name, goal);
      const head = all.map(({ snapshot, name, kept }, i) => element("th", { scope: "col" }, views[i].canvas, element("b", {}, name),
        kept ? element("span", {},
          element("button", { type: "button", "aria-label": `Take ${name}`, onclick: () => {
            byId("dialog").close("");
            this.take(snapshot.text);
          } }, "Take"),
          element("button", { type: "button", "aria-label": `Drop ${name}`, onclick: () => {
            this.kept = this.kept.filter((own) => own !== snapshot);
            fill();
          } }, "×")) : null));
      const rows = [...goals.values()].map(({ name, title, unit }) => element("tr", {}, element("th", { scope: "row" }, unit ? `${title}, ${unit}` : title),
        ...all.map(({ snapshot }) => {
          const goal = snapshot.verdict?.goals.find((own) => own.name === name);
          const sign = goal?.met === null ? "○" : goal?.met ? "✓" : "✕";
          return element("td", { title: goal?.exact }, goal ? `${sign} ${goal.value}` : "–");
        })));
      table.replaceChildren(all.length ? element("table", { class: "figures" },
        element("thead", {}, element("tr", {}, element("th", { scope: "col" }, "Goals"), ...head)), element("tbody", {}, ...rows)) : element("p", {}, "Nothing to compare yet."));
      turn();
    };
    const shown = dialogs.ask("Side by side", [table,
      element("p", { class: "option" }, element("label", { for: "compare-place" }, "Position in the cycle"), place), keep], [["", "Close"]]);
    fill();
    await shown;
  }
}
