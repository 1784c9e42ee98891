// The page: one design, what it looks like, how it moves, what the checks say.

import { Charts } from "./charts.js";
import * as dialogs from "./dialogs.js";
import { byId } from "./elements.js";
import { DesignFile } from "./file.js";
import { Form } from "./form.js";
import { Handles } from "./handles.js";
import * as help from "./help.js";
import { History } from "./history.js";
import * as layout from "./layout.js";
import * as link from "./link.js";
import * as response from "./response.js";
import { Search } from "./search.js";
import * as server from "./server.js";
import * as source from "./source.js";
import { Space } from "./space.js";
import { Stage } from "./stage.js";
import * as theme from "./theme.js";
import { Transport } from "./transport.js";
import * as verdict from "./verdict.js";
import { CANCELLED, work } from "./work.js";

/** Checks slower than this come after the picture, ms. */
const SLOW = 40;
/** Whoever waits longer is told so, ms. */
const PATIENCE = 300;
/** A picture that takes longer is not waited for while a drag goes on, ms. */
const STALE = 2000;
/** What takes longer is stopped by a change that ends a drag, ms. */
const LATE = 100;
/** Goals that take longer do not follow a drag, ms. */
const LIVE = 250;

const embedded = byId("snapshot");
const state = {
  snapshot: null,
  pinned: null,
  /** The last snapshot with checks that is no search's. */
  checked: null,
  history: null,
  /** Values given but not answered for yet, by key. */
  draft: new Map(),
  pending: null,
  solving: false,
  /** Aborts the solve under way, and whether it is out of date for changes since: for those that end a drag, and for every one. */
  stop: null,
  late: false,
  stale: false,
  /** What aborts the last checks. */
  checking: null,
  /** Resolves when nothing is left to solve. */
  work: null,
  /** Whether the program has not answered of late. */
  away: false,
  /** Resolves when the panels show the snapshot, while they do not yet. */
  shown: null,
  /** How long the last checks took, ms: unknown ones come after the picture. */
  took: Infinity,
  /** How long the last goals took, ms. */
  told: 0,
};

const stage = new Stage((poses) => {
  handles?.place(poses);
  space?.follow();
});
const transport = new Transport(stage);
const charts = new Charts((input) => transport.go(input), () => state.snapshot.name, () => state.snapshot.speed ?? transport.speed);
transport.charts = charts;
const form = new Form({ edit, hold: (on) => stage.remember(on), respond: (key) => respond(key), fixed: Boolean(embedded) });
const handles = embedded ? null : new Handles(stage, { edit, began: () => transport.play(false), points: (table) => form.points.get(table) });

const space = embedded ? null : new Space(stage, () => ({ text: state.snapshot?.text, sound: Boolean(state.snapshot?.picture && !state.snapshot.error) }));

let file = null;
let search = null;

// What is shown

/** Shows what the program answers; `asked` is the form's clock when it was asked. */
function show(snapshot, asked = snapshot.asked) {
  const before = state.snapshot;
  snapshot.asked = asked;
  if (before?.text === snapshot.text) snapshot.goals ??= before.goals;
  if (snapshot.verdict && !snapshot.error && !search?.showing) state.checked = snapshot;
  if (!snapshot.picture && before?.picture) {
    // No mechanism: the last one stays in sight, faded.
    snapshot = { ...before, asked, text: snapshot.text, tables: snapshot.tables, error: snapshot.error, goals: undefined };
  } else if (!snapshot.verdict && before) {
    snapshot = { ...snapshot, curves: merged(snapshot.curves, before.curves), stale: true };
  }
  state.snapshot = snapshot;
  // Pinned before its checks were done.
  if (state.pinned && !state.pinned.verdict && snapshot.verdict && snapshot.text === state.pinned.text) state.pinned = snapshot;
  stage.stale = Boolean(snapshot.error);
  stage.show(snapshot.picture);
  handles?.show(snapshot.picture?.handles ?? []);
  transport.draw();
  verdict.mark(snapshot);
  // Panels cost the browser more than the picture does: the eye has that first.
  if (embedded) panels();
  else state.shown ??= painted().then(panels);
}

/** Resolves when the next frame is on the screen; at once where there are no frames, in a hidden window. */
function painted() {
  if (document.hidden) return Promise.resolve();
  return new Promise((resolve) => {
    requestAnimationFrame(() => setTimeout(resolve));
    // A window hidden in between has no frame to come.
    setTimeout(resolve, 100);
  });
}

