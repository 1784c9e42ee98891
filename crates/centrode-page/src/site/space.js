// The 3D view over the drawing: requested by its button, worked by mouse, touch and keys.

import { byId, element } from "./elements.js";
import { parse, View } from "./space-view.js";
import * as server from "./server.js";
import { work } from "./work.js";

/** A change rests so long before its meshes are requested, ms. */
const REST = 400;
const STEP = (5 * Math.PI) / 180;
const MISSING = "This browser shows no 3D view: WebGL is missing or switched off. The drawing and the exported files need none.";

export class Space {
  /** `design` says the text that is shown and whether it is a mechanism; `complain` shows an error. */
  constructor(stage, design) {
    Object.assign(this, { stage, design, view: null, text: null, stop: null, timer: 0, box: null });
    this.button = byId("space");
    this.button.addEventListener("click", () => (this.box ? this.close() : this.open()));
  }

  async open() {
    this.button.setAttribute("aria-pressed", "true");
    const canvas = element("canvas", {});
    this.words = element("p", { class: "space-words", role: "status" }, "Loading …");
    const section = element("select", { "aria-label": "Section plane" },
      ...[["", "no section"], ["0", "section x"], ["1", "section y"], ["2", "section z"]].map(([value, words]) => element("option", { value }, words)));
    const where = element("input", { type: "range", min: "0", max: "1", step: "0.01", value: "0.5", "aria-label": "Position of the section", disabled: true });
    const standing = element("select", { "aria-label": "Fixed parts", onchange: () => this.view?.stand(standing.value) },
      ...[["thin", "frame see-through"], ["solid", "frame solid"], ["hidden", "frame hidden"]].map(([value, words]) => element("option", { value }, words)));
    const apart = element("input", { type: "range", min: "0", max: "1", step: "0.01", value: "0" });
    this.standing = standing;
    const cut = () => {
      where.disabled = section.value === "";
      this.view?.cut(section.value === "" ? null : Number(section.value), Number(where.value));
    };
    section.addEventListener("change", cut);
    where.addEventListener("input", cut);
    apart.addEventListener("input", () => this.view?.explode(Number(apart.value)));
    this.scene = element("div", {
      class: "space-scene", tabindex: 0, role: "application", "aria-roledescription": "3D view",
      "aria-label": "Machine in space. Arrow keys turn the view, with Shift they move it, plus and minus zoom, 0 fits, space plays, Escape closes.",
    }, canvas);
    this.box = element("div", { class: "space-box", role: "group", "aria-label": "3D view" },
      this.scene,
      element("div", { class: "space-bar" },
        element("button", { type: "button", onclick: () => this.view?.fit() }, "Fit 3D"),
        standing, section, where,
        element("label", {}, "Explode ", apart),
        element("button", { type: "button", onclick: () => this.close() }, "Close 3D")),
      this.words);
    const { box } = this;
    this.stage.box.after(box);
    this.stage.box.hidden = true;
    this.listen();
    this.scene.focus();
    try {
      const three = await import(new URL("three.module.min.js", location.href).href);
      if (this.box !== box) return;
      try {
        // Checked before three.js, which would write its own complaint.
        if (!document.createElement("canvas").getContext("webgl2")) throw new Error(MISSING);
        this.view = new View(three, canvas);
      } catch {
        throw new Error(MISSING);
      }
      this.watcher = new ResizeObserver(() => this.view?.resize(this.scene.clientWidth, this.scene.clientHeight));
      this.watcher.observe(this.scene);
      this.view.resize(this.scene.clientWidth, this.scene.clientHeight);
      await this.load();
    } catch (error) {
      if (this.box === box) this.say(error.message);
    }
  }

  say(words) {
    this.words.textContent = words;
  }

  /** Fetches the meshes of the design that is shown. */
  async load() {
    const { text, sound } = this.design();
    if (!sound || !this.view || text === this.text) return;
    this.stop?.abort();
    const stop = new AbortController();
    const fit = this.text === null;
    this.stop = stop;
    this.text = text;
    this.say("Making the meshes …");
    try {
      const machine = parse(await work((signal) => server.meshes(text, signal), stop));
      if (this.stop !== stop || !this.view) return;
      if (!machine.links.length) {
        this.say("No link of this machine has a body.");
        return;
      }
      this.view.show(machine, fit || !this.view.distance);
      this.standing.hidden = this.view.still.length === 0;
      this.view.at(this.stage.input);
      const count = machine.links.reduce((sum, { shape }) => sum + machine.shapes[shape].count, 0);
      this.say(`${machine.links.length} bodies, ${count.toLocaleString("en")} triangles: the meshes of the exported models.`);
    } catch (error) {
      if (this.stop !== stop) return;
      this.text = null;
      this.say(stop.signal.aborted ? "Cancelled; the next change makes the meshes anew." : error.message);
    }
  }

  /** Follows the drawing: its input at once, another design when it rests. */
  follow() {
    if (!this.view) return;
    this.view.at(this.stage.input);
    const { text, sound } = this.design();
    if (text === this.seen) return;
    this.seen = text;
    if (!sound || text === this.text) return;
    this.say("The previous design is shown …");
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.load(), REST);
  }

  close() {
    clearTimeout(this.timer);
    this.stop?.abort();
    this.watcher?.disconnect();
    this.view?.stop();
    this.box.remove();
    Object.assign(this, { view: null, text: null, stop: null, box: null, watcher: null });
    this.stage.box.hidden = false;
    this.button.setAttribute("aria-pressed", "false");
    this.stage.resize();
    this.button.focus();
  }

  listen() {
    const { scene } = this;
    const held = new Map();
    scene.addEventListener("contextmenu", (event) => event.preventDefault());
    scene.addEventListener("pointerdown", (event) => {
      scene.setPointerCapture(event.pointerId);
      held.set(event.pointerId, [event.clientX, event.clientY]);
    });
    scene.addEventListener("pointermove", (event) => {
      const before = held.get(event.pointerId);
      if (!before || !this.view) return;
      const now = [event.clientX, event.clientY];
      const [right, down] = [now[0] - before[0], now[1] - before[1]];
      const other = [...held].find(([id]) => id !== event.pointerId)?.[1];
      if (other) {
        const reach = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]);
        if (reach(before) > 0) this.view.zoom(reach(now) / reach(before));
        this.view.pan(right / 2, down / 2);
      } else if (event.shiftKey || event.buttons & 6) this.view.pan(right, down);
      else this.view.orbit(-right / 150, down / 150);
      held.set(event.pointerId, now);
    });
    for (const end of ["pointerup", "pointercancel"]) scene.addEventListener(end, (event) => held.delete(event.pointerId));
    scene.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.view?.zoom(Math.exp(-event.deltaY / 500));
    }, { passive: false });
    scene.addEventListener("dblclick", () => this.view?.fit());
    scene.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      const { view } = this;
      const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
      if (event.key === "Escape") this.close();
      else if (event.key === " ") byId("play").click();
      else if (way && event.shiftKey) view?.pan(-40 * way[0], -40 * way[1]);
      else if (way) view?.orbit(STEP * way[0], -STEP * way[1]);
      else if ("+=".includes(event.key)) view?.zoom(1.25);
      else if (event.key === "-") view?.zoom(0.8);
      else if (event.key === "0") view?.fit();
      else return;
      event.preventDefault();
    });
  }
}
