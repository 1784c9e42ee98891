// Curves along the cycle as small multiples, all at the input of the scrubber.

import uPlot from "./uplot.js";
import { NOISE, STEPS, WHOLE, axes, labels, line, span } from "./axes.js";
import * as files from "./chart-files.js";
import { byId, element } from "./elements.js";
import { read } from "./motion.js";
import { Sight } from "./sight.js";
import { color } from "./theme.js";

const DEG = 180 / Math.PI;
const HEIGHT = 128;
/** Height of the one chart that is enlarged, pixels. */
const LARGE = 380;
const DASH = [[], [6, 3]];
const LIMIT = [8, 4];

/** Units of the axis: name, what one of them is in degrees, steps between its ticks, and how an input is written. */
const UNITS = {
  degrees: { steps: [1, 2, 5, 10, 15, 30, 45, 60, 90, 180, 360, 720, 1080, 1440, 2160, 2880, 3600, 5400, 7200, 10800, 14400, 36000], written: (value) => `${value.toFixed(1)}°` },
  turns: { steps: STEPS, written: (value) => `${value.toFixed(3)} turns` },
  seconds: { steps: STEPS, written: (value) => `${value.toPrecision(4)} s` },
};
/** A drag that is shorter is none, pixels. */
const SHORTEST = 6;
/** Share of the stretch shown that a step of the keys zooms or moves by. */
const STEP = 0.2;

/** A figure of a curve, short enough to read. */
function brief(value, count) {
  if (value === null || value === undefined) return "–";
  if (count) return String(value);
  const size = Math.abs(value);
  if (size < NOISE) return "0";
  return size < 1e-3 || size >= 1e5 ? value.toExponential(2) : value.toPrecision(4);
}

export class Charts {
  /** `go(input)` is called when a position in a chart is picked; `name()` is that of the design, `speed()` that of its input, rad/s. */
  constructor(go, name, speed) {
    Object.assign(this, { go, name, speed, unit: "degrees" });
    /** Stretch of the input that is shown, degrees; all of it where there is none. */
    this.zoomed = null;
    this.limits = [];
    /** Input under the pointer: all charts are read there. */
    this.hovered = null;
    /** Name of the chart that is enlarged. */
    this.large = null;
    this.charts = [];
    this.input = 0;
    this.reach = [0, 360];
    this.place = byId("charts");
    this.sight = new Sight();
    byId("axis").addEventListener("change", (event) => {
      this.unit = event.target.value;
      this.refresh();
    });
    // Seconds may be those of playing.
    byId("speed").addEventListener("change", () => this.refresh());
    for (const [id, step] of [["closer-in", (a, b) => [a + STEP * (b - a), b - STEP * (b - a)]], ["whole-cycle", () => null]]) {
      byId(id).addEventListener("click", () => this.zoom(step(...this.range)));
    }
    for (const [id, way] of [["earlier", -1], ["later", 1]]) {
      byId(id).addEventListener("click", () => this.zoom(this.range.map((end) => end + way * STEP * (this.range[1] - this.range[0]))));
    }
    new ResizeObserver(() => this.resize()).observe(this.place);
  }

  /** The stretch that is shown, degrees. */
  get range() {
    return this.zoomed ?? this.reach;
  }

  /** One of the axis' units, in degrees: seconds are those of the design's speed. */
  get one() {
    return { degrees: 1, turns: 360, seconds: this.speed() * DEG }[this.unit];
  }

  /** An input, in degrees, in the unit of the axis. */
  written(input) {
    return UNITS[this.unit].written(input / this.one);
  }

  /** Shows a stretch of the input, or all of it. */
  zoom(stretch) {
    const [first, last] = this.reach;
    const [a, b] = (stretch ?? this.reach).map((end) => Math.min(Math.max(end, first), last));
    // Closer than a hundredth of a degree nothing is to be seen.
    if (b - a < 0.01) return;
    this.zoomed = a > first || b < last ? [a, b] : null;
    this.refresh();
  }

  /** Draws all charts with the axis as it is now. */
  refresh() {
    byId("zoomed").hidden = !this.zoomed;
    for (const { plot } of this.charts) plot.redraw(true, true);
    this.at(this.input);
  }

