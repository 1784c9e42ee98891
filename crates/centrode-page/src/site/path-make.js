// From the page of a path to a design: teeth are searched, a file is requested, and its page is opened.

import * as dialogs from "./dialogs.js";
import { element } from "./elements.js";
import * as files from "./new-file.js";
import { worked } from "./numbers.js";
import { asked, sizeOf } from "./path-form.js";
import * as told from "./path-told.js";
import * as server from "./server.js";
import { progress, work } from "./work.js";

/** Band that is offered, as a share of the path's size. */
const BAND = 0.03;

/** A handsome number near a size. */
const round = (size) => Number(size.toPrecision(1));

/** Says how far a search is. */
export const heed = (evaluations) => progress(`${evaluations.toLocaleString("en")} evaluations`);

/** Makes the machine of a wish; where no teeth will do, says so and offers to ease the path. */
export async function make(wish, complain) {
  const isEased = wish.given === "path" && !wish.each;
  let band = wish.band;
  const stop = new AbortController();
  try {
    for (;;) {
      const answer = await work((signal) => server.makePath(asked(wish, { band }), signal, heed), stop);
      if (!answer.refused) {
        await name(answer);
        return;
      }
      band = isEased ? await remedy(wish, answer, band) : await refuse(answer);
      if (!band) return;
    }
  } catch (error) {
    if (!stop.signal.aborted) complain(error);
  }
}

/** Asks where the design is to be. */
async function name({ text, stated: rows, goals, findings }) {
  const { taken, folder } = await server.offer();
  const row = ([head, words]) => element("tr", {}, element("th", { scope: "row" }, head), element("td", {}, words));
  const table = element("table", { class: "told" }, element("tbody", {}, ...rows.map(row)));
  await files.make({ text }, "The machine of the path, with sound teeth.", files.free("reversed", taken), folder, [...told.wishes(goals, "Wishes", "h3"), ...told.findings(findings), table]);
}

/** Shows why the search gives no machine. */
async function refuse({ refused, goals }) {
  await dialogs.ask("No machine", [element("p", {}, refused), ...told.wishes(goals, "Wishes", "h3"), element("p", {}, "Try a larger bend, another split, or other positions.")], [["close", "Close", "main"]]);
}

/** Says why there is no machine; resolves to a band within which the path is to be eased, or to null. */
async function remedy(wish, { refused, goals }, before) {
  const box = element("input", { type: "text", inputmode: "decimal", class: "number", id: "band", value: String(2 * before || round(BAND * sizeOf(wish.path))), "aria-describedby": "band-remark" });
  const remark = element("p", { class: "remark", id: "band-remark", role: "alert" });
  const sound = async () => {
    const band = worked(box.value, "mm");
    if (typeof band === "number" && band > 0) return true;
    remark.replaceChildren(element("span", { class: "error" }, "the band is a number above zero, in mm"));
    box.focus();
    return false;
  };
  const answer = await dialogs.ask("No machine", [
    element("p", {}, refused),
    ...told.wishes(goals, "Wishes", "h3"),
    element("p", {}, "What helps:"),
    element("ul", { class: "remedies" },
      element("li", {}, "another axis: where the field is bright, coloured by the minimum radius,"),
      element("li", {}, "a greater bend, or another split,"),
      element("li", {}, "a path without sharp points: let it pass next to its points, and ease it.")),
    element("p", { class: "option" }, element("label", { for: "band" }, "Pass within"), box, element("span", { class: "unit" }, "mm")),
    remark,
  ], [["", "Cancel"], ["ease", "Ease the path and make", "main"]], sound);
  return answer === "ease" ? worked(box.value, "mm") : null;
}
