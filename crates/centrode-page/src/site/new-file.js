// A new design file: requested, made, and opened; and the files opened of late.

import * as dialogs from "./dialogs.js";
import { element } from "./elements.js";
import * as server from "./server.js";

/** Cookie of the files opened of late. */
const RECENT = "centrode-recent=";

/** A name that no file of the folder has. */
export function free(name, taken) {
  for (let count = 1; ; count += 1) {
    const file = `${name}${count > 1 ? `-${count}` : ""}.toml`;
    if (!taken.includes(file)) return file;
  }
}

/** Asks where a new design file is to be, makes it, and leads to its page; `told` stands above the name. */
export async function make(from, title, file, folder, told = []) {
  const path = element("input", { type: "text", id: "new-path", spellcheck: "false", autocomplete: "off", value: file, "aria-describedby": "new-remark" });
  const remark = element("p", { class: "remark", id: "new-remark", role: "alert" });
  let page = null;
  const sound = async () => {
    try {
      const answer = await server.make(from, path.value.trim());
      page = answer.page;
      if (page) return true;
      remark.replaceChildren(element("span", { class: "error" }, answer.refused));
    } catch (error) {
      remark.replaceChildren(element("span", { class: "error" }, error.message));
    }
    path.select();
    return false;
  };
  const answer = ask();
  // The name without its ending is what is likely to be changed.
  path.focus();
  path.setSelectionRange(0, path.value.length - ".toml".length);
  await answer;
  if (page) {
    remember(path.value.trim(), folder);
    location.assign(page);
  }

  function ask() {
    return dialogs.ask("New design file", [
      element("p", {}, title),
      ...told,
      element("p", { class: "option" }, element("label", { for: "new-path" }, "File"), path),
      element("p", { class: "quiet" }, `In ${folder}, or any path.`),
      remark,
    ], [["", "Cancel"], ["make", "Make and open", "main"]], sound);
  }
}

/** Paths opened from here of late, the last first: a cookie has them, since the program stands at another address each time. */
export const recent = () => {
  const found = document.cookie.split("; ").find((own) => own.startsWith(RECENT));
  try {
    return found ? JSON.parse(decodeURIComponent(found.slice(RECENT.length))) : [];
  } catch {
    return [];
  }
};

/** Remembers a path, from the root of the disk. */
export function remember(path, folder) {
  const whole = /^(\/|[A-Za-z]:[\\/])/.test(path) ? path : `${folder}/${path}`;
  let list = [whole, ...recent().filter((own) => own !== whole)].slice(0, 8);
  // A cookie has 4096 bytes at most.
  while (encodeURIComponent(JSON.stringify(list)).length > 3500) list = list.slice(0, -1);
  document.cookie = `${RECENT}${encodeURIComponent(JSON.stringify(list))}; max-age=31536000; path=/; SameSite=Strict`;
}
