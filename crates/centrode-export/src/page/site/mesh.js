// Close to the mesh of two gears: the points at which their flanks touch, and the line of action.

import { byId } from "./elements.js";
import { color } from "./theme.js";

/** Width of the view, in lengths of the longest path of contact. */
const WIDTHS = 4;

/** Place of a track at an input, which may be one of the cycle before or after; null where it has none. */
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

/** Follows the mesh of a stage's picture once its button is pressed. */
export class MeshView {
  constructor(stage) {
    this.stage = stage;
    this.button = byId("mesh");
    this.on = false;
    this.button.addEventListener("click", () => this.turn(!this.on));
  }

  /** Takes another picture, which may have no mesh. */
  show(scene) {
    this.contacts = scene?.picture.contacts ?? null;
    this.cycle = scene?.motion.cycle;
    this.button.hidden = !this.contacts;
    if (!this.contacts && this.on) this.stage.fit();
  }

  press(on) {
    this.on = on;
    /** Whether the pitch point stays in the middle; drawn aside, the view stays where it is put. */
    this.following = on;
    this.button.setAttribute("aria-pressed", String(on));
  }

  turn(on) {
    if (!on) {
      this.stage.fit();
      return;
    }
    this.press(on);
    this.stage.fitted = false;
    const lengths = this.contacts.paths.map(({ at }) => apart(at[0], at[at.length - 1]));
    const length = Math.max(...lengths, 0);
    const { stage } = this;
    if (length > 0) stage.view.scale = Math.min(stage.width, stage.height) / (WIDTHS * length);
    stage.draw();
  }

  /** Moves the view with the pitch point, which stays in its middle. */
  follow(input) {
    const at = this.following && place(this.contacts.pitch_point, input, this.cycle);
    if (at) [this.stage.view.x, this.stage.view.y] = at;
  }

  /** Points of contact at an input. */
  points(input) {
    return this.contacts.paths.map((path) => place(path, input, this.cycle)).filter(Boolean);
  }

  draw(input) {
    if (!this.on) return;
    const pitch = place(this.contacts.pitch_point, input, this.cycle);
    if (!pitch) return;
    const { stage } = this;
    const { context, density } = stage;
    const points = this.points(input);
    this.button.dataset.contacts = points.length;
    context.setTransform(density, 0, 0, density, 0, 0);
    // All contacts lie on one line through the pitch point: the farthest tells it best.
    const far = points.reduce((best, point) => (apart(pitch, point) > apart(pitch, best) ? point : best), pitch);
    const length = apart(pitch, far);
    const [px, py] = stage.toBox(...pitch);
    if (length > 0) {
      const reach = stage.width + stage.height;
      const [dx, dy] = [(reach * (far[0] - pitch[0])) / length, (-reach * (far[1] - pitch[1])) / length];
      context.strokeStyle = color("pinned");
      context.lineWidth = 1;
      context.setLineDash([10, 4]);
      context.beginPath();
      context.moveTo(px - dx, py - dy);
      context.lineTo(px + dx, py + dy);
      context.stroke();
      context.setLineDash([]);
    }
    const dot = ([x, y], radius, fill) => {
      context.beginPath();
      context.arc(x, y, radius, 0, 2 * Math.PI);
      context.fillStyle = color(fill);
      context.fill();
      context.strokeStyle = color("sheet");
      context.stroke();
    };
    dot([px, py], 3, "ink");
    for (const point of points) dot(stage.toBox(...point), 5, "pinned");
  }
}
