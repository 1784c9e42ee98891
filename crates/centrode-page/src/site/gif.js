// Animations as GIF 89a: one palette for all frames, packed by LZW.

/** Colours differ in so many bits of red, green and blue. */
const BITS = 5;
/** Most colours of a palette. */
const COLOURS = 256;
/** Greatest code of LZW and one more. */
const CODES = 4096;

/** The colour of a pixel, as a cell of the cube of colours. */
const cell = (data, i) => {
  const drop = 8 - BITS;
  return ((data[i] >> drop) << (2 * BITS)) | ((data[i + 1] >> drop) << BITS) | (data[i + 2] >> drop);
};

/** Palette of frames: the commonest cells, each with the mean of its pixels, and the index of every cell. */
function palette(frames) {
  const cells = new Map();
  for (const data of frames) {
    for (let i = 0; i < data.length; i += 4) {
      const key = cell(data, i);
      let sum = cells.get(key);
      if (!sum) cells.set(key, sum = [0, 0, 0, 0]);
      sum[0] += 1;
      for (let k = 0; k < 3; k += 1) sum[k + 1] += data[i + k];
    }
  }
  const sorted = [...cells].sort(([a, [n]], [b, [m]]) => m - n || a - b);
  const colours = sorted.slice(0, COLOURS).map(([, [n, ...sum]]) => sum.map((part) => Math.round(part / n)));
  const index = new Map();
  sorted.forEach(([key, [n, ...sum]], i) => {
    if (i < COLOURS) {
      index.set(key, i);
      return;
    }
    const mean = sum.map((part) => part / n);
    const away = colours.map((colour) => colour.reduce((far, part, k) => far + (part - mean[k]) ** 2, 0));
    index.set(key, away.indexOf(Math.min(...away)));
  });
  return { colours, index };
}

/** Bytes that grow. */
class Bytes {
  constructor() {
    this.parts = [];
  }

  put(...bytes) {
    this.parts.push(Uint8Array.from(bytes));
  }

  /** A number of two bytes, the lower first. */
  short(value) {
    this.put(value & 255, value >> 8);
  }

  text(words) {
    this.put(...Array.from(words, (letter) => letter.charCodeAt(0)));
  }
}

/** Pixels packed by LZW, in blocks of at most 255 bytes. */
function packed(pixels) {
  const out = [];
  let [held, room] = [0, 0];
  const [clear, end] = [COLOURS, COLOURS + 1];
  let [width, next, known] = [9, end + 1, new Map()];
  const put = (code) => {
    held |= code << room;
    room += width;
    while (room >= 8) {
      out.push(held & 255);
      held >>>= 8;
      room -= 8;
    }
  };
  put(clear);
  let prefix = pixels[0];
  for (let i = 1; i < pixels.length; i += 1) {
    const key = prefix * COLOURS + pixels[i];
    const code = known.get(key);
    if (code !== undefined) {
      prefix = code;
      continue;
    }
    put(prefix);
    if (next === CODES) {
      put(clear);
      [width, next, known] = [9, end + 1, new Map()];
    } else {
      if (next === 1 << width) width += 1;
      known.set(key, next);
      next += 1;
    }
    prefix = pixels[i];
  }
  put(prefix);
  if (next === 1 << width && width < 12) width += 1;
  put(end);
  if (room > 0) out.push(held & 255);
  const blocks = [];
  for (let i = 0; i < out.length; i += 255) {
    const block = out.slice(i, i + 255);
    blocks.push(block.length, ...block);
  }
  return Uint8Array.from([...blocks, 0]);
}

/** A GIF that goes on for ever, of frames with four bytes a pixel; each is shown for so many hundredths of a second. */
export function gif(frames, width, height, hundredths) {
  const { colours, index } = palette(frames);
  const file = new Bytes();
  file.text("GIF89a");
  file.short(width);
  file.short(height);
  // A palette of 256 colours for all frames.
  file.put(0xf7, 0, 0);
  file.put(...Array.from({ length: COLOURS }, (_, i) => colours[i] ?? [0, 0, 0]).flat());
  file.put(0x21, 0xff, 11);
  file.text("NETSCAPE2.0");
  file.put(3, 1, 0, 0, 0);
  for (const data of frames) {
    file.put(0x21, 0xf9, 4, 0);
    file.short(hundredths);
    file.put(0, 0);
    file.put(0x2c, 0, 0, 0, 0);
    file.short(width);
    file.short(height);
    file.put(0, 8);
    const pixels = new Uint8Array(data.length / 4);
    for (let i = 0; i < pixels.length; i += 1) pixels[i] = index.get(cell(data, 4 * i));
    file.parts.push(packed(pixels));
  }
  file.put(0x3b);
  return new Blob(file.parts, { type: "image/gif" });
}
