// The picture as a file: SVG and PNG as it is shown, one cycle as GIF or WebM.

import * as dialogs from "./dialogs.js";
import { handOver, image } from "./chart-files.js";
import { byId, drawn, element } from "./elements.js";
import { gif } from "./gif.js";
import * as mesh from "./mesh.js";
import * as overlays from "./overlays.js";
import { MATTER, Painter, strokes } from "./painter.js";
import { color, paper } from "./theme.js";

/** Points of a picture for one pixel of the page. */
const FINE = 3;
/** Widths of an animation, pixels, and pictures a second. */
const WIDTHS = [320, 480, 640, 960];
const RATE = 20;
/** Bits of a second of WebM. */
const BITRATE = 4_000_000;
/** Room around the machine in an animation, pixels. */
const ROOM = [24, 24];
/** Points of a line, and places of the cycle, by which the size of the whole is found. */
const [ALONG, PLACES] = [32, 48];

/** Lines and arcs of a snapshot as the path of an SVG. */
function path({ vertices, closed }) {
  const count = vertices.length / 3;
  if (count === 0) return "";
  const at = (i) => [vertices[3 * i], vertices[3 * i + 1]];
  let words = `M${at(0).join(" ")}`;
  for (let i = 0; i < (closed ? count : count - 1); i += 1) {
    const j = (i + 1) % count;
    const bulge = vertices[3 * i + 2];
    const [[x, y], [u, v]] = [at(i), at(j)];
    const chord = Math.hypot(u - x, v - y);
    if (bulge === 0 || chord === 0) words += `L${u} ${v}`;
    else {
      const radius = (chord * (1 + bulge * bulge)) / (4 * Math.abs(bulge));
      words += `A${radius} ${radius} 0 ${Math.abs(bulge) > 1 ? 1 : 0} ${bulge > 0 ? 1 : 0} ${u} ${v}`;
    }
  }
  return closed ? `${words}Z` : words;
}

/** Draws on paper's colours, whatever those of the screen. */
function onPaper(draw) {
  paper(true, () => {});
  try {
    return draw();
  } finally {
    paper(false, () => {});
  }
}

/** The picture as it is shown, on white. */
function svg(stage, title) {
  const { scene, view, width, height } = stage;
  const root = drawn("svg", { viewBox: `0 0 ${width} ${height}`, width, height, "font-family": "sans-serif", "font-size": 12 });
  const name = drawn("title");
  name.textContent = title;
  root.append(name, drawn("rect", { width, height, fill: "#ffffff" }));
  const poses = scene.motion.at(stage.input);
  const layers = [drawn("g"), drawn("g")];
  const fixed = { fill: "none", "stroke-linejoin": "round" };
  const wide = (pixels) => pixels / view.scale;
  scene.picture.links.forEach((link, i) => {
    const [x, y, angle] = poses[i];
    const [px, py] = stage.toBox(x, y);
    const transform = `translate(${px} ${py}) scale(${view.scale} ${-view.scale}) rotate(${(angle * 180) / Math.PI})`;
    const groups = layers.map((layer) => layer.appendChild(drawn("g", { transform, "data-link": link.name })));
    const shape = scene.picture.shapes[link.shape];
    const body = shape.filter(({ role }) => role === "body" || role === "hole").map(path).join("");
    if (scene.links[i].solid) {
      groups[0].append(drawn("path", { ...fixed, d: body, fill: color(`link-${scene.links[i].tint % 5}`), stroke: color("ink"), "stroke-width": wide(1), "fill-rule": "evenodd" }));
    }
    for (const line of shape) {
      if (["body", "hole"].includes(line.role) || line.vertices.length === 0 || (line.role === "pitch" && !stage.pitched)) continue;
      for (const [ink, thick, dashes] of strokes(line.role, view.scale)) {
        groups[1].append(drawn("path", { ...fixed, d: path(line), stroke: color(ink), "stroke-width": wide(thick),
          ...(dashes.length ? { "stroke-dasharray": dashes.map(wide).join(" ") } : { "stroke-linecap": "round" }) }));
      }
    }
  });
  root.append(...layers, ...laidOver(stage));
  for (const { name, at: [cx, cy], words } of stage.named(poses)) {
    root.append(drawn("circle", { cx, cy, r: 4, fill: color("pinned") }));
    if (!words) continue;
    const [x, y] = words;
    const label = drawn("text", { x, y, fill: color("ink"), ...halo(3) });
    label.textContent = name;
    root.append(label);
  }
  if (stage.mesh.on) root.append(...meshes(stage));
  return `${new XMLSerializer().serializeToString(root)}\n`;
}

/** A rim of words, so many pixels wide, on which lines below them stop. */
const halo = (wide) => ({ stroke: color("sheet"), "stroke-width": wide, "stroke-linejoin": "round", "paint-order": "stroke" });