  /** Takes the values that figures are to keep to. */
  limit(limits) {
    if (JSON.stringify(limits) === JSON.stringify(this.limits)) return;
    this.limits = limits;
    for (const chart of this.charts) chart.bound();
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
    const reach = [Math.min(...ends), Math.max(...ends)].map((end) => whole(end * DEG));
    // Of another cycle another stretch is sampled.
    if (this.reach.some((end, i) => end !== reach[i])) this.zoomed = null;
    this.reach = reach;
    byId("zoomed").hidden = !this.zoomed;
    const before = new Map((pinned ?? []).map((curve) => [`${curve.chart} ${curve.name}`, curve]));
    const same = this.charts.length === groups.size &&
      [...groups].every(([name, list], i) => this.charts[i].name === name && this.charts[i].fits(list, before));
    if (!same) {
      for (const chart of this.charts) chart.leave();
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
    this.sight.all();
  }

  resize() {
    for (const chart of this.charts) {
      const width = chart.box.clientWidth;
      if (width > 0) chart.plot.setSize({ width, height: chart.height });
    }
    this.at(this.input);
  }

  /** Gives one chart the whole width; the one that has it, its own place again. */
  enlarge(name) {
    this.large = this.large === name ? null : name;
    for (const chart of this.charts) chart.grow();
    this.resize();
    this.charts.find((chart) => chart.name === this.large)?.figure.scrollIntoView({ block: "nearest" });
  }

  recolor() {
    // What is printed is all in sight.
    this.sight.all();
    for (const chart of this.charts) chart.plot.redraw(false);
  }
}

class Chart {
  constructor(charts, name, curves, before) {
    this.name = name;
    const unit = curves[0].unit;
    this.charts = charts;
    this.limits = [];
    this.bounds = element("span", { class: "series series-limit" });
    this.values = curves.map(() => element("output", {}));
    const legend = curves.map((curve, i) => element("span", { class: `series series-${i}` }, curve.name ? `${curve.name} ` : "", this.values[i]));
    if (curves.some((curve) => before.has(`${name} ${curve.name}`))) legend.push(element("span", { class: "series series-pinned" }, "pinned"));
    this.box = element("div", { class: "plot" });
    this.larger = element("button", { type: "button", class: "link", "aria-label": `${name} enlarged`, onclick: () => charts.enlarge(name) }, "Enlarge");
    this.figure = element("figure", { class: "chart" },
      element("figcaption", {}, element("b", {}, name), unit ? element("span", { class: "quiet" }, ` ${unit}`) : null, ...legend, this.bounds,
        element("span", { class: "take" }, this.larger, ...["CSV", "SVG", "PNG"].map((kind) =>
          element("button", { type: "button", class: "link", "aria-label": `${name} as ${kind}`, onclick: () => this.take(kind) }, kind)))),
      this.box);
    charts.place.append(this.figure);
    charts.sight.watch(this.figure);
    this.grow();
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
      height: this.height,
      legend: { show: false },
      cursor: { x: false, y: false, points: { show: false }, drag: { x: false, y: false } },
      scales: { x: { time: false, range: () => charts.range }, y: { range: (_, least, greatest) => span(least, greatest, this.limits) } },
      series,
      axes: axes(
        { incrs: () => UNITS[charts.unit].steps.map((step) => step * charts.one), values: (_, list) => this.ticks(list), space: 48 },
        curves[0].count ? { incrs: WHOLE } : {},
      ),
      hooks: { draw: [(plot) => this.cross(plot)] },
    }, this.data(curves, before), this.box);
    this.line = element("div", { class: "now" });
    this.degrees = element("span", {});
    this.pointed = element("div", { class: "pointed" }, this.degrees);
    this.plot.over.append(this.line, this.pointed);
    this.curves = curves;
    this.now = [charts.input, charts.hovered];
    this.bound();
    this.stretch();
    const pick = (event) => {
      const input = this.under(event) / DEG;
      // A finger that moves leads the machine; it does not hover.
      if (event.pointerType !== "touch") charts.hover(input);
      if (event.buttons === 1) charts.go(input);
    };
    this.plot.over.addEventListener("pointerdown", pick);
    this.plot.over.addEventListener("pointermove", pick);
    this.plot.over.addEventListener("pointerleave", () => charts.hover(null));
  }

  get height() {
    return this.charts.large === this.name ? LARGE : HEIGHT;
  }

  /** Takes the room that it has. */
  grow() {
    const large = this.charts.large === this.name;
    this.figure.classList.toggle("large", large);
    this.larger.setAttribute("aria-pressed", String(large));
    this.larger.textContent = large ? "Smaller" : "Enlarge";
  }

  /** The input under the pointer, degrees. */
  under(event) {
    const [first, last] = this.charts.range;
    const left = event.clientX - this.plot.over.getBoundingClientRect().left;
    return Math.min(Math.max(this.plot.posToVal(left, "x"), first), last);
  }

  /** A drag along the axis zooms to it; a double click shows the whole cycle again. */
  stretch() {
    const { plot, charts } = this;
    const axis = plot.root.querySelector(".u-axis");
    axis.classList.add("along");
    axis.title = "Drag to zoom, double-click for the whole cycle";
    let start = null;
    const ends = (event) => [start, this.under(event)].sort((a, b) => a - b);
    const mark = (a, b) => {
      const [left, right] = [a, b].map((end) => plot.valToPos(end, "x"));
      plot.setSelect({ left, width: right - left, top: 0, height: plot.over.clientHeight }, false);
      return right - left;
    };
    axis.addEventListener("pointerdown", (event) => {
      axis.setPointerCapture(event.pointerId);
      start = this.under(event);
    });
    axis.addEventListener("pointermove", (event) => {
      if (start !== null) mark(...ends(event));
    });
    axis.addEventListener("pointerup", (event) => {
      if (start === null) return;
      const drawn = ends(event);
      if (mark(...drawn) > SHORTEST) charts.zoom(drawn);
      mark(0, 0);
      start = null;
    });
    axis.addEventListener("pointercancel", () => {
      mark(0, 0);
      start = null;
    });
    axis.addEventListener("dblclick", () => charts.zoom(null));
  }

  /** The ticks of the axis in its unit. */
  ticks(list) {
    const { unit, one } = this.charts;
    return labels(list.map((value) => value / one)).map((words) => (unit === "degrees" ? `${words}°` : words));
  }

  /** The limits of the figure, in the legend and as lines. */
  bound() {
    this.limits = this.charts.limits.filter(({ chart }) => chart === this.name);
    this.bounds.textContent = this.limits.map(files.bound).join(", ");
    this.bounds.hidden = this.limits.length === 0;
    this.plot.setData(this.plot.data);
  }

  /** Draws the limits across the chart. */
  cross(plot) {
    const { ctx, bbox: { left, top, width, height } } = plot;
    ctx.save();
    ctx.strokeStyle = color("warning");
    ctx.lineWidth = devicePixelRatio;
    ctx.setLineDash(LIMIT.map((length) => length * devicePixelRatio));
    for (const { value } of this.limits) {
      const y = plot.valToPos(value, "y", true);
      if (y < top || y > top + height) continue;
      ctx.beginPath();
      ctx.moveTo(left, y);
      ctx.lineTo(left + width, y);
      ctx.stroke();
    }
    ctx.restore();
  }

  /** Whether these curves can be shown without building the chart anew. */
  fits(curves, before) {
    return curves.length === this.curves.length &&
      curves.every((curve, i) => curve.name === this.curves[i].name && before.has(`${this.name} ${curve.name}`) === this.compared[i]);
  }

  set(curves, before) {
    this.curves = curves;
    this.before = before;
    this.due = true;
    this.charts.sight.draw(this.figure, () => this.renew());
  }

  /** Draws what has been given meanwhile. */
  renew() {
    if (this.due) this.plot.setData(this.data(this.curves, this.before));
    this.due = false;
    this.point();
  }

  /** Hands itself over as a file. */
  take(kind) {
    this.renew();
    return files.take(this, kind, this.charts.name());
  }

  leave() {
    this.charts.sight.forget(this.figure);
    this.plot.destroy();
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
    this.now = [input, hovered];
    this.charts.sight.draw(this.figure, () => this.renew());
  }

  /** Shows where it is read, and what it says there. */
  point() {
    const [input, hovered] = this.now;
    // Nothing is measured here: a browser would lay out the page anew for every chart.
    const left = (at) => this.plot.valToPos(at * DEG, "x");
    const [first, last] = this.charts.range;
    this.line.style.transform = `translateX(${left(input)}px)`;
    this.line.hidden = input * DEG < first - NOISE || input * DEG > last + NOISE;
    if (hovered !== null) {
      this.pointed.style.transform = `translateX(${left(hovered)}px)`;
      this.pointed.classList.toggle("leftward", 2 * hovered * DEG > first + last);
      this.degrees.textContent = this.charts.written(hovered * DEG);
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

/** A cycle ends at a whole degree, which its last digit may fall short of. */
const whole = (angle) => (Math.abs(angle - Math.round(angle)) < 1e-3 ? Math.round(angle) : angle);
