// Links of a machine to scale on a canvas, where its motion has them.

import { Motion } from "./motion.js";
import { color } from "./theme.js";

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
export class Scene {
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

/** How names of places look, and the height of a line of them, pixels. */
const NAMES = "12px system-ui, sans-serif";
const HIGH = 13;

/** How lines look: colour, width in pixels, dashes in pixels. */
const LINES = {
  pitch: ["accent", 1, [9, 3, 2, 3]],
  trace: ["accent", 1.5, []],
  locus: ["pinned", 1.5, [2, 3]],
  overground: ["accent", 1.2, [2, 4]],
  adjacent: ["muted", 1.2, [3, 2]],
  pose: ["pinned", 1.5, [5, 3]],
  ground: ["muted", 1.5, [12, 4]],
  window: ["pinned", 1.2, [6, 4]],
};

/** Lines that a ghost leaves out, and those that are material. */
const FIXED = ["pitch", "ground"];
export const MATTER = ["bar", "clamp"];

/** How a line of a role is drawn at a scale: strokes over each other, each a colour, a width and dashes in pixels. */
export function strokes(role, scale) {
  if (role !== "bar" && role !== "clamp") return [LINES[role]];
  // A bar: an edge around a core.
  const breadth = Math.min(14, Math.max(3, 4 * scale)) * (role === "clamp" ? 0.5 : 1);
  return [["ink", breadth + 2, []], [role === "clamp" ? "accent" : "bar", breadth, []]];
}

/** Draws a scene on a canvas, `width` times `height` pixels of the page large. */
export class Painter {
  constructor(canvas, options) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d", options);
    this.scene = null;
    this.view = { x: 0, y: 0, scale: 1 };
    this.density = 1;
    this.width = 0;
    this.height = 0;
  }

  /** Whether pitch curves are drawn. */
  get pitched() {
    return true;
  }

  /** Takes the size of an element, with so many pixels of the screen to one of the page. */
  measureBy(box, density = window.devicePixelRatio || 1) {
    this.density = density;
    this.width = box.clientWidth;
    this.height = box.clientHeight;
    this.canvas.width = Math.max(1, Math.round(this.width * density));
    this.canvas.height = Math.max(1, Math.round(this.height * density));
  }

  /** Sets the view so that all of the picture is in it, with room around. */
  frame([across, up] = [48, 88]) {
    if (!this.scene) return;
    const [left, bottom, right, top] = this.scene.picture.extent;
    const scale = Math.min((this.width - across) / (right - left), (this.height - up) / (top - bottom));
    if (scale > 0 && Number.isFinite(scale)) this.view = { x: (left + right) / 2, y: (bottom + top) / 2, scale };
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

  /** Whether a position of the box is within some pixels of the pitch curve of a link. */
  isAtPitch(index, pose, [px, py], pixels) {
    const width = this.enter(pose);
    this.context.setLineDash([]);
    this.context.lineWidth = width(2 * pixels);
    const pitch = this.scene.links[index].lines.filter(({ role }) => role === "pitch");
    return pitch.some(({ path }) => this.context.isPointInStroke(path, px * this.density, py * this.density));
  }

  /** Whether a position of the box is on the body of a link, or within some pixels of one of its bars. */
  isOn(index, pose, [px, py], pixels) {
    const width = this.enter(pose);
    const { body, lines } = this.scene.links[index];
    const [x, y] = [px * this.density, py * this.density];
    this.context.setLineDash([]);
    this.context.lineWidth = width(2 * pixels);
    return this.context.isPointInPath(body, x, y, "evenodd") || lines.some(({ role, path }) => MATTER.includes(role) && this.context.isPointInStroke(path, x, y));
  }

  clear() {
    this.context.setTransform(1, 0, 0, 1, 0, 0);
    this.context.clearRect(0, 0, this.canvas.width, this.canvas.height);
  }

  /** Everything that moves, at an input. */
  parts(input) {
    const poses = this.scene.motion.at(input);
    this.scene.links.forEach((link, i) => this.link(link, poses[i]));
    this.scene.links.forEach((link, i) => this.lines(link, poses[i]));
    return poses;
  }

  /** The axes of what turns. */
  axes(poses) {
    this.scene.links.forEach((link, i) => {
      if (link.solid) this.axis(poses[i]);
    });
  }

  /** Dots and names of the places that have one. */
  marks(poses) {
    this.named(poses).forEach((mark) => this.mark(mark));
  }

  /** Named positions, in pixels, with where the name begins: next to its position where no other name is, nowhere if there is no room, once where two of one name meet. */
  named(poses) {
    this.context.font = NAMES;
    const taken = [];
    const found = [];
    for (const { name, link, at: [u, v] } of this.scene.picture.marks) {
      const [x, y, angle] = poses[link];
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      const [px, py] = this.toBox(x + c * u - s * v, y + s * u + c * v);
      if (found.some((other) => other.name === name && Math.hypot(other.at[0] - px, other.at[1] - py) < 1)) continue;
      const { width } = this.context.measureText(name);
      const free = ([left, base]) => taken.every(([l, b, w]) => Math.abs(b - base) >= HIGH || left >= l + w || l >= left + width);
      const places = [8, -8 - width].flatMap((across) => [[px + across, py - 6], [px + across, py + 16]]);
      const words = places.find(free) ?? null;
      if (words) taken.push([...words, width]);
      found.push({ name, at: [px, py], words });
    }
    return found;
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
    // Wider lines take a browser without a graphics card three times as long.
    this.context.lineWidth = width(1);
    this.context.lineJoin = "round";
    this.context.setLineDash([]);
    this.context.fill(link.body, "evenodd");
    this.context.stroke(link.body);
  }

  lines(link, pose) {
    if (link.lines.length === 0) return;
    const { context } = this;
    const width = this.enter(pose);
    context.lineJoin = "round";
    for (const { role, path } of link.lines) {
      if (role === "pitch" && !this.pitched) continue;
      for (const [name, pixels, dashes] of strokes(role, this.view.scale)) {
        context.lineCap = dashes.length ? "butt" : "round";
        context.strokeStyle = color(name);
        context.lineWidth = width(pixels);
        context.setLineDash(dashes.map(width));
        context.stroke(path);
      }
    }
    context.lineCap = "butt";
    context.setLineDash([]);
  }

  /** A dot with its name. */
  mark({ name, at: [px, py], words }) {
    const { context } = this;
    context.setTransform(this.density, 0, 0, this.density, 0, 0);
    context.fillStyle = color("pinned");
    context.beginPath();
    context.arc(px, py, 4, 0, 2 * Math.PI);
    context.fill();
    if (!words) return;
    context.font = NAMES;
    // Lines that a name lies on stop short of it.
    Object.assign(context, { strokeStyle: color("sheet"), lineWidth: 3, lineJoin: "round" });
    context.strokeText(name, ...words);
    context.fillStyle = color("ink");
    context.fillText(name, ...words);
  }

  /** The outlines of a link, with the paths of its points or without. */
  ghost(link, pose, tint, ways = true) {
    if (!pose) return;
    const width = this.enter(pose);
    this.context.strokeStyle = color(tint);
    this.context.lineWidth = width(1.2);
    this.context.setLineDash([width(4), width(3)]);
    this.context.stroke(link.body);
    for (const { role, path } of link.lines) if (ways ? !FIXED.includes(role) : MATTER.includes(role)) this.context.stroke(path);
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
}
