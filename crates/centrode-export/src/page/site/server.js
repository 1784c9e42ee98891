// What the page asks of the program behind it.

/** An answer that is none: the reason, in the program's words. */
export class Refused extends Error {
  constructor(status, body) {
    super(body.message ?? `the program answers with status ${status}`);
    this.status = status;
    this.body = body;
  }
}

async function ask(path, method, body, signal) {
  const answer = await fetch(path, {
    method,
    signal,
    headers: body === undefined ? {} : { "Content-Type": "application/json" },
    body: body === undefined ? undefined : JSON.stringify(body),
  });
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

const json = async (answer) => (await answer).json();

export const design = () => json(ask("design", "GET"));
export const save = (text, over) => json(ask("save", "POST", { text, over }));
export const keep = (text) => json(ask("keep", "POST", { text }));
export const forget = () => json(ask("keep", "DELETE"));
export const reread = () => json(ask("reread", "POST", {}));
export const search = (options) => json(ask("search", "POST", options));
export const searched = () => json(ask("search", "GET"));
export const stopSearch = () => json(ask("search", "DELETE"));
export const response = (options) => json(ask("response", "POST", options));
export const files = async (options) => (await ask("export", "POST", options)).blob();
export const solve = (request, signal) => json(ask("solve", "POST", request, signal));

/** Calls back with the file's text whenever it is not what is known, and with null when it is again. */
export function watch(changed) {
  const events = new EventSource("events");
  events.addEventListener("disk", (event) => changed(JSON.parse(event.data).text));
  return events;
}
