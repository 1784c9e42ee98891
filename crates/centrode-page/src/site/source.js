// The design file as text, to be worked on by hand.

import { ask } from "./dialogs.js";
import { element } from "./elements.js";
import * as server from "./server.js";

/** Text that was neither applied nor given up: the Escape key closes the dialog, no more. */
let kept = null;

const place = ({ key, line, column }) => `${key ? `${key}, ` : ""}line ${line}, column ${column}`;

/** Where a line begins and ends. */
function reach(text, line) {
  const lines = text.split("\n");
  const start = lines.slice(0, line - 1).join("\n").length + (line > 1 ? 1 : 0);
  return [start, start + (lines[line - 1] ?? "").length];
}

/** Shows the text; resolves to another that reads as a design, or to null. */
export async function edit(file, text, error) {
  const area = element("textarea", { "aria-label": "Design file", spellcheck: "false", wrap: "off", rows: 28, cols: 92, oninput: () => {
    kept = area.value;
  } });
  area.value = kept ?? text;
  const numbers = element("pre", { class: "line-numbers", "aria-hidden": "true" });
  const count = () => {
    const lines = area.value.split("\n").length;
    if (numbers.dataset.lines === String(lines)) return;
    numbers.dataset.lines = lines;
    numbers.textContent = Array.from({ length: lines }, (_, i) => i + 1).join("\n");
  };
  count();
  area.addEventListener("input", count);
  area.addEventListener("scroll", () => {
    numbers.scrollTop = area.scrollTop;
  });
  const remark = element("p", { class: "remark", role: "status" });
  const complain = (words) => remark.replaceChildren(element("span", { class: "error" }, words));
  if (kept !== null) remark.textContent = "This text has not been applied yet.";
  else if (error) complain(`${place(error)}: ${error.message}`);
  const sound = async (answer) => {
    if (answer !== "apply") return true;
    try {
      const { fault } = await server.fault(area.value);
      if (!fault) return true;
      complain(`${place(fault)}: ${fault.message}`);
      area.focus();
      area.setSelectionRange(...reach(area.value, fault.line));
    } catch (failure) {
      complain(failure.message);
    }
    return false;
  };
  // From the top, or from the line at fault: a browser would begin at the end.
  const [start, end] = kept === null && error?.line ? reach(area.value, error.line) : [0, 0];
  area.setSelectionRange(start, end);
  const answer = await ask(file, [remark, element("div", { class: "numbered" }, numbers, area)], [["cancel", "Cancel"], ["apply", "Apply", "main"]], sound);
  if (answer) kept = null;
  return answer === "apply" ? area.value : null;
}
