// The motion of the mechanism: played, scrubbed, and read off the curves.

import { byId, element } from "./elements.js";
import { read } from "./motion.js";

const DEG = 180 / Math.PI;

export class Transport {
  constructor(stage) {
    this.stage = stage;
    /** The charts that follow; set once they are there. */
    this.charts = null;
    this.input = 0;
    this.playing = false;
    this.curves = [];
    byId("play").addEventListener("click", () => this.play(!this.playing));
    byId("scrub").addEventListener("input", (event) => this.go(Number(event.target.value) * this.cycle()));
    byId("scrub").addEventListener("keydown", (event) => {
      const way = { ArrowLeft: -1, ArrowRight: 1, PageDown: -10, PageUp: 10 }[event.key];
      if (!way) return;
      event.preventDefault();
      this.go(this.input + way / DEG);
    });
    stage.box.addEventListener("keydown", (event) => {
      if (event.key !== " " || event.target !== stage.box) return;
      event.preventDefault();
      this.play(!this.playing);
    });
  }

  cycle() {
    return this.stage.scene?.motion.cycle ?? 2 * Math.PI;
  }

  /** Speed at which it is played, rad/s. */
  get speed() {
    return (Number(byId("speed").value) * 2 * Math.PI) / 60;
  }

  /** Stops, and leads to an input. */
  go(input) {
    this.play(false);
    this.move(input);
  }

  move(input) {
    this.draw(input);
    this.read();
  }

  /** The mechanism at an input, and where the scrubber stands. */
  draw(input = this.input) {
    this.input = Math.min(Math.max(input, 0), this.cycle());
    this.tell(this.input / this.cycle(), `${(this.input * DEG).toFixed(1)}°`);
    this.stage.at(this.input);
  }

  /** Says how far in the cycle the mechanism stands. */
  tell(share, words) {
    const [scrub, angle] = [byId("scrub"), byId("angle")];
    // An edit leaves it where it is, and writing would have the browser lay out the bar again.
    if (Number(scrub.value) === share && angle.textContent === words) return;
    scrub.value = share;
    scrub.setAttribute("aria-valuetext", words);
    angle.textContent = words;
  }

  /** New curves to be read. */
  show(curves) {
    this.curves = curves;
    this.read();
  }

  /** The curves at the input: those that stand alone in words. */
  read() {
    const lines = this.curves.filter((curve) => curve.name === "").slice(0, 3);
    byId("readout").replaceChildren(...lines.map((curve) => {
      const value = read(curve, this.input);
      const words = value === null ? "–" : value.toFixed(curve.count ? 0 : 4).replace(/^-(0\.?0*)$/, "$1");
      return element("div", {}, `${curve.chart} ${words}${curve.unit && ` ${curve.unit}`}`);
    }));
    this.charts?.at(this.input);
  }

  play(on) {
    if (this.playing === on) return;
    this.playing = on;
    const button = byId("play");
    button.textContent = on ? "Pause" : "Play";
    button.setAttribute("aria-pressed", String(on));
    if (!on) return;
    let last = performance.now();
    const step = (now) => {
      if (!this.playing) return;
      const turned = ((now - last) / 1000) * this.speed;
      last = now;
      this.move((this.input + turned) % this.cycle());
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }
}