/** Everything of the snapshot but its picture. */
function panels() {
  state.shown = null;
  const { snapshot } = state;
  byId("heading").textContent = snapshot.title || snapshot.name || file?.name || "";
  byId("definition").textContent = snapshot.definition;
  form.show(snapshot, snapshot.asked);
  charts.show(snapshot.curves, state.pinned?.curves);
  charts.place.classList.toggle("stale", Boolean(snapshot.error));
  judge();
  transport.show(snapshot.curves);
  buttons();
}

/** Goals, findings and figures. */
function judge() {
  verdict.show(state.snapshot, state.pinned, (input) => transport.go(input));
  const { error, verdict: found, limits = found?.limits } = state.snapshot;
  if (limits && !error) charts.limit(limits);
}

/** The new curves, and of the old those that the checks have yet to draw anew. */
function merged(curves, old) {
  const names = new Set(curves.map((curve) => curve.chart));
  return [...curves, ...old.filter((curve) => !names.has(curve.chart))];
}

function buttons() {
  const history = state.history;
  if (!history) return;
  // While a search shows its best, the design itself stays as it is.
  const held = search?.showing;
  byId("undo").disabled = held || !history.canUndo;
  byId("redo").disabled = held || !history.canRedo;
  byId("reset").disabled = held || !history.dirty;
  byId("source").disabled = held;
  byId("save").disabled = held || !history.dirty;
  byId("file").textContent = history.dirty ? `${file.name} — not saved` : file.name;
  document.title = `${history.dirty ? "• " : ""}${file.name} — centrode`;
}

// Changes

/** New values for keys of the design; `final` ends a drag. */
function edit(edits, final) {
  for (const { key, value } of edits) state.draft.set(key, value);
  request({ final });
}

/** Another text altogether; what is searched for the old one is no more. */
function replace(text) {
  if (search?.showing) search.abandon();
  state.draft.clear();
  request({ text, final: true, fresh: true });
}

/** Asks for a text or for the draft; what is not `wanted` any more when the answer comes is not shown. */
function request(job) {
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
    const asked = form.clock;
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
      const snapshot = await work((signal) => server.solve({ text, edits, depth }, signal), job.sent ? undefined : stop);
      if (job.wanted && !job.wanted()) continue;
      if (job.final) settle(snapshot.text, sent, edits.length > 0 || job.fresh);
      if (job.sent && state.pending) continue;
      snapshot.goals = job.goals;
      show(snapshot, asked);
      dialogs.withdraw("server");
      if (!slow) state.took = performance.now() - start;
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
      complain("server", error);
    } finally {
      clearTimeout(waiting);
      end();
      document.body.classList.remove("busy");
    }
    if (unchecked && await tell(unchecked) && !state.pending) check(unchecked);
  }
  state.solving = false;
  byId("verdict").setAttribute("aria-busy", "false");
}

/**
 * Tells the goals of the picture that is shown, before its details and checks: a drag waits for them while they are quick.
 * Resolves to whether the checks are to follow.
 */
async function tell({ text, coarse, goals }) {
  if (goals || !coarse) return true;
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
      if (!state.shown) judge();
    }
  } catch (error) {
    if (!stop.signal.aborted) complain("server", error);
    else if (!state.pending) rest();
    return false;
  } finally {
    end();
    state.told = performance.now() - start;
  }
  return true;
}

/** Waits until every change given so far is in the text. */
async function settled() {
  while (state.solving) await state.work;
}

/** Has the design that is shown drawn in full and checked, while changes to it go on being drawn. */
async function check({ text, coarse }) {
  const stop = new AbortController();
  state.checking = stop;
  const wanted = () => state.checking === stop && !state.solving && state.snapshot.text === text;
  // The screen first: the checks take the computer's time.
  await state.shown;
  try {
    for (const depth of coarse ? ["detail", "checks"] : ["checks"]) {
      if (!wanted()) return;
      const start = performance.now();
      const asked = form.clock;
      const snapshot = await work((signal) => server.solve({ text, edits: [], depth }, signal), stop);
      if (snapshot.overtaken || !wanted()) return;
      if (depth === "checks") state.took = performance.now() - start;
      show(snapshot, asked);
    }
  } catch (error) {
    if (!stop.signal.aborted) complain("server", error);
    else if (wanted()) rest();
  }
}

/** The checks were cancelled: they are done when asked for. */
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
  if (changed) file.keep();
}

function forgetDraft(sent) {
  for (const [key, value] of sent) if (state.draft.get(key) === value) state.draft.delete(key);
}

function complain(key, error) {
  const away = error instanceof server.Away;
  state.away ||= away;
  // One line, however many requests get no answer.
  dialogs.notice(away ? "server" : key, error.message, [], "error");
}

