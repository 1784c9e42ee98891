// A design in the fragment of an address: it moves with the link, and no request ever holds it.

import { handOver } from "./chart-files.js";
import * as dialogs from "./dialogs.js";
import { element } from "./elements.js";

const MARK = "#design=1.";
/** Longest fragment, characters: chats and older browsers cut what is longer. */
const LONGEST = 30_000;
/** Largest design file, bytes. */
const LARGEST = 1 << 20;

/** Whether an address has a design in its fragment, of this or of a later kind. */
export const holds = (address) => address.includes("#design=");

/** The fragment of a design's text. */
export async function written(text) {
  const packed = new Blob([text]).stream().pipeThrough(new CompressionStream("deflate"));
  const bytes = new Uint8Array(await new Response(packed).arrayBuffer());
  const letters = btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""));
  const fragment = MARK + letters.replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
  if (fragment.length > LONGEST) {
    throw new Error(`The design is too long for a link: ${fragment.length} characters, where ${LONGEST} is the most. Send its file.`);
  }
  return fragment;
}

/** The text of a design in an address; an error says why there is none. */
export async function read(address) {
  const fragment = address.slice(address.indexOf("#")).trim();
  if (!fragment.startsWith(MARK)) throw new Error("The link is of another kind: this version of centrode cannot read it.");
  if (fragment.length > LONGEST) throw new Error(`The link is too long: ${fragment.length} characters, where ${LONGEST} is the most.`);
  const letters = fragment.slice(MARK.length);
  if (!/^[\w-]+$/.test(letters)) throw new Error("The link is damaged: it has characters that no link has.");
  const parts = [];
  let size = 0;
  try {
    const bytes = Uint8Array.from(atob(letters.replaceAll("-", "+").replaceAll("_", "/")), (letter) => letter.charCodeAt(0));
    const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate")).getReader();
    for (;;) {
      const { done, value } = await reader.read();
      if (done) break;
      parts.push(value);
      size += value.length;
      // A short link can unfold to anything.
      if (size > LARGEST) {
        await reader.cancel();
        break;
      }
    }
  } catch {
    throw new Error("The link is damaged or was cut off.");
  }
  if (size > LARGEST) throw new Error(`The design in the link has more than ${LARGEST} bytes, the most of a design file.`);
  try {
    return new TextDecoder("utf-8", { fatal: true }).decode(await new Blob(parts).arrayBuffer());
  } catch {
    throw new Error("The link holds no text.");
  }
}

/** Name of the design in a text, as a person reads it. */
export const named = (text) => /^title *= *"([^"\n]+)"/m.exec(text)?.[1] ?? /^name *= *"([^"\n]+)"/m.exec(text)?.[1] ?? "a design without a name";

/** Takes designs that come with the address, now and when it is changed: `offer(text)` gets each, `complain(error)` what is none. */
export function listen(offer, complain) {
  const look = async () => {
    const address = location.hash;
    if (!holds(address)) return;
    // Once: a page loaded anew does not offer it again.
    history.replaceState(null, "", location.pathname);
    try {
      await offer(await read(address));
    } catch (error) {
      complain(error);
    }
  };
  addEventListener("hashchange", look);
  return look();
}

/** Copies the fragment of a design; where the browser does not let a page copy, it is shown. */
export async function copy(text) {
  const fragment = await written(text);
  const words = `${fragment.length} characters that hold the whole design. Put behind the address of any page of centrode studio, or of a report, they offer it there.`;
  try {
    await navigator.clipboard.writeText(fragment);
    dialogs.notice("link", `Copied: ${words}`);
  } catch {
    const area = element("textarea", { "aria-label": "Link", readonly: true, rows: 6, cols: 60 });
    area.value = fragment;
    const answer = dialogs.ask("Link", [element("p", {}, words), area], [["", "Close"]]);
    area.select();
    area.scrollTop = 0;
    await answer;
  }
}

/** Offers a design that has come with the address of a report, which shows its own and solves no other. */
export function offer(text, own) {
  if (!/^family *=/m.test(text)) throw new Error("The link holds no design: its text has no family.");
  if (text === own) {
    dialogs.notice("link", "The design of the link is the one that is shown.");
    return;
  }
  const name = /^name *= *"([\w.-]+)"/m.exec(text)?.[1] ?? "design";
  dialogs.notice("link", `The link holds ${named(text)}. A report shows the one design that it was made of: save the file of the link, and open it by centrode studio ${name}.toml.`,
    [["Save the file", () => handOver(new Blob([text], { type: "application/toml" }), name, "toml")], ["Show its text", () => show(text, name)]], "warning");
}

/** The text of a design, to be read and copied. */
function show(text, name) {
  const area = element("textarea", { "aria-label": "Design file", readonly: true, spellcheck: "false", wrap: "off", rows: 28, cols: 92 });
  area.value = text;
  area.setSelectionRange(0, 0);
  return dialogs.ask(`${name}.toml`, [area], [["", "Close"]]);
}
