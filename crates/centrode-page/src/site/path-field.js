// The map of possible axes: a coloured field below the machine, its legend, and what it says of a position.

import { byId, element } from "./elements.js";
import { rowsOf } from "./path-form.js";
import * as server from "./server.js";
import { work } from "./work.js";

/** Axes a side of the map: one that comes soon, and one that is finer. */
const COUNTS = [33, 100];
/** Colours from the best to the worst: viridis, bright first. */
const SCALE = [[253, 231, 37], [122, 209, 81], [34, 168, 132], [42, 120, 142], [65, 68, 135], [68, 1, 84]];
/** Shades of the reasons why an axis is not possible: grey, and stripes by their number of rows and columns. */
const SHADES = [[128, 0], [128, 4], [128, -4], [128, 2], [128, 3], [128, 5]];
/** Opacity of possible axes and of the others. */
const ALPHA = [165, 56];
/** Ratios farther from 1 than this factor have one colour. */
const WORST = 8;
/** Shares of the greatest least radius that have colours of their own. */
const SHARPEST = 1 / 64;

/** How an axis is coloured: from 0, the best, to 1, and the ends in words. */
const MEASURES = {
  factor: {
    of: ({ factor }) => {
      const worst = Math.min(WORST, Math.max(...factor.filter((one) => one !== null), 1.01));
      return { share: (i) => Math.log(factor[i]) / Math.log(worst), ends: ["ratio 1", `${worst >= WORST ? "beyond" : "within"} a factor of ${worst.toPrecision(2)}`] };
    },
  },
  radius: {
    of: ({ radius }) => {
      const best = Math.max(...radius.filter((one) => one !== null), 1e-9);
      return { share: (i) => Math.log(radius[i] / best) / Math.log(SHARPEST), ends: [`${best.toPrecision(3)} mm`, `${(best * SHARPEST).toPrecision(2)} mm or less`] };
    },
  },
};

function mixed(share) {
  const place = Math.min(Math.max(share, 0), 1) * (SCALE.length - 1);
  const i = Math.min(Math.floor(place), SCALE.length - 2);
  return SCALE[i].map((one, k) => Math.round(one + (place - i) * (SCALE[i + 1][k] - one)));
}

/** Whether a position of the stripes of a reason is dark. */
const striped = (stripe, i, j) => stripe !== 0 && (i + Math.sign(stripe) * j) % Math.abs(stripe) === 0;

export class Field {
  /** The map is drawn by `stage`; `complain(error)` takes an error. */
  constructor(stage, complain) {
    this.stage = stage;
    this.complain = complain;
    this.map = null;
    this.image = null;
    this.stale = false;
    this.stop = null;
    this.key = "";
    /** Whether there is a path to try axes for. */
    this.shown = true;
    for (const id of ["show-field", "field-by"]) byId(id).addEventListener("change", () => this.redraw());
    for (const kind of ["pointermove", "pointerdown"]) {
      stage.box.addEventListener(kind, (event) => {
        const bounds = stage.box.getBoundingClientRect();
        this.read(stage.toModel(event.clientX - bounds.left, event.clientY - bounds.top));
      });
    }
    stage.box.addEventListener("pointerleave", () => this.read(null));
    this.read(null);
  }

  /** Maps the axes about a path; while the hand moves, the last map is out of date. */
  async ask(wish, final) {
    const key = JSON.stringify([wish.path, wish.bend]);
    if (key === this.key) return;
    this.stop?.abort();
    this.mark(true);
    if (!final) return;
    this.key = key;
    const stop = new AbortController();
    this.stop = stop;
    byId("field").setAttribute("aria-busy", "true");
    try {
      for (const count of COUNTS) {
        const map = await work((signal) => server.mapAxes({ points: rowsOf(wish), bend_deg: wish.bend, count }, signal), stop);
        if (this.stop !== stop) return;
        if (map.refused) {
          this.show(null);
          break;
        }
        this.show(map);
      }
    } catch (error) {
      if (stop.signal.aborted) return;
      this.key = "";
      this.complain(error);
    }
    byId("field").setAttribute("aria-busy", "false");
  }

  mark(stale) {
    this.stale = stale;
    // The request is out of date.
    if (stale) this.key = "";
    byId("field").classList.toggle("stale", stale);
  }

  show(map) {
    this.map = map;
    this.stale = false;
    byId("field").classList.remove("stale");
    this.redraw();
  }