/** One step back or forth, after the changes that are on their way. */
async function step(way) {
  if (state.draft.size) {
    // A change that takes long to solve is stepped over unsolved.
    const hurry = setInterval(() => state.stop.abort(CANCELLED), SLOW);
    await settled();
    clearInterval(hurry);
  }
  const text = state.history[way]();
  request({ text, final: true, fresh: false });
  file.keep();
}

/** The program does not answer: nothing can be solved or kept until it does. */
function lost() {
  complain("server", new server.Away());
}

/** It answers again: what was given meanwhile is due. */
function found() {
  if (!state.away) return;
  state.away = false;
  dialogs.withdraw("server");
  request({ text: state.history.text, final: true });
  if (state.history.dirty) file.keep();
}

/** Shows how goals and ways answer a number: that of a field, or one to be chosen. */
async function respond(key) {
  await settled();
  const take = (name, value) => edit([{ key: name, value }], true);
  if (state.snapshot.tables) await response.ask(state.snapshot, state.history.text, take, key);
}

function pin() {
  state.pinned = state.pinned ? null : state.snapshot;
  byId("pin").setAttribute("aria-pressed", String(Boolean(state.pinned)));
  byId("pin").textContent = state.pinned ? "Unpin" : "Pin";
  stage.pin(state.pinned?.picture);
  show(state.snapshot);
}

// Start

function listen() {
  layout.start();
  theme.start(() => {
    stage.draw();
    charts.recolor();
    search?.recolor();
  });
  // On paper everything is dark on light, and drawn finer.
  addEventListener("beforeprint", () => theme.paper(true, () => {
    stage.resize(3);
    charts.recolor();
  }));
  addEventListener("afterprint", () => theme.paper(false, () => {
    stage.resize();
    charts.recolor();
  }));
  if (embedded) return;
  byId("undo").addEventListener("click", () => step("undo"));
  byId("redo").addEventListener("click", () => step("redo"));
  byId("reset").addEventListener("click", () => replace(state.history.saved));
  byId("pin").addEventListener("click", pin);
  byId("save").addEventListener("click", () => file.save());
  byId("export").addEventListener("click", () => file.download(state.snapshot.name));
  byId("link").addEventListener("click", () => file.copy());
  byId("optimise").addEventListener("click", () => search.toggle());
  byId("response").addEventListener("click", () => respond());
  byId("source").addEventListener("click", async () => {
    const text = await source.edit(file.name, state.history.text, state.snapshot?.error);
    if (text !== null) replace(text);
  });
  addEventListener("keydown", (event) => {
    if (!(event.ctrlKey || event.metaKey) || byId("dialog").open || search?.showing) return;
    const key = event.key.toLowerCase();
    // Undo within a field being typed into is the browser's.
    const typing = event.target.matches?.("input[type=text]") && event.target.value !== event.target.dataset.value;
    if (key === "s") {
      event.preventDefault();
      document.activeElement?.blur();
      file.save();
    } else if ((key === "z" || key === "y") && !typing) {
      event.preventDefault();
      const forth = key === "y" || event.shiftKey;
      step(forth ? "redo" : "undo");
    }
  });
}

async function start() {
  listen();
  if (embedded) {
    document.body.classList.add("report");
    const snapshot = JSON.parse(embedded.textContent);
    byId("imprint").textContent = `${snapshot.name}: ${snapshot.definition}`;
    show(snapshot);
    return;
  }
  const { file: name, text, recovered, formats, methods, unsearched, started } = await server.design();
  byId("start").hidden = !started;
  if (unsearched) Object.assign(byId("optimise"), { disabled: true, title: unsearched });
  state.history = new History(text);
  file = new DesignFile(name, formats, state.history, { settled, replace, complain, saved: buttons });
  search = new Search(methods, {
    text: () => state.history.text,
    preview: (best, goals) => request({ text: best, goals, final: false, wanted: () => search.showing }),
    left: verdict.clear,
    take: replace,
    drop: () => {
      const text = state.history.text;
      if (state.checked?.text === text) show(state.checked);
      request({ text, final: false });
    },
    changed: buttons,
    complain,
  });
  buttons();
  replace(text);
  for (const { file: left, text: work } of recovered) {
    dialogs.notice(left, `${left} holds changes that were not saved.`, [
      ["Restore", () => replace(work)],
      ["Discard", () => server.forget(left).catch((error) => complain("keep", error))],
    ], "warning");
  }
  // What the tour points at is in its place then.
  settled().then(() => state.shown).then(help.start);
  link.listen((text) => file.offer(text), (error) => complain("link", error));
  server.watch({ disk: (state) => file.compare(state), lost, found });
}

start().catch((error) => complain("server", error));
