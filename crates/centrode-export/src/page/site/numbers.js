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
