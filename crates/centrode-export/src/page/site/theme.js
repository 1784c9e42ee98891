// Dark and light; the computer's choice until another is made.

import { byId } from "./elements.js";

const KEY = "centrode-theme";

/** Starts the switch; calls back whenever the colours change. */
export function start(changed) {
  const root = document.documentElement;
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const stored = remembered();
  if (stored) root.dataset.theme = stored;
  byId("theme").addEventListener("click", () => {
    const now = root.dataset.theme ?? (dark.matches ? "dark" : "light");
    root.dataset.theme = now === "dark" ? "light" : "dark";
    remember(root.dataset.theme);
    changed();
  });
  dark.addEventListener("change", changed);
}

/** A colour of the page by its name. */
export function color(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
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