/** What is laid over the picture: the machine at other places of its cycle, and dimensions. */
function laidOver(stage) {
  const { scene, view } = stage;
  const wide = (pixels) => pixels / view.scale;
  const made = [];
  if (byId("show-poses").checked) {
    const group = drawn("g", { opacity: overlays.FAINT, fill: "none", stroke: color("accent"), "data-over": "poses" });
    for (const [i, [x, y, angle]] of overlays.spread(scene)) {
      const lines = scene.picture.shapes[scene.picture.links[i].shape].filter(({ role }) => ["body", "hole", ...MATTER].includes(role));
      const [px, py] = stage.toBox(x, y);
      group.append(drawn("path", { d: lines.map(path).join(""), transform: `translate(${px} ${py}) scale(${view.scale} ${-view.scale}) rotate(${(angle * 180) / Math.PI})`,
        "stroke-width": wide(1.2), "stroke-dasharray": [4, 3].map(wide).join(" ") }));
    }
    made.push(group);
  }
  if (byId("show-distances").checked) {
    const ink = color("pinned");
    for (const { from, to, words } of overlays.dimensions(stage, scene.motion.at(stage.input))) {
      const [x, y] = overlays.middle(from, to);
      const label = drawn("text", { x, y: y + 4, fill: ink, "text-anchor": "middle", ...halo(4) });
      label.textContent = words;
      made.push(drawn("path", { d: `M${from.join(" ")}L${to.join(" ")}`, stroke: ink, "data-over": "dimension" }), label);
    }
  }
  return made;
}

/** What touches in the meshes that are shown. */
function meshes(stage) {
  const { LOOK: { ink, width, dashes, pitch: small, point: large } } = mesh;
  const dot = ([cx, cy], r, fill, part) => drawn("circle", { cx, cy, r, fill: color(fill), stroke: color("sheet"), "stroke-width": width, "data-mesh": part });
  return mesh.touching(stage, stage.input).flatMap(({ pitch, points, line }) => [
    ...(line ? [drawn("path", { d: `M${line[0].join(" ")}L${line[1].join(" ")}`, stroke: color(ink), "stroke-width": width, "stroke-dasharray": dashes.join(" "), "data-mesh": "line" })] : []),
    dot(pitch, small, "ink", "pitch"),
    ...points.map((point) => dot(point, large, ink, "contact")),
  ]);
}

/** Least x, least y, greatest x, greatest y of all lines at places of the cycle. */
function around({ picture, motion }) {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  const points = picture.shapes.map((shape) => shape.flatMap((line) => {
    const made = drawn("path", { d: path(line) });
    const length = line.vertices.length ? made.getTotalLength() : 0;
    return Array.from({ length: length ? ALONG : 0 }, (_, i) => made.getPointAtLength((i / ALONG) * length));
  }));
  for (let k = 0; k < PLACES; k += 1) {
    motion.at((k / PLACES) * motion.cycle).forEach(([x, y, angle], i) => {
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      for (const p of points[picture.links[i].shape]) {
        const [u, v] = [x + c * p.x - s * p.y, y + s * p.x + c * p.y];
        [box[0], box[1], box[2], box[3]] = [Math.min(box[0], u), Math.min(box[1], v), Math.max(box[2], u), Math.max(box[3], v)];
      }
    });
  }
  return box;
}

/** A machine on a canvas of its own, whole or close to a mesh, on white, at any position of its cycle. */
class Film extends Painter {
  constructor(stage, width) {
    super(document.createElement("canvas"), { willReadFrequently: true });
    const extent = around(stage.scene);
    const [left, bottom, right, top] = extent;
    this.scene = Object.assign(Object.create(stage.scene), { picture: { ...stage.scene.picture, extent } });
    this.width = width;
    // Video is made of pairs of pixels.
    this.height = 2 * Math.round((width * Math.min(Math.max((top - bottom) / (right - left), 0.4), 1.6)) / 2);
    Object.assign(this.canvas, { width, height: this.height });
    this.stage = stage;
    this.frame(ROOM);
    // Close to a mesh or a gear it shows as much as the page does, and follows as the page does.
    if (stage.close) this.view = { ...stage.view, scale: (stage.view.scale * width) / stage.width };
  }

  get pitched() {
    return this.stage.pitched;
  }

  draw(share) {
    this.clear();
    this.context.fillStyle = "#ffffff";
    this.context.fillRect(0, 0, this.width, this.height);
    const input = share * this.scene.motion.cycle;
    const middle = this.stage.middle(input);
    if (middle) [this.view.x, this.view.y] = middle;
    const poses = this.parts(input);
    this.axes(poses);
    this.marks(poses);
    if (this.stage.mesh.on) mesh.draw(this, input);
  }
}

const rest = () => new Promise((resume) => setTimeout(resume));

