// Path, axis and gears that are wished for: as the form shows them, and as the program is asked.

/** The drawn path of the documentation, with an axis beside it, its working part, and key poses. */
export const EXAMPLE = {
  given: "path",
  path: {
    x: [0, 60, 150, 230, 262, 235, 170, 100, 40, -5, -30, -38, -30],
    y: [0, 70, 150, 215, 262, 300, 330, 330, 300, 250, 190, 130, 60],
  },
  poses: {
    x: [249.08, 167.32, 104.4, 175.51],
    y: [50.03, 64.88, 34.05, 14.69],
    direction_deg: [31.93, 20.89, 42.55, 53.59],
  },
  stroke: { x: [0, 60, 150, 230, 262], y: [0, 70, 150, 215, 262] },
  axis: [260, 160],
  bend: 40,
  arms: 3,
  split: "powers",
  band: 0,
};

/** Fewer points make no closed curve, and fewer poses no machine. */
const FEWEST = { path: 4, stroke: 3, poses: 3 };
/** Length of the clamp as it is drawn, as a share of the size of all poses. */
const CLAMP = 0.2;
/** More rows and handles would take the page too long. */
const MOST = 200;

const GIVEN = [
  { word: "path", doc: "A closed path: the tip passes its points in order." },
  { word: "stroke", doc: "The working part of a path: the return from its last point to its first is sought." },
  { word: "poses", doc: "Three to seven key poses: places of the tip and the way the clamp points there; the path between them is free." },
];

const SPLITS = [
  { word: "powers", doc: "Two different pairs, each with half of the logarithm of the ratio." },
  { word: "mildest", doc: "Two different pairs, the sharpest of whose pitch curves is as blunt as it can be." },
  { word: "one-pair", doc: "One pair twice: sun and planet are the same part." },
];

/** Fields by their keys: where their value stands, and what is known of them. */
const FIELDS = {
  "wanted.given": { kind: "choice", unit: "", choices: GIVEN, doc: "A closed path, its working part with the return free, or a few key poses with the path between them free." },
  "axis.x": { unit: "mm", doc: "Axis about which the carrier turns. Drag it in the picture, too." },
  "axis.y": { unit: "mm", doc: "Axis about which the carrier turns. Drag it in the picture, too." },
  "gears.bend_deg": { unit: "°", least: -170, greatest: 170, doc: "Angle from the carrier's first leg, to the intermediate gear, to its second. A greater bend gives greater gears." },
  "gears.arms": { kind: "integer", unit: "", least: 1, greatest: 12, doc: "Number of arms." },
  "gears.band": { unit: "mm", least: 0, greatest: 1e6, doc: "Distance within which the path may pass its points: it is eased there, for larger teeth, when the machine is made. Zero: through its points." },
  "gears.split": { kind: "choice", unit: "", choices: SPLITS, doc: "How two stages of gears share the motion." },
};

const numbers = (key, value, doc, unit = "mm") => ({ key, kind: "numbers", value, unit, doc, written: true });

function field(key, value) {
  return { key, kind: "number", value, written: true, choices: [], ...FIELDS[key] };
}

/** A coordinate with no more digits than one reads. */
const short = (value) => Number(value.toFixed(3));

/** A point halfway on to the next of a smooth closed curve. */
function onward(points, i) {
  const at = (k) => points[(i + k + points.length) % points.length];
  return [0, 1].map((k) => short((9 * (at(0)[k] + at(1)[k]) - at(-1)[k] - at(2)[k]) / 16));
}

/** A pose halfway to the next. */
const between = (poses, i) => poses[i].map((one, k) => short((one + poses[(i + 1) % poses.length][k]) / 2));

/** The table of what is given. */
function given(wish) {
  const kind = wish.given;
  const doc = kind === "poses" ? "Place of the tip." : "Points that the tip passes, in order.";
  const columns = ["x", "y"].map((name) => numbers(`${kind}.${name}`, wish[kind][name], doc));
  const options = { columns: ["x", "y"], fewest: FEWEST[kind], halfway: between };
  if (kind === "path") Object.assign(options, { smooth: true, halfway: onward });
  if (kind === "poses") {
    Object.assign(options, { columns: ["x", "y", "direction_deg"], noun: "pose" });
    columns.push(numbers("poses.direction_deg", wish.poses.direction_deg, "Direction of the clamp.", "°"));
  }
  return { key: kind, doc: GIVEN.find(({ word }) => word === kind).doc, points: options, fields: columns };
}

/** Tables of the form. */
export function tables(wish) {
  const { axis, bend, arms, split, band } = wish;
  const gears = [field("gears.bend_deg", bend), field("gears.arms", arms), field("gears.split", split)];
  if (wish.given !== "poses") gears.push(field("gears.band", band));
  return [
    { key: "wanted", doc: "What is given", fields: [field("wanted.given", wish.given)] },
    ...(wish.given === "path" ? [{ key: "axis", doc: "Axis of the carrier", fields: [field("axis.x", axis[0]), field("axis.y", axis[1])] }] : []),
    { key: "gears", doc: "Gears and arms", fields: gears },
    given(wish),
  ];
}

