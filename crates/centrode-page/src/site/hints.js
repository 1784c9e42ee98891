// Help on a number: by F1 in its field, or by a tap on its name.

import { element } from "./elements.js";

/** A press that moves farther is a drag, pixels. */
const STILL = 3;

/** Shows what is known of fields of a form when it is requested. */
export function listen(form) {
  let pressed = 0;
  const of = (target) => {
    const row = target.closest(".field");
    return row && [...form.controls.values()].find((control) => control.row === row);
  };
  form.place.addEventListener("keydown", (event) => {
    const control = event.key === "F1" ? of(event.target) : null;
    if (!control) return;
    event.preventDefault();
    toggle(control);
  });
  form.place.addEventListener("pointerdown", (event) => {
    pressed = event.clientX;
  });
  form.place.addEventListener("click", (event) => {
    // The name of a switch switches it.
    const control = event.target.closest("label") && event.detail > 0 && Math.abs(event.clientX - pressed) < STILL ? of(event.target) : null;
    if (control && control.field.kind !== "switch") toggle(control);
  });
}

/** Shows or hides the words of a field below it. */
function toggle({ field, row, remark }) {
  const shown = row.querySelector(".hint");
  if (shown) {
    shown.remove();
    return;
  }
  const range = [["at least", field.minimum], ["at most", field.maximum]].filter(([, value]) => value !== undefined).map((words) => words.join(" "));
  const words = [field.doc, ...range].filter(Boolean).join("; ");
  remark.before(element("p", { class: "hint", role: "status" }, words || "There is no description of this number."));
}
