// Goals and findings.

import { byId, element } from "./elements.js";
import * as figures from "./figures.js";

const SIGN = { error: "✕", warning: "▲", note: "●" };

/** Shows what the checks say; `go` leads to an input angle. */
export function show(snapshot, pinned, go) {
  const place = byId("findings");
  const verdict = snapshot.verdict;
  byId("verdict").classList.toggle("stale", !verdict || Boolean(snapshot.error));
  if (snapshot.error) {
    const { key, line, column, message } = snapshot.error;
    place.replaceChildren(
      title("No mechanism", "error"),
      element("ul", { class: "findings" }, element("li", { class: "error" },
        element("p", {}, element("b", {}, `${SIGN.error} error `), message),
        element("p", { class: "detail" }, key ? `${key}, line ${line}, column ${column}` : `line ${line}, column ${column}`))),
    );
    return;
  }
  if (!verdict) return;
  place.replaceChildren(
    title(verdict.ok ? "Sound" : "Does not do its job", verdict.ok ? "good" : "error", verdict.summary),
    element("ul", { class: "findings" }, ...verdict.findings.map((finding) => item(finding, go))),
  );
  figures.show(verdict, pinned?.verdict);
}

function title(words, kind, summary) {
  return element("div", { class: `title ${kind}` },
    element("h2", {}, `${kind === "good" ? "✓" : "✕"} ${words}`),
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
