// Curves along the cycle as small multiples, all at the input of the scrubber.

import uPlot from "./uplot.js";
import { WHOLE, axes, line } from "./axes.js";
import * as files from "./chart-files.js";
import { byId, element } from "./elements.js";
import { read } from "./motion.js";

const DEG = 180 / Math.PI;
const HEIGHT = 128;
const DASH = [[], [6, 3]];
/** What is smaller is a rounding error, whatever its unit: a figure of a machine is not. */
const NOISE = 1e-9;

/** A figure of a curve, short enough to read. */
function brief(value, count) {
  if (value === null || value === undefined) return "–";
  if (count) return String(value);
  const size = Math.abs(value);
  if (size < NOISE) return "0";
  return size < 1e-3 || size >= 1e5 ? value.toExponential(2) : value.toPrecision(4);
}

export class Charts {
  /** `go(input)` is called when a place in a chart is picked; `name()` is that of the design. */
  constructor(go, name) {
    this.go = go;
    this.name = name;
    /** Input under the pointer: all charts are read there. */
    this.hovered = null;
    this.charts = [];
    this.input = 0;
    this.reach = [0, 360];
    this.place = byId("charts");
    new ResizeObserver(() => this.resize()).observe(this.place);
  }

  /** Takes new curves; `at` says where in the cycle they are read. */
  show(curves, pinned) {
    const groups = new Map();
    for (const curve of curves) {
      if (!groups.has(curve.chart)) groups.set(curve.chart, []);
      groups.get(curve.chart).push(curve);
    }
    // All charts show the same stretch of the input.
    const ends = curves.flatMap(({ input }) => [input[0], input.at(-1)]).filter(Number.isFinite);
    this.reach = [Math.min(...ends), Math.max(...ends)].map((end) => whole(end * DEG));
    const before = new Map((pinned ?? []).map((curve) => [`${curve.chart} ${curve.name}`, curve]));
    const same = this.charts.length === groups.size &&
      [...groups].every(([name, list], i) => this.charts[i].name === name && this.charts[i].fits(list, before));
    if (!same) {
      for (const chart of this.charts) chart.plot.destroy();
      this.place.replaceChildren();
      this.charts = [...groups].map(([name, list]) => new Chart(this, name, list, before));
    } else {
      [...groups.values()].forEach((list, i) => this.charts[i].set(list, before));
    }
  }

  at(input) {
    this.input = input;
    for (const chart of this.charts) chart.at(input, this.hovered);
  }

  /** Reads all charts at an input under the pointer; at none, where the machine stands. */
  hover(input) {
    this.hovered = input;
    this.place.classList.toggle("hovered", input !== null);
    this.at(this.input);
  }

  resize() {
    for (const chart of this.charts) {
      const width = chart.box.clientWidth;
      if (width > 0) chart.plot.setSize({ width, height: HEIGHT });
    }
    this.at(this.input);
  }

  recolor() {
    for (const chart of this.charts) chart.plot.redraw(false);
  }
}

