// Path, axis and gears that are wished for: as the form shows them, and as the program is asked.

/** The drawn path of the documentation, with an axis inside it. */
export const EXAMPLE = {
  x: [0, 60, 150, 230, 262, 235, 170, 100, 40, -5, -30, -38, -30],
  y: [0, 70, 150, 215, 262, 300, 330, 330, 300, 250, 190, 130, 60],
  axis: [260, 160],
  bend: 40,
  arms: 3,
  split: "powers",
};

/** Fewer points make no closed curve. */
const FEWEST = 4;
/** More rows and handles would take the page too long. */
const MOST = 200;

const SPLITS = [
  { word: "powers", doc: "Two different pairs, each with half of the logarithm of the ratio." },
  { word: "mildest", doc: "Two different pairs, the sharpest of whose pitch curves is as blunt as it can be." },
  { word: "one-pair", doc: "One pair twice: sun and planet are the same part." },
];

/** Fields by their keys: where their value stands, and what is known of them. */
const FIELDS = {
  "axis.x": { unit: "mm", doc: "Axis about which the carrier turns. Drag it in the picture, too." },
  "axis.y": { unit: "mm", doc: "Axis about which the carrier turns. Drag it in the picture, too." },
  "gears.bend_deg": { unit: "°", least: -170, greatest: 170, doc: "Angle from the carrier's first leg, to the intermediate gear, to its second. A greater bend gives greater gears." },
  "gears.arms": { kind: "integer", unit: "", least: 1, greatest: 12, doc: "Number of arms." },
  "gears.split": { kind: "choice", unit: "", choices: SPLITS, doc: "How two stages of gears share the motion." },
};

const numbers = (key, value, doc) => ({ key, kind: "numbers", value, unit: "mm", doc, written: true });

function field(key, value) {
  return { key, kind: "number", value, written: true, choices: [], ...FIELDS[key] };
}

/** Tables of the form. */
export function tables({ x, y, axis, bend, arms, split }) {
  return [
    { key: "axis", doc: "Axis of the carrier", fields: [field("axis.x", axis[0]), field("axis.y", axis[1])] },
    { key: "gears", doc: "Gears and arms", fields: [field("gears.bend_deg", bend), field("gears.arms", arms), field("gears.split", split)] },
    {
      key: "path",
      doc: "Points that the tip passes, in order; a closed smooth curve runs through them",
      points: { smooth: true, fewest: FEWEST },
      fields: [numbers("path.x", x, "Points that the tip passes, in order."), numbers("path.y", y, "Points that the tip passes, in order.")],
    },
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
  const next = { ...wish, x: [...wish.x], y: [...wish.y], axis: [...wish.axis] };
  for (const { key, value } of edits) {
    const [, list, place] = /^path\.([xy])(?:\[(\d+)\])?$/.exec(key) ?? [];
    const values = Array.isArray(value) ? value : [value];
    const wrong = values.map((one) => fault(key, one)).find(Boolean) ?? (values.length > MOST ? `${values.length} points; the page shows up to ${MOST}` : null);
    if (wrong) return { key, wrong };
    if (list && place === undefined) next[list] = values;
    else if (list) next[list][Number(place)] = value;
    else if (key === "axis.x") next.axis[0] = value;
    else if (key === "axis.y") next.axis[1] = value;
    else next[{ "gears.bend_deg": "bend", "gears.arms": "arms", "gears.split": "split" }[key]] = value;
  }
  return { next };
}

/** Points of a wish. */
export const pointsOf = ({ x, y }) => x.map((one, i) => [one, y[i]]);

/** A wish as the program is asked. */
export const asked = (wish) => ({ points: pointsOf(wish), axis: wish.axis, bend_deg: wish.bend, arms: wish.arms, split: wish.split });

/** Points of the picture that can be dragged. */
export function handles({ x, y, axis }) {
  const handle = { link: 0, plane: "cartesian", scale: 1, origin: [0, 0], chained: true };
  const points = x.map((one, i) => ({ ...handle, name: `point ${i + 1} of the path`, keys: [`path.x[${i}]`, `path.y[${i}]`], values: [one, y[i]] }));
  return [...points, { ...handle, name: "axis of the carrier", kind: "axis", chained: false, keys: ["axis.x", "axis.y"], values: axis }];
}
