// The machine in space, drawn by three.js: its camera, its section and how far it is taken apart.

const DEG = Math.PI / 180;
/** Colours of links, one after the other. */
const COLORS = [0x8c959f, 0x4e79a7, 0xf28e2b, 0x59a14f, 0xe15759, 0x76b7b2, 0xedc948, 0xb07aa1];
/** Half the angle that is seen, and the steepest view. */
const HALF = 17.5 * DEG;
const STEEPEST = 89.9 * DEG;
/** Room round the machine, as a share of its size. */
const ROOM = 1.12;
/** Where the camera stands at first: round the z axis, and above the plane of the gears. */
const TURN = -60 * DEG;
const TILT = 35 * DEG;

/** How much of what is fixed is seen where it is to be looked through. */
const THIN = 0.22;
/** Size of a body next to the machine from which on it hides the rest. */
const LARGE = 0.6;

/** Reads what the program answers: head, places and STL files. */
export function parse(buffer) {
  const size = new DataView(buffer).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, size)));
  let at = 4 + size;
  const each = 7 * head.input.length;
  const links = head.links.map((link) => {
    const places = new Float32Array(buffer, at, each);
    at += 4 * each;
    return { ...link, places };
  });
  const shapes = head.shapes.map(({ file, bytes }) => {
    const stl = new DataView(buffer, at, bytes);
    at += bytes;
    return { file, ...triangles(stl) };
  });
  return { input: head.input, links, shapes };
}

/** Corners and normals of the triangles of a binary STL file. */
function triangles(stl) {
  const count = stl.getUint32(80, true);
  const corners = new Float32Array(9 * count);
  const normals = new Float32Array(9 * count);
  for (let face = 0; face < count; face += 1) {
    const at = 84 + 50 * face;
    for (let k = 0; k < 9; k += 1) {
      corners[9 * face + k] = stl.getFloat32(at + 12 + 4 * k, true);
      normals[9 * face + k] = stl.getFloat32(at + 4 * (k % 3), true);
    }
  }
  return { count, corners, normals };
}

export class View {
  /** Throws where there is no WebGL. */
  constructor(three, canvas) {
    this.three = three;
    this.renderer = new three.WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.camera = new three.PerspectiveCamera(2 * HALF / DEG, 1, 1, 1000);
    this.camera.up.set(0, 0, 1);
    this.scene = new three.Scene();
    this.light = new three.DirectionalLight(0xffffff, 2.2);
    this.scene.add(new three.HemisphereLight(0xffffff, 0x8a8a94, 1.6), this.light);
    this.plane = new three.Plane();
    this.target = new three.Vector3();
    Object.assign(this, { bodies: [], geometries: [], apart: 0, section: null, standing: "thin", now: 0, turn: TURN, tilt: TILT, frame: 0 });
  }

  /** Takes another machine; the camera stays where it is unless it is to be fitted. */
  show({ input, links, shapes }, fit) {
    const { three } = this;
    this.clear();
    this.input = input;
    this.geometries = shapes.map(({ corners, normals }) => {
      const geometry = new three.BufferGeometry();
      geometry.setAttribute("position", new three.BufferAttribute(corners, 3));
      geometry.setAttribute("normal", new three.BufferAttribute(normals, 3));
      geometry.computeBoundingSphere();
      return geometry;
    });
    this.bodies = links.map(({ name, shape, places }, index) => {
      const material = new three.MeshLambertMaterial({ color: COLORS[index % COLORS.length], side: three.DoubleSide });
      const body = new three.Mesh(this.geometries[shape], material);
      body.name = name;
      body.userData = { places, away: new three.Vector3() };
      this.scene.add(body);
      return body;
    });
    this.measure();
    const keeps = ({ userData: { places } }, first) => places.every((value, i) => i % 7 < first || Math.abs(value - places[i % 7]) < 1e-6);
    // What is fixed, and ground that slides below the machine.
    const still = (body) => keeps(body, 0) || (keeps(body, 3) && body.geometry.boundingSphere.radius > LARGE * this.radius);
    this.still = this.bodies.filter(still);
    // Where nothing moves there is nothing behind it.
    if (this.still.length === this.bodies.length) this.still = [];
    this.stand(this.standing);
    if (fit) this.fit();
    this.at(this.now);
  }

  /** How what is fixed is drawn: "solid", "thin", to be looked through, or "hidden". */
  stand(how) {
    this.standing = how;
    for (const body of this.still ?? []) {
      body.visible = how !== "hidden";
      Object.assign(body.material, { transparent: how === "thin", opacity: how === "thin" ? THIN : 1, depthWrite: how !== "thin", needsUpdate: true });
      body.renderOrder = how === "thin" ? 1 : 0;
    }
    this.draw();
  }

  clear() {
    for (const body of this.bodies) {
      this.scene.remove(body);
      body.material.dispose();
    }
    for (const geometry of this.geometries) geometry.dispose();
  }

