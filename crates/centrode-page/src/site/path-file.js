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

/** Gives the browser a file to keep. */
function keep(name, text, type) {
  const address = URL.createObjectURL(new Blob([text], { type }));
  element("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}

/**
 * Listens to the buttons of files: `take(found)` gets what a file holds, `table()` are heads and rows of what is shown, `asked()` is the
 * wish as the program is asked, `given()` says what is given, `tell(words, severity)` takes a message.
 */
export function listen({ given, take, table, asked, tell }) {
  const input = byId("path-file");
  byId("open-path").addEventListener("click", () => input.click());
  input.addEventListener("change", async () => {
    const [file] = input.files;
    if (!file) return;
    try {
      if (file.size > LARGEST) throw new Error(`the file has ${file.size} bytes; the limit is ${LARGEST}`);
      const text = await file.text();
      const found = given() === "poses" && !/^\s*family\s*=/m.test(text) ? poses(text) : await server.readPath(text);
      if (found.refused) throw new Error(found.refused);
      take(found);
      tell(`${file.name}: ${found.note}.`, "note");
    } catch (error) {
      tell(`${file.name}: ${error.message}`, "error");
    } finally {
      // The same file may be opened again.
      input.value = "";
    }
  });
  byId("save-points").addEventListener("click", () => {
    keep(`${given()}.csv`, `${table().map((row) => row.join(",")).join("\n")}\n`, "text/csv");
  });
  byId("save-path").addEventListener("click", async () => {
    try {
      const text = await server.pathDesign(asked());
      if (text.refused) throw new Error(text.refused);
      keep("path.toml", text, "application/toml");
    } catch (error) {
      tell(error.message, "error");
    }
  });
}
