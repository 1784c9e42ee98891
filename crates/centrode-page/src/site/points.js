// Points of a curve as a table: typed, added, deleted, and pasted from a spreadsheet.

import { ask } from "./dialogs.js";
import { element, symbol, words } from "./elements.js";
import { typed } from "./numbers.js";

/** Lists that hold the coordinates of points where a table has both. */
const PAIRS = [["radius", "angle_deg"], ["x", "y"]];
/** Fewer points make no curve. */
const FEWEST = 3;

const capital = (word) => word.charAt(0).toUpperCase() + word.slice(1);

/** A coordinate with no more digits than one reads. */
const short = (value) => Number(value.toFixed(3));

/** The lists of points of a table, two or as many as it has columns; null where it has none. */
export function pointsOf({ key, fields, points }) {
  const named = (name) => fields.find((field) => field.key === `${key}.${name}`);
  if (points) return points.columns.map(named);
  if (named("kind")?.value !== "bspline") return null;
  const pairs = PAIRS.map((names) => names.map(named));
  const lists = pairs.find((pair) => pair.every((field) => Array.isArray(field?.value) && field.value.length > 1));
  return lists && lists[0].value.length === lists[1].value.length ? lists : null;
}

/** The cells of a line of a spreadsheet, or of a text. */
function cells(line) {
  if (/[\t;]/.test(line.trim())) return line.replace(/[\t; ]+$/, "").split(/[\t;]/).map((cell) => cell.trim());
  const plain = line.trim();
  if (/\s/.test(plain)) return plain.split(/\s+/).map((cell) => cell.replace(/,$/, "")).filter(Boolean);
  // A comma alone is that of a number, unless there are points as well or several commas.
  return /\..*,|,.*[.,]/.test(plain) ? plain.split(",") : [plain];
}

/** Rows of numbers in a text, without a head; an error names the line. Cells from the column `optional` on may be empty. */
export function rowsIn(text, optional = Infinity) {
  const lines = text.split(/\r\n|\r|\n/).map((line, i) => [i + 1, line]).filter(([, line]) => line.trim());
  const rows = lines.map(([number, line]) => [number, cells(line).map(typed)]);
  if (rows.length > 1 && rows[0][1].every((cell) => typeof cell !== "number")) rows.shift();
  for (const [number, row] of rows) {
    const wrong = row.find((cell, column) => typeof cell !== "number" && !(cell === "" && column >= optional));
    if (wrong !== undefined) return { error: `line ${number}: ${wrong === "" ? "a number is missing" : `${wrong} is no number`}` };
  }
  return { rows: rows.map(([number, row]) => Object.assign(row, { line: number })) };
}

/** A point between two others, as far out as they are. */
function between([a, b], [c, d], polar) {
  if (polar) return [short((a + c) / 2), short((b + d + (d < b ? 360 : 0)) / 2)];
  const [r, s] = [Math.hypot(a, b), Math.hypot(c, d)];
  const start = Math.atan2(b, a);
  const turn = Math.atan2(a * d - b * c, a * c + b * d);
  const angle = start + turn / 2;
  return [short(((r + s) / 2) * Math.cos(angle)), short(((r + s) / 2) * Math.sin(angle))];
}

