// Path, axis, gears and further wishes as the form and the picture show them.

import { RANGES, USUAL, columnsOf, designOf } from "./path-design.js";
import * as shapes from "./path-shapes.js";

const none = (list) => list.map(() => null);
const points = (x, y) => ({ x, y, tolerance: none(x), direction_deg: none(x), direction_tolerance_deg: none(x) });

/** The drawn path of the documentation, with an axis next to it, its working part, and key poses. */
export const EXAMPLE = {
  given: "path",
  path: points([0, 60, 150, 230, 262, 235, 170, 100, 40, -5, -30, -38, -30], [0, 70, 150, 215, 262, 300, 330, 330, 300, 250, 190, 130, 60]),
  poses: {
    x: [249.08, 167.32, 104.4, 175.51],
    y: [50.03, 64.88, 34.05, 14.69],
    direction_deg: [31.93, 20.89, 42.55, 53.59],
  },
  stroke: points([0, 60, 150, 230, 262], [0, 70, 150, 215, 262]),
  axis: [260, 160],
  free: false,
  box: [[null, null], [null, null]],
  bend: 40,
  arms: 3,
  split: "powers",
  band: 0,
  each: false,
  module: null,
  aim: null,
  directed: false,
  ...Object.fromEntries(RANGES.map((key) => [key, [null, null]])),
  clamp: null,
  turn: null,
  keep_out: [],
  rest: { design: {}, path: {} },
};

/** Fewer points make no closed curve, and fewer poses no machine. */
const FEWEST = { path: 4, stroke: 3, poses: 3 };
/** Length of the clamp as it is drawn, as a share of the size of all poses; and of a direction, of the path's. */
const CLAMP = 0.2;
const ARROW = 0.13;
/** More rows and handles would take the page too long, and more handles of directions that are not required yet. */
const MOST = 200;
const MOST_FREE = 60;

const GIVEN = [
  { word: "path", doc: "A closed path: the tip passes its points in order." },
  { word: "stroke", doc: "The working part of a path: the return from its last point to its first is searched." },
  { word: "poses", doc: "Three to seven key poses: positions of the tip and directions of the clamp; the path between them is free." },
];

const SPLITS = [
  { word: "powers", doc: "Two different pairs, each with half of the logarithm of the ratio." },
  { word: "mildest", doc: "Two different pairs with the largest minimum radius of their pitch curves." },
  { word: "one-pair", doc: "One pair twice: sun and planet are the same part." },
];

const AIMS = [
  { word: "module", doc: "The largest full teeth." },
  { word: "mild", doc: "The ratio nearest to 1." },
  { word: "small", doc: "The minimum reach of the tip." },
];

const range = (unit, doc) => ({ kind: "numbers", unit, minimum: 0, optional: true, holders: ["minimum", "maximum"], doc });

