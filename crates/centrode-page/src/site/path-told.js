// Further wishes, and findings on the machine that was found.

import { element } from "./elements.js";

/** Wishes, each reached or missed by how much. */
export function wishes(goals, head = "Wishes", heading = "h2") {
  if (!goals?.length) return [];
  const missed = goals.filter(({ met }) => !met).length;
  const title = missed ? `${head}: ${missed} of ${goals.length} missed` : `${head}: all reached`;
  const one = ({ name, words, met }) => element("li", { class: met ? "met" : "missed", "data-goal": name }, `${met ? "✓" : "✕"} ${words}`);
  return [element(heading, {}, title), element("ul", { class: "wishes" }, ...goals.map(one))];
}

/** Findings, each with its rule. */
export function findings(found) {
  return (found ?? []).map(([rule, words]) => element("p", { class: "finding", "data-rule": rule }, element("b", {}, "! "), words));
}
