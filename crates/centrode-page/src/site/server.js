// Requests of the page to the program behind it.

/** An answer that is none: the reason, in the program's words. */
export class Refused extends Error {
  constructor(status, body) {
    super(body.message ?? `the program answers with status ${status}`);
    this.status = status;
    this.body = body;
  }
}

/** No answer at all. */
export class Away extends Error {
  constructor() {
    super("the program does not answer: is centrode studio still running?");
  }
}

/** This page among those that are open. */
const page = String(Math.random());

/** Number of solves requested: a delayed one must not replace a later one. */
let turn = 0;

/** The program stops what it does for an answer once `signal` aborts. */
async function ask(path, method, body, signal, keepalive = false) {
  let answer;
  try {
    answer = await fetch(path, {
      method,
      headers: body === undefined ? {} : { "Content-Type": "application/json" },
      body: body === undefined ? undefined : JSON.stringify(body),
      signal,
      keepalive,
    });
  } catch {
    throw new Away();
  }
  if (!answer.ok) {
    const text = await answer.text();
    let parsed;
    try {
      parsed = JSON.parse(text);
    } catch {
      parsed = { message: text || undefined };
    }
    throw new Refused(answer.status, parsed);
  }
  return answer;
}

/** The text of an answer as it comes. */
async function* parts(answer) {
  const reader = (await answer).body.pipeThrough(new TextDecoderStream()).getReader();
  for (;;) {
    let part;
    try {
      part = await reader.read();
    } catch {
      throw new Away();
    }
    if (part.done) return;
    yield part.value;
  }
}

/** An answer that takes long: `heed(evaluations)` hears how far it is. */
async function streamed(path, body, signal, heed) {
  let text = "";
  for await (const part of parts(ask(path, "POST", body, signal))) {
    const lines = (text + part).split("\n");
    text = lines.pop();
    for (const line of lines) {
      const { evaluations, answer } = JSON.parse(line);
      if (answer) return answer;
      heed(evaluations);
    }
  }
  throw new Away();
}

/** An answer that is one value in two lines: `heed(first)` hears what the first line holds; the second is read once that is done. */
async function halved(path, body, signal, heed) {
  let [text, first] = ["", null];
  for await (const part of parts(ask(path, "POST", body, signal))) {
    text += part;
    const end = first ? -1 : text.indexOf("\n");
    if (end < 0) continue;
    first = JSON.parse(`${text.slice(0, end)}}`);
    text = text.slice(end + 1);
    await heed?.(first);
  }
  if (!first) return JSON.parse(text);
  // What breaks off has no end.
  const { message = text ? null : "solving this design has failed", ...second } = text ? JSON.parse(`{${text.slice(1)}`) : {};
  if (message) throw new Refused(500, { message });
  return Object.assign(first, second);
}

const json = async (answer) => (await answer).json();

export const offer = () => json(ask("start", "GET"));
export const picture = (kind, name) => json(ask(`pictures/${kind}/${encodeURIComponent(name)}`, "GET"));
export const open = (path) => json(ask("open", "POST", { path }));
export const make = (from, path) => json(ask("new", "POST", { from, path }));
export const solvePath = (wish, signal) => json(ask("path/solve", "POST", wish, signal));
export const findMachine = (wish, signal, heed) => streamed("path/find", wish, signal, heed);
export const mapAxes = (wish, signal) => json(ask("path/map", "POST", wish, signal));
export const bestAxis = (wish, signal) => json(ask("path/axis", "POST", wish, signal));
export const readPath = (text) => json(ask("path/open", "POST", { text }));
export const makePath = (wish, signal, heed) => streamed("path/machine", wish, signal, heed);
export const pathDesign = (wish) => json(ask("path/design", "POST", wish));
export const design = () => json(ask("design", "GET"));
export const save = (text, base, over) => json(ask("save", "POST", { text, base, over }));
// It arrives although the page is left; browsers send no more than 64 KiB that way.
export const keep = (text) => json(ask("keep", "POST", { text }, undefined, text.length < 20_000));
export const forget = (file) => json(ask("keep", "DELETE", { file }));
export const reread = () => json(ask("reread", "POST", {}));
export const choices = (text) => json(ask("choices", "POST", { text }));
export const fault = (text) => json(ask("fault", "POST", { text }));
export const compose = (text, input, gesture) => json(ask("compose", "POST", { text, input, gesture }));
export const addTable = (text, key) => json(ask("table", "POST", { text, key }));
export const search = (options, signal) => json(ask("search", "POST", options, signal));
export const searched = () => json(ask("search", "GET"));
export const forgetSearch = () => json(ask("search/all", "DELETE"));
export const stopSearch = () => json(ask("search", "DELETE"));
export const response = (options, signal) => json(ask("response", "POST", options, signal));
export const files = async (options, signal) => (await ask("export", "POST", options, signal)).blob();
export const meshes = async (text, signal) => (await ask("meshes", "POST", { text }, signal)).arrayBuffer();
/** Solves a design; `heed(first)` hears of its picture before the rest is read. */
export const solve = async (request, signal, heed) => whole(await halved("solve", { page, turn: (turn += 1), ...request }, signal, heed));

/** What share of the checks that are under way is done; null while nothing is solved. */
export const progress = async () => (await json(ask(`progress/${page}`, "GET"))).share;

/** A snapshot with the inputs of every curve: where a curve has none, they are those of the one before. */
export function whole(snapshot) {
  let before;
  for (const curve of snapshot.curves ?? []) before = curve.input ??= before;
  return snapshot;
}

/** Calls `disk` with the file's text, or with what is missing, whenever that changes; `lost` and `found` as the program goes and comes. */
export function watch({ disk, lost, found }) {
  const events = new EventSource("events");
  events.addEventListener("disk", (event) => disk(JSON.parse(event.data)));
  events.addEventListener("error", lost);
  events.addEventListener("open", found);
  return events;
}