/** Fields by their keys: where their value stands, and what is known of them. */
const FIELDS = {
  "wanted.given": { kind: "choice", unit: "", choices: GIVEN, doc: "A closed path, its working part with the return free, or a few key poses with the path between them free." },
  "axis.x": { unit: "mm", doc: "Axis about which the carrier turns. Drag it in the picture, too." },
  "axis.y": { unit: "mm", doc: "Axis about which the carrier turns. Drag it in the picture, too." },
  "axis.sought": { label: "Seek it, too", kind: "switch", unit: "", doc: "The axis is searched on and about the path when the machine is found or made; the drawn one is an example." },
  "axis.within_x": { ...range("mm", "Minimum and maximum x of the axis to search; default: those of the map of possible axes."), minimum: undefined, label: "Within x" },
  "axis.within_y": { ...range("mm", "Minimum and maximum y of the axis to search; default: those of the map of possible axes."), minimum: undefined, label: "Within y" },
  "gears.bend_deg": { unit: "°", minimum: -170, maximum: 170, doc: "Angle from the carrier's first leg, to the intermediate gear, to its second. A greater bend gives greater gears." },
  "gears.arms": { kind: "integer", unit: "", minimum: 1, maximum: 12, doc: "Number of arms." },
  "gears.band": { unit: "mm", minimum: 0, maximum: 1e6, doc: "Distance within which the path may pass its points: it is eased there, for larger teeth, when the machine is made. Zero: through its points." },
  "gears.split": { kind: "choice", unit: "", choices: SPLITS, doc: "How two stages of gears share the motion." },
  "gears.module": { unit: "mm", positive: true, optional: true, doc: "Module of full teeth up to which the path is eased, and no more." },
  "gears.aim": { kind: "choice", unit: "", optional: true, choices: AIMS, doc: "What is made the most of where something is free." },
  "path.tolerances": { label: "Tolerances", kind: "switch", unit: "", doc: "Each point has its own tolerance, instead of one band for all." },
  "path.directions": { label: "Directions", kind: "switch", unit: "", doc: "Directions of the clamp required at points: drag the small circles next to them, or type them in the table." },
  "wishes.carrier": range("mm", "Minimum and maximum length of the carrier."),
  "wishes.arm": range("mm", "Minimum and maximum length of the arm."),
  "wishes.center_distance": { ...range("mm", "Minimum and maximum centre distance of the gears."), label: "Centre distance" },
  "wishes.ratio": range("", "Minimum and maximum ratio of planet to carrier."),
  "wishes.clamp_deg": { label: "Clamp", unit: "°", optional: true, doc: "Direction of the clamp less that of the arm; default: the one that suits the directions best." },
  "wishes.turn.from": { label: "Turn from point", kind: "integer", unit: "", minimum: 1, optional: true, doc: "Turn of the carrier: number of the point from which it is counted." },
  "wishes.turn.to": { label: "Turn to point", kind: "integer", unit: "", minimum: 1, optional: true, doc: "Number of the point up to which it is counted." },
  "wishes.turn.between_deg": { label: "Turn", kind: "numbers", unit: "°", minimum: 0, maximum: 360, optional: true, holders: ["minimum", "maximum"], doc: "Minimum and maximum turn of the carrier from the one point to the other." },
};

/** Keys that are one number of the wish. */
const PLAIN = {
  "wanted.given": "given", "axis.sought": "free", "gears.bend_deg": "bend", "gears.arms": "arms", "gears.split": "split", "gears.band": "band",
  "gears.module": "module", "gears.aim": "aim", "path.tolerances": "each", "path.directions": "directed", "wishes.clamp_deg": "clamp",
};

/** Columns of points that may be empty, with their headings. */
const FREE = {
  tolerance: ["±", "mm", "Distance within which the path may pass the point; empty, none."],
  direction_deg: ["dir", "°", "Direction of the clamp there, from x; empty, it is free."],
  direction_tolerance_deg: ["±", "°", `How far off it may be; empty, ${USUAL}.`],
};

const numbers = (key, value, doc, unit = "mm", heading) => ({ key, kind: "numbers", value, unit, doc, heading, written: true });

const field = (key, value) => ({ key, kind: "number", value, written: true, choices: [], ...FIELDS[key] });

/** A coordinate with no more digits than one reads. */
const short = (value) => Number(value.toFixed(3));

/** A point halfway on to the next of a smooth closed curve. */
function onward(points, i) {
  const at = (k) => points[(i + k + points.length) % points.length];
  const place = [0, 1].map((k) => short((9 * (at(0)[k] + at(1)[k]) - at(-1)[k] - at(2)[k]) / 16));
  return [...place, ...none(points[i].slice(2))];
}

/** A pose halfway to the next, or a point, of which nothing else is required. */
const between = (poses, i) => poses[i].map((one, k) => {
  const other = poses[(i + 1) % poses.length][k];
  return one === null || other === null ? null : short((one + other) / 2);
});

