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

/** A symbol of a paper, `gamma_0`, as it is printed there. */
export function symbol(text) {
  const greek = { beta: "β", gamma: "γ", phi: "φ" };
  const [letter, index] = text.split("_");
  return element("i", { class: "symbol" }, greek[letter] ?? letter, index ? element("sub", {}, index) : null);
}

/** A key with its tables, as the form shows them. */
export const place = (key) => key.split(".").map(words).join(" · ");

/** What is wrong with a key, as its field says it: without its name, and without words of the file. */
export function fault({ key, rule, message }) {
  const last = key.split(".").pop();
  const missing = /^the key "([^"]+)" is missing$/.exec(rule);
  if (missing) return `${words(missing[1])} has no value, and needs one`;
  if (!rule) return message;
  const rest = rule.startsWith(last) ? rule.slice(last.length) : "";
  return last && /^[^\w]/.test(rest) ? rest.trim() : rule;
}

/** A key of the design file as a person reads it. */
export function words(key) {
  const last = key.split(".").pop().replace(/_(deg|kg|kg_mm2)$/, "").replaceAll("_", " ");
  return last.charAt(0).toUpperCase() + last.slice(1);
}