class Chart {
  constructor(charts, name, curves, before) {
    this.name = name;
    const unit = curves[0].unit;
    this.values = curves.map(() => element("output", {}));
    const legend = curves.map((curve, i) => element("span", { class: `series series-${i}` }, curve.name ? `${curve.name} ` : "", this.values[i]));
    if (curves.some((curve) => before.has(`${name} ${curve.name}`))) legend.push(element("span", { class: "series series-pinned" }, "pinned"));
    this.box = element("div", { class: "plot" });
    charts.place.append(element("figure", { class: "chart" },
      element("figcaption", {}, element("b", {}, name), unit ? element("span", { class: "quiet" }, ` ${unit}`) : null, ...legend,
        element("span", { class: "take" }, ...["CSV", "SVG"].map((kind) =>
          element("button", { type: "button", class: "link", "aria-label": `${name} as ${kind}`, onclick: () => files.take(this, kind, charts.name()) }, kind)))),
      this.box));
    this.compared = curves.map((curve) => before.has(`${name} ${curve.name}`));
    const series = [{}];
    curves.forEach((curve, i) => {
      // A count jumps from one whole number to the next.
      const own = curve.count ? { paths: uPlot.paths.stepped({ align: 1 }) } : {};
      series.push(line(i === 0 ? "ink" : "accent", { ...own, dash: DASH[i % 2] }));
      if (this.compared[i]) series.push(line("pinned", { ...own, width: 1.2, dash: [3, 3] }));
    });
    this.plot = new uPlot({
      width: Math.max(this.box.clientWidth, 160),
      height: HEIGHT,
      legend: { show: false },
      cursor: { x: false, y: false, points: { show: false }, drag: { x: false, y: false } },
      scales: { x: { time: false, range: () => charts.reach }, y: { range: span } },
      series,
      axes: axes(
        { incrs: [15, 30, 45, 60, 90, 180, 360, 720, 1080, 1440, 2160, 2880, 3600, 5400, 7200, 10800, 14400, 36000], values: (_, list) => list.map((v) => `${v}°`), space: 48 },
        curves[0].count ? { incrs: WHOLE } : {},
      ),
    }, this.data(curves, before), this.box);
    this.line = element("div", { class: "now" });
    this.degrees = element("span", {});
    this.pointed = element("div", { class: "pointed" }, this.degrees);
    this.plot.over.append(this.line, this.pointed);
    this.curves = curves;
    const pick = (event) => {
      const left = event.clientX - this.plot.over.getBoundingClientRect().left;
      const [first, last] = charts.reach;
      const input = Math.min(Math.max(this.plot.posToVal(left, "x"), first), last) / DEG;
      // A finger that moves leads the machine; it does not hover.
      if (event.pointerType !== "touch") charts.hover(input);
      if (event.buttons === 1) charts.go(input);
    };
    this.plot.over.addEventListener("pointerdown", pick);
    this.plot.over.addEventListener("pointermove", pick);
    this.plot.over.addEventListener("pointerleave", () => charts.hover(null));
  }

  /** Whether these curves can be shown without building the chart anew. */
  fits(curves, before) {
    return curves.length === this.curves.length &&
      curves.every((curve, i) => curve.name === this.curves[i].name && before.has(`${this.name} ${curve.name}`) === this.compared[i]);
  }

  set(curves, before) {
    this.curves = curves;
    this.plot.setData(this.data(curves, before));
  }

  data(curves, before) {
    const x = curves[0].input;
    const data = [x.map((input) => input * DEG)];
    for (const curve of curves) {
      data.push(curve.value);
      const old = before.get(`${this.name} ${curve.name}`);
      if (old) data.push(x.map((input) => read(old, input)));
    }
    return data;
  }

  at(input, hovered) {
    const left = (at) => this.plot.valToPos(at * DEG, "x");
    this.line.style.transform = `translateX(${left(input)}px)`;
    if (hovered !== null) {
      const place = left(hovered);
      this.pointed.style.transform = `translateX(${place}px)`;
      this.pointed.classList.toggle("leftward", place > this.plot.over.clientWidth / 2);
      this.degrees.textContent = `${(hovered * DEG).toFixed(1)}°`;
    }
    this.curves.forEach((curve, i) => {
      this.values[i].textContent = brief(read(curve, hovered ?? input), curve.count);
    });
  }

  /** What is drawn: a name, a colour, dashes and whether it is a count, for every line. */
  get lines() {
    return this.curves.flatMap((curve, i) => {
      const own = { name: curve.name || this.name, ink: i === 0 ? "ink" : "accent", dash: DASH[i % 2], count: curve.count };
      return this.compared[i] ? [own, { ...own, name: `pinned ${own.name}`, ink: "pinned", dash: [3, 3] }] : [own];
    });
  }
}

/** Range of the vertical axis: what is nearly constant is shown as constant, not as its rounding errors. */
function span(_, least, greatest) {
  if (least === null || !Number.isFinite(least)) return [0, 1];
  const size = Math.max(Math.abs(least), Math.abs(greatest));
  const room = greatest - least < 1e-6 * size ? Math.max(0.1 * size, Number.MIN_VALUE) : 0.08 * (greatest - least);
  return size < NOISE ? [-1, 1] : [least - room, greatest + room];
}

/** A cycle ends at a whole degree, which its last digit may fall short of. */
const whole = (angle) => (Math.abs(angle - Math.round(angle)) < 1e-3 ? Math.round(angle) : angle);
