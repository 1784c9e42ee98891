// Composing a machine: tools above the picture, their fields, clicks in the picture, and the ghost of the part to come.

import { ComposePanel } from "./compose-panel.js";
import { byId, drawn, element } from "./elements.js";
import { brief } from "./numbers.js";
import { Picking } from "./picking.js";
import * as server from "./server.js";
import { TOOLS, gesture } from "./tools.js";

/** A press that moves farther is a drag of the view, pixels. */
const STILL = 4;
/** How closely an empty machine is seen at first, pixels per mm. */
const FIRST = 3;

/** The axes of the ground on which an empty machine begins, mm. */
const GROUND = [[[-1000, 0], [1000, 0]], [[0, -1000], [0, 1000]]];

export class Compose {
  /** `page.text()` and `page.input()` are what is shown, `page.settled()` waits for changes on their way, `page.take(text)` takes a text, `page.edit(edits)` changes values, `page.began()` stops the motion. */
  constructor(stage, page) {
    Object.assign(this, { stage, page });
    this.parts = { points: [], bodies: [], parts: [], figures: [] };
    this.picking = new Picking(stage, () => this.parts);
    this.tool = null;
    /** Number of the last preview requested, and whether one is on its way. */
    this.asked = 0;
    this.busy = false;
    this.hover = null;
    this.other = null;
    this.place = byId("compose");
    this.panel = new ComposePanel({ changed: () => this.changed(), select: (key) => this.select(key), change: (own) => this.change(own), leave: () => this.choose(null) });
    this.layer = stage.box.appendChild(drawn("svg", { class: "compose-layer" }));
    this.marks = this.layer.appendChild(drawn("g"));
    this.buttons = TOOLS.map((tool) => element("button", { type: "button", id: `tool-${tool.id}`, "aria-pressed": "false",
      title: `${tool.title} (${tool.key.toUpperCase()})`, onclick: () => this.choose(this.tool === tool ? null : tool) }, tool.words));
    byId("compose-tools").append(...this.buttons);
    this.panel.place.addEventListener("submit", (event) => {
      event.preventDefault();
      this.add(this.hover);
    });
    this.listen();
  }

  /** Takes the parts of a snapshot; none where its family is not composed. */
  show(snapshot) {
    const { compose } = snapshot;
    this.place.hidden = !compose;
    if (!compose) {
      if (this.tool) this.choose(null);
      return;
    }
    const first = compose.empty && !this.parts.empty;
    this.parts = compose;
    if (first && !this.stage.scene) {
      this.stage.view = { x: 0, y: 0, scale: FIRST };
      this.choose(TOOLS.find(({ id }) => id === "body"));
      this.stage.draw();
    } else if (this.tool) {
      this.panel.refill(compose);
    }
    if (this.other && this.other.text !== snapshot.text) this.other = null;
    this.draw();
  }

  // Tools and their fields

  choose(tool) {
    this.tool = tool;
    this.stage.tool = tool;
    document.body.classList.toggle("composing", Boolean(tool));
    this.buttons.forEach((button, i) => button.setAttribute("aria-pressed", String(TOOLS[i] === tool)));
    this.panel.place.hidden = !tool;
    this.hover = null;
    this.selected = null;
    this.other = null;
    if (tool) {
      // Parts that are added do not move the view under the pointer.
      this.stage.fitted = false;
      this.page.began();
      this.fill();
    }
    this.draw();
  }

  /** The fields of the tool, empty. */
  fill() {
    this.panel.fill(this.tool, this.parts);
    this.say(this.prompt());
    if (this.tool.id === "goal") this.preview(null);
  }

  /** Selects a part by its key; of a dyad the other solution is shown. */
  async select(key) {
    this.selected = key || null;
    this.other = null;
    const part = byId("compose-part");
    part.value = key;
    byId("compose-name").value = key.split(".").pop();
    byId("form").querySelector(`[data-key="${CSS.escape(key)}"]`)?.scrollIntoView({ block: "nearest" });
    this.say(key ? `${part.selectedOptions[0]?.textContent ?? key} is selected.` : this.prompt());
    const answer = key.startsWith("dyads.") ? await this.ask({ part: "other", key }) : null;
    if (answer?.other && this.selected === key) this.offer(answer.other);
    this.draw();
  }

  // What is said

  /** Something was typed or chosen. */
  changed() {
    this.say(this.prompt());
    this.draw();
    this.preview(this.hover);
  }

  say(words, buttons) {
    this.panel.say(words, buttons);
  }

  prompt() {
    const { tool, parts } = this;
    if (!tool) return "";
    if (tool.id === "select") return "Click a part, or choose it from the list.";
    if (tool.id === "goal") return "Click a point, or choose a figure; its value now is the limit that is offered.";
    if (parts.empty && tool.id === "body" && this.panel.due) return "Click where the crank turns.";
    return this.panel.due?.prompt ?? tool.place;
  }

