// The page: one design, what it looks like, how it moves, what the checks say.

import { Charts } from "./charts.js";
import * as dialogs from "./dialogs.js";
import { byId, element } from "./elements.js";
import { Form } from "./form.js";
import { Handles } from "./handles.js";
import { History } from "./history.js";
import { read } from "./motion.js";
import * as response from "./response.js";
import { Search } from "./search.js";
import * as server from "./server.js";
import { Stage } from "./stage.js";
import * as theme from "./theme.js";
import * as verdict from "./verdict.js";

const DEG = 180 / Math.PI;
/** Checks slower than this come after the picture, ms. */
const SLOW = 40;
/** Whoever waits longer is told so, ms. */
const PATIENCE = 300;

const embedded = byId("snapshot");
const state = {
  snapshot: null,
  pinned: null,
  history: null,
  file: "",
  formats: [],
  input: 0,
  playing: false,
  /** Values given but not answered for yet, by key. */
  draft: new Map(),
  pending: null,
  solving: false,
  /** Resolves when nothing is left to solve. */
  work: null,
  /** Goals of the best design so far, while a search shows it. */
  goals: null,
  /** Whether the program has not answered of late. */
  away: false,
  /** Resolves when the panels show the snapshot, while they do not yet. */
  shown: null,
  /** How long the last checks took, ms: unknown ones come after the picture. */
  took: Infinity,
};

const stage = new Stage((poses) => handles?.place(poses));
const charts = new Charts((input) => {
  play(false);
  move(input);
});
const form = new Form({ edit, fixed: Boolean(embedded) });
const handles = embedded ? null : new Handles(stage, { edit, began: () => play(false) });

let search = null;

// Motion

const cycle = () => stage.scene?.motion.cycle ?? 2 * Math.PI;

function move(input) {
  draw(input);
  readout();
  charts.at(state.input);
}

/** The mechanism at an input, and where the scrubber stands. */
function draw(input) {
  state.input = Math.min(Math.max(input, 0), cycle());
  const scrub = byId("scrub");
  scrub.value = state.input / cycle();
  const words = `${(state.input * DEG).toFixed(1)}°`;
  byId("angle").textContent = words;
  scrub.setAttribute("aria-valuetext", words);
  stage.at(state.input);
}

/** The curves that stand alone, at the input. */
function readout() {
  const lines = (state.snapshot?.curves ?? []).filter((curve) => curve.name === "").slice(0, 3);
  byId("readout").replaceChildren(...lines.map((curve) => {
    const value = read(curve, state.input);
    const words = value === null ? "–" : value.toFixed(4).replace(/^-(0\.0*)$/, "$1");
    return element("div", {}, `${curve.chart} ${words}${curve.unit && ` ${curve.unit}`}`);
  }));
}

