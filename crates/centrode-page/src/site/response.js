// How goals and paths of points respond to one number of the design.

import uPlot from "./uplot.js";
import { axes, line } from "./axes.js";
import * as dialogs from "./dialogs.js";
import { byId, element } from "./elements.js";
import * as server from "./server.js";
import { color } from "./theme.js";
import { Ways, hue } from "./ways.js";

const SIZE = { width: 250, height: 130 };

/** Every number of the design that can be moved: key and value. */
function numbers(snapshot) {
  const found = [];
  for (const field of snapshot.tables.flatMap((table) => (table.absent ? [] : table.fields))) {
    if (typeof field.value === "number") found.push([field.key, field.value]);
    if (Array.isArray(field.value)) {
      field.value.forEach((value, i) => {
        if (typeof value === "number") found.push([`${field.key}[${i}]`, value]);
      });
    }
  }
  return found;
}

/** The field of a number. */
function fieldOf(snapshot, name) {
  const fields = snapshot.tables.flatMap((table) => (table.absent ? [] : table.fields));
  return fields.find((field) => field.key === name.replace(/\[\d+\]$/, "")) ?? {};
}

/** A range about a value: a tenth of it to both sides; of a count one at least, as far as there is one. */
function around(value, { kind, minimum }) {
  const share = Math.abs(value) * 0.1;
  const whole = ["integer", "integers"].includes(kind);
  const reach = whole ? Math.max(1, Math.round(share)) : share || 1;
  const from = whole ? Math.max(minimum ?? -Infinity, value - reach) : value - reach;
  return [from, value + reach].map((end) => String(Number(end.toPrecision(6))));
}

const number = (input) => Number(input.value.trim().replace(",", "."));

/** Every third of many values at which goals are known: their ways are drawn. */
const THINNED = 3;

/** How many goals are reached at one of the values. */
function reached(charts, i) {
  const goals = charts.filter(({ required, figures }) => required.some((end) => end !== null) && figures[i] !== null);
  const met = goals.filter(({ required: [least, greatest], figures }) => figures[i] >= (least ?? -Infinity) && figures[i] <= (greatest ?? Infinity));
  return goals.length ? `${met.length} of ${goals.length} goals reached` : "";
}

