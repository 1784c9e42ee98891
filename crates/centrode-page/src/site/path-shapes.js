// Shapes that the machine must not enter: in the form, as handles and as lines.

/** New shapes are so large, a share of the path's size, and so far next to it. */
const LARGE = 0.1;
const BESIDE = 0.15;

const KINDS = {
  circle: "Circle",
  polygon: "Polygon",
  ground: "Ground",
};

const short = (value) => Number(value.toFixed(3));
const middle = (list) => list.reduce((sum, one) => sum + one, 0) / list.length;
const base = (shape) => `wishes.keep_out.${shape.name}`;

/** Box round points: least and greatest x and y, and its diagonal. */
export function boxOf({ x, y }) {
  const [left, right, low, high] = [Math.min(...x), Math.max(...x), Math.min(...y), Math.max(...y)];
  return { left, right, low, high, size: Math.hypot(right - left, high - low) };
}

/** A new shape next to points, with a name that no other has. */
export function added(kind, shapes, points) {
  const { right, low, high, size } = boxOf(points);
  const taken = shapes.map(({ name }) => name);
  const named = (count) => (count > 1 ? `${kind}-${count}` : kind);
  let count = 1;
  while (taken.includes(named(count))) count += 1;
  // Each below the one before, so that none covers another.
  const [x, y, half] = [short(right + BESIDE * size), short((low + high) / 2 - 2.5 * LARGE * size * shapes.length), short(LARGE * size)];
  const shape = { name: named(count), kind, clearance: 0 };
  if (kind === "circle") return { ...shape, center: [x, y], radius: half };
  if (kind === "ground") return { ...shape, below: short(low - BESIDE * size) };
  return { ...shape, x: [x - half, x + half, x + half, x - half].map(short), y: [y - half, y - half, y + half, y + half].map(short) };
}

/** Shapes as the design file has them. */
export function written(shapes) {
  return Object.fromEntries(shapes.map((shape) => {
    const clearance = shape.clearance ? { clearance: shape.clearance } : {};
    if (shape.kind === "circle") return [shape.name, { center: shape.center, radius: shape.radius, ...clearance }];
    if (shape.kind === "ground") return [shape.name, { below: shape.below, ...clearance }];
    return [shape.name, { corners: shape.x.map((x, i) => [x, shape.y[i]]), ...clearance }];
  }));
}

/** Shapes of a design file. */
export function read(shapes = {}) {
  return Object.entries(shapes).map(([name, { corners, center, radius, below, clearance = 0 }]) => {
    if (center) return { name, kind: "circle", center, radius, clearance };
    if (below !== undefined && below !== null) return { name, kind: "ground", below, clearance };
    return { name, kind: "polygon", x: corners.map(([x]) => x), y: corners.map(([, y]) => y), clearance };
  });
}

/** Changes a key of a shape, or deletes the shape; returns what is wrong, if anything. */
export function change(shapes, name, key, place, value) {
  const at = shapes.findIndex((shape) => shape.name === name);
  if (at < 0) return null;
  const shape = shapes[at];
  if (key === undefined) {
    shapes.splice(at, 1);
  } else if (key === "name") {
    if (shapes.some((other) => other !== shape && other.name === value)) return `there is a shape ${value} already`;
    if (!/^[A-Za-z0-9_-]{1,64}$/.test(value ?? "")) return "1 to 64 letters, digits, - or _";
    shape.name = value;
  } else if (key === "at.x" || key === "at.y") {
    // The whole polygon moves with its middle.
    const list = key.slice(-1);
    const step = value - middle(shape[list]);
    shape[list] = shape[list].map((one) => short(one + step));
  } else if (place === undefined) {
    shape[key] = value;
  } else {
    shape[key][Number(place)] = value;
  }
  return null;
}

/** Fields of a shape by their keys. */
export const FIELDS = {
  radius: { unit: "mm", positive: true, doc: "Radius of the circle." },
  below: { unit: "mm", doc: "Height of the ground, which fills all below it: its y." },
  clearance: { unit: "mm", minimum: 0, doc: "Minimum distance of the arm's plate from it." },
  center: { kind: "numbers", unit: "mm", doc: "Centre of the circle: x and y." },
  name: { kind: "text", unit: "", doc: "Its name in the design: letters, digits, - and _." },
};

