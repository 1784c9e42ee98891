// Numbers as they are typed, and stepped by keys.

/** A handsome step for a number: a hundredth of its size, one for whole numbers. */
export function stepOf(field, value) {
  if (field.kind === "integer" || field.kind === "integers") return 1;
  const size = Math.abs(value);
  if (!Number.isFinite(size) || size === 0) return 0.01;
  return 10 ** Math.round(Math.log10(size) - 2.2);
}

/** What is typed, as a value of the design: a number where it reads as one. */
export function typed(text) {
  const plain = text.trim().replace(",", ".").replace("−", "-");
  return /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(plain) && Number.isFinite(Number(plain)) ? Number(plain) : text.trim();
}

/** Digits after the point. */
const decimals = (value) => (String(value).split("e")[0].split(".")[1] ?? "").length + Math.max(0, -(String(value).split("e")[1] ?? 0));

/** A power of ten without the rounding of its making. */
export const tidy = (power) => Number(power.toPrecision(1));

/** A number some steps on, with no digits but its own and the step's: back again it is what it was. */
export const stepped = (value, count, step) => Number((value + count * step).toFixed(Math.min(100, Math.max(decimals(value), decimals(step)))));

/** More digits of a number in a message mean nothing to its reader. */
const TOLD = 6;

/** A message with its numbers as short as they can be read. */
export const brief = (text) => text.replace(/\d+\.\d+(e[-+]?\d+)?/gi, (number) => {
  const digits = number.split(/e/i)[0].replace(".", "").replace(/^0+/, "").length;
  return digits > TOLD ? String(Number(Number(number).toPrecision(TOLD))) : number;
});

/** Units that a number may be given in, and how many of the field's own they are. */
const UNITS = {
  mm: { mm: 1, cm: 10, m: 1000, in: 25.4, '"': 25.4 },
  "°": { "°": 1, deg: 1, rad: 180 / Math.PI },
};

/** Reads a sum of products with brackets, from left to right; nothing where there is none. */
class Sum {
  constructor(text, units) {
    this.words = text.match(/\d+(?:[.,]\d*)?(?:e[-+]?\d+)?|[.,]\d+(?:e[-+]?\d+)?|[a-z]+|\S/gi) ?? [];
    this.units = units;
  }

  take(...signs) {
    return signs.includes(this.words[0]) ? this.words.shift() : null;
  }

  sum() {
    let total = this.product();
    for (let sign = this.take("+", "-"); sign; sign = this.take("+", "-")) {
      const next = this.product();
      total = sign === "+" ? total + next : total - next;
    }
    return total;
  }

  product() {
    let total = this.factor();
    const first = this.unit();
    let named = Boolean(first);
    total *= first ?? 1;
    for (let sign = this.take("*", "/"); sign; sign = this.take("*", "/")) {
      const next = this.factor();
      total = sign === "*" ? total * next : total / next;
      const size = this.unit();
      // Square millimetres are no length.
      if (size && named) return NaN;
      named ||= Boolean(size);
      total *= size ?? 1;
    }
    return total;
  }

  /** Size of the unit that comes next: it is that of all before it in the product, as in 1/8 in. */
  unit() {
    const size = this.units[this.words[0]];
    if (size !== undefined) this.words.shift();
    return size;
  }

  factor() {
    if (this.take("-")) return -this.factor();
    if (this.take("(")) {
      const inner = this.sum();
      return this.take(")") ? inner : NaN;
    }
    const word = this.words.shift() ?? "";
    if (word.toLowerCase() === "pi") return Math.PI;
    return /^[\d.,]/.test(word) ? Number(word.replace(",", ".")) : NaN;
  }

  /** The value, if all of the text is it. */
  get value() {
    const value = this.sum();
    return this.words.length === 0 && Number.isFinite(value) ? Number(value.toPrecision(12)) : null;
  }
}

/** What is typed into the field of a number: itself, or what it comes to in the field's unit; else the text. */
export function worked(text, unit) {
  const plain = typed(text);
  if (typeof plain === "number" || plain === "") return plain;
  return new Sum(plain.replaceAll("−", "-").replaceAll("×", "*").replaceAll("·", "*"), UNITS[unit] ?? {}).value ?? plain;
}

/** A number as assistive techniques read it: without an exponent. */
export function decimal(value) {
  const text = String(value);
  return text.includes("e-") ? value.toFixed(20).replace(/0+$/, "") : text;
}
