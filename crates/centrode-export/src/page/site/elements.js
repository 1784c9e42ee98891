// Elements of the page.

/** The element with an id. */
export const byId = (id) => document.getElementById(id);

/** A new element: attributes, listeners under "on...", children as text or elements. */
export function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
    else made.setAttribute(key, value === true ? "" : value);
  }
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

/** A new SVG element. */
export function drawn(name, attributes = {}) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  return made;
}

/** A key of the design file as a person reads it. */
export function words(key) {
  const last = key.split(".").pop().replace(/_deg$/, "").replaceAll("_", " ");
  return last.charAt(0).toUpperCase() + last.slice(1);
}