/** Names of the columns of what is given. */
function columns(wish) {
  if (wish.given === "poses") return ["x", "y", "direction_deg"];
  return ["x", "y", ...(wish.each ? ["tolerance"] : []), ...(wish.directed ? ["direction_deg", "direction_tolerance_deg"] : [])];
}

/** The table of what is given. */
function given(wish) {
  const kind = wish.given;
  const poses = kind === "poses";
  const names = columns(wish);
  const column = (name) => {
    const [heading, unit, doc] = FREE[name] ?? [undefined, "mm", poses ? "Position of the tip." : "Points that the tip passes, in order."];
    if (poses && heading) return numbers("poses.direction_deg", wish.poses.direction_deg, "Direction of the clamp.", "°");
    return numbers(`${kind}.${name}`, wish[kind][name], doc, unit, heading);
  };
  const options = { columns: names, fewest: FEWEST[kind], halfway: between, optional: poses ? 3 : 2 };
  if (kind === "path") Object.assign(options, { smooth: true, halfway: onward });
  if (poses) options.noun = "pose";
  const switches = poses ? [] : [field("path.tolerances", wish.each), field("path.directions", wish.directed)];
  return { key: kind, doc: GIVEN.find(({ word }) => word === kind).doc, points: options, fields: [...switches, ...names.map(column)] };
}

/** Tables of the form; `act` has what the buttons of shapes do. */
export function tables(wish, act) {
  const { axis, bend, arms, split, band, free, module, aim, turn } = wish;
  const gears = [field("gears.bend_deg", bend), field("gears.arms", arms), field("gears.split", split)];
  const found = [{ key: "wanted", doc: "What is given", fields: [field("wanted.given", wish.given)] }];
  if (wish.given === "path") {
    const box = free ? [field("axis.within_x", wish.box[0]), field("axis.within_y", wish.box[1])] : [];
    found.push({ key: "axis", doc: "Axis of the carrier", fields: [field("axis.x", axis[0]), field("axis.y", axis[1]), field("axis.sought", free), ...box] });
  }
  if (wish.given === "poses") return [...found, { key: "gears", doc: "Gears and arms", fields: gears }, given(wish)];
  gears.push(...(wish.each ? [] : [field("gears.band", band)]), field("gears.module", module), field("gears.aim", aim));
  const wishes = [
    ...RANGES.map((key) => field(`wishes.${key}`, wish[key])),
    field("wishes.clamp_deg", wish.clamp),
    field("wishes.turn.from", turn?.from ?? null), field("wishes.turn.to", turn?.to ?? null), field("wishes.turn.between_deg", turn?.between ?? [null, null]),
  ];
  return [
    ...found,
    { key: "gears", doc: "Gears and arms", fields: gears },
    given(wish),
    { key: "wishes", title: "Bounds, clamp, turn", doc: "Other requirements on the machine", optional: true, fields: wishes },
    ...shapes.tables(wish.keep_out, act),
  ];
}

/** Reason why a value is none of a key. */
function fault(key, value) {
  const plain = key.replace(/\[\d+\]$/, "");
  const [, column] = /^(?:path|stroke)\.([a-z_]+)$/.exec(plain) ?? [];
  const [, own] = /^wishes\.keep_out\.[^.]+\.([a-z]+)$/.exec(plain) ?? [];
  const known = FIELDS[plain] ?? (own && shapes.FIELDS[own]) ?? {};
  const { kind, minimum = column?.endsWith("tolerance") ? 0 : undefined, maximum, positive = column === "direction_tolerance_deg", optional = column in FREE } = known;
  if (["choice", "switch", "text"].includes(kind)) return null;
  if (value === null || value === "") return optional || isDropped(key) ? null : "a number is missing";
  if (typeof value !== "number") return `${value} is no number`;
  if (kind === "integer" && !Number.isInteger(value)) return `${value} is no whole number`;
  if (positive && !(value > 0)) return `a number above 0, not ${value}`;
  if (value < minimum || value > maximum) return maximum === undefined ? `a number from ${minimum}, not ${value}` : `a number from ${minimum} to ${maximum}, not ${value}`;
  return null;
}

