// The page: one design, what it looks like, how it moves, what the checks say.

import { Charts } from "./charts.js";
import { Compare } from "./compare.js";
import { Compose } from "./compose.js";
import * as dialogs from "./dialogs.js";
import { byId, place } from "./elements.js";
import { DesignFile } from "./file.js";
import { Form } from "./form.js";
import { Handles } from "./handles.js";
import * as help from "./help.js";
import { History } from "./history.js";
import * as layout from "./layout.js";
import * as link from "./link.js";
import { brief } from "./numbers.js";
import * as pictures from "./picture-files.js";
import * as response from "./response.js";
import { Search } from "./search.js";
import * as server from "./server.js";
import { SLOW, connect, edit, request, settled } from "./solving.js";
import * as source from "./source.js";
import { Space } from "./space.js";
import { Stage } from "./stage.js";
import { state } from "./state.js";
import * as theme from "./theme.js";
import { Transport } from "./transport.js";
import * as verdict from "./verdict.js";
import { CANCELLED } from "./work.js";

const embedded = byId("snapshot");
const stage = new Stage((poses) => {
  handles?.place(poses);
  space?.follow();
  compose?.draw();
});
const transport = new Transport(stage);
const charts = new Charts((input) => transport.go(input), () => state.snapshot.name, () => state.snapshot.speed ?? transport.speed);
transport.charts = charts;
const form = new Form({ edit, hold: (on) => stage.remember(on), respond: (key) => respond(key), add, fixed: Boolean(embedded), brief: true });
const handles = embedded ? null : new Handles(stage, { edit, began: () => transport.play(false), points: (table) => form.points.get(table) });

const space = embedded ? null : new Space(stage, () => ({ text: state.snapshot?.text, sound: Boolean(state.snapshot?.picture && !state.snapshot.error && !state.snapshot.detail) }));

const compose = embedded ? null : new Compose(stage, {
  text: () => state.history.text,
  input: () => transport.input,
  settled,
  shown: async () => state.shown,
  take: replace,
  edit: (edits) => edit(edits, true),
  began: () => transport.play(false),
  complain,
});

let file = null;
let search = null;
/** Family of the design that is shown. */
let family;
/** Says why there is no search, or with no reason that there is one. */
let searchable;

connect({ form, file: () => file, draw, show, judge, complain });

// What is shown

/** Resolves when the picture that was drawn last is on the screen. */
let seen = Promise.resolve();

/** Draws the picture of a snapshot, whatever else is known of it, and marks what is still of the design before; resolves once it is seen. */
function draw(snapshot) {
  stage.stale = Boolean(snapshot.error);
  stage.show(snapshot.picture);
  handles?.show(snapshot.picture?.handles ?? []);
  transport.draw();
  verdict.fade(snapshot);
  if (!embedded) seen = painted();
  return seen;
}

/** Shows what the program answers; `asked` is the form's clock when it was asked. */
function show(snapshot, asked = snapshot.asked) {
  const before = state.snapshot;
  snapshot.asked = asked;
  if (before?.text === snapshot.text) snapshot.goals ??= before.goals;
  if (snapshot.verdict && !snapshot.error && !search?.showing) state.checked = snapshot;
  if (!snapshot.picture && before?.picture) {
    // No mechanism: the last one stays in sight, faded.
    snapshot = { ...before, asked, text: snapshot.text, tables: snapshot.tables, error: snapshot.error, goals: undefined, compose: snapshot.compose ?? before.compose };
  } else if (!snapshot.verdict && before) {
    snapshot = { ...snapshot, curves: merged(snapshot.curves, before.curves), stale: true };
  }
  state.snapshot = snapshot;
  // Pinned before its checks were done.
  if (state.pinned && !state.pinned.verdict && snapshot.verdict && snapshot.text === state.pinned.text) state.pinned = snapshot;
  // The eye may have it already.
  if (stage.stale !== Boolean(snapshot.error) || stage.scene?.picture !== snapshot.picture) draw(snapshot);
  verdict.fade(snapshot);
  // Panels cost the browser more than the picture does: the eye has that first.
  if (embedded) panels();
  else state.shown ??= seen.then(panels);
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
  Object.assign(byId("definition"), { textContent: snapshot.definition, title: snapshot.definition });
  form.show(snapshot, snapshot.asked);
  compose?.show(snapshot);
  charts.show(snapshot.curves, state.pinned?.curves);
  charts.place.classList.toggle("stale", Boolean(snapshot.error));
  judge();
  transport.show(snapshot.curves);
  buttons();
  if (!embedded) note(snapshot);
}

/** Takes note of the family; of some families no design is searched. */
async function note({ tables, text }) {
  const now = tables.flatMap(({ fields }) => fields).find(({ key }) => key === "family")?.value;
  if (!now || now === family) return;
  const first = family === undefined;
  family = now;
  if (first) return;
  try {
    const { unsearched } = await server.choices(text);
    if (family === now) searchable(unsearched);
  } catch (error) {
    complain("server", error);
  }
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

/** Another text altogether; what is searched for the old one is no more. */
function replace(text) {
  if (search?.showing) search.abandon();
  state.draft.clear();
  request({ text, final: true, fresh: true });
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

/** Adds a table that is not in the file, as one step. */
async function add(key) {
  await settled();
  try {
    const { text, refused } = await server.addTable(state.history.text, key);
    dialogs.withdraw("table");
    if (text) replace(text);
    else dialogs.notice("table", `${place(key)} is not added: ${brief(refused)}`, [], "warning");
  } catch (error) {
    complain("table", error);
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
  pictures.listen(stage, () => state.snapshot?.name, complain);
  if (embedded) return;
  byId("undo").addEventListener("click", () => step("undo"));
  byId("redo").addEventListener("click", () => step("redo"));
  byId("reset").addEventListener("click", () => replace(state.history.saved));
  byId("pin").addEventListener("click", pin);
  new Compare(() => state.snapshot, replace);
  byId("save").addEventListener("click", () => file.save());
  byId("export").addEventListener("click", () => file.download(state.snapshot.name, state.snapshot.tables));
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
    const snapshot = server.whole(JSON.parse(embedded.textContent));
    byId("imprint").textContent = `${snapshot.name}: ${snapshot.definition}`;
    show(snapshot);
    const wrong = (error) => complain("link", error);
    byId("link").addEventListener("click", () => link.copy(snapshot.text).catch(wrong));
    link.listen((text) => link.offer(text, snapshot.text), wrong);
    return;
  }
  const { file: name, text, recovered, formats, purposes, methods, unsearched, started } = await server.design();
  byId("start").hidden = !started;
  const usual = byId("optimise").title;
  searchable = (reason) => {
    Object.assign(byId("optimise"), { disabled: Boolean(reason), title: reason ?? usual });
    Object.assign(byId("unsearched"), { hidden: !reason, textContent: reason ? `Optimise is not possible: ${reason}` : "" });
  };
  searchable(unsearched);
  state.history = new History(text);
  file = new DesignFile(name, formats, purposes, state.history, { settled, replace, complain, saved: buttons });
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
  // The target of the tour is in its final position then.
  settled().then(() => state.shown).then(help.start);
  link.listen((text) => file.offer(text), (error) => complain("link", error));
  server.watch({ disk: (state) => file.compare(state), lost, found });
}

start().catch((error) => complain("server", error));
