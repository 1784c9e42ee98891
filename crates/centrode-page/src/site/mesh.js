// Close to the meshes of gears: the points at which flanks touch, and the lines of action.

import { byId } from "./elements.js";
import { color } from "./theme.js";

/** Width of the view, in lengths of the longest path of contact next to the pitch point. */
const WIDTHS = 4;
/** Width of the view where no path is known, as a share of the picture. */
const SHARE = 0.15;

/** Position of a track at an input, which may be one of the cycle before or after; null where it has none. */
function place({ input, at }, now, cycle) {
  const first = input[0];
  const last = input[input.length - 1];
  const then = [now, now - cycle, now + cycle].find((value) => first <= value && value <= last);
  if (then === undefined) return null;
  let low = 0;
  let high = input.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (input[middle] <= then) low = middle;
    else high = middle;
  }
  const share = input[high] > input[low] ? (then - input[low]) / (input[high] - input[low]) : 0;
  return [0, 1].map((k) => at[low][k] + share * (at[high][k] - at[low][k]));
}

const apart = (a, b) => Math.hypot(b[0] - a[0], b[1] - a[1]);

/** What touches in each mesh of a scene at an input, in pixels of a painter: pitch point, points of contact, ends of the line of action. */
export function touching(painter, input) {
  const { picture: { contacts = [] }, motion: { cycle } } = painter.scene;
  return contacts.flatMap(({ pitch_point: pitches, paths }) => {
    const pitch = place(pitches, input, cycle);
    if (!pitch) return [];
    const points = paths.map((path) => place(path, input, cycle)).filter(Boolean);
    // All contacts lie on one line through the pitch point: the farthest shows it best.
    const far = points.reduce((best, point) => (apart(pitch, point) > apart(pitch, best) ? point : best), pitch);
    const [middle, end] = [pitch, far].map((at) => painter.toBox(...at));
    const length = apart(middle, end);
    // Of several meshes each has its own line next to it; that of one goes through the picture.
    const reach = contacts.length > 1 ? Math.max(24, 2 * length) : painter.width + painter.height;
    const way = [0, 1].map((k) => (reach * (end[k] - middle[k])) / length);
    const line = length > 0 ? [-1, 1].map((side) => [0, 1].map((k) => middle[k] + side * way[k])) : null;
    return [{ pitch: middle, points: points.map((at) => painter.toBox(...at)), line }];
  });
}

/** How it is drawn: colour, width and dashes of the lines, radii of pitch points and of contacts, pixels. */
export const LOOK = { ink: "pinned", width: 1, dashes: [10, 4], pitch: 3, point: 5 };

/** Draws what touches on the canvas of a painter. */
export function draw(painter, input) {
  const { context, density } = painter;
  context.setTransform(density, 0, 0, density, 0, 0);
  const dot = ([x, y], radius, fill) => {
    context.beginPath();
    context.arc(x, y, radius, 0, 2 * Math.PI);
    context.fillStyle = color(fill);
    context.fill();
    context.strokeStyle = color("sheet");
    context.stroke();
  };
  for (const { pitch, points, line } of touching(painter, input)) {
    context.lineWidth = LOOK.width;
    if (line) {
      context.strokeStyle = color(LOOK.ink);
      context.setLineDash(LOOK.dashes);
      context.beginPath();
      context.moveTo(...line[0]);
      context.lineTo(...line[1]);
      context.stroke();
      context.setLineDash([]);
    }
    dot(pitch, LOOK.pitch, "ink");
    for (const point of points) dot(point, LOOK.point, LOOK.ink);
  }
}

/** Follows a mesh of a stage's picture once its button is pressed, then the next. */
export class MeshView {
  constructor(stage) {
    this.stage = stage;
    this.button = byId("mesh");
    this.contacts = [];
    /** Number of the mesh in view; none. */
    this.index = null;
    this.button.addEventListener("click", () => this.turn());
  }

  get on() {
    return this.index !== null;
  }

  /** Takes another picture, which may have no mesh. */
  show(scene) {
    this.contacts = scene?.picture.contacts ?? [];
    this.cycle = scene?.motion.cycle;
    this.button.hidden = this.contacts.length === 0;
    if (this.on && !this.contacts[this.index]) this.stage.fit();
    this.tell();
  }

  press(index) {
    this.index = index;
    /** Whether the pitch point stays in the middle; drawn aside, the view stays where it is put. */
    this.following = this.on;
    this.button.setAttribute("aria-pressed", String(this.on));
    this.tell();
  }

  /** Names the mesh in view, where there are several. */
  tell() {
    const { length } = this.contacts;
    const words = length > 1 && this.on ? `Mesh ${this.index + 1}/${length}` : "Mesh";
    if (this.button.textContent !== words) this.button.textContent = words;
    this.button.title = this.on ? (this.contacts[this.index]?.mesh ?? "") : "Close to the mesh, with the points at which flanks touch and the line of action";
  }

  /** Looks at the next mesh; after the last, at everything. */
  turn() {
    const next = this.on ? this.index + 1 : 0;
    if (next >= this.contacts.length) {
      this.stage.fit();
      return;
    }
    const { stage } = this;
    stage.look.leave();
    // From one to the next the scale stays as it is.
    if (!this.on) stage.view.scale = Math.min(stage.width, stage.height) / this.width();
    this.press(next);
    stage.fitted = false;
    stage.draw();
  }

  /** Width of the view, mm. */
  width() {
    // Next to the pitch point, which may be carried about.
    const lengths = this.contacts.flatMap(({ pitch_point: pitches, paths }) => paths.map(({ input, at }) => {
      const ends = [0, at.length - 1].map((i) => apart(at[i], place(pitches, input[i], this.cycle)));
      return ends[0] + ends[1];
    }));
    const longest = lengths.reduce((most, length) => Math.max(most, length), 0);
    const [left, bottom, right, top] = this.stage.scene.picture.extent;
    return longest > 0 ? WIDTHS * longest : SHARE * Math.max(right - left, top - bottom);
  }

  /** Where the pitch point is that is followed; null where none is. */
  middle(input) {
    return this.following ? place(this.contacts[this.index].pitch_point, input, this.cycle) : null;
  }

  draw(input) {
    if (!this.on) return;
    this.button.dataset.contacts = touching(this.stage, input).reduce((sum, { points }) => sum + points.length, 0);
    draw(this.stage, input);
  }
}
