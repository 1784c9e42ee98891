// How far the contours of a link reach from its own axis, arcs taken exactly.

/** Centre and radius of the arc from one corner to the next; null for a straight side. */
function arc([x, y, bulge], [u, v]) {
  const chord = Math.hypot(u - x, v - y);
  if (chord === 0 || !bulge) return null;
  const lift = (1 - bulge * bulge) / (4 * bulge);
  return { center: [(x + u) / 2 - (v - y) * lift, (y + v) / 2 + (u - x) * lift], radius: (chord * (1 + bulge * bulge)) / (4 * Math.abs(bulge)) };
}

/** Corners of a side, and where between them it is nearest to the axis or farthest. */
function extremes(a, b) {
  const [[x, y, bulge], [u, v]] = [a, b];
  const places = [[x, y], [u, v]];
  const round = arc(a, b);
  if (round) {
    const { center: [cx, cy], radius } = round;
    const away = Math.hypot(cx, cy);
    for (const side of away > 0 ? [radius / away, -radius / away] : []) {
      const place = [cx + side * cx, cy + side * cy];
      // An arc that turns counter-clockwise lies to the right of its chord.
      if (((u - x) * (place[1] - y) - (v - y) * (place[0] - x)) * bulge < 0) places.push(place);
    }
    return places;
  }
  const square = (u - x) ** 2 + (v - y) ** 2;
  const share = square > 0 ? -(x * (u - x) + y * (v - y)) / square : 0;
  return share > 0 && share < 1 ? [...places, [x + share * (u - x), y + share * (v - y)]] : places;
}

/** The sides of a shape's contours of a role: both corners of each. */
function sides(shape, role) {
  return shape.filter(({ role: own }) => own === role).flatMap(({ vertices, closed }) => {
    const count = vertices.length / 3;
    const at = (i) => vertices.slice(3 * i, 3 * i + 3);
    return Array.from({ length: closed ? count : Math.max(0, count - 1) }, (_, i) => [at(i), at((i + 1) % count)]);
  });
}

/** The nearest and the farthest place of a shape's outline, each with its radius; null where it has none. */
export function reach(shape) {
  const places = sides(shape, "body").flatMap(([a, b]) => extremes(a, b)).map((at) => ({ at, radius: Math.hypot(...at) }));
  if (places.length === 0) return null;
  const best = (better) => places.reduce((one, other) => (better(other.radius, one.radius) ? other : one));
  return { least: best((a, b) => a < b), greatest: best((a, b) => a > b) };
}

/** Radius of the hole round the axis; null where there is none. */
export function bore(shape) {
  const arcs = sides(shape, "hole").map(([a, b]) => arc(a, b)).filter(Boolean);
  return arcs.find(({ center, radius }) => Math.hypot(...center) < 0.01 * radius)?.radius ?? null;
}
