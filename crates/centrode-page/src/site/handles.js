// Points of the drawing that represent numbers of the design: to be dragged, or moved by arrow keys.

import { byId, drawn } from "./elements.js";

const DEG = Math.PI / 180;

/** Where a handle lies in the frame of its link. */
function position({ plane, values: [a, b], scale, origin: [x, y] }) {
  if (plane === "cartesian") return [x + a * scale, y + b * scale];
  return [x + a * scale * Math.cos(b * DEG), y + a * scale * Math.sin(b * DEG)];
}

/** The numbers of a handle in words. */
function words({ keys, values }) {
  const names = keys.map((key) => key.split(".").at(-1).split("[")[0]);
  const said = names.flatMap((name, i) => {
    if (!name) return [];
    if (name.endsWith("_deg")) return [`${name.slice(0, -4)} ${values[i]}°`];
    // Two numbers of one list are coordinates.
    return [`${names[0] === names[1] ? "xy"[i] : name} ${values[i]} mm`];
  });
  return said.join(", ").replaceAll("_", " ");
}

/** The table and the position in its list of a point of a curve; null for another. */
function pointOf({ keys: [key], chained }) {
  const found = chained && /^(.+)\.[^.]+\[(\d+)\]$/.exec(key);
  return found ? [found[1], Number(found[2])] : null;
}

/** So near to a curve is on it, pixels. */
const NEAR = 8;

/** Distance of a position from the line between two others. */
function off([px, py], [x, y], [u, v]) {
  const [dx, dy] = [u - x, v - y];
  const share = ((px - x) * dx + (py - y) * dy) / (dx * dx + dy * dy || 1);
  const on = Math.min(Math.max(share, 0), 1);
  return Math.hypot(px - x - on * dx, py - y - on * dy);
}

/** Room that the coordinates of a point take next to it, pixels. */
const ROOM = 190;

/** A power of ten so small that a step of it is no more than the size. */
const power = (size) => 10 ** Math.floor(Math.log10(size));

const rounded = (value, step) => Number((Math.round(value / step) * step).toFixed(Math.max(0, -Math.round(Math.log10(step)))));

export class Handles {
  /** `edit(edits, final)` takes new values; `began()` is called when a drag starts; `points(table)` are those of a curve. */
  constructor(stage, { edit, began, points }) {
    this.points = points;
    /** Name of the point that gets the focus once it is there. */
    this.wish = null;
    this.stage = stage;
    this.edit = edit;
    this.began = began;
    this.layer = stage.box.querySelector("svg");
    this.list = [];
    /** Marks by the names of their points. */
    this.marks = new Map();
    this.poses = [];
    this.dragged = null;
    byId("show-handles").addEventListener("change", () => this.place(this.poses));
    stage.box.addEventListener("dblclick", (event) => this.insert(event), true);
  }

  show(handles) {
    this.list = handles;
    byId("show-handles").parentElement.hidden = handles.length === 0;
    this.chain ??= this.layer.appendChild(drawn("polygon", { class: "chain" }));
    // A mark that is held stays, even if this design has no such point.
    const names = new Set(handles.map((handle) => handle.name));
    for (const [name, mark] of this.marks) {
      if (names.has(name) || name === this.dragged) continue;
      mark.remove();
      this.marks.delete(name);
    }
    let next = null;
    for (const handle of handles.toReversed()) {
      let mark = this.marks.get(handle.name);
      if (!mark) {
        mark = this.mark(handle.name);
        if (handle.kind) mark.classList.add(handle.kind);
        this.marks.set(handle.name, mark);
        this.layer.insertBefore(mark, next);
      }
      mark.classList.toggle("free", Boolean(handle.free));
      const point = pointOf(handle);
      const number = mark.querySelector(".number");
      const count = point ? String(point[1] + 1) : "";
      if (number.textContent !== count) number.textContent = count;
      this.tell(handle, mark);
      next = mark;
    }
    if (this.wish && this.marks.has(this.wish)) {
      this.marks.get(this.wish).focus();
      this.wish = null;
    }
    this.place(this.poses);
  }

  /** Writes the coordinates of a point next to it. */
  tell(handle, mark) {
    const told = words(handle);
    const label = `${handle.name}: ${told}`;
    // Most points stay where they are, and writing would have the browser lay them out again.
    if (mark.getAttribute("aria-label") === label) return;
    mark.setAttribute("aria-label", label);
    const point = pointOf(handle);
    mark.querySelector(".where").textContent = point ? `${point[1] + 1}: ${told}` : told;
  }

