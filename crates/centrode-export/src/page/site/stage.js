// The drawing: links to scale where the motion has them, with zoom and pan.

import { byId } from "./elements.js";
import { Motion } from "./motion.js";
import { color } from "./theme.js";

const CLOSEST = 1e5;

/** Lines and arcs of a snapshot as the canvas draws them. */
function outline({ vertices, closed }) {
  const path = new Path2D();
  const count = vertices.length / 3;
  path.moveTo(vertices[0], vertices[1]);
  for (let i = 0; i < (closed ? count : count - 1); i += 1) {
    const [x, y, bulge] = [vertices[3 * i], vertices[3 * i + 1], vertices[3 * i + 2]];
    const j = (i + 1) % count;
    const [u, v] = [vertices[3 * j], vertices[3 * j + 1]];
    const chord = Math.hypot(u - x, v - y);
    if (bulge === 0 || chord === 0) {
      path.lineTo(u, v);
      continue;
    }
    const lift = (1 - bulge * bulge) / (4 * bulge);
    const [cx, cy] = [(x + u) / 2 - (v - y) * lift, (y + v) / 2 + (u - x) * lift];
    const radius = (chord * (1 + bulge * bulge)) / (4 * Math.abs(bulge));
    path.arc(cx, cy, radius, Math.atan2(y - cy, x - cx), Math.atan2(v - cy, u - cx), bulge < 0);
  }
  if (closed) path.closePath();
  return path;
}

/** The lines of a part. */
function shape(paths) {
  const body = new Path2D();
  const lines = [];
  for (const path of paths) {
    if (path.vertices.length === 0) continue;
    if (path.role === "body" || path.role === "hole") body.addPath(outline(path));
    else lines.push({ role: path.role, path: outline(path) });
  }
  return { body, lines, solid: paths.some((path) => path.role === "body") };
}

/** A picture ready to be drawn. */
class Scene {
  constructor(picture) {
    this.picture = picture;
    this.motion = new Motion(picture.motion);
    const shapes = picture.shapes.map(shape);
    this.links = picture.links.map((link) => ({ ...shapes[link.shape], name: link.name, kind: link.name.replace(/ \d+$/, "") }));
    // Links of one kind have one colour.
    const kinds = [...new Set(this.links.filter((link) => link.solid).map((link) => link.kind))];
    for (const link of this.links) link.tint = kinds.indexOf(link.kind);
  }
}

/** How lines look: colour, width in pixels, dashes in pixels. */
const LINES = {
  pitch: ["accent", 1, [9, 3, 2, 3]],
  trace: ["accent", 1.5, []],
  locus: ["pinned", 1.5, [2, 3]],
  overground: ["accent", 1.2, [2, 4]],
  beside: ["muted", 1.2, [3, 2]],
  pose: ["pinned", 1.5, [5, 3]],
  ground: ["muted", 1.5, [12, 4]],
  window: ["pinned", 1.2, [6, 4]],
};

export class Stage {
  constructor(moved) {
    this.box = byId("stage");
    this.canvas = this.box.querySelector("canvas");
    this.context = this.canvas.getContext("2d");
    this.moved = moved;
    this.scene = null;
    this.pinned = null;
    this.input = 0;
    this.stale = false;
    this.view = { x: 0, y: 0, scale: 1 };
    this.fitted = true;
    /** Whether a point is being drawn aside: the view must not move under it. */
    this.held = false;
    this.density = 1;
    /** Of the box: asking the page for it costs a layout. */
    this.width = 0;
    this.height = 0;
    this.resize();
    new ResizeObserver(() => this.resize()).observe(this.box);
    this.listen();
  }

  /** Takes a new picture; it is drawn by `at`. */
  show(picture) {
    this.scene = picture ? new Scene(picture) : null;
    const pitch = this.scene?.links.some((link) => link.lines.some(({ role }) => role === "pitch"));
    byId("show-pitch").parentElement.hidden = !pitch;
    if (this.fitted && !this.held) this.frame();
  }

  pin(picture) {
    this.pinned = picture ? new Scene(picture) : null;
    this.draw();
  }

  at(input) {
    this.input = input;
    this.draw();
  }

  resize(density = window.devicePixelRatio || 1) {
    this.density = density;
    this.width = this.box.clientWidth;
    this.height = this.box.clientHeight;
    // On paper the drawing keeps the shape it has on the screen.
    if (!matchMedia("print").matches) this.box.style.setProperty("--aspect", this.width > 0 && this.height > 0 ? this.width / this.height : 1);
    this.canvas.width = Math.max(1, Math.round(this.width * density));
    this.canvas.height = Math.max(1, Math.round(this.height * density));
    if (this.fitted) this.fit();
    else this.draw();
  }

  fit() {
    this.fitted = true;
    this.frame();
    this.draw();
  }

  /** Sets the view so that all of the picture is in it. */
  frame() {
    if (this.scene) {
      const [left, bottom, right, top] = this.scene.picture.extent;
      const scale = Math.min((this.width - 48) / (right - left), (this.height - 88) / (top - bottom));
      if (scale > 0 && Number.isFinite(scale)) {
        this.view = { x: (left + right) / 2, y: (bottom + top) / 2, scale };
      }
    }
  }