/** Tables of the form: one to add shapes, and one a shape. `act` has what their buttons do. */
export function tables(shapes, act) {
  const field = (shape, name) => ({ key: `${base(shape)}.${name}`, kind: "number", value: shape[name], written: true, choices: [], ...FIELDS[name] });
  const columns = (shape) => ["x", "y"].map((name) => ({ key: `${base(shape)}.${name}`, kind: "numbers", value: shape[name], unit: "mm", doc: "Corners of the polygon in order.", written: true }));
  const own = {
    circle: (shape) => [field(shape, "center"), field(shape, "radius")],
    ground: (shape) => [field(shape, "below")],
    polygon: columns,
  };
  const one = (shape) => ({
    key: base(shape), title: `Keep out of ${shape.name}`, doc: "A shape that the machine must not enter; it can be dragged in the picture.",
    points: shape.kind === "polygon" ? { columns: ["x", "y"], fewest: 3, noun: "corner", halfway: (points, i) => points[i].map((one, k) => short((one + points[(i + 1) % points.length][k]) / 2)) } : undefined,
    fields: [field(shape, "name"), ...own[shape.kind](shape), field(shape, "clearance")],
    actions: [{ id: `delete-${shape.name}`, words: `Delete ${shape.name}`, act: () => act.drop(shape.name) }],
  });
  const add = Object.entries(KINDS).map(([kind, words]) => ({ id: `add-${kind}`, words, title: `Add a shape to keep out of: ${words.toLowerCase()}`, act: () => act.add(kind) }));
  return [{ key: "wishes.keep_out", title: "Keep out of", doc: "Shapes that the machine must not enter: tray, ground, planted stems.", fields: [], actions: add }, ...shapes.map(one)];
}

/** Points of the picture by which shapes are dragged; Delete at one of them drops the shape, but for a corner. */
export function handles(shapes, handle, points) {
  const { left, right } = boxOf(points);
  return shapes.flatMap((shape) => {
    const key = base(shape);
    const drop = [{ key, value: null }];
    const one = (rest) => ({ ...handle, chained: false, kind: "shape", drop, ...rest });
    if (shape.kind === "circle") {
      return [
        one({ name: `centre of ${shape.name}`, keys: [`${key}.center[0]`, `${key}.center[1]`], values: shape.center }),
        one({ name: `radius of ${shape.name}`, plane: "polar", origin: shape.center, keys: [`${key}.radius`, ""], values: [shape.radius, 0] }),
      ];
    }
    if (shape.kind === "ground") return [one({ name: `height of ${shape.name}`, keys: ["", `${key}.below`], values: [(left + right) / 2, shape.below] })];
    return [
      one({ name: `middle of ${shape.name}`, keys: [`${key}.at.x`, `${key}.at.y`], values: [short(middle(shape.x)), short(middle(shape.y))] }),
      ...shape.x.map((x, i) => one({ name: `corner ${i + 1} of ${shape.name}`, kind: "corner", chained: true, drop: undefined, keys: [`${key}.x[${i}]`, `${key}.y[${i}]`], values: [x, shape.y[i]] })),
    ];
  });
}

/** Lines of the shapes. */
export function lines(shapes, points) {
  const { left, right, size } = boxOf(points);
  return shapes.map((shape) => {
    if (shape.kind === "circle") {
      const [[x, y], r] = [shape.center, shape.radius];
      return { role: "ground", closed: true, vertices: [x + r, y, 1, x - r, y, 1] };
    }
    if (shape.kind === "ground") return { role: "ground", closed: false, vertices: [left - size / 2, shape.below, 0, right + size / 2, shape.below, 0] };
    return { role: "ground", closed: true, vertices: shape.x.flatMap((x, i) => [x, shape.y[i], 0]) };
  });
}

/** Box of the shapes as x and y of places, for the picture to hold them. */
export function places(shapes) {
  return shapes.flatMap((shape) => {
    if (shape.kind === "circle") return [[-1, -1], [1, 1]].map(([u, v]) => [shape.center[0] + u * shape.radius, shape.center[1] + v * shape.radius]);
    return shape.kind === "polygon" ? shape.x.map((x, i) => [x, shape.y[i]]) : [];
  });
}
