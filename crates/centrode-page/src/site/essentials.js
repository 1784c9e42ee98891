// The numbers with which a design of each family begins: three to six of them come first.

/** At most so many come first. */
const MOST = 6;

/** Keys in the order of their weight; those of the design itself come before those of its pairs. */
const KEYS = [
  "arms", "bend_deg", "arm.tip_distance", "scheme", "gears.speed_ratio", "lead", "shaft.lead", "holes", "shaft.holes", "radius", "window_deg", "moved_distance",
  "linkage.crank", "linkage.coupler", "linkage.rocker", "linkage.frame", "linkage.pivot", "goals.swing_deg", "input.speed_rpm",
  "pitch.kind", "pitch.eccentricity", "module", "pitch.module", "tooth_count", "pitch.tooth_count", "gears.module", "gears.tooth_count", "mean_ratio", "teeth.backlash",
].map((key) => new RegExp(`^${key.replace(".", "\\.")}$`));
/** Of a composed machine, the lengths of its bars and the laws of its bodies. */
const PARTS = [/^dyads\.[^.]+\.lengths$/, /^bodies\.[^.]+\.law\.ratio$/, /^cams\.[^.]+\.base_radius$/, /^pairs\.[^.]+\.pitch\.eccentricity$/];

/** Keys of the fields that come first. */
export function first(tables) {
  const fields = tables.flatMap((table) => table.fields).filter(({ value, kind }) => value !== null && kind !== "text");
  const found = [...KEYS, ...PARTS].flatMap((key) => fields.filter((field) => key.test(field.key)));
  return found.slice(0, MOST).map(({ key }) => key);
}

const COOKIE = "centrode-form";

/** Whether all numbers were chosen at the last visit: a cookie, since the program has another port each time. */
export const all = () => document.cookie.split("; ").includes(`${COOKIE}=all`);

/** Remembers whether all numbers are shown. */
export function remember(on) {
  document.cookie = `${COOKIE}=${on ? "all" : "few"}; path=/; max-age=31536000; samesite=strict`;
}