  /** Moves the marks to where the links stand. */
  place(poses) {
    this.poses = poses;
    const hidden = !byId("show-handles").checked || this.list.length === 0;
    this.layer.classList.toggle("hidden", hidden);
    if (hidden || !this.chain) return;
    const points = this.list.flatMap((handle) => {
      const pose = poses[handle.link];
      if (!pose) return [];
      const [x, y] = position(handle);
      const [c, s] = [Math.cos(pose[2]), Math.sin(pose[2])];
      const [px, py] = this.stage.toBox(pose[0] + c * x - s * y, pose[1] + s * x + c * y);
      const mark = this.marks.get(handle.name);
      mark.setAttribute("transform", `translate(${px.toFixed(2)} ${py.toFixed(2)})`);
      mark.classList.toggle("leftward", px > this.stage.width - ROOM);
      return handle.chained ? [`${px.toFixed(1)},${py.toFixed(1)}`] : [];
    });
    this.chain.setAttribute("points", points.join(" "));
  }

  mark(name) {
    const mark = drawn("g", { class: "handle", tabindex: 0, role: "button" });
    mark.append(drawn("circle", { r: 12, class: "reach" }), drawn("circle", { r: 5 }),
      drawn("text", { class: "number", x: 8, y: -7 }), drawn("text", { class: "where", x: 10, y: -8 }));
    mark.addEventListener("pointerdown", (event) => {
      event.preventDefault();
      event.stopPropagation();
      // Where marks lie on each other, the one whose middle is nearest is meant.
      const taken = this.nearest(event) ?? name;
      this.marks.get(taken).focus();
      this.marks.get(taken).setPointerCapture(event.pointerId);
      this.dragged = taken;
      this.stage.held = true;
      this.stage.remember(true);
      this.began();
    });
    mark.addEventListener("pointermove", (event) => {
      if (this.dragged === name) this.move(name, this.pointed(event), false);
    });
    for (const end of ["pointerup", "pointercancel"]) {
      mark.addEventListener(end, (event) => {
        if (this.dragged !== name) return;
        this.dragged = null;
        this.stage.held = false;
        this.stage.remember(false);
        this.move(name, this.pointed(event), true);
      });
    }
    mark.addEventListener("keydown", (event) => {
      this.nudge(name, event);
      this.count(name, event);
      this.drop(name, event);
    });
    return mark;
  }

  /** Name of the mark whose middle is nearest to a pointer. */
  nearest(event) {
    let best = Infinity;
    let found = null;
    for (const [name, mark] of this.marks) {
      const { left, right, top, bottom } = mark.firstChild.getBoundingClientRect();
      const off = Math.hypot(event.clientX - (left + right) / 2, event.clientY - (top + bottom) / 2);
      if (off < best) [best, found] = [off, name];
    }
    return found;
  }

  named(name) {
    return this.list.find((handle) => handle.name === name);
  }

  pointed(event) {
    const bounds = this.stage.box.getBoundingClientRect();
    return this.stage.toModel(event.clientX - bounds.left, event.clientY - bounds.top);
  }

  /** A point of the drawing in the plane of a handle. */
  within(handle, [x, y]) {
    const [ox, oy, angle] = this.poses[handle.link];
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    return [
      (c * (x - ox) + s * (y - oy) - handle.origin[0]) / handle.scale,
      (c * (y - oy) - s * (x - ox) - handle.origin[1]) / handle.scale,
    ];
  }

  /** The numbers of a point of the plane, with the digits that can be seen. */
  numbers(handle, [u, v]) {
    const step = power(1 / (this.stage.view.scale * Math.abs(handle.scale)));
    if (handle.plane !== "polar") return [rounded(u, step), rounded(v, step)];
    const radius = Math.hypot(u, v);
    const turn = power(step / Math.max(radius, step) / DEG);
    // The turn nearest to the one written: a list of angles need not start at zero.
    const now = Math.atan2(v, u) / DEG;
    const turns = Math.round((handle.values[1] - now) / 360);
    return [rounded(radius, step), rounded(now + 360 * turns, turn)];
  }

  /** Takes a point of the drawing back to the numbers it represents. */
  move(name, place, final) {
    const handle = this.named(name);
    if (!handle) {
      // This design has no such point: it stays as it is, and so does what was requested last.
      if (final) this.edit([], true);
      return;
    }
    const values = this.numbers(handle, this.within(handle, place));
    const edits = handle.keys.map((key, i) => ({ key, value: values[i] })).filter((edit) => edit.key);
    handle.values = values.map((value, i) => (handle.keys[i] ? value : handle.values[i]));
    this.tell(handle, this.marks.get(handle.name));
    this.place(this.poses);
    this.edit(edits, final);
  }