/** The dialog: which number, between which values; the answers below. `take` has a value for a key. */
export async function ask(snapshot, text, take, first) {
  const known = new Map(numbers(snapshot));
  const units = new Map([...known.keys()].map((name) => [name, fieldOf(snapshot, name).unit ?? ""]));
  const key = element("select", { id: "response-key" }, ...[...known.keys()].map((name) => element("option", { value: name }, name)));
  const from = element("input", { type: "text", inputmode: "decimal", class: "number", id: "response-from" });
  const to = element("input", { type: "text", inputmode: "decimal", class: "number", id: "response-to" });
  const place = element("div", { class: "multiples" });
  const words = element("p", { class: "remark", role: "status" });
  const reach = () => {
    if (known.size) [from.value, to.value] = around(known.get(key.value), fieldOf(snapshot, key.value));
  };
  if (known.has(first)) key.value = first;
  key.addEventListener("change", reach);
  reach();
  for (const end of [from, to]) {
    end.addEventListener("keydown", (event) => {
      if (event.key !== "Enter") return;
      event.preventDefault();
      show();
    });
  }
  let stop = new AbortController();
  const show = async () => {
    stop.abort();
    stop = new AbortController();
    const { signal } = stop;
    place.replaceChildren();
    if (from.value.trim() === "" || to.value.trim() === "" || !(number(from) < number(to))) {
      words.textContent = `the values must rise, but go from ${from.value} to ${to.value}`;
      return;
    }
    words.textContent = "checking…";
    try {
      const name = key.value;
      const answers = await server.response({ text, key: name, from: number(from), to: number(to) }, signal);
      // Another has been requested since.
      if (signal.aborted) return;
      const gaps = answers.charts.some((chart) => chart.figures.includes(null));
      words.textContent = answers.charts.length === 0
        ? "no value between these makes a mechanism, or none changes a figure"
        : `Across: ${name}${units.get(name) && `, ${units.get(name)}`}. Blue: the design as it is. Dashed: the required range.${gaps ? " No point: no mechanism, or no such figure." : ""}`;
      for (const chart of answers.charts) draw(place, answers.values, chart, known.get(name));
      await overlay(name, answers, signal);
    } catch (error) {
      if (!signal.aborted) words.replaceChildren(element("span", { class: "error" }, error.message));
    }
  };
  /** Paths of the points at some of the values, and a list of these to take one from. */
  const overlay = async (name, { values, charts }, signal) => {
    const ways = new Ways();
    const list = element("ul", { class: "ways-list" });
    place.prepend(element("div", { class: "overlay" }, ways.box, list));
    const unit = units.get(name);
    const row = (index, words, rest, value) => {
      const content = [element("span", { class: "swatch" }), element("b", {}, words), ` ${rest}`];
      content[0].style.background = hue(index);
      const item = value === undefined ? element("span", {}, ...content) : element("button", { type: "button", title: "Take this value", onclick: () => {
        byId("dialog").close("");
        take(name, value);
      } }, ...content);
      for (const [event, front] of [["pointerenter", index], ["focus", index], ["pointerleave", undefined], ["blur", undefined]]) item.addEventListener(event, () => ways.draw(front));
      list.append(element("li", {}, item));
    };
    if (snapshot.picture) ways.add(snapshot.picture, "");
    row(0, `${known.get(name)}${unit && ` ${unit}`}`, "the design as it is");
    const every = values.length > THINNED ** 2 ? THINNED : 1;
    for (let i = 0; i < values.length; i += every) {
      const value = Number(values[i].toPrecision(6));
      if (value === known.get(name)) continue;
      const found = await server.solve({ text, edits: [{ key: name, value }], depth: "picture" }, signal);
      if (signal.aborted) return;
      const words = `${value}${unit && ` ${unit}`}`;
      if (found.error) {
        list.append(element("li", { class: "error" }, `${words}: ${found.error.message}`));
        continue;
      }
      ways.add(found.picture, String(value));
      row(ways.drawn.length - 1, words, reached(charts, i), value);
    }
    if (ways.count === 0) ways.box.remove();
  };
  await dialogs.ask("Response", [
    element("p", { class: "option" }, element("label", { for: "response-key" }, "Number"), key),
    element("p", { class: "option" }, element("label", { for: "response-from" }, "From"), from,
      element("label", { for: "response-to" }, "to"), to,
      element("button", { type: "button", class: "main", onclick: show }, "Show")),
    words, place,
  ], [["", "Close"]]);
  stop.abort();
}

function draw(place, values, chart, now) {
  const box = element("div", { class: "plot" });
  const ends = chart.required.filter((end) => end !== null);
  place.append(element("figure", { class: "chart" },
    element("figcaption", {}, element("b", {}, chart.title), chart.unit ? element("span", { class: "quiet" }, ` ${chart.unit}`) : null), box));
  const lines = (plot) => {
    const { ctx } = plot;
    const { left, top, width, height } = plot.bbox;
    ctx.save();
    ctx.lineWidth = devicePixelRatio;
    ctx.setLineDash([4 * devicePixelRatio, 3 * devicePixelRatio]);
    const stroke = (x0, y0, x1, y1, name) => {
      ctx.strokeStyle = color(name);
      ctx.beginPath();
      ctx.moveTo(x0, y0);
      ctx.lineTo(x1, y1);
      ctx.stroke();
    };
    for (const end of ends) {
      const y = plot.valToPos(end, "y", true);
      if (y >= top && y <= top + height) stroke(left, y, left + width, y, "warning");
    }
    const x = plot.valToPos(now, "x", true);
    if (x >= left && x <= left + width) stroke(x, top, x, top + height, "accent");
    ctx.restore();
  };
  new uPlot({
    ...SIZE,
    legend: { show: false },
    cursor: { show: false },
    scales: { x: { time: false } },
    series: [{}, line("ink", { points: { show: true, size: 4 } })],
    axes: axes(),
    hooks: { draw: [lines] },
  }, [values, chart.figures], box);
}