export class Points {
  /**
   * Of `noun`s at least `fewest` are needed; a new one lies `halfway(points, i)` to the next. Through `smooth` ones a closed curve passes.
   * Cells from the column `optional` on may be empty.
   */
  constructor(form, key, pair, { smooth = false, fewest = FEWEST, noun = "point", halfway, optional = Infinity } = {}) {
    Object.assign(this, { smooth, fewest, noun, halfway, optional });
    this.form = form;
    this.key = key;
    this.pair = pair;
    this.polar = pair[0].key.endsWith(".radius");
    /** Points given but not answered for yet, and the form's clock then. */
    this.given = null;
    this.controls = pair.map((field) => {
      const remark = element("p", { class: "remark", id: `remark-${field.key}` });
      const row = element("th", { scope: "col", title: field.doc || undefined, "aria-label": field.heading && words(field.key) }, field.heading ?? words(field.key), ...(field.symbol ? [" ", symbol(field.symbol)] : []), " ", element("span", { class: "unit" }, field.unit));
      const control = { field, remark, row, inputs: [] };
      form.controls.set(field.key, control);
      return control;
    });
    const rows = pair[0].value.map((_, i) => this.row(i));
    const buttons = form.fixed ? null : element("button", { type: "button", id: `text-${key}`, class: "as-text", onclick: () => this.text() }, "As text …");
    const body = element("tbody", {}, ...rows);
    body.addEventListener("paste", (event) => this.paste(event));
    body.addEventListener("keydown", (event) => this.keyed(event));
    this.place = element("div", { class: pair.length > 3 ? "points wide" : "points" },
      element("table", { "aria-label": `${capital(this.noun)}s` }, element("thead", {}, element("tr", {}, element("th", { scope: "col" }, "No."), ...this.controls.map(({ row }) => row),
        form.fixed ? null : element("td", {}))), body),
      ...this.controls.map(({ remark }) => remark), buttons);
  }

  /** How many numbers each has, in words. */
  get many() {
    return ["two", "three"][Math.min(this.optional, this.pair.length) - 2] ?? String(this.pair.length);
  }

  /** Fewest numbers of a row. */
  get minimum() {
    return Math.min(this.optional, this.pair.length);
  }

  /** Id of an input of the table. */
  id(column, i) {
    return `field-${this.pair[column].key}${i ? `-${i}` : ""}`;
  }

  row(i) {
    const inputs = this.controls.map((control, column) => {
      const { field } = control;
      const input = this.form.number(field, `${field.key}[${i}]`, {
        id: this.id(column, i), "aria-label": `${words(field.key)} ${i + 1}`, "aria-describedby": `remark-${field.key}`, disabled: this.form.fixed,
      });
      input.dataset.row = i;
      input.dataset.column = column;
      control.inputs.push(input);
      return element("td", {}, input);
    });
    const button = (name, sign, title, act, disabled) => element("button", { type: "button", id: `${name}-${this.key}-${i}`, "aria-label": title, title, onclick: act, disabled }, sign);
    const count = this.pair[0].value.length;
    return element("tr", {}, element("th", { scope: "row" }, String(i + 1)), ...inputs, this.form.fixed ? null : element("td", { class: "act" },
      button("add", "+", `Add a ${this.noun} after ${this.noun} ${i + 1}`, () => this.add(i)),
      button("delete", "×", `Delete ${this.noun} ${i + 1}`, () => this.remove(i), count <= this.fewest)));
  }

  /** The points as they are now, given or typed. */
  get points() {
    if (this.given && this.given.clock > this.form.asked) return this.given.points;
    return this.pair[0].value.map((_, i) => this.controls.map(({ field, inputs }) => {
      const value = typed(inputs[i].value);
      return typeof value === "number" ? value : field.value[i];
    }));
  }

  /** Gives other points; an element gets the focus once they are there. */
  give(points, wish = null) {
    this.form.clock += 1;
    this.given = { points, clock: this.form.clock };
    this.form.wish = wish;
    this.form.edit(this.pair.map(({ key }, column) => ({ key, value: points.map((point) => point[column]) })), true);
  }

  /** Adds a point after another: a given one, or one halfway to the next. */
  add(i, wish = this.id(0, i + 1), given = null) {
    const { points } = this;
    const blank = this.pair.slice(2).map(() => null);
    const next = (given && [...given, ...blank]) ?? this.halfway?.(points, i) ?? between(points[i], points[(i + 1) % points.length], this.polar);
    this.give(points.toSpliced(i + 1, 0, next), wish);
  }