  refuse({ refused, nearest, dependents }, at) {
    const buttons = [];
    if (nearest) {
      const words = Object.values(nearest).join(" and ");
      buttons.push(["compose-nearest", `Use ${words}`, () => {
        for (const [key, value] of Object.entries(nearest)) this.panel.controls.get(key).input.value = value;
        this.add(at);
      }]);
    }
    if (dependents) buttons.push(["compose-all", "Delete them all", () => this.change({ part: "delete", all: true })]);
    this.say(brief(refused), buttons);
    this.panel.status.classList.add("error");
  }

  // What is requested

  /** The answer to a gesture on the design as it is; null if there is none. */
  async ask(own) {
    try {
      return await server.compose(this.page.text(), this.page.input(), own);
    } catch (error) {
      this.page.complain("compose", error);
      return null;
    }
  }

  /** Shows the part as it would be, with the numbers as they would be measured. */
  async preview(at) {
    const { tool } = this;
    if (!tool || tool.id === "select" || this.panel.missing) return;
    this.asked += 1;
    if (this.busy) return;
    this.busy = true;
    let seen = 0;
    let answer = null;
    while (seen !== this.asked && this.tool === tool && !this.panel.missing) {
      seen = this.asked;
      try {
        answer = await this.ask(gesture(tool, this.panel.values, this.hover ?? at));
      } catch {
        // What is being typed is not complete.
        answer = null;
      }
    }
    this.busy = false;
    if (this.tool !== tool) return;
    this.ghost = answer?.lines ?? [];
    for (const { field, input } of this.panel.controls.values()) {
      const value = answer?.numbers?.[field.id];
      if (field.kind === "number") input.placeholder = value === undefined ? "" : String(value);
    }
    this.draw();
  }

  /** Adds the part that the fields and the place describe. */
  async add(at) {
    // A second click while a part is on its way adds no other.
    if (this.adding) return;
    this.adding = true;
    try {
      await this.put(at);
    } finally {
      this.adding = false;
    }
  }

  async put(at) {
    const { tool } = this;
    if (!tool || tool.id === "select") return;
    await this.page.settled();
    const { missing } = this.panel;
    if (missing) {
      this.panel.controls.get(missing.id).input.focus();
      return;
    }
    let own;
    try {
      own = gesture(tool, this.panel.values, at);
    } catch (error) {
      this.refuse({ refused: error.message });
      return;
    }
    const answer = await this.ask(own);
    if (!answer || this.tool !== tool) return;
    if (answer.refused) {
      this.refuse(answer, at);
      return;
    }
    const heldBy = this.panel.place.contains(document.activeElement) ? document.activeElement.id : null;
    this.took(answer);
    this.hover = null;
    this.ghost = [];
    this.fill();
    if (answer.key.startsWith("bodies.")) this.parts.empty = false;
    this.say(`Part ${answer.key.split(".").pop()} is added.${answer.other ? " The dashed ghost is the other solution: click it to choose it. " : " "}${this.prompt()}`);
    if (heldBy) (byId(heldBy) ?? this.panel.place.querySelector("select, input")).focus();
  }

  /** Takes the text of an answer as one step. */
  took(answer) {
    this.page.take(answer.text);
    if (answer.other) this.offer(answer.other, answer.text);
    else this.other = null;
  }

  /** Renames, copies or deletes the part that is selected. */
  async change(own) {
    const key = byId("compose-part").value;
    if (!key) {
      this.refuse({ refused: "select a part first" });
      return;
    }
    await this.page.settled();
    const answer = await this.ask({ ...own, key });
    if (!answer) return;
    if (answer.refused) {
      this.refuse(answer);
      return;
    }
    this.took(answer);
    await this.page.settled();
    await this.page.shown();
    this.panel.refill(this.parts);
    await this.select(this.parts.parts.includes(answer.key) ? answer.key : "");
  }

  /** The other solution, to be clicked while its design is shown. */
  offer(other, text = this.page.text()) {
    this.other = { ...other, text, input: this.page.input() };
  }

  // The picture

  listen() {
    const { box } = this.stage;
    let pressed = null;
    box.addEventListener("pointerdown", (event) => {
      pressed = this.tool && event.button === 0 && !event.target.closest("button, label, select, .handle, .other") ? this.picking.at(event) : null;
    });
    box.addEventListener("pointermove", (event) => {
      if (!this.tool || event.buttons || event.pointerType === "touch") return;
      this.point(this.picking.at(event));
    });
    box.addEventListener("pointerup", (event) => {
      const at = this.picking.at(event);
      const still = pressed && Math.hypot(at[0] - pressed[0], at[1] - pressed[1]) < STILL;
      pressed = null;
      if (still) this.click(at);
    });
    box.addEventListener("pointerleave", () => {
      this.near = null;
      this.draw();
    });
    box.addEventListener("keydown", (event) => {
      if (event.target !== box || event.ctrlKey || event.metaKey || event.altKey || this.place.hidden) return;
      const tool = TOOLS.find(({ key }) => key === event.key);
      const first = [...this.panel.controls.values()].find(({ field }) => field.kind === "number");
      if (tool) this.choose(tool);
      else if (this.tool && first && /^[\d.]$/.test(event.key)) Object.assign(first.input, { value: "" }).focus();
      else return;
      if (tool) event.preventDefault();
    });
    for (const place of [box, this.place]) {
      place.addEventListener("keydown", (event) => {
        if (event.key === "Escape" && this.tool) {
          this.choose(null);
          box.focus();
        }
      });
    }
  }

