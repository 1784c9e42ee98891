// Dark and light; the computer's choice until another is made.

import { byId } from "./elements.js";

const KEY = "centrode-theme";

/** Colours asked for since they last changed. */
const known = new Map();

/** Starts the switch; calls back whenever the colours change. */
export function start(changed) {
  const root = document.documentElement;
  const switched = () => {
    known.clear();
    changed();
  };
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const stored = remembered();
  if (stored) root.dataset.theme = stored;
  byId("theme").addEventListener("click", () => {
    const now = root.dataset.theme ?? (dark.matches ? "dark" : "light");
    root.dataset.theme = now === "dark" ? "light" : "dark";
    remember(root.dataset.theme);
    switched();
  });
  dark.addEventListener("change", switched);
  for (const turn of ["beforeprint", "afterprint"]) addEventListener(turn, () => known.clear());
}

/** A colour of the page by its name. */
export function color(name) {
  let value = known.get(name);
  if (value === undefined) {
    value = getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
    known.set(name, value);
  }
  return value;
}

// A page opened from a file may have no storage.
function remembered() {
  try {
    return localStorage.getItem(KEY);
  } catch {
    return null;
  }
}

function remember(theme) {
  try {
    localStorage.setItem(KEY, theme);
  } catch {
    // The choice holds until the page is closed.
  }
}
