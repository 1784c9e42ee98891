// The wish of the page as the design of family path that the command reads, and back.

import * as shapes from "./path-shapes.js";

/** Ranges that may be wished for, by their keys. */
export const RANGES = ["carrier", "arm", "center_distance", "ratio"];
/** Tolerance of a direction where none is given, degrees. */
export const USUAL = 2;

const ends = ([minimum, maximum]) => ({ ...(minimum === null ? {} : { minimum }), ...(maximum === null ? {} : { maximum }) });
const isFree = (range) => range.every((end) => end === null);
const hasKeys = (table) => Object.keys(table).length > 0;

/** Further wishes, with the keys of the design file. */
function wishesOf(wish) {
  const found = {};
  for (const key of RANGES) if (!isFree(wish[key])) found[key] = ends(wish[key]);
  if (wish.clamp !== null) found.clamp_deg = wish.clamp;
  const { direction_deg, direction_tolerance_deg } = wish[wish.given];
  const directions = direction_deg.flatMap((angle, i) => (angle === null ? [] : [{ point: i + 1, direction_deg: angle, tolerance_deg: direction_tolerance_deg[i] ?? USUAL }]));
  if (wish.directed && directions.length) found.directions = directions;
  const { turn } = wish;
  // One that is half given is reported by its field.
  if (turn && turn.from !== null && turn.to !== null) found.turn = { from: turn.from, to: turn.to, between_deg: [turn.between[0] ?? 0, turn.between[1] ?? 360] };
  if (wish.keep_out.length) found.keep_out = shapes.written(wish.keep_out);
  return found;
}

/** The design; where the axis is free it is omitted, unless it is `placed` all the same. */
export function designOf(wish, { placed = false, band = wish.band } = {}) {
  const { given, rest, axis, bend, arms, split, aim, module } = wish;
  const design = { ...rest.design, bend_deg: bend, arms, split };
  if (given === "poses") return { ...design, path: {} };
  if (given === "path" && (placed || !wish.free)) {
    design.axis = axis;
  } else if (given === "path" && wish.box.flat().every((end) => end !== null)) {
    const [[left, right], [low, high]] = wish.box;
    design.axis_box = [[left, low], [right, high]];
  }
  if (aim) design.aim = aim;
  const { x, y, tolerance } = wish[given];
  design.path = { ...rest.path, points: x.map((one, i) => [one, y[i]]) };
  if (given === "stroke") design.path.open = true;
  if (wish.each) design.path.tolerance = tolerance.map((one) => one ?? 0);
  else if (band > 0) design.path.band = band;
  if (module !== null) design.path.module = module;
  const wishes = wishesOf(wish);
  if (hasKeys(wishes)) design.wishes = wishes;
  return design;
}

/** Whether more is required than the path as it is drawn, so that a machine is searched and not merely made. */
export const isSought = (wish) => wish.given !== "path" || wish.free || wish.each || wish.band > 0 || Boolean(wish.aim) || hasKeys(wishesOf(wish));

/** Whether there are wishes besides the path. */
export const isWished = (wish) => wish.given !== "poses" && hasKeys(wishesOf(wish));

/** Columns of points with directions required at some of them, and tolerances where they have such. */
export function columnsOf({ points, tolerance = [] }, directions = []) {
  const column = (of) => points.map((_, i) => of(i) ?? null);
  const at = (i) => directions.find(({ point }) => point === i + 1);
  return {
    x: points.map(([x]) => x),
    y: points.map(([, y]) => y),
    tolerance: column((i) => tolerance[i]),
    direction_deg: column((i) => at(i)?.direction_deg),
    direction_tolerance_deg: column((i) => at(i)?.tolerance_deg),
  };
}

/** The wish with what a file holds: all of a design, or points with their tolerances and directions. */
export function withOpened(wish, start, { design, whole }) {
  const { path: { points, tolerance = [], band = 0, module = null, open = false, ...path }, wishes = {}, axis, axis_box: box, bend_deg, arms, split, aim, ...others } = design;
  const columns = columnsOf({ points, tolerance }, wishes.directions);
  const [each, directed] = [tolerance.length > 0, (wishes.directions ?? []).length > 0];
  if (!whole) return { ...wish, [wish.given]: columns, each, directed };
  const given = open ? "stroke" : "path";
  return {
    ...structuredClone(start), given, [given]: columns, each, directed, band, module,
    axis: axis ?? wish.axis, free: !axis, box: box ? [0, 1].map((k) => [Math.min(box[0][k], box[1][k]), Math.max(box[0][k], box[1][k])]) : [[null, null], [null, null]], bend: bend_deg, arms, split, aim: aim ?? null,
    ...Object.fromEntries(RANGES.map((key) => [key, [wishes[key]?.minimum ?? null, wishes[key]?.maximum ?? null]])),
    clamp: wishes.clamp_deg ?? null,
    turn: wishes.turn ? { from: wishes.turn.from, to: wishes.turn.to, between: wishes.turn.between_deg } : null,
    keep_out: shapes.read(wishes.keep_out),
    // What the page does not show stays with the design.
    rest: { design: others, path },
  };
}