  /** Zooms so that the point under a place of the box stays there. */
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
    this.view.x -= dx / this.view.scale;
    this.view.y += dy / this.view.scale;
    this.fitted = false;
    this.draw();
  }

  toModel(px, py) {
    return [
      this.view.x + (px - this.width / 2) / this.view.scale,
      this.view.y - (py - this.height / 2) / this.view.scale,
    ];
  }

  toBox(x, y) {
    return [
      this.width / 2 + (x - this.view.x) * this.view.scale,
      this.height / 2 - (y - this.view.y) * this.view.scale,
    ];
  }

  draw() {
    const context = this.context;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    if (!this.scene) return;
    context.globalAlpha = this.stale ? 0.45 : 1;
    const poses = this.scene.motion.at(this.input);
    this.scene.links.forEach((link, i) => this.link(link, poses[i]));
    this.scene.links.forEach((link, i) => this.lines(link, poses[i]));
    if (this.pinned) {
      const before = this.pinned.motion.at(this.input * this.pinned.motion.cycle / this.scene.motion.cycle);
      this.pinned.links.forEach((link, i) => this.ghost(link, before[i]));
    }
    this.scene.links.forEach((link, i) => {
      if (link.solid) this.axis(poses[i]);
    });
    this.scene.picture.marks.forEach((mark) => this.mark(mark, poses[mark.link]));
    context.globalAlpha = 1;
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

  /** Into the frame of a link; the returned function makes a width in pixels one of the frame. */
  enter([x, y, angle]) {
    const s = this.view.scale * this.density;
    const [px, py] = this.toBox(x, y);
    const [c, d] = [s * Math.cos(angle), s * Math.sin(angle)];
    this.context.setTransform(c, -d, -d, -c, px * this.density, py * this.density);
    return (pixels) => pixels / this.view.scale;
  }

  link(link, pose) {
    if (!link.solid) return;
    const width = this.enter(pose);
    this.context.fillStyle = color(`link-${link.tint % 5}`);
    this.context.strokeStyle = color("ink");
    this.context.lineWidth = width(1.1);
    this.context.lineJoin = "round";
    this.context.setLineDash([]);
    this.context.fill(link.body, "evenodd");
    this.context.stroke(link.body);
  }

  lines(link, pose) {
    if (link.lines.length === 0) return;
    const { context } = this;
    const width = this.enter(pose);
    for (const { role, path } of link.lines) {
      if (role === "bar" || role === "clamp") {
        this.bar(path, role, width);
        continue;
      }
      if (role === "pitch" && !byId("show-pitch").checked) continue;
      const [name, pixels, dashes] = LINES[role];
      context.strokeStyle = color(name);
      context.lineWidth = width(pixels);
      context.setLineDash(dashes.map(width));
      context.stroke(path);
    }
    context.setLineDash([]);
  }

  /** A bar: an edge around a core. */
  bar(path, role, width) {
    const { context } = this;
    const breadth = Math.min(14, Math.max(3, 4 * this.view.scale)) * (role === "clamp" ? 0.5 : 1);
    context.setLineDash([]);
    context.lineCap = "round";
    context.lineJoin = "round";
    context.strokeStyle = color("ink");
    context.lineWidth = width(breadth + 2);
    context.stroke(path);
    context.strokeStyle = color(role === "clamp" ? "accent" : "bar");
    context.lineWidth = width(breadth);
    context.stroke(path);
    context.lineCap = "butt";
  }

  /** A dot with its name beside it. */
  mark({ name, at }, [x, y, angle]) {
    const { context } = this;
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    const [px, py] = this.toBox(x + c * at[0] - s * at[1], y + s * at[0] + c * at[1]);
    context.setTransform(this.density, 0, 0, this.density, 0, 0);
    context.fillStyle = color("pinned");
    context.beginPath();
    context.arc(px, py, 4, 0, 2 * Math.PI);
    context.fill();
    context.fillStyle = color("ink");
    context.font = "12px system-ui, sans-serif";
    context.fillText(name, px + 8, py - 6);
  }

  ghost(link, pose) {
    if (!pose) return;
    const width = this.enter(pose);
    this.context.strokeStyle = color("pinned");
    this.context.lineWidth = width(1.2);
    this.context.setLineDash([width(4), width(3)]);
    this.context.stroke(link.body);
    for (const { role, path } of link.lines) if (role !== "pitch" && role !== "ground") this.context.stroke(path);
    this.context.setLineDash([]);
  }

  axis(pose) {
    const width = this.enter(pose);
    const reach = width(8);
    this.context.strokeStyle = color("ink");
    this.context.lineWidth = width(1);
    this.context.beginPath();
    this.context.moveTo(-reach, 0);
    this.context.lineTo(reach, 0);
    this.context.moveTo(0, -reach);
    this.context.lineTo(0, reach);
    this.context.stroke();
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
      if (event.button !== 0 || event.target.closest("button, label, .handle")) return;
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
      if (!event.target.closest("button, label, .handle")) this.fit();
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
    byId("show-pitch").addEventListener("change", () => this.draw());
  }
}

/** The longest whole length that is no wider than a share of the box. */
export function ruler(scale, width) {
  const longest = (0.16 * width) / scale;
  const power = 10 ** Math.floor(Math.log10(longest));
  const length = [5, 2, 1].map((k) => k * power).find((candidate) => candidate <= longest) ?? power;
  return { length, pixels: length * scale };
}