/** Reason why a value is none of a key. */
function fault(key, value) {
  const { kind, least, greatest } = FIELDS[key] ?? {};
  if (kind === "choice") return null;
  if (typeof value !== "number") return value === "" ? "a number is missing" : `${value} is no number`;
  if (kind === "integer" && !Number.isInteger(value)) return `${value} is no whole number`;
  if (value < least || value > greatest) return `a number from ${least} to ${greatest}, not ${value}`;
  return null;
}

/** The wish with other values, or the first key at fault and the reason. */
export function changed(wish, edits) {
  const next = structuredClone(wish);
  for (const { key, value } of edits) {
    const [, table, list, place] = /^(path|stroke|poses)\.([a-z_]+)(?:\[(\d+)\])?$/.exec(key) ?? [];
    const values = Array.isArray(value) ? value : [value];
    const wrong = values.map((one) => fault(key, one)).find(Boolean) ?? (values.length > MOST ? `${values.length} points; the page shows up to ${MOST}` : null);
    if (wrong) return { key, wrong };
    if (list && place === undefined) next[table][list] = values;
    else if (list) next[table][list][Number(place)] = value;
    else if (key === "axis.x") next.axis[0] = value;
    else if (key === "axis.y") next.axis[1] = value;
    else next[{ "wanted.given": "given", "gears.bend_deg": "bend", "gears.arms": "arms", "gears.split": "split", "gears.band": "band" }[key]] = value;
  }
  return { next };
}

/** Rows of what is given: points, or poses. */
export function rowsOf(wish) {
  const { x, y, direction_deg } = wish[wish.given];
  return x.map((one, i) => (direction_deg ? [one, y[i], direction_deg[i]] : [one, y[i]]));
}

/** The wish with other rows of what is given. */
export function withRows(wish, rows) {
  const names = ["x", "y", "direction_deg"].slice(0, wish.given === "poses" ? 3 : 2);
  return { ...wish, [wish.given]: Object.fromEntries(names.map((name, k) => [name, rows.map((row) => row[k])])) };
}

/** A wish as the program is asked. */
export function asked(wish) {
  const choices = { bend_deg: wish.bend, arms: wish.arms, split: wish.split };
  const rows = rowsOf(wish);
  if (wish.given === "path") return { points: rows, axis: wish.axis, ...choices };
  return wish.given === "poses" ? { poses: rows, ...choices } : { stroke: rows, band: wish.band, ...choices };
}

/** Greatest distance across a path, or poses. */
export const sizeOf = ({ x, y }) => Math.hypot(Math.max(...x) - Math.min(...x), Math.max(...y) - Math.min(...y));

const HANDLE = { link: 0, plane: "cartesian", scale: 1, origin: [0, 0], chained: true };

/** Points of the picture that can be dragged. */
export function handles(wish) {
  const { given, axis } = wish;
  const { x, y, direction_deg } = wish[given];
  const noun = direction_deg ? "pose" : "point";
  const points = x.map((one, i) => ({ ...HANDLE, name: `${noun} ${i + 1} of the path`, keys: [`${given}.x[${i}]`, `${given}.y[${i}]`], values: [one, y[i]] }));
  if (given === "path") return [...points, { ...HANDLE, name: "axis of the carrier", kind: "axis", chained: false, keys: ["axis.x", "axis.y"], values: axis }];
  if (given === "stroke") return points;
  const length = CLAMP * sizeOf(wish.poses);
  return [...points, ...direction_deg.map((angle, i) => ({
    ...HANDLE, name: `direction of pose ${i + 1}`, plane: "polar", origin: [x[i], y[i]], chained: false, keys: ["", `poses.direction_deg[${i}]`], values: [length, angle],
  }))];
}

/** Lines that show what is wanted: the clamp in every pose; of a stroke, its points joined. */
export function wantedLines(wish) {
  const { x, y, direction_deg } = wish[wish.given];
  if (!direction_deg) return [{ role: "beside", closed: false, vertices: x.flatMap((one, i) => [one, y[i], 0]) }];
  const length = CLAMP * sizeOf(wish.poses);
  return direction_deg.map((angle, i) => {
    const [c, s] = [Math.cos((angle * Math.PI) / 180), Math.sin((angle * Math.PI) / 180)];
    return { role: "clamp", closed: false, vertices: [x[i], y[i], 0, x[i] + length * c, y[i] + length * s, 0] };
  });
}

/** What is wanted as a picture: the order of the places, and the lines. */
export function wantedPicture(wish) {
  const { x, y } = wish[wish.given];
  const room = 2 * CLAMP * sizeOf({ x, y });
  return {
    shapes: [[{ role: "beside", closed: wish.given === "poses", vertices: x.flatMap((one, i) => [one, y[i], 0]) }], wantedLines(wish)],
    links: [{ name: "path", shape: 0 }, { name: "wanted", shape: 1 }],
    motion: { input_name: "carrier", input: [0, 2 * Math.PI], poses: [[0, 0, 0], [0, 0, 0]] },
    handles: [],
    marks: [],
    extent: [Math.min(...x) - room, Math.min(...y) - room, Math.max(...x) + room, Math.max(...y) + room],
  };
}
