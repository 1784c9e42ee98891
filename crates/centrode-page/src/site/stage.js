// The drawing: links to scale where the motion has them, with zoom and pan.

import { byId } from "./elements.js";
import { LookView } from "./look.js";
import { MeshView } from "./mesh.js";
import * as overlays from "./overlays.js";
import { Painter, Scene } from "./painter.js";

const CLOSEST = 1e5;
/** Room above and below what is drawn, pixels. */
const SPARE = 44;

export class Stage extends Painter {
  constructor(moved) {
    super(byId("stage").querySelector("canvas"));
    this.box = byId("stage");
    this.moved = moved;
    this.pinned = null;
    this.input = 0;
    this.stale = false;
    this.fitted = true;
    /** Whether a point is being drawn aside: the view must not move under it. */
    this.held = false;
    /** Tool that takes clicks in the picture. */
    this.tool = null;
    /** Picture from before a drag, which is drawn below it. */
    this.before = null;
    this.mesh = new MeshView(this);
    this.look = new LookView(this);
    this.resize();
    new ResizeObserver(() => this.resize()).observe(this.box);
    this.listen();
  }

  /** Takes a new picture; it is drawn by `at`. */
  show(picture) {
    this.scene = picture ? new Scene(picture) : null;
    const pitch = this.scene?.links.some((link) => link.lines.some(({ role }) => role === "pitch"));
    byId("show-pitch").parentElement.hidden = !pitch;
    this.mesh.show(this.scene);
    this.look.show(this.scene);
    if (this.fitted && !this.held) this.frame();
  }

  /** Room is left for the buttons above, however many lines they take. */
  frame() {
    const bar = this.box.querySelector(".view");
    const above = Math.min(Math.max(SPARE, bar.offsetTop + bar.offsetHeight + 4), 0.3 * this.height);
    super.frame([48, above + SPARE]);
    if (this.scene) this.view.y += (above - SPARE) / 2 / this.view.scale;
  }

  pin(picture) {
    this.pinned = picture ? new Scene(picture) : null;
    this.draw();
  }

  /** Keeps the picture as it is now in sight, as a ghost, or no longer. */
  remember(on) {
    this.before = on ? this.scene : null;
    if (!on) this.draw();
  }

  at(input) {
    this.input = input;
    this.draw();
  }

  get pitched() {
    return byId("show-pitch").checked;
  }

  resize(density) {
    this.measureBy(this.box, density);
    // On paper the drawing has the same shape as on the screen.
    if (!matchMedia("print").matches) this.box.style.setProperty("--aspect", this.width > 0 && this.height > 0 ? this.width / this.height : 1);
    if (this.fitted) this.fit();
    else this.draw();
  }

  fit() {
    this.mesh.press(null);
    this.look.leave();
    this.fitted = true;
    this.frame();
    this.draw();
  }

  /** Zooms so that the point under a position of the box stays there. */
  zoom(factor, px = this.width / 2, py = this.height / 2) {
    const [x, y] = this.toModel(px, py);
    this.view.scale = Math.min(Math.max(this.view.scale * factor, 1 / CLOSEST), CLOSEST);
    const [nx, ny] = this.toModel(px, py);
    this.view.x += x - nx;
    this.view.y += y - ny;
    this.fitted = false;
    this.draw();
  }

  pan(dx, dy) {
    this.mesh.following = this.look.following = false;
    this.view.x -= dx / this.view.scale;
    this.view.y += dy / this.view.scale;
    this.fitted = false;
    this.draw();
  }

  /** Whether the view is close to a mesh or a gear. */
  get close() {
    return this.mesh.on || this.look.on;
  }

  /** What the view follows at an input; null where it is fixed. */
  middle(input) {
    return this.mesh.middle(input) ?? this.look.middle(input);
  }

  /** Moves the view with what it follows, which stays in its middle. */
  follow(input) {
    const at = this.middle(input);
    if (at) [this.view.x, this.view.y] = at;
  }

