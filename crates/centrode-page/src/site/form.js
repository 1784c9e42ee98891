// The numbers of the design, one field a key.

import { byId, element, fault, symbol, words } from "./elements.js";
import { first } from "./essentials.js";
import { Find } from "./find.js";
import * as hints from "./hints.js";
import { brief, decimal, stepOf, stepped, tidy, typed, worked } from "./numbers.js";
import { Points, pointsOf } from "./points.js";

const SLOW = 4;

/** How much room a field takes. */
function sizeOf(field) {
  if (Array.isArray(field.value)) return "list";
  return ["text", "choice", "either"].includes(field.kind) ? "wordy" : "";
}

export class Form {
  /** `edit(edits, final)` takes new values; `fixed` shows them only, `brief` the essential ones first. */
  constructor({ edit, hold, respond, add, fixed, brief }) {
    this.edit = edit;
    /** Adds a table to the file. */
    this.add = add;
    /** Whether the essential numbers are shown first. */
    this.brief = brief && !fixed;
    this.tables = [];
    /** Told when a drag of a number begins and ends. */
    this.hold = hold;
    this.respond = respond;
    this.fixed = fixed;
    this.place = byId("form");
    this.shape = "";
    this.controls = new Map();
    /** Points of curves, by the tables they are in. */
    this.points = new Map();
    this.find = new Find(this);
    /** Id of what gets the focus once it is there. */
    this.wish = null;
    this.folded = new Set(["drawing"]);
    /** Tables without a value that were opened all the same. */
    this.unfolded = new Set();
    /** Whether the last design was none, and the tables of the last that was one. */
    this.failed = false;
    this.good = [];
    /** Grows with every change of an input, which keeps the number it was changed at. */
    this.clock = 0;
    this.changed = new WeakMap();
    hints.listen(this);
    this.place.addEventListener("input", ({ target }) => this.touch(target));
  }

  /** An input has been given something. */
  touch(input) {
    this.clock += 1;
    this.changed.set(input, this.clock);
  }

  /** Whether an input was edited since the request of the shown design. */
  isAhead(input) {
    return (this.changed.get(input) ?? 0) > this.asked;
  }

  /** Shows a design; `asked` is the clock at its request: later edits stay. */
  show(snapshot, asked = this.clock) {
    this.asked = asked;
    const shape = JSON.stringify(snapshot.tables.map((table) => [table.key, table.absent, table.fields.map((field) =>
      [field.key, field.kind, Array.isArray(field.value) ? field.value.length : 0, field.choices])]));
    if (shape !== this.shape) this.build(snapshot.tables);
    this.shape = shape;
    const wish = this.wish && byId(this.wish);
    if (wish) {
      wish.focus();
      this.wish = null;
    }
    for (const table of snapshot.tables) {
      for (const field of table.fields) this.fill(field);
    }
    this.remark(snapshot);
    this.find.again();
  }

  /** The control of a key, or of the nearest around it. */
  near(key) {
    for (let path = key; path; path = path.replace(/(\[\d+\]|\.?[^.[\]]+)$/, "")) {
      if (this.controls.has(path)) return this.controls.get(path);
    }
    return undefined;
  }

  /** Builds the form of the same design again, filled. */
  rebuild() {
    this.build(this.tables);
    for (const table of this.tables) for (const field of table.fields) this.fill(field);
  }

  build(tables) {
    this.tables = tables;
    const focused = document.activeElement;
    const typing = (input) => input === focused && input.type === "text" && input.value !== input.dataset.value;
    const all = [...this.controls.values()].flatMap((control) => control.inputs);
    const ahead = all.filter((input) => typing(input) || this.isAhead(input));
    const [start, end] = ahead.includes(focused) ? [focused.selectionStart, focused.selectionEnd] : [];
    this.controls.clear();
    this.points.clear();
    const there = tables.filter((table) => !table.absent && (table.fields.length || table.actions));
    this.place.replaceChildren(this.find.place, ...there.map((table) => this.table(table)));
    if (!this.fixed) this.offer(tables);
    if (this.find.few.checked) this.lead(tables);
    for (const old of ahead) this.carry(old, byId(old.id));
    const again = focused?.id ? byId(focused.id) : null;
    again?.focus();
    if (start !== undefined && again?.type === "text") again.setSelectionRange(start, end);
  }

  /** Copies the text of an input to the one that replaces it. */
  carry(old, input) {
    if (input?.type !== old.type) return;
    if (old.tagName === "SELECT") input.replaceChildren(...old.children);
    input.checked = old.checked;
    input.value = old.value;
    if (this.changed.has(old)) this.changed.set(input, this.changed.get(old));
    // The browser reports a change only of what was typed into this very element.
    input.addEventListener("blur", () => {
      if (input.value !== input.dataset.value) input.dispatchEvent(new Event("change"));
    }, { once: true });
  }