/** Whether a key names a shape, whose lack of a value drops it. */
const isDropped = (key) => /^wishes\.keep_out\.[^.]+$/.test(key);

/** Sets a part of the turn of the carrier; of which nothing is left there is none. */
function turned(wish, key, place, value) {
  const turn = wish.turn ?? { from: null, to: null, between: [null, null] };
  if (place !== undefined) turn.between[Number(place)] = value;
  else turn[key] = value;
  return [turn.from, turn.to, ...turn.between].every((one) => one === null) ? null : turn;
}

/** Points counted anew after one was added or deleted: the turn keeps its own, and goes with one of them. */
function recounted(turn, before, after) {
  const step = after.length - before.length;
  if (!turn || Math.abs(step) !== 1) return { turn };
  const differs = before.findIndex((one, i) => one !== after[i]);
  const first = differs < 0 ? Math.min(before.length, after.length) : differs;
  const gone = step < 0 && [turn.from, turn.to].includes(first + 1);
  if (gone) return { turn: null, note: `With point ${first + 1} its wish for a turn of the carrier, from point ${turn.from ?? "–"} to point ${turn.to ?? "–"}, is gone; Undo has both again.` };
  const moved = (number) => (number === null || number <= first ? number : number + step);
  return { turn: { ...turn, from: moved(turn.from), to: moved(turn.to) } };
}

/** Points in words, to be compared. */
const places = ({ x, y }) => x.map((one, i) => `${one} ${y[i]}`);

/** What a wish lacks before it can be sent to the program: its key and the reason; null where it is whole. */
export function lacks(wish) {
  if (wish.given === "poses") return null;
  if (wish.turn) {
    const missing = ["from", "to"].find((end) => wish.turn[end] === null);
    if (missing) return { key: `wishes.turn.${missing}`, wrong: "a turn is wished between two points: give both, or neither" };
    if (wish.turn.between.every((end) => end === null)) return { key: "wishes.turn.between_deg", wrong: "no turn is given between the two points" };
  }
  if (!wish.free || wish.given !== "path") return null;
  const ends = wish.box.flat();
  const some = ends.filter((end) => end !== null).length;
  if (some > 0 && some < ends.length) return { key: `axis.within_${wish.box[0].includes(null) ? "x" : "y"}`, wrong: "the axis is searched within four numbers, or, without any, on the map" };
  return null;
}

/** The wish with other values, or the first key at fault and the reason. */
export function changed(wish, edits) {
  const next = structuredClone(wish);
  for (const { key, value } of edits) {
    const values = Array.isArray(value) ? value : [value];
    const wrong = values.map((one) => fault(key, one)).find(Boolean) ?? (values.length > MOST ? `${values.length} points; the page shows up to ${MOST}` : null);
    if (wrong) return { key, wrong };
    const amiss = set(next, key, Array.isArray(value) ? values.map((one) => (one === "" ? null : one)) : value === "" ? null : value);
    if (amiss) return { key, wrong: amiss };
  }
  const { given: kind } = next;
  if (kind === "poses") return { next };
  const { turn, note } = recounted(next.turn, places(wish[kind]), places(next[kind]));
  return { next: { ...next, turn }, note };
}

