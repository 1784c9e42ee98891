// Questions to the user: what to export, whom to believe about a file.

import { byId, element } from "./elements.js";

/** Shows a dialog; resolves to what its button says, or to null when it is closed. Where `sound(answer)` resolves to false it stays. */
export function ask(title, content, buttons, sound) {
  const dialog = byId("dialog");
  const form = element("form", { method: "dialog" },
    element("h2", { id: "dialog-title" }, title),
    ...content,
    element("div", { class: "buttons" }, ...buttons.map(([value, words, kind]) => value
      ? element("button", { value, class: kind }, words)
      // Not what the Enter key presses.
      : element("button", { type: "button", onclick: () => dialog.close("") }, words))));
  if (sound) {
    form.addEventListener("submit", async (event) => {
      event.preventDefault();
      const answer = event.submitter?.value ?? "";
      if (await sound(answer) && dialog.open && form.isConnected) dialog.close(answer);
    });
  }
  dialog.replaceChildren(form);
  dialog.returnValue = "";
  dialog.showModal();
  return new Promise((resolve) => {
    dialog.addEventListener("close", () => resolve(dialog.returnValue || null), { once: true });
  });
}

/** What to export, of kinds and parts given as word and description, for receivers given as word, kinds and tolerance, with choices of the drawing's keys; resolves to the options, or to null. */
export async function files(formats, purposes, parts, sheets) {
  const boxes = formats.map(([name]) => {
    const box = element("input", { type: "checkbox", value: name });
    box.checked = true;
    return box;
  });
  const named = parts.map(([name]) => {
    const box = element("input", { type: "checkbox", value: name, id: `export-part-${name}` });
    box.checked = true;
    return box;
  });
  const tick = (words, on) => element("button", { type: "button", onclick: () => named.forEach((box) => Object.assign(box, { checked: on })) }, words);
  const tolerance = element("input", { type: "text", inputmode: "decimal", class: "number", value: "0.001", id: "export-tolerance" });
  const select = (id, ...choices) => element("select", { id }, ...choices.map(([value, words]) => element("option", { value }, words)));
  const dxf = select("export-dxf", ["r2010", "R2010, lines and arcs"], ["r12", "R12, for old controllers"], ["spline", "R2010, splines"], ["chords", "R2010, straight lines"]);
  const layers = select("export-layers", ["cut", "contour and holes"], ["all", "with reference curves"]);
  const kerf = element("input", { type: "text", inputmode: "decimal", class: "number", value: "", id: "export-kerf", placeholder: "as designed" });
  const receiver = select("export-for", ["", "all kinds"], ...purposes.map(([name]) => [name, name]));
  receiver.addEventListener("change", () => {
    const [, kinds, mm] = purposes.find(([name]) => name === receiver.value) ?? ["", formats.map(([name]) => name), 0.001];
    for (const box of boxes) box.checked = kinds.includes(box.value);
    tolerance.value = String(mm);
  });
  const keys = sheets.map(({ key, words, value, choices }) => {
    const list = select(`export-${key.split(".").pop()}`, ...(value === null ? [["", "as needed"]] : []), ...choices.map(({ word }) => [word, word]));
    list.value = value ?? "";
    return { key, words, value: list.value, select: list };
  });
  const answer = await ask("Export", [
    element("p", { class: "option" }, element("label", { for: receiver.id }, "For"), receiver),
    element("fieldset", {}, element("legend", {}, "Files"),
      ...boxes.map((box, i) => element("label", {}, box, ` ${box.value.toUpperCase()} `, element("span", { class: "quiet" }, formats[i][1])))),
    ...(parts.length > 1 ? [element("details", {}, element("summary", {}, "Parts"),
      element("fieldset", { "aria-label": "Parts" },
        ...named.map((box, i) => element("label", {}, box, ` ${box.value} `, element("span", { class: "quiet" }, parts[i][1])))),
      element("p", { class: "option" }, tick("All", true), tick("None", false),
        element("span", { class: "quiet" }, "Models and motion are of the whole machine.")))] : []),
    element("p", { class: "option" }, element("label", { for: "export-tolerance" }, "Tolerance"), tolerance, element("span", {}, "mm")),
    element("p", { class: "option" }, element("label", { for: "export-dxf" }, "DXF"), dxf),
    element("p", { class: "option" }, element("label", { for: layers.id }, "Layers"), layers),
    element("p", { class: "option" }, element("label", { for: kerf.id }, "Width of cut"), kerf, element("span", {}, "mm")),
    ...keys.map(({ words, select }) => element("p", { class: "option" }, element("label", { for: select.id }, words), select)),
  ], [["", "Cancel"], ["export", "Export zip", "main"]]);
  if (answer !== "export") return null;
  const chosen = boxes.filter((box) => box.checked).map((box) => box.value);
  const edits = keys.filter(({ value, select }) => select.value !== value).map(({ key, select }) => ({ key, value: select.value }));
  const some = named.filter((box) => box.checked).map((box) => box.value);
  // All of them are what is written without a choice.
  return { options: { formats: chosen, parts: some.length === named.length ? [] : some, none: named.length > 0 && some.length === 0, tolerance: tolerance.value, dxf: dxf.value, layers: layers.value, kerf: kerf.value.trim() }, edits };
}

/** A line below the bar; `key` names it, so that the next of its kind replaces it. */
export function notice(key, words, buttons = [], severity = "note") {
  withdraw(key);
  const close = () => withdraw(key);
  byId("notices").append(element("div", { class: `notice ${severity}`, "data-key": key },
    element("span", {}, words),
    ...buttons.map(([name, act]) => element("button", { type: "button", onclick: () => {
      close();
      act();
    } }, name)),
    element("button", { type: "button", class: "close", "aria-label": "Close", onclick: close }, "×")));
}

export function withdraw(key) {
  for (const old of byId("notices").children) if (old.dataset.key === key) old.remove();
}