  table(table) {
    const name = table.title ?? (table.key ? table.key.split(".").map(words).join(" · ") : "General");
    const fold = element("details", { class: "table", "data-key": table.key },
      element("summary", { title: table.doc || undefined }, name),
      ...this.rows(table), this.actions(table));
    const isBlank = (value) => value === null || (Array.isArray(value) && value.every(isBlank));
    const fully = this.folded.has(table.key) || (table.optional && !this.unfolded.has(table.key) && table.fields.every((field) => isBlank(field.value)));
    fold.open = this.fixed || !fully;
    fold.addEventListener("toggle", () => {
      this.folded[fold.open ? "delete" : "add"](table.key);
      this.unfolded[fold.open ? "add" : "delete"](table.key);
    });
    const remark = element("p", { class: "remark", id: `remark-${table.key}` });
    fold.querySelector("summary").after(remark);
    if (table.key) this.controls.set(table.key, { field: null, remark, row: fold, inputs: [] });
    return fold;
  }

  /** Tables that are not in the file, each a name in the grey line of the table around it. */
  offer(tables) {
    const absent = tables.filter(({ addable }) => addable);
    for (const { key, doc } of absent) {
      const around = key.split(".").slice(0, -1).join(".");
      const fold = [...this.place.querySelectorAll("details.table")].find(({ dataset }) => dataset.key === around) ?? this.place.querySelector("details.table");
      if (!fold) continue;
      const line = fold.querySelector(".absent") ?? fold.appendChild(element("p", { class: "absent" }));
      const name = words(key);
      line.append(element("button", { type: "button", id: `add-${key}`, title: `Add ${name}. ${doc}`, onclick: () => {
        this.unfolded.add(key);
        this.add(key);
      } }, `+ ${name}`));
    }
  }

  /** The essential numbers first, under a title of their own. */
  lead(tables) {
    const rows = first(tables).map((key) => this.controls.get(key)?.row.closest(".points, .field")).filter((row) => row?.matches(".field"));
    if (rows.length < 3) return;
    for (const label of rows.map((row) => row.querySelector("label"))) {
      // The table in which it is, which is not around it here.
      const around = label.htmlFor.replace("field-", "").split(".").at(-2);
      if (around) label.prepend(element("span", { class: "around" }, `${words(around)} · `));
    }
    const section = element("section", { class: "table first", "aria-label": "Essentials" }, element("h2", {}, "Essentials"), ...rows);
    this.find.place.after(section);
  }

  /** Buttons of a table that do more than change a value. */
  actions({ actions }) {
    if (!actions || this.fixed) return null;
    const button = ({ id, words: name, title, act }) => element("button", { type: "button", id, title, onclick: act }, name);
    return element("p", { class: "group actions" }, ...actions.map(button));
  }

  /** The fields of a table, two lists of a curve's points as one. */
  rows(table) {
    const pair = pointsOf(table);
    if (!pair) return table.fields.map((field) => this.row(field));
    const points = new Points(this, table.key, pair, table.points);
    this.points.set(table.key, points);
    return table.fields.flatMap((field) => {
      if (field === pair[0]) return [points.place];
      return pair.includes(field) ? [] : [this.row(field)];
    });
  }

  row(field) {
    const id = `field-${field.key}`;
    const remark = element("p", { class: "remark", id: `remark-${field.key}` });
    const control = { field, remark, inputs: [] };
    this.controls.set(field.key, control);
    const label = element("label", { for: id, title: field.doc || undefined }, field.label ?? words(field.key), ...(field.symbol ? [" ", symbol(field.symbol)] : []));
    const boxes = this.inputs(field, id, control);
    const unit = element("span", { class: "unit" }, field.unit);
    control.row = element("div", { class: `field ${sizeOf(field)}` }, label, boxes, unit, remark);
    if (["number", "integer"].includes(field.kind) && !this.fixed) {
      this.draggable(label, control);
      // Keys have F4 for it: a stop at each number on the way through the form would be too many.
      unit.after(element("button", { type: "button", class: "respond", tabindex: -1, title: "How goals and paths respond to this number (F4)",
        "aria-label": `Response to ${words(field.key)}`, onclick: () => this.respond(field.key) }, "∿"));
    }
    return control.row;
  }

