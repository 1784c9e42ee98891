// Paths of a machine's points at several values of one number, over each other.

import { element } from "./elements.js";
import { Painter, Scene } from "./painter.js";
import { color } from "./theme.js";

/** Links of a scene with the lines that tell its motion: the ways of points, or the pitch curves of gears alone. */
function told(picture) {
  const scene = new Scene(picture);
  const poses = scene.motion.at(0);
  const of = (wanted) => picture.links.flatMap((link, i) => {
    const paths = picture.shapes[link.shape].filter(({ role, vertices }) => role === wanted && vertices.length);
    const lines = scene.links[i].lines.filter(({ role }) => role === wanted);
    return lines.map(({ path }, k) => ({ path, vertices: paths[k].vertices, pose: poses[i] }));
  });
  const traces = of("trace");
  return traces.length ? traces : of("pitch");
}

/** Draws the ways of one design after the other; the first is the design as it is. */
export class Ways extends Painter {
  constructor() {
    super(element("canvas", { role: "img", "aria-label": "Paths of the points at these values" }));
    this.box = element("div", { class: "ways" }, this.canvas);
    this.drawn = [];
  }

  /** Adds a design's ways, with a name to be written next to them. */
  add(picture, name) {
    const [left, bottom, right, top] = picture.extent;
    const before = this.scene?.picture.extent ?? picture.extent;
    this.scene = { picture: { extent: [
      Math.min(left, before[0]), Math.min(bottom, before[1]), Math.max(right, before[2]), Math.max(top, before[3]),
    ] } };
    this.drawn.push({ lines: told(picture), name });
    this.draw();
  }

  /** How many of the designs have ways at all. */
  get count() {
    return this.drawn.filter(({ lines }) => lines.length).length;
  }

  /** Draws all of them, one in front. */
  draw(front) {
    this.measureBy(this.box);
    this.frame([32, 32]);
    this.clear();
    this.names = [];
    const order = this.drawn.map((_, i) => i).reverse().sort((i, j) => (i === front) - (j === front));
    for (const i of order) this.way(this.drawn[i], i, i === front);
  }

  way({ lines, name }, index, front) {
    const { context } = this;
    for (const { path, pose } of lines) {
      const width = this.enter(pose);
      context.setLineDash([]);
      context.strokeStyle = hue(index);
      context.lineWidth = width(front ? 3.5 : index ? 1.4 : 2.6);
      context.stroke(path);
    }
    const longest = lines.reduce((best, line) => (line.vertices.length > (best?.vertices.length ?? 0) ? line : best), null);
    if (!longest || !name) return;
    // Each name at another point of its path, so that they do not lie on each other.
    const count = longest.vertices.length / 3;
    const at = Math.floor(((index * 0.17) % 1) * count);
    const [u, v] = [longest.vertices[3 * at], longest.vertices[3 * at + 1]];
    const [ox, oy, angle] = longest.pose;
    const [px, py] = this.toBox(ox + Math.cos(angle) * u - Math.sin(angle) * v, oy + Math.sin(angle) * u + Math.cos(angle) * v);
    context.setTransform(this.density, 0, 0, this.density, 0, 0);
    context.font = `${front ? "bold " : ""}12px system-ui, sans-serif`;
    context.fillStyle = color("ink");
    // Below a name that is there already.
    let level = py - 4;
    while (this.names.some(([x, y]) => Math.abs(x - px) < 60 && Math.abs(y - level) < 13)) level += 13;
    this.names.push([px, level]);
    context.fillText(name, px + 4, level);
  }
}

/** Colour of a design's ways by its number: that of the machine's own points first. */
export const hue = (index) => (index ? `hsl(${(30 + 75 * index) % 360} 60% 50%)` : color("accent"));
