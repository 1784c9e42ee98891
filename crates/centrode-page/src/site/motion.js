// Poses of every link at an input: read between the samples of the snapshot.

export class Motion {
  constructor({ input, poses }) {
    this.input = input;
    this.poses = poses;
    this.cycle = input[input.length - 1];
  }

  /** The sample before an input within the cycle, and how far on to the next. */
  place(input) {
    let low = 0;
    let high = this.input.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.input[middle] <= input) low = middle;
      else high = middle;
    }
    const span = this.input[high] - this.input[low];
    return [low, span > 0 ? (input - this.input[low]) / span : 0];
  }

  /** x, y and angle of every link; one that is fixed has them once. */
  at(input) {
    const [index, share] = this.place(Math.min(Math.max(input, 0), this.cycle));
    return this.poses.map((samples) => {
      if (samples.length === 3) return samples;
      const i = 3 * index;
      const j = Math.min(i + 3, samples.length - 3);
      return [0, 1, 2].map((k) => samples[i + k] + share * (samples[j + k] - samples[i + k]));
    });
  }
}

/** A curve at an input, or nothing where it has no value; a count is that of the sample before. */
export function read(curve, input) {
  const x = curve.input;
  if (x.length < 2) return null;
  let low = 0;
  let high = x.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (x[middle] <= input) low = middle;
    else high = middle;
  }
  if (curve.count) return curve.value[input >= x[high] ? high : low];
  const [a, b] = [curve.value[low], curve.value[high]];
  if (a === null || b === null) return null;
  const share = Math.min(Math.max((input - x[low]) / (x[high] - x[low]), 0), 1);
  return a + share * (b - a);
}