  inputs(field, id, control) {
    const common = { id, "aria-describedby": `remark-${field.key}`, disabled: this.fixed };
    const give = (value, final = true) => this.edit([{ key: field.key, value }], final);
    if (field.kind === "choice") {
      const select = element("select", { ...common, onchange: () => give(select.value || null) });
      control.inputs = [select];
      return select;
    }
    if (field.kind === "switch") {
      const box = element("input", { ...common, type: "checkbox", onchange: () => give(box.checked) });
      control.inputs = [box];
      return box;
    }
    if (Array.isArray(field.value) && ["numbers", "integers"].includes(field.kind)) {
      const few = field.value.length < 4 ? ` of-${field.value.length}` : "";
      const list = element("div", { class: `numbers${few}`, role: "group", "aria-label": field.label ?? words(field.key) });
      control.inputs = field.value.map((_, i) => this.number(field, `${field.key}[${i}]`, {
        ...common, id: i ? `${id}-${i}` : id, "aria-label": `${field.label ?? words(field.key)} ${field.holders?.[i] ?? i + 1}`,
      }));
      list.append(...control.inputs);
      return list;
    }
    if (field.kind === "number" || field.kind === "integer") {
      control.inputs = [this.number(field, field.key, common)];
      return control.inputs[0];
    }
    const listId = field.choices?.length ? `${id}-words` : undefined;
    const box = element("input", { ...common, type: "text", spellcheck: "false", autocomplete: "off", list: listId, onchange: () => {
      const list = ["numbers", "integers"].includes(field.kind);
      const value = list ? box.value.split(/[\s;]+/).filter(Boolean).map(typed) : field.kind === "either" ? typed(box.value) : box.value;
      give(box.value === "" && field.optional ? null : value);
    } });
    control.inputs = [box];
    if (!listId) return box;
    return element("span", {}, box, element("datalist", { id: listId }, ...field.choices.map(({ word }) => element("option", { value: word }))));
  }

  /** An input for one number: typed, or moved by the arrow keys. */
  number(field, key, attributes) {
    const box = element("input", { ...attributes, type: "text", inputmode: "decimal", class: "number", role: "spinbutton", spellcheck: "false", autocomplete: "off",
      "aria-valuemin": field.minimum === undefined ? undefined : decimal(field.minimum), "aria-valuemax": field.maximum === undefined ? undefined : decimal(field.maximum) });
    const give = (value) => this.edit([{ key, value }], true);
    // Of one size while the keys are at it: as many steps down as up lead back.
    let step = 1;
    const measure = () => {
      step = stepOf(field, typed(box.value));
    };
    box.addEventListener("focus", measure);
    box.addEventListener("change", () => {
      const value = worked(box.value, field.unit);
      // The result replaces the formula it was computed from.
      if (typeof value === "number" && typed(box.value) !== value) box.value = String(value);
      measure();
      if (value === "" && field.optional && key === field.key) give(null);
      else give(value);
    });
    box.addEventListener("keydown", (event) => {
      if (event.key === "F4" && !event.ctrlKey && !event.altKey && !event.metaKey) {
        event.preventDefault();
        box.blur();
        this.respond(key);
        return;
      }
      if (event.key === "Enter") {
        box.select();
        return;
      }
      const way = { ArrowUp: 1, ArrowDown: -1, PageUp: 10, PageDown: -10 }[event.key];
      const value = typed(box.value);
      if (!way || typeof value !== "number" || event.ctrlKey || event.metaKey) return;
      event.preventDefault();
      const coarser = event.shiftKey ? 10 : event.altKey && field.kind !== "integer" ? 0.1 : 1;
      const next = stepped(value, way, tidy(step * coarser));
      box.value = String(next);
      this.touch(box);
      give(next);
    });
    return box;
  }

  /** Dragging the name of a number sideways changes it. */
  draggable(label, control) {
    label.classList.add("draggable");
    let start = null;
    label.addEventListener("pointerdown", (event) => {
      const value = typed(control.inputs[0].value);
      if (event.button !== 0 || typeof value !== "number") return;
      label.setPointerCapture(event.pointerId);
      this.hold(true);
      start = { x: event.clientX, value, step: stepOf(control.field, value), now: value, moved: false };
    });
    const follow = (event, final) => {
      if (!start) return;
      const count = Math.round((event.clientX - start.x) / SLOW);
      const next = stepped(start.value, count, start.step);
      start.moved ||= count !== 0;
      if (start.moved && (final || next !== start.now)) {
        start.now = next;
        control.inputs[0].value = String(next);
        this.touch(control.inputs[0]);
        this.edit([{ key: control.field.key, value: next }], final);
      }
      if (!final) return;
      start = null;
      this.hold(false);
    };
    label.addEventListener("pointermove", (event) => follow(event, false));
    label.addEventListener("pointerup", (event) => follow(event, true));
    label.addEventListener("pointercancel", (event) => follow(event, true));
  }

