// Goals and findings.

import { byId, element, fault, place as path } from "./elements.js";
import * as figures from "./figures.js";
import { brief } from "./numbers.js";

const SIGN = { error: "✕", warning: "▲", note: "●", good: "✓", open: "○" };

/** Nothing is known of the design yet. */
export function clear() {
  byId("goals").replaceChildren();
  byId("findings").replaceChildren(title("Checking …", "open"));
  byId("figures").replaceChildren();
  byId("verdict").classList.add("stale");
}

/** The checks were cancelled: what an earlier design was worth says nothing of this one; `again` begins anew. */
export function unchecked(again) {
  clear();
  byId("findings").replaceChildren(
    title("Not checked", "error"),
    element("p", {}, "The checks were cancelled. ", element("button", { type: "button", class: "link", onclick: again }, "Check")));
}

/** Marks what will be that of the design before once a snapshot's picture is drawn. */
export function fade({ verdict, goals: told, error }) {
  if (!verdict && !told) byId("goals").setAttribute("aria-busy", "true");
  if (!verdict || error) byId("verdict").classList.add("stale");
}

/** Marks what is still that of the design before, of all that is shown. */
function mark({ verdict, goals: told, error }) {
  byId("goals").setAttribute("aria-busy", String(!verdict && !told));
  byId("verdict").classList.toggle("stale", !verdict || Boolean(error));
}

/** Shows what the checks say, or what is known before; `go` leads to an input angle. */
export function show(snapshot, pinned, go) {
  const place = byId("findings");
  const { verdict, error } = snapshot;
  const told = verdict?.goals ?? snapshot.goals;
  mark(snapshot);
  if (error && snapshot.compose?.empty) {
    clear();
    place.replaceChildren(title("No part yet", "open"), element("p", {}, "Add a body: click where it turns, then its end."));
    return;
  }
  if (error) {
    const { key, line, column } = error;
    const words = brief(fault(error));
    // Nothing of the design before is left to be taken for this one's.
    clear();
    place.replaceChildren(
      title(line ? "No mechanism" : "Not solved", "error"),
      element("ul", { class: "findings no-mechanism" }, element("li", { class: "error" },
        element("p", {}, element("b", {}, `${SIGN.error} error `), key ? `${path(key)}: ${words}` : words),
        // What is no design at all has no form: its position is one in the text.
        line && !key ? element("p", { class: "detail" }, `line ${line}, column ${column}`) : null)),
      ...(snapshot.picture ? [element("p", { class: "detail" }, "Picture and curves are those of the last good design.")] : []),
    );
    return;
  }
  if (told) goals(told, pinned?.verdict?.goals);
  if (!verdict) {
    // What is known of the design before says nothing of this one.
    if (!place.querySelector(".findings:not(.no-mechanism)")) place.replaceChildren(title("Checking …", "open"));
    const left = [told ? null : byId("goals").firstChild && "goals", place.querySelector("li") && "findings", byId("figures").firstChild && "figures"].filter(Boolean);
    place.firstChild.replaceWith(title("Checking …", "open", left.length ? `figures are from the previous design: ${left.join(", ")}` : ""));
    return;
  }
  place.replaceChildren(
    status(verdict),
    element("ul", { class: "findings" }, ...verdict.findings.map((finding) => item(finding, go))),
  );
  figures.show(verdict, pinned?.verdict);
}

/** The one status: it is as good as the worst that is listed. */
function status({ ok, goals: list, findings, summary }) {
  if (findings.some(({ rule }) => rule === "detail")) return title("Cannot be made", "error", summary);
  const missed = list.filter((goal) => goal.met === false).length;
  if (missed) return title(`Misses ${missed} goal${missed > 1 ? "s" : ""}`, "error", summary);
  if (!ok) return title("Does not do its job", "error", summary);
  return findings.some(({ severity }) => severity === "warning") ? title("Works, with warnings", "warning", summary) : title("Sound", "good", summary);
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

/** A goal; a paper may give one number to several. */
function bar(goal, before) {
  const state = goal.met === null ? "open" : goal.met ? "met" : "unmet";
  const sign = { open: "○", met: "✓", unmet: "✕" }[state];
  const fill = element("div", { class: "bar-fill" });
  fill.style.transform = `scaleX(${goal.progress ?? 0})`;
  const was = before && before.value !== goal.value ? ` (was ${before.value})` : "";
  return element("div", { class: `goal ${state}`, "data-goal": goal.name },
    element("div", { class: "head" }, element("span", {}, `${goal.number}. ${goal.title}`, goal.paper === null ? null : element("span", { class: "quiet" }, ` goal ${goal.paper} of the paper`)),
      element("b", { title: goal.exact }, `${sign} ${goal.value}${goal.unit && ` ${goal.unit}`}${was}`)),
    element("div", { class: "track", role: "progressbar", "aria-label": goal.title, "aria-valuemin": 0, "aria-valuemax": 1,
      "aria-valuenow": goal.progress ?? undefined, "aria-valuetext": `${goal.value} ${goal.unit}, required ${goal.required}, ${goal.verdict}` }, fill,
      // The bar of a missed goal ends where the goal is met.
      state === "unmet" ? element("span", { class: "target", "aria-hidden": "true" }) : null),
    element("div", { class: "detail" }, `${goal.required}${goal.unit && ` ${goal.unit}`}; ${goal.verdict}${goal.spare ? `, ${goal.spare} to spare` : ""}`));
}

function title(words, kind, summary) {
  return element("div", { class: `title ${kind}` },
    element("h2", {}, `${SIGN[kind]} ${words}`),
    summary ? element("span", { class: "quiet" }, summary) : null);
}

function item(finding, go) {
  const details = [finding.where, finding.figures].filter(Boolean).join("; ");
  return element("li", { class: finding.severity },
    element("p", {}, element("b", {}, `${SIGN[finding.severity]} ${finding.severity} `), brief(finding.message)),
    details ? element("p", { class: "detail" }, details,
      finding.input === null ? null : element("button", { type: "button", class: "link", onclick: () => go(finding.input) }, "show")) : null,
    finding.remedy ? element("p", { class: "detail" }, `remedy: ${finding.remedy}`) : null);
}
