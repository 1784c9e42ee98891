// How the axes of every chart look.

import { color } from "./theme.js";

const AXIS = {
  stroke: () => color("muted"),
  grid: { stroke: () => color("grid"), width: 1 },
  ticks: { show: false },
  font: "11px system-ui, sans-serif",
};

/** The axis along the bottom, then the one up the side, each with what it has of its own. */
export const axes = (across = {}, up = {}) => [
  { ...AXIS, size: 20, gap: 2, ...across },
  { ...AXIS, size: 54, gap: 4, space: 18, ...up },
];