  /** The pointer is here: what a click would take is named. */
  point(pixels) {
    const due = this.panel.due;
    const wants = due?.kind ?? (this.tool.id === "select" || this.tool.id === "goal" ? "any" : "place");
    const point = wants === "body" ? null : this.picking.point(pixels);
    const name = point ?? this.parts.bodies[this.picking.body(pixels, wants === "body")]?.name ?? "frame";
    const words = point ?? (wants === "pin" ? `new point on ${name}` : wants === "place" && this.tool.id !== "point" ? "" : name);
    this.near = { pixels, words };
    if (wants === "place" && !this.panel.due) {
      this.hover = this.picking.place(pixels);
      if (this.tool.id !== "point") this.preview(this.hover);
    }
    this.draw();
  }

  click(pixels) {
    const { tool, picking } = this;
    const point = picking.point(pixels);
    const body = this.parts.bodies[picking.body(pixels, this.panel.due?.kind === "body")];
    if (tool.id === "select") {
      const key = this.parts.parts.find((own) => point && new RegExp(`(^|\\.)${point.replace(".", "\\.(points|corners)\\.")}$`).test(own));
      this.select(key ?? (this.parts.parts.includes(body.key) ? body.key : ""));
      return;
    }
    if (tool.id === "goal") {
      const figure = this.parts.figures.find((own) => own.startsWith(`${point ?? body.name}.`));
      if (figure) this.panel.controls.get("figure").input.value = figure;
      this.preview(null);
      return;
    }
    const due = this.panel.due;
    if (!due) {
      if (tool.id === "point" && !this.panel.controls.get("on").input.value) this.panel.controls.get("on").input.value = body.name;
      this.add(picking.place(pixels));
      return;
    }
    this.other = null;
    this.panel.pick(due, point, body.name, picking.place(pixels));
    this.say(this.prompt());
    this.draw();
  }

  /** Draws points to click, picks, the ghost of the part to come, and the other solution. */
  draw() {
    const { stage, tool } = this;
    if (!tool && !this.other && !this.marks.firstChild && !this.ghostMark) return;
    if (this.other && this.other.input !== this.page.input()) this.other = null;
    const lines = (list, name) => list.map(([a, b]) => {
      const [[x1, y1], [x2, y2]] = [stage.toBox(...a), stage.toBox(...b)];
      return drawn("line", { class: name, x1, y1, x2, y2 });
    });
    const parts = [];
    if (tool) {
      if (this.parts.empty) parts.push(...lines(GROUND, "ground"));
      const picked = new Set([...this.panel.controls.values()].map(({ input }) => input.value));
      for (const { name, link, at } of this.parts.points) {
        const [cx, cy] = this.picking.pixels(link, at);
        parts.push(drawn("circle", { class: picked.has(name) ? "pick picked" : "pick", cx, cy, r: 5 }));
      }
      for (const { input, at } of this.panel.controls.values()) {
        const place = at && input.value.startsWith("+") ? at.map((box) => Number(box.value)) : null;
        if (!place || at.some((box) => box.value === "")) continue;
        const [cx, cy] = stage.toBox(...place);
        parts.push(drawn("circle", { class: "pick picked", cx, cy, r: 5 }));
      }
      parts.push(...lines(this.ghost ?? [], "to-come"));
      if (this.near?.words) {
        const [x, y] = this.near.pixels;
        const right = x > stage.width - 160;
        const words = drawn("text", { class: "near", x: right ? x - 12 : x + 14, y: y - 10, "text-anchor": right ? "end" : "start" });
        words.textContent = this.near.words;
        parts.push(words);
      }
    }
    this.marks.replaceChildren(...parts);
    this.drawOther(lines);
  }

  /** Draws the other solution, as an element that stays while the pointer is on it. */
  drawOther(lines) {
    const { other } = this;
    // The pins at which its lines begin stay free for clicks.
    const free = other?.lines.map(([[x, y], b]) => [[x + 0.4 * (b[0] - x), y + 0.4 * (b[1] - y)], b]);
    const drawings = other ? [...lines(free, "reach"), ...lines(other.lines, "line")] : [];
    const where = drawings.map((line) => line.outerHTML).join("");
    if (this.where === where) return;
    this.where = where;
    this.ghostMark?.remove();
    this.ghostMark = null;
    if (!other) return;
    const take = () => {
      this.other = null;
      this.page.edit(other.edits);
      this.stage.box.focus();
      this.draw();
    };
    this.ghostMark = this.layer.appendChild(drawn("g", { class: "other", role: "button", tabindex: 0, "aria-label": "Choose the other solution" }));
    this.ghostMark.append(...drawings);
    this.ghostMark.addEventListener("click", take);
    this.ghostMark.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" && event.key !== " ") return;
      event.preventDefault();
      event.stopPropagation();
      take();
    });
  }
}
