// Files of a path: points of a CSV file or of a drawing, and the points as CSV.

import { byId, element } from "./elements.js";
import { rowsIn } from "./points.js";
import * as server from "./server.js";

/** Largest file that is opened, bytes. */
const LARGEST = 1 << 20;

/** Key poses of a text. */
function poses(text) {
  const { rows, error } = rowsIn(text);
  const wrong = error ?? rows.filter((row) => row.length !== 3).map(({ line }) => `line ${line}: a pose has three numbers`)[0];
  return wrong ? { refused: wrong } : { points: rows, note: `${rows.length} poses` };
}

/** Listens to both buttons: `take(rows)` gets those of a file, `rows()` are those shown, `given()` says what they are, `tell(words, severity)` takes a message. */
export function listen({ given, take, rows, tell }) {
  const input = byId("path-file");
  byId("open-path").addEventListener("click", () => input.click());
  input.addEventListener("change", async () => {
    const [file] = input.files;
    if (!file) return;
    try {
      if (file.size > LARGEST) throw new Error(`the file has ${file.size} bytes; the limit is ${LARGEST}`);
      const text = await file.text();
      const found = given() === "poses" ? poses(text) : await server.readPath(text);
      if (found.refused) throw new Error(found.refused);
      take(found.points);
      tell(`${file.name}: ${found.note}.`, "note");
    } catch (error) {
      tell(`${file.name}: ${error.message}`, "error");
    } finally {
      // The same file may be opened again.
      input.value = "";
    }
  });
  byId("save-path").addEventListener("click", () => {
    const list = rows();
    const head = ["x", "y", "direction_deg"].slice(0, list[0].length);
    const text = [head, ...list].map((row) => row.join(",")).join("\n");
    const address = URL.createObjectURL(new Blob([`${text}\n`], { type: "text/csv" }));
    element("a", { href: address, download: `${given()}.csv` }).click();
    setTimeout(() => URL.revokeObjectURL(address), 1000);
  });
}
