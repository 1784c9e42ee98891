// Dark and light; the computer's choice until another is made.

import { byId } from "./elements.js";

const KEY = "centrode-theme";

/** Colours requested since they last changed. */
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

}

/** Takes the colours of paper, or those of the screen again; calls back to have all drawn with them. */
export function paper(on, draw) {
  const root = document.documentElement;
  if (on) {
    root.dataset.screen = root.dataset.theme ?? "";
    root.dataset.theme = "light";
  } else if (root.dataset.screen !== undefined) {
    if (root.dataset.screen) root.dataset.theme = root.dataset.screen;
    else delete root.dataset.theme;
    delete root.dataset.screen;
  }
  known.clear();
  draw();
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
