// The start page: files of the folder, templates of the families, and every shipped design with its picture.

import * as dialogs from "./dialogs.js";
import { byId, element } from "./elements.js";
import * as link from "./link.js";
import { free, make, recent, remember } from "./new-file.js";
import { Painter, Scene } from "./painter.js";
import * as server from "./server.js";
import * as theme from "./theme.js";

/** Speed of the moving pictures, rad of the input a millisecond. */
const SPEED = (2 * Math.PI * 6) / 60000;
/** Pictures requested at once: they take the computer's time. */
const AT_ONCE = 2;
/** Room around a picture, pixels. */
const ROOM = [16, 16];

const still = matchMedia("(prefers-reduced-motion: reduce)");
const moving = byId("moving");

/** A picture that moves while it is pointed at, has the focus, or all do. */
class Thumbnail {
  constructor(kind, name) {
    this.of = [kind, name];
    this.canvas = element("canvas", { "aria-hidden": "true" });
    this.painter = new Painter(this.canvas);
    this.input = 0;
    this.seen = false;
    this.held = false;
    this.stepping = false;
    new ResizeObserver(() => this.draw()).observe(this.canvas);
  }

  async load() {
    try {
      this.painter.scene = new Scene(await server.picture(...this.of));
      this.draw();
    } catch (error) {
      complain(error);
    }
  }

  draw() {
    const { painter } = this;
    painter.measureBy(this.canvas);
    if (!painter.scene) return;
    painter.frame(ROOM);
    this.paint();
  }

  paint() {
    this.painter.clear();
    // Names would hide a picture this small.
    this.painter.axes(this.painter.parts(this.input));
    this.canvas.dataset.input = this.input;
  }

  get moves() {
    return this.seen && this.painter.scene && !still.matches && (this.held || moving.getAttribute("aria-pressed") === "true");
  }

  /** Moves for as long as it is to. */
  go() {
    if (this.stepping || !this.moves) return;
    this.stepping = true;
    let last = performance.now();
    const step = (now) => {
      this.stepping = this.moves;
      if (!this.stepping) return;
      this.input = (this.input + Math.max(0, now - last) * SPEED) % this.painter.scene.motion.cycle;
      last = now;
      this.paint();
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  hold(on) {
    this.held = on;
    this.go();
  }
}

const thumbnails = new Map();
const waiting = [];
let loading = 0;

/** Loads the pictures that have come into sight, a few at a time. */
function load() {
  while (loading < AT_ONCE && waiting.length) {
    loading += 1;
    waiting.shift().load().finally(() => {
      loading -= 1;
      load();
    });
  }
}

const sight = new IntersectionObserver((changes) => {
  for (const { target, isIntersecting } of changes) {
    const thumbnail = thumbnails.get(target);
    if (isIntersecting && !thumbnail.asked) {
      thumbnail.asked = true;
      waiting.push(thumbnail);
    }
    thumbnail.seen = isIntersecting;
    thumbnail.go();
  }
  load();
}, { rootMargin: "120px" });

function complain(error, key = "server") {
  dialogs.notice(key, error.message, [], "error");
}

const capital = (words) => words.charAt(0).toUpperCase() + words.slice(1);

/** Opens a file; where it cannot be, the reason stands below the path. */
async function open(path) {
  const remark = byId("open-remark");
  remark.replaceChildren();
  try {
    if (link.holds(path)) {
      await unfold(await link.read(path));
      return;
    }
    const { page, refused } = await server.open(path);
    if (page) {
      remember(path, byId("folder").textContent);
      location.assign(page);
      return;
    }
    byId("path").value = path;
    remark.replaceChildren(element("span", { class: "error" }, refused));
    byId("path").focus();
  } catch (error) {
    complain(error);
  }
}

/** Asks where the design of a link is to be. */
async function unfold(text) {
  const { taken, folder } = await server.offer();
  const title = link.named(text);
  const name = title.toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, "").slice(0, 40) || "design";
  await make({ text }, title, free(name, taken), folder);
}

/** A card of the gallery. */
function card(kind, name, title, words, offer) {
  const thumbnail = new Thumbnail(kind, name);
  const pressed = () => make({ [kind]: name }, title, free(name, offer.taken), offer.folder);
  const button = element("button", { type: "button", class: "card", onclick: pressed, "data-design": name },
    thumbnail.canvas, element("b", {}, title), element("span", { class: "quiet" }, words));
  for (const [event, on] of [["pointerenter", true], ["focus", true], ["pointerleave", false], ["blur", false]]) {
    button.addEventListener(event, () => thumbnail.hold(on));
  }
  thumbnails.set(button, thumbnail);
  sight.observe(button);
  return element("li", {}, button);
}

function gallery(id, title, words, cards) {
  return element("section", { "aria-labelledby": id },
    element("h2", { id }, title), words && element("p", { class: "quiet" }, words), element("ul", { class: "gallery" }, ...cards));
}

function show(offer) {
  byId("folder").textContent = offer.folder;
  const paths = recent();
  byId("recent-title").hidden = paths.length === 0;
  byId("recent").replaceChildren(...paths.map((path) => element("li", {}, element("button", { type: "button", onclick: () => open(path) },
    element("b", {}, path.split(/[\\/]/).pop()), element("span", { class: "quiet" }, path)))));
  byId("found").replaceChildren(...offer.files.map(({ file, title, family }) => element("li", {},
    element("button", { type: "button", onclick: () => open(file) }, element("b", {}, file), element("span", { class: "quiet" }, title || family)))));
  if (offer.files.length === 0) byId("found").replaceChildren(element("li", { class: "quiet" }, "No design yet."));
  const families = offer.families.filter(({ shipped }) => shipped.length);
  byId("families").replaceChildren(
    gallery("new", "New, by family", "A commented design file, as centrode new writes it.",
      offer.families.map(({ word, noun, about }) => card("new", word, capital(noun.replace(/^an? /, "")), about, offer))),
    ...families.map(({ word, noun, shipped }) => gallery(`shipped-${word}`, `Shipped: ${noun.replace(/^an? /, "")}`, "",
      shipped.map(({ name, title }) => card("shipped", name, title || name, name, offer)))),
  );
}

moving.addEventListener("click", () => {
  moving.setAttribute("aria-pressed", String(moving.getAttribute("aria-pressed") !== "true"));
  for (const thumbnail of thumbnails.values()) thumbnail.go();
});
// With reduced motion nothing moves.
const calm = () => {
  moving.hidden = still.matches;
};
still.addEventListener("change", calm);
calm();
byId("empty").addEventListener("click", async () => {
  try {
    const { empty, taken, folder } = await server.offer();
    await make({ text: empty }, "An empty machine, to be composed by clicks.", free("machine", taken), folder);
  } catch (error) {
    complain(error);
  }
});
byId("open").addEventListener("submit", (event) => {
  event.preventDefault();
  open(byId("path").value.trim());
});
theme.start(() => {
  for (const thumbnail of thumbnails.values()) thumbnail.draw();
});
link.listen(unfold, (error) => complain(error, "link"));
const refresh = () => server.offer().then(show).catch(complain);
// Back from a design: its file may be new.
addEventListener("pageshow", (event) => {
  if (event.persisted) refresh();
});
refresh();
