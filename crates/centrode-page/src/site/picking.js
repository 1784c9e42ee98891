// What lies under the pointer of a machine that is being composed: points, bodies, the ground.

/** So near to a point is on it, pixels. */
const NEAR = 12;
/** So near to the line of a bar is on it, pixels. */
const BESIDE = 7;

/** A power of ten so small that a step of it is no more than the size. */
const power = (size) => 10 ** Math.floor(Math.log10(size));

export class Picking {
  /** `parts()` are the points and bodies of the snapshot. */
  constructor(stage, parts) {
    this.stage = stage;
    this.parts = parts;
  }

  /** Poses of the links at the input shown; the frame alone where there is no picture. */
  get poses() {
    const { scene, input } = this.stage;
    return scene ? scene.motion.at(input) : [[0, 0, 0]];
  }

  /** Where a point of a link is in the picture, pixels. */
  pixels(link, [u, v]) {
    const [x, y, angle] = this.poses[link] ?? [0, 0, 0];
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    return this.stage.toBox(x + c * u - s * v, y + s * u + c * v);
  }

  /** The pointer in the box, pixels. */
  at(event) {
    const bounds = this.stage.box.getBoundingClientRect();
    return [event.clientX - bounds.left, event.clientY - bounds.top];
  }

  /** A position of the picture with the digits that can be seen, mm. */
  place(pixels) {
    const step = power(1 / this.stage.view.scale);
    const digits = Math.max(0, -Math.round(Math.log10(step)));
    return this.stage.toModel(...pixels).map((value) => Number((Math.round(value / step) * step).toFixed(digits)) + 0);
  }

  /** Name of the point under the pointer; null where there is none. */
  point(pixels) {
    let [best, found] = [NEAR, null];
    for (const { name, link, at } of this.parts().points) {
      const [x, y] = this.pixels(link, at);
      const off = Math.hypot(x - pixels[0], y - pixels[1]);
      if (off < best) [best, found] = [off, name];
    }
    return found;
  }

  /** Index of the body under the pointer, that of the frame for the ground. Where `turning` is set, one that turns there first. */
  body(pixels, turning = false) {
    const { bodies } = this.parts();
    if (turning) {
      let [best, found] = [NEAR, 0];
      bodies.forEach(({ turns }, i) => {
        const [x, y] = this.pixels(i, [0, 0]);
        const off = Math.hypot(x - pixels[0], y - pixels[1]);
        if (turns && off < best) [best, found] = [off, i];
      });
      if (found) return found;
    }
    const { stage, poses } = this;
    const links = stage.scene?.links ?? [];
    for (let i = Math.min(links.length, bodies.length) - 1; i > 0; i -= 1) {
      if (stage.isOn(i, poses[i], pixels, BESIDE)) return i;
    }
    return 0;
  }
}
