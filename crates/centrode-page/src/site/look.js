// One gear from nearby: its axis stays in the middle of the view while the machine moves.

import { byId, element } from "./elements.js";
import { reach } from "./reach.js";

/** Room around the gear, as a share of its radius. */
const ROOM = 1.15;

export class LookView {
  constructor(stage) {
    this.stage = stage;
    this.choice = byId("look");
    /** Number of the link in view; none. */
    this.index = null;
    this.gears = [];
    this.choice.addEventListener("change", () => this.turn());
  }

  get on() {
    return this.index !== null;
  }

  /** Takes another picture: its gears are the links that carry a pitch curve. */
  show(scene) {
    const carries = ({ solid, lines }) => solid && lines.some(({ role }) => role === "pitch");
    this.gears = (scene?.links ?? []).flatMap((link, i) => (carries(link) ? [[link.name, i]] : []));
    const names = this.gears.map(([name]) => name);
    if (names.join("\n") !== this.named) {
      const before = this.choice.value;
      this.named = names.join("\n");
      this.choice.replaceChildren(element("option", { value: "" }, "All"), ...names.map((name) => element("option", { value: name }, name)));
      this.choice.value = names.includes(before) ? before : "";
      this.choice.hidden = names.length === 0;
    }
    if (!this.on) return;
    const found = this.gears.find(([name]) => name === this.choice.value);
    if (found) [, this.index] = found;
    else this.stage.fit();
  }

  /** Looks at the gear that is chosen, or at everything. */
  turn() {
    const found = this.gears.find(([name]) => name === this.choice.value);
    if (!found) {
      this.stage.fit();
      return;
    }
    const { stage } = this;
    stage.mesh.press(null);
    [, this.index] = found;
    this.following = true;
    const { shapes, links } = stage.scene.picture;
    const { greatest } = reach(shapes[links[this.index].shape]);
    stage.view.scale = Math.min(stage.width, stage.height) / (2 * ROOM * greatest.radius);
    stage.fitted = false;
    stage.draw();
  }

  /** Looks at no gear any more. */
  leave() {
    this.index = null;
    this.following = false;
    this.choice.value = "";
  }

  /** Where the axis of the gear is that is followed; null where none is. */
  middle(input) {
    return this.on && this.following ? this.stage.scene.motion.at(input)[this.index].slice(0, 2) : null;
  }
}