  /** Paints the map anew, and its legend. */
  redraw() {
    const { map } = this;
    this.image = map && this.painted(map);
    byId("field-faults").replaceChildren(...(map?.faults ?? []).map(([name, words, count], i) =>
      element("li", { "data-fault": name }, this.swatch(i), element("span", {}, `${words} `, element("span", { class: "quiet" }, `${Math.round((100 * count) / map.fault.length)} %`)))));
    byId("field-count").textContent = map
      ? `${map.possible} of ${map.fault.length} axes tried are possible: ${map.inside} inside the path, ${map.possible - map.inside} outside.`
      : "Draw a path first: axes are tried for a path.";
    this.scale();
    this.stage.draw();
  }

  painted(map) {
    const [columns, rows] = map.count;
    const canvas = document.createElement("canvas");
    canvas.width = columns;
    canvas.height = rows;
    const context = canvas.getContext("2d");
    const image = context.createImageData(columns, rows);
    const { share } = MEASURES[byId("field-by").value].of(map);
    map.fault.forEach((fault, n) => {
      const [i, j] = [n % columns, Math.floor(n / columns)];
      const place = 4 * ((rows - 1 - j) * columns + i);
      const [grey, stripe] = SHADES[(fault ?? 0) % SHADES.length];
      const color = fault === null ? mixed(share(n)) : [grey, grey, grey];
      const alpha = fault === null ? ALPHA[0] : ALPHA[1] * (striped(stripe, i, j) ? 1.9 : 1);
      image.data.set([...color, alpha], place);
    });
    context.putImageData(image, 0, 0);
    return canvas;
  }

  swatch(fault) {
    const canvas = element("canvas", { width: 14, height: 12, "aria-hidden": "true" });
    const context = canvas.getContext("2d");
    const image = context.createImageData(14, 12);
    const [grey, stripe] = SHADES[fault % SHADES.length];
    for (let n = 0; n < 14 * 12; n += 1) {
      const dark = striped(stripe, n % 14, 11 - Math.floor(n / 14));
      image.data.set([grey, grey, grey, ALPHA[1] * (dark ? 1.9 : 1)], 4 * n);
    }
    context.putImageData(image, 0, 0);
    return canvas;
  }

  scale() {
    const canvas = byId("field-scale");
    canvas.width = 256;
    canvas.height = 1;
    const context = canvas.getContext("2d");
    const image = context.createImageData(256, 1);
    for (let i = 0; i < 256; i += 1) image.data.set([...mixed(i / 255), ALPHA[0]], 4 * i);
    context.putImageData(image, 0, 0);
    const ends = this.map ? MEASURES[byId("field-by").value].of(this.map).ends : ["", ""];
    [byId("field-low").textContent, byId("field-high").textContent] = ends;
  }

  /** Draws the field where it lies in the plane. */
  paint(painter) {
    if (!this.shown || !this.image || !byId("show-field").checked) return;
    const { map: { x, y, count }, image } = this;
    const half = [x, y].map(([from, to], k) => (to - from) / (count[k] - 1) / 2);
    const [left, top] = painter.toBox(x[0] - half[0], y[1] + half[1]);
    const [right, bottom] = painter.toBox(x[1] + half[0], y[0] - half[1]);
    const { context, density } = painter;
    context.setTransform(density, 0, 0, density, 0, 0);
    context.globalAlpha = this.stale ? 0.4 : 1;
    context.imageSmoothingEnabled = false;
    context.drawImage(image, left, top, right - left, bottom - top);
    context.globalAlpha = 1;
  }

  /** Number of the axis tried nearest to a position; null outside the map. */
  cell([px, py]) {
    const { x, y, count } = this.map;
    const [i, j] = [[px, x], [py, y]].map(([at, [from, to]], k) => Math.round(((at - from) / (to - from)) * (count[k] - 1)));
    return i >= 0 && j >= 0 && i < count[0] && j < count[1] ? j * count[0] + i : null;
  }

  /** Says what the map knows of a position. */
  read(place) {
    const readout = byId("field-readout");
    const n = place && this.map && !this.stale ? this.cell(place) : null;
    if (n === null) {
      readout.textContent = "Point at the field for the figures of an axis there.";
      return;
    }
    const { fault, faults, ratios, radius } = this.map;
    const at = place.map((one) => one.toFixed(1)).join(", ");
    readout.textContent = fault[n] === null
      ? `Axis at ${at}: ratio ${ratios[n].map((one) => one.toFixed(3)).join(" to ")}, minimum radius ${radius[n].toPrecision(3)} mm`
      : `Axis at ${at}: not possible, ${faults[fault[n]][1]}`;
  }
}