/** One cycle as GIF; `told(share)` is called with its progress, and `signal` ends it. */
export async function asGif(stage, width, seconds, told, signal) {
  const film = new Film(stage, width);
  // Hundredths of a second are what a GIF counts in.
  const hundredths = Math.round(100 / RATE);
  const count = Math.max(2, Math.round((100 * seconds) / hundredths));
  const frames = [];
  for (let i = 0; i < count; i += 1) {
    onPaper(() => film.draw(i / count));
    frames.push(film.context.getImageData(0, 0, film.width, film.height).data);
    told(i / count);
    await rest();
    if (signal.aborted) return null;
  }
  return gif(frames, film.width, film.height, hundredths);
}

/** One cycle as WebM, recorded while it is drawn. */
export async function asWebm(stage, width, seconds, told, signal) {
  const film = new Film(stage, width);
  onPaper(() => film.draw(0));
  const stream = film.canvas.captureStream(0);
  const [track] = stream.getVideoTracks();
  const recorder = new MediaRecorder(stream, { mimeType: "video/webm", videoBitsPerSecond: BITRATE });
  const parts = [];
  recorder.addEventListener("dataavailable", ({ data }) => parts.push(data));
  const stopped = new Promise((resolve) => recorder.addEventListener("stop", resolve, { once: true }));
  recorder.start();
  const start = performance.now();
  for (let i = 0; !signal.aborted; i += 1) {
    const share = i / (RATE * seconds);
    if (share >= 1) break;
    onPaper(() => film.draw(share));
    track.requestFrame();
    told(share);
    await new Promise((resume) => setTimeout(resume, Math.max(0, start + ((i + 1) * 1000) / RATE - performance.now())));
  }
  recorder.stop();
  await stopped;
  return signal.aborted ? null : new Blob(parts, { type: "video/webm" });
}

/** Whether the browser can record a canvas. */
const records = () => typeof MediaRecorder === "function" && MediaRecorder.isTypeSupported("video/webm");

/** Asks what to take of the picture, and hands it over; `name` is that of the design. */
export async function take(stage, name, complain) {
  if (!stage.scene) return;
  const kinds = [["svg", "SVG, as it is shown"], ["png", "PNG, as it is shown"], ["gif", "GIF, one cycle"], ...(records() ? [["webm", "WebM, one cycle"]] : [])];
  const kind = element("select", { id: "picture-kind" }, ...kinds.map(([value, words]) => element("option", { value }, words)));
  const width = element("select", { id: "picture-width" }, ...WIDTHS.map((size) => element("option", { value: size, selected: size === 480 }, `${size} pixels`)));
  const seconds = element("input", { type: "text", inputmode: "decimal", class: "number", id: "picture-seconds", value: "4" });
  const film = element("div", {},
    element("p", { class: "option" }, element("label", { for: "picture-width" }, "Width"), width),
    element("p", { class: "option" }, element("label", { for: "picture-seconds" }, "Length"), seconds, element("span", {}, "s")));
  const words = element("p", { class: "remark", role: "status" });
  const moves = () => ["gif", "webm"].includes(kind.value);
  const shown = () => {
    film.hidden = !moves();
  };
  kind.addEventListener("change", shown);
  shown();
  const stop = new AbortController();
  const made = async (answer) => {
    if (answer !== "take") return true;
    const length = Number(seconds.value.trim().replace(",", "."));
    if (moves() && !(length >= 0.5 && length <= 30)) {
      words.textContent = `the length is ${seconds.value || "empty"}; it must be 0.5 to 30 s`;
      return false;
    }
    try {
      const told = (share) => {
        words.textContent = `${Math.round(100 * share)} %`;
      };
      const file = { svg: svgFile, png: pngFile, gif: () => asGif(stage, Number(width.value), length, told, stop.signal), webm: () => asWebm(stage, Number(width.value), length, told, stop.signal) }[kind.value];
      const blob = await file();
      if (!blob) return true;
      handOver(blob, name, kind.value);
      const size = `${Math.max(1, Math.round(blob.size / 1024))} kB`;
      dialogs.notice("picture", moves() ? `One cycle in ${length} s, ${width.value} pixels wide, ${size}.` : `The picture as it is shown, ${size}.`);
      return true;
    } catch (error) {
      complain("picture", error);
      return true;
    }
  };
  const svgFile = () => new Blob([onPaper(() => svg(stage, name))], { type: "image/svg+xml" });
  const pngFile = () => image(onPaper(() => svg(stage, name)), FINE * stage.width, FINE * stage.height);
  await dialogs.ask("Take the picture", [
    element("p", { class: "option" }, element("label", { for: "picture-kind" }, "File"), kind), film, words,
  ], [["", "Close"], ["take", "Take", "main"]], made);
  stop.abort();
}

/** The button of the picture; `name()` is that of the design. */
export function listen(stage, name, complain) {
  byId("take-picture").addEventListener("click", () => take(stage, name(), complain));
}