  fill(field) {
    const control = this.controls.get(field.key);
    // A table that is not in the file has no controls.
    if (!control) return;
    control.field = field;
    const values = Array.isArray(field.value) && control.inputs.length > 1 ? field.value : [field.value];
    // Most numbers stay as they are, and writing them again would have the browser lay them out again.
    const filled = JSON.stringify([field.value, field.written, field.choices]);
    const shown = control.inputs.every((input) => input.type === "checkbox" ? input.checked === Boolean(field.value) : input.value === input.dataset.value);
    if (control.filled === filled && shown) return;
    control.filled = filled;
    control.row.classList.toggle("written", field.written);
    control.inputs.forEach((input, i) => {
      if (this.isAhead(input)) return;
      const value = Array.isArray(values[i]) ? (values[i].length === 1 ? values[i][0] : values[i].join(" ")) : values[i];
      if (input.type === "checkbox") {
        input.checked = Boolean(value);
      } else if (input.tagName === "SELECT") {
        this.options(input, field, value);
      } else {
        const text = value === null || value === undefined ? "" : String(value);
        input.placeholder = field.holders?.[i] ?? (field.optional && field.value === null ? "auto" : "");
        // What is being typed is not touched, nor what is on its way; a number changed elsewhere is not being typed.
        const idle = input.value === (input.dataset.value ?? "");
        input.dataset.value = text;
        if (typeof value === "number") input.setAttribute("aria-valuenow", decimal(value));
        else input.removeAttribute("aria-valuenow");
        if (document.activeElement !== input || idle || typed(input.value) === value) input.value = text;
      }
    });
  }

  options(select, field, value) {
    const list = field.choices.map(({ word, doc }) => element("option", { value: word, title: doc || undefined }, word));
    if (value !== null && !field.choices.some(({ word }) => word === value)) {
      list.unshift(element("option", { value: String(value) }, String(value)));
    }
    if (value === null || field.optional && field.value === null) list.unshift(element("option", { value: "" }, "auto"));
    select.replaceChildren(...list);
    select.value = value ?? "";
    select.disabled = this.fixed;
    select.dataset.value = select.value;
  }

  /** The key at fault: where only its table is known, that of the one number in it that has changed since the last good design. */
  blamed(key, { tables }) {
    if (this.near(key)?.field !== null) return key;
    const within = (tables) => tables.flatMap(({ fields }) => fields).filter((field) => field.key.startsWith(`${key}.`));
    const good = new Map(within(this.good).map((field) => [field.key, JSON.stringify(field.value)]));
    const changed = within(tables).filter((field) => good.get(field.key) !== JSON.stringify(field.value));
    return changed.length === 1 ? changed[0].key : key;
  }

  /** Errors and findings next to what causes them. */
  remark(snapshot) {
    const remarks = new Map();
    const put = (key, severity, message) => {
      const control = this.near(key);
      if (control) remarks.set(control, [...(remarks.get(control) ?? []), { severity, message }]);
    };
    const wrong = snapshot.error ?? snapshot.detail;
    if (wrong) put(this.blamed(wrong.key, snapshot), "error", brief(fault(wrong)));
    else this.good = snapshot.tables;
    for (const finding of snapshot.error ? [] : snapshot.verdict?.findings ?? []) {
      const cause = finding.causes.find((key) => {
        const control = this.controls.get(key);
        return control && control.field?.value !== null;
      });
      if (cause && finding.severity !== "note") put(cause, finding.severity, `${finding.rule}: ${brief(finding.message)}`);
    }
    // Until the checks are done their last remarks stay, but those of an error that is no more do not.
    if (!wrong && !snapshot.verdict && !this.failed) return;
    this.failed = Boolean(wrong);
    for (const control of this.controls.values()) {
      const list = remarks.get(control) ?? [];
      const said = JSON.stringify(list);
      if (control.said === said) continue;
      control.said = said;
      control.remark.replaceChildren(...list.map(({ severity, message }) =>
        element("span", { class: severity }, element("b", {}, `${severity} `), message)));
      const bad = list.some(({ severity }) => severity === "error");
      for (const input of control.inputs) input.setAttribute("aria-invalid", String(bad));
      if (list.length && control.row.tagName === "DETAILS") control.row.open = true;
      const fold = list.length ? control.row.closest("details") : null;
      if (fold) fold.open = true;
    }
  }
}
