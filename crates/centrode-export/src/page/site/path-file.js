// Files of a path: points of a CSV file or of a drawing, and the points as CSV.

import { byId, element } from "./elements.js";
import * as server from "./server.js";

/** Largest file that is opened, bytes. */
const LARGEST = 1 << 20;

/** Listens to both buttons: `take(points)` gets those of a file, `points()` are those shown, `tell(words, severity)` takes a message. */
export function listen({ take, points, tell }) {
  const input = byId("path-file");
  byId("open-path").addEventListener("click", () => input.click());
  input.addEventListener("change", async () => {
    const [file] = input.files;
    if (!file) return;
    try {
      if (file.size > LARGEST) throw new Error(`the file has ${file.size} bytes; the limit is ${LARGEST}`);
      const found = await server.readPath(await file.text());
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
    const text = ["x,y", ...points().map((point) => point.join(","))].join("\n");
    const address = URL.createObjectURL(new Blob([`${text}\n`], { type: "text/csv" }));
    element("a", { href: address, download: "path.csv" }).click();
    setTimeout(() => URL.revokeObjectURL(address), 1000);
  });
}
