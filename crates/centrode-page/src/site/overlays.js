// What can be laid over the picture: the machine at other positions of its cycle, and dimensions.

import { bore, reach } from "./reach.js";
import { color } from "./theme.js";

/** Places of the cycle that are drawn over each other, and how faintly. */
const POSES = 12;
export const FAINT = 0.35;
/** Axes nearer to each other than this share of the picture are one. */
const ONE = 1e-4;

/** Where what moves stands at places evenly spread over the cycle: index of the link and pose, each once. */
export function spread({ motion, picture, links }) {
  const moving = links.map((_, i) => i).filter((i) => picture.motion.poses[i].length > 3);
  return Array.from({ length: POSES }, (_, k) => motion.at((k / POSES) * motion.cycle)).flatMap((places) => moving.map((i) => [i, places[i]]));
}

/** Draws what moves at these places, by its outlines. */
export function poses(painter) {
  const { scene, context } = painter;
  const alpha = context.globalAlpha;
  context.globalAlpha = FAINT * alpha;
  for (const [i, pose] of spread(scene)) painter.ghost(scene.links[i], pose, "accent", false);
  context.globalAlpha = alpha;
}

/** The axes of bodies at a position of the cycle, each once. */
function axes(scene, places) {
  const [left, bottom, right, top] = scene.picture.extent;
  const near = ONE * Math.hypot(right - left, top - bottom);
  const found = [];
  scene.links.forEach((link, i) => {
    if (!link.solid) return;
    const [x, y] = places[i];
    if (!found.some(([u, v]) => Math.hypot(u - x, v - y) < near)) found.push([x, y]);
  });
  return found;
}

/** The shortest lines that join all points: pairs of them. */
function joined(points) {
  const pairs = [];
  const [tree, rest] = [points.slice(0, 1), points.slice(1)];
  while (rest.length) {
    let best = null;
    for (const a of tree) {
      rest.forEach((b, i) => {
        const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
        if (!best || length < best.length) best = { a, i, length };
      });
    }
    const [b] = rest.splice(best.i, 1);
    tree.push(b);
    pairs.push({ a: best.a, b, length: best.length });
  }
  return pairs;
}

const short = (value) => Number(value.toPrecision(4));

/**
 * Dimensions in pixels of a painter: ends of their lines, and words. Distances of axes that are next to each other; of each
 * form of gear its greatest and its least radius, and its bore.
 */
export function dimensions(painter, places) {
  const { scene } = painter;
  const line = (a, b, words) => ({ from: painter.toBox(...a), to: painter.toBox(...b), words });
  const found = joined(axes(scene, places)).map(({ a, b, length }) => line(a, b, `${short(length)} mm`));
  const seen = new Set();
  scene.picture.links.forEach(({ shape: number }, i) => {
    const shape = scene.picture.shapes[number];
    if (seen.has(number) || !shape.some(({ role }) => role === "pitch") || !reach(shape)) return;
    seen.add(number);
    const [x, y, angle] = places[i];
    const on = ([u, v]) => [x + Math.cos(angle) * u - Math.sin(angle) * v, y + Math.sin(angle) * u + Math.cos(angle) * v];
    const { least, greatest } = reach(shape);
    found.push(line([x, y], on(greatest.at), `R ${short(greatest.radius)}`), line([x, y], on(least.at), `R ${short(least.radius)}`));
    const hole = bore(shape);
    if (hole) found.push(line(on([-hole, 0]), on([hole, 0]), `⌀ ${short(2 * hole)}`));
  });
  return found;
}

/** Draws dimensions over the picture. */
export function measured(painter, places) {
  const { context, density } = painter;
  context.setTransform(density, 0, 0, density, 0, 0);
  context.strokeStyle = color("pinned");
  context.lineWidth = 1;
  context.setLineDash([]);
  context.font = "12px system-ui, sans-serif";
  context.textAlign = "center";
  for (const { from, to, words } of dimensions(painter, places)) {
    context.beginPath();
    context.moveTo(...from);
    context.lineTo(...to);
    context.stroke();
    const [x, y] = middle(from, to);
    const wide = context.measureText(words).width + 8;
    context.fillStyle = color("sheet");
    context.fillRect(x - wide / 2, y - 9, wide, 18);
    context.fillStyle = color("pinned");
    context.fillText(words, x, y + 4);
  }
  context.textAlign = "start";
}

/** Where the words of a dimension stand: two thirds on its way, clear of others from the same axis. */
export const middle = (from, to) => [0, 1].map((k) => from[k] + (to[k] - from[k]) * 0.62);
