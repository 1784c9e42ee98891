// What can be laid over the picture: the machine at other places of its cycle, and the distances of its axes.

import { color } from "./theme.js";

/** Places of the cycle that are drawn over each other. */
const POSES = 12;
/** Axes nearer to each other than this share of the picture are one. */
const ONE = 1e-4;

/** Draws what moves at places evenly spread over the cycle, each by its outline. */
export function poses(painter) {
  const { scene, context } = painter;
  const alpha = context.globalAlpha;
  context.globalAlpha = 0.35 * alpha;
  for (let k = 0; k < POSES; k += 1) {
    const places = scene.motion.at((k / POSES) * scene.motion.cycle);
    scene.links.forEach((link, i) => {
      if (scene.picture.motion.poses[i].length > 3) painter.ghost(link, places[i], "accent");
    });
  }
  context.globalAlpha = alpha;
}

/** The axes of bodies at a place of the cycle, each once. */
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

/** Draws the distances of axes that are next to each other. */
export function distances(painter, places) {
  const { context, scene, density } = painter;
  context.setTransform(density, 0, 0, density, 0, 0);
  context.strokeStyle = context.fillStyle = color("pinned");
  context.lineWidth = 1;
  context.setLineDash([]);
  context.font = "12px system-ui, sans-serif";
  context.textAlign = "center";
  const line = (a, b, length) => {
    const [[px, py], [qx, qy]] = [painter.toBox(...a), painter.toBox(...b)];
    context.beginPath();
    context.moveTo(px, py);
    context.lineTo(qx, qy);
    context.stroke();
    label(`${Number(length.toPrecision(4))} mm`, (px + qx) / 2, (py + qy) / 2);
  };
  const label = (words, x, y) => {
    const wide = context.measureText(words).width + 8;
    context.fillStyle = color("sheet");
    context.fillRect(x - wide / 2, y - 9, wide, 18);
    context.fillStyle = color("pinned");
    context.fillText(words, x, y + 4);
  };
  for (const { a, b, length } of joined(axes(scene, places))) line(a, b, length);
  context.textAlign = "start";
}