  /** The sphere round the machine where the cycle begins, and which way each body goes when it is taken apart. */
  measure() {
    const box = new this.three.Box3();
    for (const body of this.bodies) {
      this.place(body, 0, 0, 0);
      body.updateMatrixWorld();
      box.expandByObject(body);
    }
    const sphere = box.getBoundingSphere(new this.three.Sphere());
    this.corners = [0, 1, 2, 3, 4, 5, 6, 7].map((k) => new this.three.Vector3(...["x", "y", "z"].map((axis, i) => (k >> i & 1 ? box.max : box.min)[axis])));
    this.middle = sphere.center;
    this.radius = sphere.radius || 1;
    const high = this.bodies.map((body) => [body, body.geometry.boundingSphere.center.clone().applyMatrix4(body.matrixWorld)]);
    high.sort((a, b) => a[1].z - b[1].z);
    const last = Math.max(1, high.length - 1);
    // Along z in their order, so that bodies on one shaft part, too; aside by where they are.
    high.forEach(([body, center], rank) => {
      body.userData.away.copy(center).sub(this.middle).multiplyScalar(0.8).setZ((rank / last - 0.5) * 2.4 * this.radius);
    });
  }

  place(body, index, share, apart) {
    const { places, away } = body.userData;
    const [i, j] = [7 * index, 7 * Math.min(index + 1, this.input.length - 1)];
    body.position.fromArray(places, i);
    body.quaternion.fromArray(places, i + 3);
    if (share > 0) {
      const { three } = this;
      body.position.lerp(new three.Vector3().fromArray(places, j), share);
      body.quaternion.slerp(new three.Quaternion().fromArray(places, j + 3), share);
    }
    body.position.addScaledVector(away, apart);
  }

  /** The machine at an input, by the samples of its picture. */
  at(now) {
    this.now = now;
    if (!this.bodies.length) return;
    const { input } = this;
    let low = 0;
    let high = input.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (input[middle] <= now) low = middle;
      else high = middle;
    }
    const span = input[high] - input[low];
    const share = span > 0 ? Math.min(Math.max((now - input[low]) / span, 0), 1) : 0;
    for (const body of this.bodies) this.place(body, low, share, this.apart);
    this.draw();
  }

  /** Cuts away what lies beyond a share of the machine along an axis (0, 1, 2); `null` for nothing. */
  cut(axis, share) {
    this.section = axis === null ? null : { axis, share };
    this.draw();
  }

  explode(share) {
    this.apart = share;
    this.at(this.now);
  }

  fit() {
    this.target.copy(this.middle);
    Object.assign(this, { turn: TURN, tilt: TILT });
    // So near that every corner of the machine is just in sight.
    const [flat, up] = [Math.cos(TILT), Math.sin(TILT)];
    const { three } = this;
    const back = new three.Vector3(Math.cos(TURN) * flat, Math.sin(TURN) * flat, up);
    const right = new three.Vector3(-Math.sin(TURN), Math.cos(TURN), 0);
    const above = back.clone().cross(right);
    const away = this.corners.map((corner) => {
      const from = corner.clone().sub(this.middle);
      const aside = Math.max(Math.abs(from.dot(right)) / this.camera.aspect, Math.abs(from.dot(above)));
      return from.dot(back) + (ROOM * aside) / Math.tan(HALF);
    });
    this.distance = Math.max(...away, 0.1 * this.radius);
    this.draw();
  }

  orbit(turn, tilt) {
    this.turn += turn;
    this.tilt = Math.min(Math.max(this.tilt + tilt, -STEEPEST), STEEPEST);
    this.draw();
  }

  /** Moves by pixels of the canvas. */
  pan(right, down) {
    const pixel = (2 * this.distance * Math.tan(HALF)) / this.height;
    const { three, camera } = this;
    const [x, y] = [0, 1].map((column) => new three.Vector3().setFromMatrixColumn(camera.matrix, column));
    this.target.addScaledVector(x, -right * pixel).addScaledVector(y, down * pixel);
    this.draw();
  }

  zoom(factor) {
    this.distance = Math.min(Math.max(this.distance / factor, 0.02 * this.radius), 50 * this.radius);
    this.draw();
  }

  resize(width, height) {
    if (!width || !height) return;
    this.height = height;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.draw();
  }

  /** Draws in the next frame, once however often it is requested. */
  draw() {
    this.frame ||= requestAnimationFrame(() => this.render());
  }

  render() {
    this.frame = 0;
    if (!this.bodies.length) return;
    const { camera, target, radius, distance, section, middle } = this;
    const [flat, up] = [Math.cos(this.tilt), Math.sin(this.tilt)];
    camera.position.set(Math.cos(this.turn) * flat, Math.sin(this.turn) * flat, up).multiplyScalar(distance).add(target);
    camera.near = Math.max(distance - 6 * radius, 0.005 * distance);
    camera.far = distance + 6 * radius;
    camera.updateProjectionMatrix();
    camera.lookAt(target);
    camera.updateMatrix();
    // The light comes over the shoulder.
    this.light.position.set(-0.4, 0.6, 1).applyQuaternion(camera.quaternion);
    if (section) {
      this.plane.normal.set(0, 0, 0).setComponent(section.axis, -1);
      this.plane.constant = middle.getComponent(section.axis) + (2 * section.share - 1) * radius;
    }
    this.renderer.clippingPlanes = section ? [this.plane] : [];
    this.renderer.render(this.scene, camera);
  }

  stop() {
    cancelAnimationFrame(this.frame);
    this.clear();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }
}
