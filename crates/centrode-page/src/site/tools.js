// The tools with which a machine is composed: what each one picks in the picture, and the numbers that can be typed.

const pin = (id, words, prompt) => ({ id, kind: "pin", words, prompt });
const body = (id, words, prompt) => ({ id, kind: "body", words, prompt });
const number = (id, words, unit = "mm") => ({ id, kind: "number", words, unit });
const choice = (id, words, ...choices) => ({ id, kind: "choice", words, choices });
const side = (...words) => choice("side", "Side", ["", "where clicked"], ...words.map((word) => [word, word]));

/** `place` is the prompt for the last click, which measures the numbers that are not typed. */
export const TOOLS = [
  { id: "select", words: "Select", key: "v", title: "Select a part: rename, copy or delete it", fields: [] },
  { id: "body", words: "+ Body", key: "b", title: "Add a body that turns on a pin", place: "Click the end of the body, or type length and angle.",
    fields: [pin("on", "Turns on", "Click where the body turns: a point, a body or the ground."), number("length", "Length"), number("angle_deg", "Angle", "°"),
      choice("ratio", "Moves", ["", "by default"], ["1", "with the input"], ["-1", "against the input"], ["0", "not at all"])] },
  { id: "bars", words: "+ Dyad", key: "d", title: "Add a dyad: two bars between two pins", place: "Click where the bars meet, or type their lengths.",
    fields: [pin("from", "From", "Click the first pin of the bars."), pin("to", "To", "Click the second pin, on another body or on the ground."),
      number("length", "Length 1"), number("length2", "Length 2"), side("left", "right")] },
  { id: "slider", words: "+ Slider", key: "s", title: "Add a bar with a block that slides along a line", place: "Click where the block is, or type length and angle.",
    fields: [pin("from", "From", "Click the pin of the bar."), pin("line", "Line through", "Click a point of the line, on another body or on the ground."),
      number("length", "Length"), number("angle_deg", "Angle of the line", "°"), side("forward", "backward")] },
  { id: "gears", words: "+ Gear pair", key: "g", title: "Add a gear pair", place: "Click the axis of the second gear, or type module, teeth and angle.",
    fields: [body("on", "On", "Click the body that carries the first gear."), choice("curve", "Pitch curve", ["ellipse", "ellipse"], ["circle", "circle"]),
      number("eccentricity", "Eccentricity", ""), number("module", "Module"), number("teeth", "Teeth", ""), number("angle_deg", "Angle", "°")] },
  { id: "cam", words: "+ Cam", key: "c", title: "Add a disc cam and its lever", place: "Click the centre of the roller, or type arm and base radius.",
    fields: [body("on", "On", "Click the body that carries the cam."), pin("to", "Lever turns on", "Click where the lever turns."),
      number("length", "Arm"), number("radius", "Base radius"), number("swing_deg", "Swing", "°")] },
  { id: "point", words: "+ Point", key: "p", title: "Add a point to a body or to the frame", place: "Click where the point is: a body or the ground.",
    fields: [body("on", "Body", ""), number("x", "x"), number("y", "y")] },
  { id: "corner", words: "+ Corner", key: "k", title: "Add a point of a body by its distances from two others", place: "Click where the corner is, or type both distances.",
    fields: [pin("from", "From", "Click a point of the body."), pin("to", "And", "Click another point of the same body."),
      number("length", "Distance 1"), number("length2", "Distance 2"), side("left", "right")] },
  { id: "goal", words: "+ Goal", key: "t", title: "Add a goal for a figure", place: "",
    fields: [{ id: "figure", kind: "figure", words: "Figure" }, choice("over", "Of it", ["minimum", "minimum"], ["maximum", "maximum"], ["span", "span"]),
      choice("below", "Is", ["", "at least"], ["true", "at most"]), number("limit", "Limit", "")] },
];

/** The gesture that the fields describe, with the place that was clicked. */
export function gesture(tool, values, at) {
  const { length, length2, ...rest } = values;
  const two = tool.fields.some(({ id }) => id === "length2");
  const numbers = two ? { lengths: [length, length2] } : { length };
  const own = Object.fromEntries(Object.entries({ ...rest, ...numbers }).filter(([, value]) => value !== null && value !== undefined));
  if (own.ratio !== undefined) own.ratio = Number(own.ratio);
  if (tool.id === "goal") return { part: "goal", ...own, below: own.below === "true" };
  return { part: tool.id, at, ...own };
}
