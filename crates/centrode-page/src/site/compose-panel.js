// The fields of the tool with which a machine is composed: clicks fill them in, and so do keys.

import { byId, element } from "./elements.js";
import { worked } from "./numbers.js";

/** What a table of the design holds, in words. */
const KINDS = { bodies: "body", dyads: "dyad", pairs: "gear pair", gears: "gear", meshes: "mesh", cams: "cam", copies: "copies", loads: "load", obstacles: "obstacle", goals: "goal" };

/** A part in words, by its key. */
function named(key) {
  const steps = key.split(".");
  if (steps.includes("points") || steps.includes("corners")) return `point ${steps.at(-3)}.${steps.at(-1)}`;
  return `${KINDS[steps[0]] ?? steps[0]} ${steps[1]}`;
}

/** What a select offers, with its choice kept. */
function offer(select, list) {
  const now = select.value;
  select.replaceChildren(...list.map(([value, words]) => element("option", { value }, words)));
  if (list.some(([value]) => value === now)) select.value = now;
}

export class ComposePanel {
  /** `page.changed()` hears of what is typed, `page.select(key)` and `page.change(gesture)` of the part that is selected, `page.leave()` ends the tool. */
  constructor(page) {
    this.page = page;
    this.place = byId("compose-panel");
    this.status = element("p", { id: "compose-status", role: "status" });
    /** Controls of the fields by id. */
    this.controls = new Map();
    this.parts = null;
    this.tool = null;
  }

  /** The fields of a tool, empty. */
  fill(tool, parts) {
    this.parts = parts;
    this.tool = tool;
    this.controls.clear();
    const rows = tool.fields.map((field) => this.field(field));
    const end = tool.id === "select" ? this.selection() : [element("button", { id: "compose-add", class: "main" }, "Add")];
    this.place.setAttribute("aria-label", tool.title);
    this.place.replaceChildren(...rows, ...end, element("button", { type: "button", id: "compose-done", title: "Leave the tool (Esc)", onclick: () => this.page.leave() }, "Done"), this.status);
  }

  /** Lists follow the design. */
  refill(parts) {
    this.parts = parts;
    for (const { field, input } of this.controls.values()) {
      const list = this.choices(field);
      if (list) offer(input, list);
    }
    if (this.tool.id === "select") offer(byId("compose-part"), this.listed());
  }

  /** What a list of a field offers; null for a field that is no list. */
  choices({ kind, choices }) {
    const { points, bodies, figures } = this.parts;
    if (kind === "choice") return choices;
    if (kind === "pin") return [["", "click, or choose"], ...points.map(({ name }) => [name, name]), ...bodies.map(({ name }) => [`+${name}`, `new point on ${name}`])];
    if (kind === "body") return [["", "click, or choose"], ...bodies.map(({ name }) => [name, name])];
    if (kind === "figure") return figures.map((words) => [words, words]);
    return null;
  }

  field(field) {
    const id = `compose-${field.id}`;
    const list = this.choices(field);
    const input = list ? element("select", { id }) : element("input", { id, type: "text", inputmode: "decimal", class: "number", autocomplete: "off", spellcheck: "false" });
    if (list) offer(input, list);
    const control = { field, input };
    this.controls.set(field.id, control);
    const row = element("span", { class: "compose-field" }, element("label", { for: id }, field.words), input);
    if (field.unit) row.append(element("span", { class: "unit" }, field.unit));
    if (field.kind === "pin") {
      // Coordinates of a new point, which a click fills in.
      const box = (axis) => element("input", { type: "text", inputmode: "decimal", class: "number", id: `${id}-${axis}`, "aria-label": `${field.words}: ${axis}`, autocomplete: "off" });
      control.at = [box("x"), box("y")];
      control.where = element("span", { class: "compose-where", hidden: true }, "x", control.at[0], "y", control.at[1]);
      row.append(control.where);
      input.addEventListener("change", () => {
        control.where.hidden = !input.value.startsWith("+");
      });
    }
    row.addEventListener("change", () => this.page.changed());
    return row;
  }

  /** Fields of the tool that selects. */
  selection() {
    const part = element("select", { id: "compose-part", onchange: () => this.page.select(part.value) });
    offer(part, this.listed());
    const name = element("input", { id: "compose-name", type: "text", autocomplete: "off", spellcheck: "false" });
    const button = (id, words, act) => element("button", { type: "button", id: `compose-${id}`, onclick: act }, words);
    name.addEventListener("keydown", (event) => {
      if (event.key !== "Enter") return;
      event.preventDefault();
      this.page.change({ part: "rename", to: name.value.trim() });
    });
    return [
      element("span", { class: "compose-field" }, element("label", { for: "compose-part" }, "Part"), part),
      element("span", { class: "compose-field" }, element("label", { for: "compose-name" }, "Name"), name),
      button("rename", "Rename", () => this.page.change({ part: "rename", to: name.value.trim() })),
      button("copy", "Copy", () => this.page.change({ part: "copy" })),
      button("delete", "Delete", () => this.page.change({ part: "delete" })),
    ];
  }

  /** The parts as a list. */
  listed() {
    return [["", "click, or choose"], ...this.parts.parts.map((key) => [key, named(key)])];
  }

  /** The pick that is due: the first field without a value, or the place. */
  get due() {
    return [...this.controls.values()].find(({ field, input }) => ["pin", "body"].includes(field.kind) && !input.value && field.prompt)?.field ?? null;
  }

  /** The first pick without a value, whether a click or a list is to fill it; a gesture is complete without any. */
  get missing() {
    return [...this.controls.values()].find(({ field, input }) => ["pin", "body", "figure"].includes(field.kind) && !input.value)?.field ?? null;
  }

  /** Writes what was clicked into the field of a pick: a point, or a new point of a body. */
  pick({ id, kind }, point, body, place) {
    const control = this.controls.get(id);
    if (kind === "body") {
      control.input.value = body;
      return;
    }
    control.input.value = point ?? `+${body}`;
    control.where.hidden = Boolean(point);
    if (!point) place.forEach((value, i) => Object.assign(control.at[i], { value }));
  }

  /** Values of the fields as a gesture takes them. */
  get values() {
    const found = {};
    for (const { field, input, at } of this.controls.values()) {
      const text = input.value.trim();
      if (text === "") continue;
      if (field.kind === "number") {
        const value = worked(text, field.unit);
        if (typeof value !== "number") throw new Error(`${field.words}: ${text} is not a number`);
        found[field.id] = value;
      } else if (field.kind === "pin" && text.startsWith("+")) {
        const place = at.map((box) => worked(box.value, "mm"));
        if (place.some((value) => typeof value !== "number")) throw new Error(`${field.words}: give x and y of the new point`);
        found[field.id] = { body: text.slice(1), at: place };
      } else {
        found[field.id] = text;
      }
    }
    return found;
  }

  say(words, buttons = []) {
    this.status.classList.remove("error");
    this.status.replaceChildren(words, ...buttons.map(([id, name, act]) => element("button", { type: "button", id, onclick: act }, name)));
  }
}
