// How the axes of every chart look.

import { color } from "./theme.js";

const AXIS = {
  stroke: () => color("muted"),
  grid: { stroke: () => color("grid"), width: 1 },
  ticks: { show: false },
  font: "11px system-ui, sans-serif",
  values: (_, list) => labels(list),
};

/** Most digits after the point: a float has no more. */
const MOST = 15;

/** The numbers of an axis with the digits that their step needs, and no more; very large and small ones as powers of ten. */
export function labels(list) {
  const known = list.filter((value) => value !== null && value !== undefined);
  const size = Math.max(...known.map(Math.abs));
  const step = known.length > 1 ? known[1] - known[0] : size;
  const power = size !== 0 && (size < 1e-2 || size >= 1e5);
  const written = (value, digits) => power && value !== 0 ? value.toExponential(digits) : value.toFixed(power ? 0 : digits);
  const told = (digits) => known.every((value) => Math.abs(Number(written(value, digits)) - value) <= 1e-6 * Math.abs(step));
  let digits = 0;
  while (digits < MOST && !told(digits)) digits += 1;
  return list.map((value) => (value === null || value === undefined ? null : written(value, digits)));
}

/** The axis along the bottom, then the one up the side, each with what it has of its own. */
export const axes = (across = {}, up = {}) => [
  { ...AXIS, size: 20, gap: 2, ...across },
  { ...AXIS, size: 54, gap: 4, space: 18, ...up },
];

/** Steps between whole numbers. */
export const WHOLE = Array.from({ length: 9 }, (_, power) => [1, 2, 5].map((step) => step * 10 ** power)).flat();

/** Steps of what is divided by tens. */
export const STEPS = Array.from({ length: 12 }, (_, power) => [1, 2, 5].map((step) => step * 10 ** (power - 6))).flat();

/** A line of a chart: not on whole pixels, which would make stairs of it. */
export const line = (name, own = {}) => ({ stroke: () => color(name), width: 1.5, pxAlign: 0, points: { show: false }, spanGaps: false, ...own });

/** What is smaller is a rounding error, whatever its unit: a figure of a machine is not. */
export const NOISE = 1e-9;

/** Range of the vertical axis: what is nearly constant is shown as constant, not as its rounding errors. A limit near by is in it. */
export function span(least, greatest, limits) {
  if (least === null || !Number.isFinite(least)) return [0, 1];
  const room = greatest - least;
  for (const { value } of limits) {
    if (Math.max(least - value, value - greatest) <= room) [least, greatest] = [Math.min(least, value), Math.max(greatest, value)];
  }
  return spread(least, greatest);
}

function spread(least, greatest) {
  const size = Math.max(Math.abs(least), Math.abs(greatest));
  const room = greatest - least < 1e-6 * size ? Math.max(0.1 * size, Number.MIN_VALUE) : 0.08 * (greatest - least);
  return size < NOISE ? [-1, 1] : [least - room, greatest + room];
}
