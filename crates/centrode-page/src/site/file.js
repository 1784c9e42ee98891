// The design file on disk: autosaved, saved, loaded, exported from, and compared with what others make of it.

import * as dialogs from "./dialogs.js";
import * as link from "./link.js";
import { element, words } from "./elements.js";
import * as server from "./server.js";
import { work } from "./work.js";

/** Work is put next to the file so long after a change, ms. */
const REST = 200;

export class DesignFile {
  /**
   * `page.settled()` waits for the changes on their way, `page.replace(text)` takes another text, `page.saved()` is called
   * a new state of the file, `page.complain(key, error)` of what goes wrong.
   */
  constructor(name, formats, purposes, history, page) {
    this.name = name;
    this.formats = formats;
    this.purposes = purposes;
    this.history = history;
    this.page = page;
    this.keeping = 0;
    addEventListener("pagehide", () => {
      if (this.keeping) this.put();
    });
  }

  /** Puts what is not saved next to the file, soon. */
  keep() {
    this.keeping ||= setTimeout(() => this.put(), REST);
  }

  /** Puts what is not saved next to the file, now. */
  put() {
    this.rest();
    server.keep(this.history.text).then(() => dialogs.withdraw("keep")).catch((error) => this.page.complain("keep", error));
  }

  /** Nothing is left to be put next to the file. */
  rest() {
    clearTimeout(this.keeping);
    this.keeping = 0;
  }

  async save(over = false) {
    await this.page.settled();
    const text = this.history.text;
    try {
      const answer = await server.save(text, this.history.saved, over);
      if (!answer.saved) {
        await this.settle(answer);
        return;
      }
      this.rest();
      this.history.saved = text;
      if (this.history.dirty) this.keep();
      dialogs.withdraw("disk");
      dialogs.withdraw("save");
      this.page.saved();
    } catch (error) {
      this.page.complain("save", error);
    }
  }

  /** The file has been changed by others: whose work stays? */
  async settle({ message, gone }) {
    const words = element("p", {}, `${message}. Saving would ${gone ? "create it again" : "overwrite the file on disk"}.`);
    const answer = await dialogs.ask(gone ? "File missing" : "Changed on disk", [words],
      [["", "Cancel"], ...(gone ? [] : [["load", "Load the file"]]), ["over", gone ? "Save" : "Overwrite", gone ? "main" : "danger"]]);
    if (answer === "over") await this.save(true);
    if (answer === "load") await this.load();
  }

  /** Takes what is on disk now. */
  async load() {
    try {
      const { text } = await server.reread();
      this.history.saved = text;
      this.page.replace(text);
      dialogs.withdraw("disk");
    } catch (error) {
      this.page.complain("disk", error);
    }
  }

  /** Says what has become of the file, if it is not what this page knows. */
  compare({ text, missing }) {
    if (text === this.history.saved) {
      dialogs.withdraw("disk");
      return;
    }
    if (missing) dialogs.notice("disk", `${this.name} ${missing}.`, [], "warning");
    else dialogs.notice("disk", `${this.name} has been changed on disk.`, [["Load the file", () => this.load()]], "warning");
    // Another window that saved has taken the autosave away.
    if (this.history.dirty) this.keep();
  }

  /** Offers a design that has come with the address; it is not taken by itself. */
  async offer(text) {
    const { fault } = await server.fault(text);
    if (fault) throw new Error(`The link holds no design: ${fault.message}`);
    if (text === this.history.text) {
      dialogs.notice("link", "The design of the link is the one that is shown.");
      return;
    }
    dialogs.notice("link", `The link holds ${link.named(text)}. If you open it, it replaces the design that is shown. Undo brings that back, and ${this.name} does not change until you save.`,
      [["Open it", () => this.page.replace(text)]], "warning");
  }

  /** Copies a link that holds the design. */
  async copy() {
    await this.page.settled();
    await link.copy(this.history.text).catch((error) => this.page.complain("link", error));
  }

  /** Exports the files of the design, as a zip with a name; sheets may differ from what the design says of them. */
  async download(name, tables) {
    await this.page.settled();
    const drawing = tables.find(({ key }) => key === "drawing")?.fields ?? [];
    const sheets = drawing.filter(({ choices }) => choices?.length).map(({ key, value, choices }) => ({ key, value, choices, words: words(key) }));
    let parts = [];
    try {
      ({ parts } = await server.choices(this.history.text));
    } catch (error) {
      this.page.complain("export", error);
      return;
    }
    const asked = await dialogs.files(this.formats, this.purposes, parts, sheets);
    if (!asked) return;
    const { options: { none, ...options }, edits } = asked;
    if (options.formats.length === 0 || none) {
      dialogs.notice("export", `nothing to export: no ${none ? "part" : "kind of file"} is chosen`, [], "warning");
      return;
    }
    dialogs.withdraw("export");
    const stop = new AbortController();
    try {
      const blob = await work(async (signal) => {
        const text = edits.length ? (await server.solve({ text: this.history.text, edits, depth: "numbers" }, signal)).text : this.history.text;
        return server.files({ text, ...options }, signal);
      }, stop);
      const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(blob), download: `${name || "design"}.zip` });
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 60000);
    } catch (error) {
      if (!stop.signal.aborted) this.page.complain("export", error);
    }
  }
}
