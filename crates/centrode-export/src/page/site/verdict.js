// Goals and findings.

import { byId, element } from "./elements.js";
import * as figures from "./figures.js";

const SIGN = { error: "✕", warning: "▲", note: "●", good: "✓", open: "○" };

const checking = () => element("p", {}, "Checking …");

/** Nothing is known of the design yet. */
export function clear() {
  byId("goals").replaceChildren();
  byId("findings").replaceChildren(checking());
  byId("figures").replaceChildren();
}

/** The checks were cancelled: what an earlier design was worth says nothing of this one; `again` begins anew. */
export function unchecked(again) {
  clear();
  byId("findings").replaceChildren(
    title("Not checked", "error"),
    element("p", {}, "The checks were cancelled. ", element("button", { type: "button", class: "link", onclick: again }, "Check")));
}

/** Shows what the checks say; `go` leads to an input angle. */
export function show(snapshot, pinned, go) {
  const place = byId("findings");
  const verdict = snapshot.verdict;
  byId("verdict").classList.toggle("stale", !verdict || Boolean(snapshot.error));
  if (snapshot.error) {
    const { key, line, column, message } = snapshot.error;
    place.replaceChildren(
      title(line ? "No mechanism" : "Not solved", "error"),
      element("ul", { class: "findings no-mechanism" }, element("li", { class: "error" },
        element("p", {}, element("b", {}, `${SIGN.error} error `), message),
        line ? element("p", { class: "detail" }, key ? `${key}, line ${line}, column ${column}` : `line ${line}, column ${column}`) : null)),
    );
    return;
  }
  if (!verdict) {
    // What is known of the design before says nothing of this one.
    const before = place.querySelector(".title");
    if (!before || place.querySelector(".no-mechanism")) place.replaceChildren(checking());
    else before.replaceWith(title("Checking …", "open"));
    return;
  }
  place.replaceChildren(
    title(verdict.ok ? "Sound" : "Does not do its job", verdict.ok ? "good" : "error", verdict.summary),
    element("ul", { class: "findings" }, ...verdict.findings.map((finding) => item(finding, go))),
  );
  goals(verdict.goals, pinned?.verdict?.goals);
  figures.show(verdict, pinned?.verdict);
}

/** Goals as bars: figure, range, and how near it is. */
export function goals(list, pinned) {
  if (list.length === 0) {
    byId("goals").replaceChildren();
    return;
  }
  const checked = list.filter((goal) => goal.met !== null);
  const met = checked.filter((goal) => goal.met).length;
  const open = list.length - checked.length;
  const before = new Map((pinned ?? []).map((goal) => [goal.name, goal]));
  byId("goals").replaceChildren(
    element("div", { class: "title" }, element("h2", {}, `Goals: ${met} of ${checked.length} reached`),
      open ? element("span", { class: "quiet" }, `${open} not checked`) : null),
    ...list.map((goal) => bar(goal, before.get(goal.name))));
}

function bar(goal, before) {
  const state = goal.met === null ? "open" : goal.met ? "met" : "unmet";
  const sign = { open: "○", met: "✓", unmet: "✕" }[state];
  const fill = element("div", { class: "bar-fill" });
  fill.style.transform = `scaleX(${goal.progress ?? 0})`;
  const was = before && before.value !== goal.value ? ` (was ${before.value})` : "";
  return element("div", { class: `goal ${state}`, "data-goal": goal.name },
    element("div", { class: "head" }, element("span", {}, `${goal.number}. ${goal.title}`),
      element("b", { title: goal.exact }, `${sign} ${goal.value}${goal.unit && ` ${goal.unit}`}${was}`)),
    element("div", { class: "track", role: "progressbar", "aria-label": goal.title, "aria-valuemin": 0, "aria-valuemax": 1,
      "aria-valuenow": goal.progress ?? undefined, "aria-valuetext": `${goal.value} ${goal.unit}, wanted ${goal.wanted}, ${goal.verdict}` }, fill),
    element("div", { class: "detail" }, `${goal.wanted}${goal.unit && ` ${goal.unit}`}; ${goal.verdict}`));
}

function title(words, kind, summary) {
  return element("div", { class: `title ${kind}` },
    element("h2", {}, `${SIGN[kind]} ${words}`),
    summary ? element("span", { class: "quiet" }, summary) : null);
}

function item(finding, go) {
  const details = [finding.where, finding.figures].filter(Boolean).join("; ");
  return element("li", { class: finding.severity },
    element("p", {}, element("b", {}, `${SIGN[finding.severity]} ${finding.severity} `), finding.message),
    details ? element("p", { class: "detail" }, details,
      finding.input === null ? null : element("button", { type: "button", class: "link", onclick: () => go(finding.input) }, "show")) : null,
    finding.remedy ? element("p", { class: "detail" }, `remedy: ${finding.remedy}`) : null);
}