function play(on) {
  if (state.playing === on) return;
  state.playing = on;
  const button = byId("play");
  button.textContent = on ? "Pause" : "Play";
  button.setAttribute("aria-pressed", String(on));
  if (!on) return;
  let last = performance.now();
  const step = (now) => {
    if (!state.playing) return;
    const turned = ((now - last) / 60000) * Number(byId("speed").value) * 2 * Math.PI;
    last = now;
    move((state.input + turned) % cycle());
    requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
}

// What is shown

function show(snapshot) {
  const before = state.snapshot;
  if (!snapshot.picture && before?.picture) {
    // No mechanism: the last one stays in sight, faded.
    snapshot = { ...before, text: snapshot.text, tables: snapshot.tables, error: snapshot.error };
  } else if (!snapshot.verdict && before) {
    snapshot = { ...snapshot, curves: merged(snapshot.curves, before.curves), stale: true };
  }
  state.snapshot = snapshot;
  // Pinned before its checks were done.
  if (state.pinned && !state.pinned.verdict && snapshot.verdict && snapshot.text === state.pinned.text) state.pinned = snapshot;
  stage.stale = Boolean(snapshot.error);
  stage.show(snapshot.picture);
  handles?.show(snapshot.picture?.handles ?? []);
  draw(state.input);
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
  byId("heading").textContent = snapshot.title || snapshot.name || state.file;
  byId("definition").textContent = snapshot.definition;
  form.show(snapshot);
  charts.show(snapshot.curves, state.pinned?.curves);
  if (!snapshot.verdict && state.goals) verdict.goals(state.goals, state.pinned?.verdict?.goals);
  verdict.show(snapshot, state.pinned, (input) => {
    play(false);
    move(input);
  });
  readout();
  charts.at(state.input);
  buttons();
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
  byId("file").textContent = history.dirty ? `${state.file} — not saved` : state.file;
  document.title = `${history.dirty ? "• " : ""}${state.file} — centrode`;
}

// Changes

/** New values for keys of the design; `final` ends a drag. */
function edit(edits, final) {
  for (const { key, value } of edits) state.draft.set(key, value);
  request({ final });
}

/** Another text altogether. */
function replace(text) {
  state.draft.clear();
  request({ text, final: true, fresh: true });
}

function request(job) {
  // A change that ends a drag stays one, whatever overtakes it.
  const { text, final, fresh } = state.pending ?? {};
  state.pending = { text: job.text ?? text, final: job.final || Boolean(final), fresh: job.fresh || (job.text === undefined && Boolean(fresh)) };
  if (!state.solving) state.work = solve();
}

async function solve() {
  state.solving = true;
  while (state.pending) {
    const job = state.pending;
    state.pending = null;
    const sent = new Map(state.draft);
    const text = job.text ?? state.history.text;
    const edits = [...sent].map(([key, value]) => ({ key, value }));
    const slow = state.took > SLOW;
    const waiting = setTimeout(() => document.body.classList.add("busy"), PATIENCE);
    try {
      const start = performance.now();
      const snapshot = await server.solve({ text, edits, depth: slow ? "picture" : "checks" });
      if (snapshot.overtaken) {
        // Another window of this page has asked; then it is our turn again.
        state.pending ??= job;
        await new Promise((resume) => setTimeout(resume, 100));
        continue;
      }
      if (job.final) settle(snapshot.text, sent, edits.length > 0 || job.fresh);
      show(snapshot);
      if (!slow) state.took = performance.now() - start;
      else if (!state.pending && !snapshot.error) check(snapshot);
      dialogs.withdraw("server");
    } catch (error) {
      // What was typed is due when the program answers again.
      const away = error instanceof server.Away;
      if (job.final && !away) forgetDraft(sent);
      if (away && job.fresh) state.history.push(text);
      complain("server", error);
    } finally {
      clearTimeout(waiting);
      document.body.classList.remove("busy");
    }
  }
  state.solving = false;
}

/** Waits until every change given so far is in the text. */
async function settled() {
  while (state.solving) await state.work;
}

/** Has the design that is shown drawn in full and checked, while changes to it go on being drawn. */
async function check({ text, coarse }) {
  const wanted = () => !state.solving && state.snapshot.text === text;
  // The screen first: the checks take the computer's time.
  await state.shown;
  try {
    for (const depth of coarse ? ["detail", "checks"] : ["checks"]) {
      if (!wanted()) return;
      const start = performance.now();
      let snapshot = await server.solve({ text, edits: [], depth });
      while (snapshot.overtaken && wanted()) {
        // Another window of this page has asked; then it is our turn again.
        await new Promise((resume) => setTimeout(resume, 100));
        snapshot = await server.solve({ text, edits: [], depth });
      }
      if (snapshot.overtaken || !wanted()) return;
      if (depth === "checks") state.took = performance.now() - start;
      show(snapshot);
    }
  } catch (error) {
    complain("server", error);
  }
}

/** A change has arrived in the text; a step back or forth is in the history already, and is no new one. */
function settle(text, sent, fresh) {
  const changed = text !== state.history.text;
  if (fresh) state.history.push(text);
  forgetDraft(sent);
  if (changed) keep();
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

let keeping = 0;
/** Puts what is not saved beside the file, soon. */
function keep() {
  clearTimeout(keeping);
  keeping = setTimeout(() => {
    server.keep(state.history.text).then(() => dialogs.withdraw("keep")).catch((error) => complain("keep", error));
  }, 200);
}

/** One step back or forth, after the changes that are on their way. */
async function step(way) {
  if (state.draft.size) await settled();
  const text = state.history[way]();
  request({ text, final: true, fresh: false });
  keep();
}

async function save(over = false) {
  await settled();
  const text = state.history.text;
  try {
    const answer = await server.save(text, state.history.saved, over);
    if (!answer.saved) {
      await settleConflict(answer);
      return;
    }
    clearTimeout(keeping);
    state.history.saved = text;
    if (state.history.dirty) keep();
    dialogs.withdraw("disk");
    dialogs.withdraw("save");
    buttons();
  } catch (error) {
    complain("save", error);
  }
}

/** The file has been changed by others: whose work stays? */
async function settleConflict({ message, gone }) {
  const words = element("p", {}, `${message}. Saving would ${gone ? "make it anew" : "write over that"}.`);
  const answer = await dialogs.ask(gone ? "Not there" : "Changed on disk", [words],
    [["", "Cancel"], ...(gone ? [] : [["load", "Load the file"]]), ["over", gone ? "Save" : "Write over it", gone ? "main" : "danger"]]);
  if (answer === "over") await save(true);
  if (answer === "load") await load();
}

/** Takes what is on disk now. */
async function load() {
  try {
    const { text } = await server.reread();
    state.history.saved = text;
    replace(text);
    dialogs.withdraw("disk");
  } catch (error) {
    complain("disk", error);
  }
}

/** Says what has become of the file, if it is not what this page knows. */
function compare({ text, missing }) {
  if (text === state.history.saved) {
    dialogs.withdraw("disk");
    return;
  }
  if (missing) dialogs.notice("disk", `${state.file} ${missing}.`, [], "warning");
  else dialogs.notice("disk", `${state.file} has been changed on disk.`, [["Load the file", load]], "warning");
  // Another window that saved has taken the autosave away.
  if (state.history.dirty) keep();
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
  if (state.history.dirty) keep();
}

async function download() {
  await settled();
  const options = await dialogs.files(state.formats);
  if (!options) return;
  if (options.formats.length === 0) {
    dialogs.notice("export", "nothing to export: no kind of file is chosen", [], "warning");
    return;
  }
  dialogs.withdraw("export");
  try {
    const blob = await server.files({ text: state.history.text, ...options });
    const link = Object.assign(document.createElement("a"), {
      href: URL.createObjectURL(blob),
      download: `${state.snapshot.name || "design"}.zip`,
    });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
  } catch (error) {
    complain("export", error);
  }
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
  byId("play").addEventListener("click", () => play(!state.playing));
  byId("scrub").addEventListener("input", (event) => {
    play(false);
    move(Number(event.target.value) * cycle());
  });
  byId("scrub").addEventListener("keydown", (event) => {
    const way = { ArrowLeft: -1, ArrowRight: 1, PageDown: -10, PageUp: 10 }[event.key];
    if (!way) return;
    event.preventDefault();
    play(false);
    move(state.input + way / DEG);
  });
  stage.box.addEventListener("keydown", (event) => {
    if (event.key !== " " || event.target !== stage.box) return;
    event.preventDefault();
    play(!state.playing);
  });
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
  byId("save").addEventListener("click", () => save());
  byId("export").addEventListener("click", download);
  byId("optimise").addEventListener("click", () => search.toggle());
  byId("response").addEventListener("click", () => response.ask(state.snapshot, state.history.text));
  byId("source").addEventListener("click", async () => {
    const text = await dialogs.source(state.file, state.history.text, state.snapshot?.error);
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
      save();
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
  const { file, text, recovered, formats, methods, unsearched } = await server.design();
  if (unsearched) Object.assign(byId("optimise"), { disabled: true, title: unsearched });
  state.file = file;
  state.formats = formats;
  state.history = new History(text);
  search = new Search(methods, {
    text: () => state.history.text,
    preview: (best, goals) => {
      state.goals = goals;
      request({ text: best, final: false });
    },
    take: replace,
    drop: () => request({ text: state.history.text, final: false }),
    left: () => {
      state.goals = null;
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
  server.watch({ disk: compare, lost, found });
}

start().catch((error) => complain("server", error));
