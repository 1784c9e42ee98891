// Changes of the design on their way to the program, and its answers: picture first, then goals, then checks.

import * as dialogs from "./dialogs.js";
import * as server from "./server.js";
import { state } from "./state.js";
import * as verdict from "./verdict.js";
import { byId } from "./elements.js";
import { progress, work } from "./work.js";

/** Checks slower than this come after the picture, ms. */
export const SLOW = 20;
/** A longer wait is shown, ms. */
const PATIENCE = 300;
/** A picture that takes longer is not waited for while a drag goes on, ms. */
const STALE = 2000;
/** What takes longer is stopped by a change that ends a drag, ms. */
const LATE = 100;
/** Goals that take longer do not follow a drag, ms. */
const LIVE = 250;
/** While checks last, how much of them is done is polled so often, ms. */
const ASKED = 500;

/** The page: its `form`, `file()`, and the receivers of answers: `draw`, `show`, `judge`, `complain`. */
const page = {};
export const connect = (own) => Object.assign(page, own);

/** New values for keys of the design; `final` ends a drag. */
export function edit(edits, final) {
  for (const { key, value } of edits) state.draft.set(key, value);
  request({ final });
}

/** Asks for a text or for the draft; what is not `wanted` any more when the answer comes is not shown. */
export function request(job) {
  // A change that ends a drag stays one, whatever overtakes it.
  const { text, final, fresh } = state.pending ?? {};
  state.pending = { ...job, text: job.text ?? text, final: job.final || Boolean(final), fresh: job.fresh || (job.text === undefined && Boolean(fresh)) };
  byId("verdict").setAttribute("aria-busy", "true");
  if (!state.solving) state.work = solve();
  else if ((job.final && state.late) || state.stale) state.stop.abort();
}

/** Begins a solve that a later change stops, any one after `patience`; returns what ends it. */
function begin(stop, patience) {
  Object.assign(state, { stop, late: false, stale: false });
  const timers = [["late", LATE, () => state.pending.final], ["stale", patience, () => true]].map(([mark, time, due]) => setTimeout(() => {
    state[mark] = true;
    if (state.pending && due()) stop.abort();
  }, time));
  return () => timers.forEach(clearTimeout);
}

async function solve() {
  state.solving = true;
  // A change whose solve was stopped: it is made all the same, unsolved.
  let unsolved = null;
  while (unsolved || state.pending) {
    const job = unsolved ?? state.pending;
    if (unsolved) unsolved = null;
    else state.pending = null;
    const sent = job.sent ?? new Map(state.draft);
    const asked = page.form.clock;
    const text = job.text ?? state.history.text;
    const edits = [...sent].map(([key, value]) => ({ key, value }));
    const slow = state.took > SLOW;
    let unchecked = null;
    const stop = new AbortController();
    const end = begin(stop, STALE);
    const waiting = setTimeout(() => document.body.classList.add("busy"), PATIENCE);
    try {
      const start = performance.now();
      const depth = job.sent ? "numbers" : slow ? "picture" : "checks";
      const wanted = () => !job.wanted || job.wanted();
      // The browser's own time for the picture is not that of the checks.
      let painting = 0;
      const first = async (picture) => {
        if (!wanted()) return;
        const drawn = performance.now();
        await page.draw({ ...picture, goals: job.goals });
        painting = performance.now() - drawn;
      };
      const snapshot = await work((signal) => server.solve({ text, edits, depth }, signal, first), job.sent ? undefined : stop);
      if (!wanted()) continue;
      if (job.final) settle(snapshot.text, sent, edits.length > 0 || job.fresh);
      if (job.sent && state.pending) continue;
      snapshot.goals = job.goals;
      page.show(snapshot, asked);
      dialogs.withdraw("server");
      if (!slow) state.took = performance.now() - start - painting;
      else if (!snapshot.error) unchecked = snapshot;
    } catch (error) {
      if (stop.signal.aborted && !job.sent) {
        if (job.final || !state.pending) unsolved = { ...job, sent };
        state.took = Infinity;
        continue;
      }
      // What was typed is due when the program answers again.
      const away = error instanceof server.Away;
      if (job.final && !away) forgetDraft(sent);
      if (away && job.fresh) state.history.push(text);
      page.complain("server", error);
    } finally {
      clearTimeout(waiting);
      end();
      document.body.classList.remove("busy");
    }
    if (unchecked && await tell(unchecked) && !state.pending) check(unchecked);
  }
  state.solving = false;
  // What is shown is this answer's once its panels are.
  await state.shown;
  if (!state.solving) byId("verdict").setAttribute("aria-busy", "false");
}

/**
 * Tells the goals of the picture that is shown, before its details and checks: a drag waits for them while they are quick.
 * Resolves to whether the checks are to follow.
 */
async function tell({ text, goals_first: first, goals }) {
  if (goals || !first) return true;
  if (state.pending && state.told > LIVE) {
    // Tried again some pictures later.
    state.told *= 0.8;
    return true;
  }
  const stop = new AbortController();
  const end = begin(stop, LIVE);
  const start = performance.now();
  try {
    const answer = await work((signal) => server.solve({ text, edits: [], depth: "goals" }, signal), stop);
    if (answer.goals && state.snapshot.text === text) {
      Object.assign(state.snapshot, answer);
      if (!state.shown) page.judge();
    }
  } catch (error) {
    if (!stop.signal.aborted) page.complain("server", error);
    else if (!state.pending) rest();
    return false;
  } finally {
    end();
    state.told = performance.now() - start;
  }
  return true;
}

/** Waits until every change given so far is in the text. */
export async function settled() {
  while (state.solving) await state.work;
}

/** Has the design that is shown drawn in full and checked, while changes to it go on being drawn. */
async function check({ text, coarse }) {
  const stop = new AbortController();
  state.checking = stop;
  const wanted = () => state.checking === stop && !state.solving && state.snapshot.text === text;
  // The screen first: the checks take the computer's time.
  await state.shown;
  const followed = setInterval(() => follow(stop), ASKED);
  try {
    for (const depth of coarse ? ["detail", "checks"] : ["checks"]) {
      if (!wanted()) return;
      const start = performance.now();
      const asked = page.form.clock;
      const snapshot = await work((signal) => server.solve({ text, edits: [], depth }, signal), stop);
      if (snapshot.overtaken || !wanted()) return;
      if (depth === "checks") state.took = performance.now() - start;
      page.show(snapshot, asked);
    }
  } catch (error) {
    if (!stop.signal.aborted) page.complain("server", error);
    else if (wanted()) rest();
  } finally {
    clearInterval(followed);
    progress("");
  }
}

/** Says how much of the checks is done. */
async function follow(stop) {
  try {
    const share = await server.progress();
    if (share > 0 && share < 1 && state.checking === stop) progress(`${Math.floor(100 * share)} % done`);
  } catch {
    // Those who wait for the checks get the reason why there are none.
  }
}

/** The checks were cancelled: they are done when requested. */
function rest() {
  verdict.unchecked(() => {
    verdict.clear();
    check(state.snapshot);
  });
}

/** A change has arrived in the text; a step back or forth is in the history already, and is no new one. */
function settle(text, sent, fresh) {
  const changed = text !== state.history.text;
  if (fresh) state.history.push(text);
  forgetDraft(sent);
  if (changed) page.file().keep();
}

function forgetDraft(sent) {
  for (const [key, value] of sent) if (state.draft.get(key) === value) state.draft.delete(key);
}
