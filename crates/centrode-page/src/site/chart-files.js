// A chart as a file: its numbers as CSV, its picture as SVG.

import { drawn } from "./elements.js";

/** Size of the picture, and room for what stands around the lines. */
const [WIDTH, HEIGHT] = [640, 320];
const [LEFT, RIGHT, TOP, BOTTOM] = [64, 20, 44, 40];
/** Colours of paper. */
const INK = { warning: "#7d5200", ink: "#1a2027", accent: "#0a5aa8", pinned: "#8a4b00", grid: "#d5dbe1", muted: "#566270" };
/** Points of a picture for one of its units. */
const FINE = 3;
const MEDIA = { CSV: "text/csv", SVG: "image/svg+xml" };

/** A limit in words. */
export const bound = ({ value, minimum }) => `${minimum ? "at least" : "at most"} ${Number(value.toPrecision(4))}`;

/** Text that no spreadsheet runs as a formula. */
const inert = (text) => (/^[=+\-@\t＝＋－＠]/.test(text) ? `'${text}` : text);

/** A cell as CSV has it. */
const cell = (text) => (/[",\n]/.test(text) ? `"${inert(text).replaceAll('"', '""')}"` : inert(text));

/** A number with all digits that mean something. */
const digits = (value) => (value === null || value === undefined ? "" : String(Number(value.toPrecision(12))));

/** Every point of the lines of a chart, a row each; the first column is the input. */
export function csv(chart) {
  // Spreadsheets take a degree sign for something else.
  const unit = chart.curves[0].unit.replace("°", "deg");
  const head = ["input deg", ...chart.lines.map(({ name }) => (unit ? `${name} ${unit}` : name))];
  const [inputs, ...values] = chart.plot.data;
  const rows = Array.from(inputs, (input, i) => [String(Number(input.toFixed(9))), ...values.map((list) => digits(list[i]))]);
  return [head.map(cell), ...rows].map((row) => `${row.join(",")}\n`).join("");
}

/** The way of a line, broken where it has no value; a count goes in steps. */
function way(inputs, values, count, [x, y]) {
  let path = "";
  let pen = false;
  let last = null;
  for (const [i, input] of Array.from(inputs).entries()) {
    const value = values[i];
    if (value === null || value === undefined) {
      pen = false;
      continue;
    }
    const [px, py] = [x(input).toFixed(2), y(value).toFixed(2)];
    if (pen && count) path += `H${px}V${py}`;
    else path += `${pen ? "L" : "M"}${px} ${py}`;
    [pen, last] = [true, py];
  }
  return last === null ? "" : path;
}

/** The picture of a chart, as it is on the page, on white. */
export function svg(chart) {
  const { plot, name, curves } = chart;
  const { x: across, y: up } = plot.scales;
  const x = (value) => LEFT + ((value - across.min) / (across.max - across.min)) * (WIDTH - LEFT - RIGHT);
  const y = (value) => HEIGHT - BOTTOM - ((value - up.min) / (up.max - up.min)) * (HEIGHT - TOP - BOTTOM);
  const root = drawn("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, width: WIDTH, height: HEIGHT, "font-family": "sans-serif", "font-size": 12 });
  const text = (words, attributes) => {
    const made = drawn("text", attributes);
    made.textContent = words;
    root.append(made);
  };
  const title = drawn("title");
  title.textContent = name;
  root.append(title, drawn("rect", { width: WIDTH, height: HEIGHT, fill: "#ffffff" }));
  text(curves[0].unit ? `${name}, ${curves[0].unit}` : name, { x: LEFT, y: 20, fill: INK.ink, "font-weight": "bold" });
  const told = plot.axes.map(({ _splits, _values }) => _splits.flatMap((at, i) => (_values[i] === null || _values[i] === "" ? [] : [[at, _values[i]]])));
  for (const [at, words] of told[0]) {
    root.append(drawn("path", { d: `M${x(at).toFixed(2)} ${TOP}V${HEIGHT - BOTTOM}`, stroke: INK.grid }));
    text(words, { x: x(at).toFixed(2), y: HEIGHT - BOTTOM + 18, fill: INK.muted, "text-anchor": "middle" });
  }
  for (const [at, words] of told[1]) {
    root.append(drawn("path", { d: `M${LEFT} ${y(at).toFixed(2)}H${WIDTH - RIGHT}`, stroke: INK.grid }));
    text(words, { x: LEFT - 8, y: (y(at) + 4).toFixed(2), fill: INK.muted, "text-anchor": "end" });
  }
  for (const { value, minimum } of chart.limits) {
    if (value < up.min || value > up.max) continue;
    root.append(drawn("path", { d: `M${LEFT} ${y(value).toFixed(2)}H${WIDTH - RIGHT}`, stroke: INK.warning, "stroke-dasharray": "8 4", "data-limit": value }));
    text(bound({ value, minimum }), { x: WIDTH - RIGHT - 4, y: (y(value) - 4).toFixed(2), fill: INK.warning, "text-anchor": "end" });
  }
  text(chart.charts.unit === "degrees" ? "Input angle" : `Input, ${chart.charts.unit}`, { x: (LEFT + WIDTH - RIGHT) / 2, y: HEIGHT - 4, fill: INK.muted, "text-anchor": "middle" });
  const frame = drawn("clipPath", { id: "frame" });
  frame.append(drawn("rect", { x: LEFT, y: TOP, width: WIDTH - LEFT - RIGHT, height: HEIGHT - TOP - BOTTOM }));
  root.append(frame);
  const [inputs, ...values] = plot.data;
  let beside = WIDTH - RIGHT;
  chart.lines.forEach(({ name: own, ink, dash, count }, i) => {
    const look = { fill: "none", stroke: INK[ink], "stroke-width": 1.5, ...(dash.length ? { "stroke-dasharray": dash.join(" ") } : {}) };
    root.append(drawn("path", { ...look, d: way(inputs, values[i], count, [x, y]), "stroke-linejoin": "round", "clip-path": "url(#frame)", "data-line": own }));
    if (chart.lines.length === 1) return;
    // From the right, a line and its name each.
    text(own, { x: beside, y: 20, fill: INK[ink], "text-anchor": "end" });
    root.append(drawn("path", { ...look, d: `M${beside - 7 * own.length - 28} 16h22` }));
    beside -= 7 * own.length + 44;
  });
  return `${new XMLSerializer().serializeToString(root)}\n`;
}

/** A picture in SVG as points, so many across and up. */
export async function image(text, width, height) {
  const made = new Image();
  made.src = `data:image/svg+xml,${encodeURIComponent(text)}`;
  await made.decode();
  const canvas = Object.assign(document.createElement("canvas"), { width: Math.round(width), height: Math.round(height) });
  canvas.getContext("2d").drawImage(made, 0, 0, canvas.width, canvas.height);
  return new Promise((resolve) => canvas.toBlob(resolve, "image/png"));
}

/** Hands over a file, named by words and its ending. */
export function handOver(file, words, ending) {
  const name = (words || "design").toLowerCase().replace(/[^a-z0-9.]+/g, "-").replace(/^-|-$/g, "");
  const href = URL.createObjectURL(file);
  Object.assign(document.createElement("a"), { href, download: `${name}.${ending}` }).click();
  setTimeout(() => URL.revokeObjectURL(href), 60000);
}

/** Hands over a chart of a design as a file. */
export async function take(chart, kind, design) {
  // As fine as a good print needs.
  const file = kind === "PNG" ? await image(svg(chart), FINE * WIDTH, FINE * HEIGHT) : new Blob([kind === "CSV" ? csv(chart) : svg(chart)], { type: MEDIA[kind] });
  handOver(file, `${design || "design"} ${chart.name}`, kind.toLowerCase());
}