/** Takes the value of a key; returns what is wrong, if anything. */
function set(next, key, value) {
  const [, table, list, place] = /^(path|stroke|poses)\.([a-z_]+)(?:\[(\d+)\])?$/.exec(key) ?? [];
  const [, shape, own, at] = /^wishes\.keep_out\.([^.[\]]+)(?:\.([a-z.]+))?(?:\[(\d+)\])?$/.exec(key) ?? [];
  const [, wished, end] = /^wishes\.([a-z_]+)\[(\d)\]$/.exec(key) ?? [];
  const [, turn, bound] = /^wishes\.turn\.([a-z_]+)(?:\[(\d)\])?$/.exec(key) ?? [];
  const [, within, side] = /^axis\.within_([xy])\[(\d)\]$/.exec(key) ?? [];
  if (key in PLAIN) next[PLAIN[key]] = value;
  else if (shape) return shapes.change(next.keep_out, shape, own, at, value);
  else if (turn) next.turn = turned(next, turn, bound, value);
  else if (within) next.box["xy".indexOf(within)][Number(side)] = value;
  else if (wished) next[wished][Number(end)] = value;
  else if (list && place === undefined) spread(next[table], list, value);
  else if (list) {
    next[table][list][Number(place)] = value;
    if (list === "direction_deg" && table !== "poses" && value === null) next[table].direction_tolerance_deg[Number(place)] = null;
  } else next.axis["xy".indexOf(key.at(-1))] = value;
  return null;
}

/** A column with its values; what other columns have no values for is free. */
function spread(table, list, values) {
  table[list] = values;
  for (const name of Object.keys(FREE)) if (list === "x" && table[name] && table[name].length !== values.length) table[name] = values.map((_, i) => table[name][i] ?? null);
}

/** Rows of what is given: points, or poses. */
export function rowsOf(wish) {
  const { x, y, direction_deg } = wish[wish.given];
  return x.map((one, i) => (wish.given === "poses" ? [one, y[i], direction_deg[i]] : [one, y[i]]));
}

/** Heads and rows of what is given, with all that its table shows. */
export function tableOf(wish) {
  const names = columns(wish);
  const blank = (name, value) => value ?? (name === "tolerance" ? 0 : "");
  return [names, ...wish[wish.given].x.map((_, i) => names.map((name) => blank(name, wish[wish.given][name][i])))];
}

/** The wish with other poses. */
export function withPoses(wish, rows) {
  return { ...wish, poses: Object.fromEntries(["x", "y", "direction_deg"].map((name, k) => [name, rows.map((row) => row[k])])) };
}

/** A wish that was kept, with whatever it lacks. */
export function whole(wish) {
  const found = { ...structuredClone(EXAMPLE), ...wish };
  for (const kind of ["path", "stroke"]) found[kind] = { ...columnsOf({ points: found[kind].x.map((x, i) => [x, found[kind].y[i]]) }), ...found[kind] };
  return found;
}

/** A wish as the program is asked. */
export function asked(wish, options) {
  const design = designOf(wish, options);
  return wish.given === "poses" ? { design, poses: rowsOf(wish) } : { design };
}

/** Greatest distance across a path, or poses. */
export const sizeOf = (points) => shapes.boxOf(points).size;

const HANDLE = { link: 0, plane: "cartesian", scale: 1, origin: [0, 0], chained: true };
const DEG = Math.PI / 180;

/** Direction that is offered at a point: away from the middle of the path. */
function offered({ x, y }, i) {
  const { left, right, low, high } = shapes.boxOf({ x, y });
  return Math.round(Math.atan2(y[i] - (low + high) / 2, x[i] - (left + right) / 2) / DEG);
}

/** Handles of the directions required at points, and of those that may be. */
function directions(wish) {
  const { given: kind } = wish;
  const { x, y, direction_deg } = wish[kind];
  const length = ARROW * sizeOf(wish[kind]);
  return direction_deg.flatMap((angle, i) => {
    const free = angle === null;
    if (free && x.length > MOST_FREE) return [];
    const key = `${kind}.direction_deg[${i}]`;
    return [{
      ...HANDLE, name: `direction at point ${i + 1}`, kind: "direction", free, plane: "polar", origin: [x[i], y[i]], chained: false,
      keys: ["", key], values: [length, angle ?? offered(wish[kind], i)], drop: free ? undefined : [{ key, value: null }],
    }];
  });
}