  remove(i, wish = `delete-${this.key}-${Math.min(i, this.points.length - 2)}`) {
    const { points } = this;
    if (points.length > this.fewest) this.give(points.toSpliced(i, 1), wish);
  }

  keyed(event) {
    const { row, column } = event.target.dataset;
    if (row === undefined || event.altKey || event.metaKey || this.form.fixed) return;
    const i = Number(row);
    if (event.key === "Insert" && !event.ctrlKey && !event.shiftKey) this.add(i);
    else if (event.key === "Delete" && event.ctrlKey) this.remove(i, this.id(Number(column), Math.min(i, this.points.length - 2)));
    else return;
    event.preventDefault();
  }

  /** Cells of a spreadsheet, from the cell that has the focus on; what does not fit below is added. */
  paste(event) {
    const { row, column } = event.target.dataset;
    const text = event.clipboardData?.getData("text/plain") ?? "";
    const { rows, error } = rowsIn(text, Math.max(0, this.optional - Number(column)));
    if (row === undefined || this.form.fixed) return;
    // One cell is the browser's, and so is what is no table.
    if (error ? !/[\t\n]/.test(text.trim()) : rows.length < 2 && (rows[0]?.length ?? 0) < 2) return;
    event.preventDefault();
    const fault = error ?? this.fault(rows, Number(row), Number(column));
    if (fault) {
      this.complain(`pasted, ${fault}`);
      return;
    }
    const points = this.points.map((point) => [...point]);
    rows.forEach((cells, k) => {
      points[Number(row) + k] ??= this.pair.map(() => null);
      cells.forEach((value, c) => {
        points[Number(row) + k][Number(column) + c] = value;
      });
    });
    // What was typed into the cell goes.
    event.target.value = event.target.dataset.value;
    this.give(points, event.target.id);
  }

  /** Reason why rows do not fit into the table from a cell on. */
  fault(rows, row, column) {
    const wide = rows.find((cells) => column + cells.length > this.pair.length);
    if (wide) return `line ${wide.line}: more numbers than columns`;
    const bare = rows.find((cells, k) => row + k >= this.points.length && column + cells.length < this.minimum);
    return bare ? `line ${bare.line}: a new ${this.noun} needs ${this.many} numbers` : null;
  }

  complain(message) {
    this.controls[0].remark.replaceChildren(element("span", { class: "error" }, element("b", {}, "error "), message));
    this.controls[0].said = null;
  }

  /** All points as a text, to be copied into a spreadsheet, or pasted from one. */
  async text() {
    const names = this.pair.map(({ key, unit }) => `${words(key)}${unit && ` ${unit}`}`).join(", ");
    const area = element("textarea", { "aria-label": `${capital(this.noun)}s, one a line: ${names}`, spellcheck: "false", rows: 16, cols: 40 });
    area.value = this.points.map((point) => point.join("\t")).join("\n");
    const remark = element("p", { class: "remark", role: "status" });
    let points = null;
    const sound = async () => {
      const { rows, error } = rowsIn(area.value, this.optional);
      const short = rows?.find((cells) => cells.length < this.minimum || cells.length > this.pair.length);
      const fault = error ?? (short ? `line ${short.line}: a ${this.noun} has ${this.many} numbers` : null) ?? (rows.length < this.fewest ? `a curve has at least ${this.fewest} points` : null);
      points = fault ? null : rows.map((cells) => this.pair.map((_, column) => cells[column] ?? null));
      remark.replaceChildren(...(fault ? [element("span", { class: "error" }, fault)] : []));
      return points !== null;
    };
    const answer = ask(`${capital(this.noun)}s`, [element("p", { class: "quiet" }, `One a line: ${names}.`), area, remark], [["", "Cancel"], ["apply", "Apply", "main"]], sound);
    area.focus();
    area.select();
    if (await answer === "apply") this.give(points, `text-${this.key}`);
  }
}
