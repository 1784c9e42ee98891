// Numbers of the form by words, and the essential ones alone.

import { element, words } from "./elements.js";
import * as essentials from "./essentials.js";

export class Find {
  constructor(form) {
    this.form = form;
    this.box = element("input", { type: "text", id: "find", "aria-label": "Find a number", placeholder: "Find a number …", spellcheck: "false", autocomplete: "off",
      oninput: () => this.show(),
      onkeydown: (event) => {
        if (event.key !== "Escape" || !this.box.value) return;
        event.preventDefault();
        this.box.value = "";
        this.show();
      } });
    this.few = element("input", { type: "checkbox", id: "essentials", onchange: () => this.choose() });
    this.few.checked = Boolean(form.brief) && !essentials.all();
    this.count = element("p", { class: "quiet", id: "find-count", role: "status" });
    this.place = element("div", { class: "find" }, this.box,
      element("label", { title: "What the file says and what it cannot be without" }, this.few, " Essentials"), this.count);
    /** Tables and whether they were open, before all with something found were opened. */
    this.opened = new Map();
  }

  /** Whether a field is one that the design is made of: written in the file, or one it cannot be without. */
  static essential({ written, optional, value }) {
    return written || (!optional && value !== null);
  }

  /** Essentials alone, or all numbers: remembered for the next visit. */
  choose() {
    if (this.form.brief) essentials.remember(!this.few.checked);
    this.form.rebuild();
    this.show();
  }

  /** Hides fields outside the search. */
  show() {
    const asked = this.box.value.toLowerCase().split(/\s+/).filter(Boolean);
    const all = [...this.form.controls.values()].filter(({ field }) => field);
    // The columns of a table of points have one position.
    const places = new Map();
    for (const { field, row, remark } of all) {
      const place = row.closest(".points") ?? row;
      const table = field.key.split(".").slice(0, -1).join(" ");
      const told = [words(field.key), field.key, table, field.doc].join(" ").replaceAll("_", " ").concat(" ", field.symbol ?? "").toLowerCase();
      const meant = asked.every((word) => told.includes(word)) && (!this.few.checked || Find.essential(field) || remark.childNodes.length > 0);
      places.set(place, (places.get(place) ?? false) || meant);
    }
    for (const [place, meant] of places) place.hidden = !meant;
    const more = [...this.form.place.querySelectorAll(".absent button")];
    for (const button of more) button.hidden = !asked.every((word) => button.title.toLowerCase().includes(word));
    for (const fold of this.form.place.querySelectorAll(".table")) {
      const found = [...places].some(([place, meant]) => meant && fold.contains(place)) || more.some((button) => !button.hidden && fold.contains(button));
      fold.hidden = !found;
      if (asked.length && !this.opened.has(fold)) this.opened.set(fold, fold.open);
      if (asked.length) fold.open = found;
      else if (this.opened.has(fold)) fold.open = this.opened.get(fold);
    }
    if (!asked.length) this.opened.clear();
    const shown = [...places.values()].filter(Boolean).length;
    this.count.textContent = asked.length || this.few.checked ? `${shown} of ${places.size}` : "";
  }

  /** Looks again, in a form that has changed. */
  again() {
    if (this.box.value || this.few.checked) this.show();
  }
}