/** Points of the picture that can be dragged. */
export function handles(wish) {
  const { given, axis } = wish;
  const { x, y, direction_deg } = wish[given];
  const noun = given === "poses" ? "pose" : "point";
  const points = x.map((one, i) => ({ ...HANDLE, name: `${noun} ${i + 1} of the path`, keys: [`${given}.x[${i}]`, `${given}.y[${i}]`], values: [one, y[i]] }));
  if (given !== "poses") {
    points.push(...(wish.directed ? directions(wish) : []), ...shapes.handles(wish.keep_out, HANDLE, wish[given]));
    if (given === "path") points.push({ ...HANDLE, name: "axis of the carrier", kind: "axis", chained: false, keys: ["axis.x", "axis.y"], values: axis });
    return points;
  }
  const length = CLAMP * sizeOf(wish.poses);
  return [...points, ...direction_deg.map((angle, i) => ({
    ...HANDLE, name: `direction of pose ${i + 1}`, plane: "polar", origin: [x[i], y[i]], chained: false, keys: ["", `poses.direction_deg[${i}]`], values: [length, angle],
  }))];
}

/** A line from a position in a direction, degrees. */
function ray(role, [x, y], length, angle) {
  return { role, closed: false, vertices: [x, y, 0, x + length * Math.cos(angle * DEG), y + length * Math.sin(angle * DEG), 0] };
}

/** Lines that show what is required: the clamp in every pose or at points, within its tolerance; of a stroke, its points joined; shapes. */
export function wantedLines(wish) {
  const { x, y, direction_deg, direction_tolerance_deg } = wish[wish.given];
  const at = (i) => [x[i], y[i]];
  if (wish.given === "poses") return direction_deg.map((angle, i) => ray("clamp", at(i), CLAMP * sizeOf(wish.poses), angle));
  const found = wish.given === "stroke" ? [{ role: "adjacent", closed: false, vertices: x.flatMap((one, i) => [one, y[i], 0]) }] : [];
  const length = ARROW * sizeOf(wish[wish.given]);
  if (wish.directed) {
    direction_deg.forEach((angle, i) => {
      if (angle === null) return;
      const off = direction_tolerance_deg[i] ?? USUAL;
      found.push(ray("clamp", at(i), length, angle), ray("pose", at(i), 1.15 * length, angle - off), ray("pose", at(i), 1.15 * length, angle + off));
    });
  }
  return [...found, ...shapes.lines(wish.keep_out, wish[wish.given])];
}

/** A picture with the lines of what is required, and room for the shapes. */
export function withWanted(picture, wish) {
  const { links, motion } = picture;
  const [left, low, right, high] = picture.extent;
  const places = wish.given === "poses" ? [] : shapes.places(wish.keep_out);
  const [xs, ys] = [0, 1].map((k) => places.map((place) => place[k]));
  return {
    ...picture,
    shapes: [...picture.shapes, wantedLines(wish)],
    links: [...links, { name: "wanted", shape: picture.shapes.length }],
    motion: { ...motion, poses: [...motion.poses, [0, 0, 0]] },
    extent: [Math.min(left, ...xs), Math.min(low, ...ys), Math.max(right, ...xs), Math.max(high, ...ys)],
  };
}

/** What is required as a picture: the order of the places, and the lines. */
export function wantedPicture(wish) {
  const { x, y } = wish[wish.given];
  const room = 2 * CLAMP * sizeOf({ x, y });
  return {
    shapes: [[{ role: "adjacent", closed: wish.given !== "stroke", vertices: x.flatMap((one, i) => [one, y[i], 0]) }]],
    links: [{ name: "path", shape: 0 }],
    motion: { input_name: "carrier", input: [0, 2 * Math.PI], poses: [[0, 0, 0]] },
    handles: [],
    marks: [],
    extent: [Math.min(...x) - room, Math.min(...y) - room, Math.max(...x) + room, Math.max(...y) + room],
  };
}