  /** Adds a point where the curve, or the line between two of its points, is clicked twice. */
  insert(event) {
    const [table] = pointOf(this.list.find((handle) => pointOf(handle)) ?? { keys: [""] }) ?? [];
    const own = this.list.filter((handle) => pointOf(handle)?.[0] === table);
    const points = own.length > 1 && byId("show-handles").checked && this.points(pointOf(own[0])[0]);
    if (!points || event.target.closest("button, label, .handle")) return;
    const bounds = this.stage.box.getBoundingClientRect();
    const place = [event.clientX - bounds.left, event.clientY - bounds.top];
    const plane = this.within(own[0], this.pointed(event));
    // Between the positions of poses, or of a stroke, no curve is known.
    const i = points.smooth ? this.spanAt(own, place) : points.halfway ? null : this.sectorAt(own, place, plane);
    if (i === null) return;
    event.stopPropagation();
    const values = this.numbers(own[i], plane);
    // The numbers are those of the nearest turn, which may be the one before.
    if (own[i].plane === "polar" && this.turn(own[i], plane) > 180) values[1] += 360;
    this.began();
    this.wish = own[i].name.replace(/\d+/, String(i + 2));
    points.add(i, null, values);
  }

  /** Turn from a handle on to a position of its plane, going round, degrees. */
  turn({ plane: kind, values: [a, b] }, plane) {
    const from = kind === "polar" ? b : Math.atan2(b, a) / DEG;
    return ((Math.atan2(plane[1], plane[0]) / DEG - from) % 360 + 360) % 360;
  }

  /** The handle before a position of the box, going round; null for a position that is on no line. */
  sectorAt(own, place, plane) {
    const { link } = own[0];
    const [ox, oy, angle] = this.poses[link];
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    const corners = own.map((handle) => {
      const [x, y] = position(handle);
      return this.stage.toBox(ox + c * x - s * y, oy + s * x + c * y);
    });
    const onLine = corners.some((corner, i) => off(place, corner, corners[(i + 1) % corners.length]) < NEAR);
    if (!onLine && !this.stage.isAtPitch(link, this.poses[link], place, NEAR)) return null;
    return own.reduce((best, handle, k) => (this.turn(handle, plane) < this.turn(own[best], plane) ? k : best), 0);
  }

  /** The handle before a position of the box on the curve through all of them, whose corners are spread evenly from handle to handle. */
  spanAt(own, place) {
    const { shapes, links } = this.stage.scene.picture;
    const [{ vertices }] = shapes[links[own[0].link].shape];
    const corners = Array.from({ length: vertices.length / 3 }, (_, i) => this.stage.toBox(vertices[3 * i], vertices[3 * i + 1]));
    const offs = corners.map((corner, i) => off(place, corner, corners[(i + 1) % corners.length]));
    const nearest = offs.indexOf(Math.min(...offs));
    return offs[nearest] < NEAR ? Math.floor(((nearest + 0.5) * own.length) / corners.length) : null;
  }

  /** Adds a point after this one, or deletes it; the focus follows. */
  count(name, event) {
    const point = pointOf(this.named(name) ?? { keys: [""] });
    const points = point && this.points(point[0]);
    if (!points || event.ctrlKey || event.metaKey || event.altKey) return;
    const called = (i) => name.replace(/\d+/, String(i + 1));
    if (event.key === "Insert") {
      this.wish = called(point[1] + 1);
      points.add(point[1], null);
    } else if (event.key === "Delete" || event.key === "Backspace") {
      this.wish = called(Math.min(point[1], points.points.length - 2));
      points.remove(point[1], null);
    } else {
      return;
    }
    event.preventDefault();
    event.stopPropagation();
    this.began();
  }

  /** Delete at what is no point of a curve gives the edits that drop it, where there are such. */
  drop(name, event) {
    const { drop } = this.named(name) ?? {};
    if (!drop || !["Delete", "Backspace"].includes(event.key) || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    event.stopPropagation();
    this.began();
    this.stage.box.focus();
    this.edit(drop, true);
  }

  nudge(name, event) {
    const ways = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const way = ways[event.key];
    if (!way) return;
    event.preventDefault();
    event.stopPropagation();
    this.began();
    const handle = this.named(name);
    if (!handle) return;
    const [ox, oy, angle] = this.poses[handle.link];
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    const [x, y] = position(handle);
    const reach = (event.shiftKey ? 10 : 1) * 2 * power(10 / this.stage.view.scale) / 2;
    this.move(name, [ox + c * x - s * y + way[0] * reach, oy + s * x + c * y + way[1] * reach], true);
  }
}