  draw() {
    this.clear();
    if (!this.scene) {
      // What is composed begins on an empty ground.
      if (this.tool) {
        this.measure();
        this.moved?.([[0, 0, 0]]);
      }
      return;
    }
    this.follow(this.input);
    this.context.globalAlpha = this.stale ? 0.45 : 1;
    const poses = this.parts(this.input);
    for (const [scene, tint] of [[this.before, "muted"], [this.pinned, "pinned"]]) {
      if (!scene || scene === this.scene) continue;
      const poses = scene.motion.at(this.input * scene.motion.cycle / this.scene.motion.cycle);
      scene.links.forEach((link, i) => this.ghost(link, poses[i], tint));
    }
    if (byId("show-poses").checked) overlays.poses(this);
    this.axes(poses);
    this.marks(poses);
    if (byId("show-distances").checked) overlays.measured(this, poses);
    this.mesh.draw(this.input);
    this.context.globalAlpha = 1;
    this.measure();
    this.moved?.(poses);
  }

  /** A rule at the corner of the drawing. */
  measure() {
    const { length, pixels } = ruler(this.view.scale, this.width);
    const words = length >= 1 ? `${length} mm` : `${Number(length.toPrecision(2))} mm`;
    const wide = `${(100 * pixels) / Math.max(1, this.width)}%`;
    const rule = byId("rule");
    const label = rule.firstChild ?? rule.appendChild(document.createElement("span"));
    if (rule.style.width === wide && label.textContent === words) return;
    rule.style.width = wide;
    label.textContent = words;
  }

  listen() {
    const { box } = this;
    const place = (event) => {
      const bounds = box.getBoundingClientRect();
      return [event.clientX - bounds.left, event.clientY - bounds.top];
    };
    box.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(Math.exp(-event.deltaY / 500), ...place(event));
    }, { passive: false });
    const held = new Map();
    box.addEventListener("pointerdown", (event) => {
      if (event.button !== 0 || event.target.closest("button, label, .handle, .other")) return;
      box.setPointerCapture(event.pointerId);
      held.set(event.pointerId, place(event));
    });
    box.addEventListener("pointermove", (event) => {
      const before = held.get(event.pointerId);
      if (!before) return;
      const now = place(event);
      const other = [...held].find(([id]) => id !== event.pointerId)?.[1];
      if (other) {
        const reach = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]);
        if (reach(before) > 0) this.zoom(reach(now) / reach(before), ...other);
      } else {
        this.pan(now[0] - before[0], now[1] - before[1]);
      }
      held.set(event.pointerId, now);
    });
    for (const end of ["pointerup", "pointercancel"]) {
      box.addEventListener(end, (event) => held.delete(event.pointerId));
    }
    box.addEventListener("dblclick", (event) => {
      if (!this.tool && !event.target.closest("button, label, .handle")) this.fit();
    });
    box.addEventListener("keydown", (event) => {
      if (event.target !== box || event.ctrlKey || event.metaKey || event.altKey) return;
      const step = 40;
      const keys = {
        ArrowLeft: () => this.pan(step, 0),
        ArrowRight: () => this.pan(-step, 0),
        ArrowUp: () => this.pan(0, step),
        ArrowDown: () => this.pan(0, -step),
        "+": () => this.zoom(1.25),
        "=": () => this.zoom(1.25),
        "-": () => this.zoom(0.8),
        0: () => this.fit(),
      };
      if (!keys[event.key]) return;
      event.preventDefault();
      keys[event.key]();
    });
    byId("closer").addEventListener("click", () => this.zoom(1.25));
    byId("farther").addEventListener("click", () => this.zoom(0.8));
    byId("fit").addEventListener("click", () => this.fit());
    for (const id of ["show-pitch", "show-poses", "show-distances"]) byId(id).addEventListener("change", () => this.draw());
  }
}

/** The longest whole length that is no wider than a share of the box. */
export function ruler(scale, width) {
  const longest = (0.16 * width) / scale;
  const power = 10 ** Math.floor(Math.log10(longest));
  const length = [5, 2, 1].map((k) => k * power).find((candidate) => candidate <= longest) ?? power;
  return { length, pixels: length * scale };
}
