// The page on which a machine is made from a path.

import { Charts } from "./charts.js";
import * as dialogs from "./dialogs.js";
import { byId, element, place } from "./elements.js";
import { Form } from "./form.js";
import { Handles } from "./handles.js";
import { History } from "./history.js";
import * as layout from "./layout.js";
import { Field } from "./path-field.js";
import * as file from "./path-file.js";
import { isSought, withOpened } from "./path-design.js";
import { EXAMPLE, asked, changed, handles as marks, lacks, rowsOf, tableOf, tables, wantedPicture, whole, withPoses, withWanted } from "./path-form.js";
import * as maker from "./path-make.js";
import * as shapes from "./path-shapes.js";
import { Solving } from "./path-solving.js";
import * as lines from "./path-told.js";
import * as server from "./server.js";
import { Stage } from "./stage.js";
import * as theme from "./theme.js";
import { Transport } from "./transport.js";
import { work } from "./work.js";

/** The drawing, with the field of possible axes below it. */
class PathStage extends Stage {
  clear() {
    super.clear();
    this.field?.paint(this);
  }

  /** Whether a link is drawn: the path and what is required of it always are. */
  isShown({ name }) {
    return ["path", "wanted"].includes(name) || byId("show-gears").checked;
  }

  link(link, pose) {
    if (this.isShown(link)) super.link(link, pose);
  }

  lines(link, pose) {
    if (this.isShown(link)) super.lines(link, pose);
  }
}

const stage = new PathStage((poses) => handles?.place(poses));
const transport = new Transport(stage);
const charts = new Charts((input) => transport.go(input), () => "path", () => transport.speed);
transport.charts = charts;
const form = new Form({ edit, hold: () => {}, respond: () => {}, fixed: false });
const handles = new Handles(stage, { edit, began: () => {}, points: (table) => form.points.get(table) });
const field = new Field(stage, complain);
stage.field = field;
const solving = new Solving({ show: (answer, more) => wish.given === "path" && show(answer, more), complain, rested: () => busy(Boolean(finding)) });

/** What is drawn is kept while the window is open: a design made of it leads away from this page, and back. */
const KEPT = "centrode-path";
let wish = kept();
/** Figures that are shown. */
let told = [];
/** The key at fault of what was typed last, and why; what is shown is that of the value before. */
let amiss = null;
/** What ends the search for the machine. */
let finding = null;
const history = new History(JSON.stringify(wish));

/** Takes new values; `final` ends a drag. */
function edit(edits, final) {
  const { next, key, wrong, note } = changed(wish, edits);
  if (wrong) {
    refuse({ key, wrong });
    return;
  }
  take(next, final);
  if (note) dialogs.notice("turn", note, [], "warning");
  else dialogs.withdraw("turn");
}

/** Says what is wrong with a value, of which no machine is made. */
function refuse(fault) {
  amiss = fault;
  fill({ key: fault.key, message: fault.wrong, rule: "" });
  able();
}

/** Whether the machine that is shown may be made. */
let isPossible = false;

/** Buttons that make a machine; a value at fault is not passed over. */
function able() {
  const why = amiss && `${place(amiss.key)}: ${amiss.wrong}`;
  for (const id of ["make", "find-machine"]) {
    const button = byId(id);
    button.dataset.usual ??= button.title;
    button.title = why ?? button.dataset.usual;
  }
  byId("make").disabled = !isPossible || Boolean(amiss);
  byId("find-machine").disabled = Boolean(amiss);
  byId("amiss").hidden = !amiss;
  byId("amiss").textContent = amiss ? `✕ ${why}. What is shown is of the value before: no machine is made of it.` : "";
}

/** Takes another wish. */
function take(next, final, fresh = true) {
  wish = next;
  if (final && fresh) history.push(JSON.stringify(wish));
  if (final) keep();
  amiss = lacks(wish);
  fill(amiss && { key: amiss.key, message: amiss.wrong, rule: "" });
  buttons();
  able();
  const isPath = wish.given === "path";
  field.shown = isPath;
  for (const id of ["field", "field-readout"]) byId(id).hidden = !isPath;
  byId("show-field").parentElement.hidden = !isPath;
  byId("save-path").hidden = wish.given === "poses";
  finding?.abort();
  if (isPath) {
    busy(true);
    solving.ask(wish, final);
    field.ask(wish, final);
  } else {
    unfound();
  }
}

/** Shows what is given, for which no machine has been searched yet. */
function unfound() {
  busy(false);
  const words = wish.given === "poses" ? "takes these poses" : "runs along these points, with any return to the first,";
  show({ curves: [], figures: [], fault: { of: "sought", message: `The machine whose tip ${words} is searched on request: it takes some seconds.` } });
}

/** Seeks the machine of poses or of a stroke. */
async function find() {
  const stop = new AbortController();
  finding = stop;
  busy(true);
  try {
    const answer = await work((signal) => server.findMachine(asked(wish), signal, maker.heed), stop);
    if (finding !== stop) return;
    // What others the path has may still be on its way: it is not that of the machine found.
    solving.end();
    if (answer.refused) show({ curves: [], figures: [], fault: { of: "none", message: answer.refused } });
    else show({ ...answer, found: true });
  } catch (error) {
    if (!stop.signal.aborted) complain(error);
  } finally {
    if (finding === stop) {
      finding = null;
      busy(false);
    }
  }
}

/** Acts of the buttons of shapes. */
const act = {
  add: (kind) => {
    const shape = shapes.added(kind, wish.keep_out, wish[wish.given]);
    take({ ...wish, keep_out: [...wish.keep_out, shape] }, true);
    byId(`delete-${shape.name}`)?.closest("details").querySelector("input").focus();
  },
  drop: (name) => {
    take({ ...wish, keep_out: wish.keep_out.filter((shape) => shape.name !== name) }, true);
    byId("add-circle")?.focus();
  },
};

/** Shows the wish in the form, with what is wrong with it. */
function fill(error) {
  form.show({ tables: tables(wish, act), error, verdict: error ? undefined : { findings: [] } });
}

/** The key of a message of the program that begins with one, and the rule. */
function blamed(message) {
  const [, key, rule] = /^([a-z_.]+(?:\[\d+\])?[\w.[\]-]*):? (.*)$/.exec(message) ?? [];
  return key ? { key: key.replace(/^(bend_deg|arms|split|aim)$/, "gears.$1").replace(/^path\.(band|module)$/, "gears.$1").replace(/^axis_box$/, "axis.within_x"), message: rule, rule: "" } : null;
}

/** Shows what the program answers; where `more` figures are to come, those from before stay, faded. */
function show({ picture, curves, figures, fault, goals, findings, found }, more = false) {
  stage.show(withWanted(picture?.links.length ? picture : wantedPicture(wish), wish));
  handles.show(marks(wish));
  transport.draw();
  charts.place.classList.toggle("stale", Boolean(fault));
  if (!fault) charts.show(curves);
  transport.show(curves);
  judge(fault, found && { missed: (goals ?? []).filter(({ met }) => !met).length });
  if (fault?.of === "wish") fill(blamed(fault.message));
  byId("wished").replaceChildren(...lines.wishes(goals, found || !isSought(wish) ? "Wishes" : "Wishes as drawn"), ...lines.findings(findings));
  const names = new Set(figures.map(({ name }) => name));
  const stale = more && !fault ? told.filter(({ name }) => !names.has(name)) : [];
  told = [...figures, ...stale.map((one) => ({ ...one, stale: true }))];
  const rows = told.map(({ name, words, stale: faded }) =>
    element("tr", { class: faded && "stale" }, element("th", { scope: "row" }, name), element("td", { "data-key": name }, words)));
  byId("figures").replaceChildren(...(rows.length ? [element("table", { class: "figures" }, element("tbody", {}, ...rows))] : []));
  // Another axis may be possible, where it is free.
  const isAble = !fault || (fault.of === "axis" && wish.free);
  isPossible = isAble;
  able();
  byId("finding").hidden = wish.given === "path" ? found || !isAble || !isSought(wish) : !fault;
}

/** Says whether there is a machine; what has been said already is not said again. */
function judge(fault, found) {
  const place = byId("possible");
  const missed = found?.missed ? `, which misses ${found.missed === 1 ? "a wish" : `${found.missed} wishes`}` : "";
  const head = fault ? heading(fault) : `${missed ? "!" : "✓"} ${found ? `A machine is found${missed}` : "This axis is possible"}`;
  const words = fault ? capital(fault.message) : "";
  if (place.dataset.said === head + words) return;
  place.dataset.said = head + words;
  const kind = fault ? fault.of === "sought" ? "" : "error" : missed ? "" : "good";
  place.replaceChildren(element("div", { class: `title ${kind}` }, element("h2", {}, head)), ...(words ? [element("p", {}, words)] : []));
}

const capital = (words) => words.charAt(0).toUpperCase() + words.slice(1);

const heading = ({ of }) => ({ path: "✕ No path", axis: "✕ This axis is not possible", split: "✕ No gears", wish: "✕ A value breaks a rule", sought: "○ Not searched yet", none: "✕ No machine found" })[of];

// A window may have no storage.
function kept() {
  try {
    return whole(JSON.parse(sessionStorage.getItem(KEPT)) ?? {});
  } catch {
    return EXAMPLE;
  }
}

function keep() {
  try {
    sessionStorage.setItem(KEPT, JSON.stringify(wish));
  } catch {
    // It holds until the page is left.
  }
}

function complain(error) {
  dialogs.notice("server", error.message, [], "error");
}

/** Whether an answer is still to come. */
function busy(is) {
  byId("verdict").setAttribute("aria-busy", String(is));
}

function buttons() {
  byId("undo").disabled = !history.canUndo;
  byId("redo").disabled = !history.canRedo;
}

function step(way) {
  take(JSON.parse(history[way]()), true, false);
}

/** Takes the best axis of the map. */
async function best(bluntest) {
  const stop = new AbortController();
  try {
    const found = await work((signal) => server.bestAxis({ points: rowsOf(wish), bend_deg: wish.bend, bluntest }, signal), stop);
    if (found.refused) dialogs.notice("axis", found.refused, [], "warning");
    else take({ ...wish, axis: found }, true);
  } catch (error) {
    if (!stop.signal.aborted) complain(error);
  }
}

function listen() {
  layout.start({ goals: "Machine", design: "Path" });
  theme.start(() => {
    stage.draw();
    charts.recolor();
  });
  byId("undo").addEventListener("click", () => step("undo"));
  byId("redo").addEventListener("click", () => step("redo"));
  byId("mildest").addEventListener("click", () => best(false));
  byId("bluntest").addEventListener("click", () => best(true));
  byId("find-machine").addEventListener("click", find);
  byId("show-gears").addEventListener("change", () => stage.draw());
  byId("make").addEventListener("click", () => maker.make(wish, complain));
  file.listen({
    given: () => wish.given,
    table: () => tableOf(wish),
    asked: () => asked(wish),
    take: (found) => take(wish.given === "poses" && found.points ? withPoses(wish, found.points) : withOpened(wish, EXAMPLE, found), true),
    tell: (words, severity) => dialogs.notice("path", words, [], severity),
  });
  addEventListener("keydown", (event) => {
    if (!(event.ctrlKey || event.metaKey) || byId("dialog").open) return;
    const key = event.key.toLowerCase();
    // Undo within a field being typed into is the browser's.
    const typing = event.target.matches?.("input[type=text]") && event.target.value !== event.target.dataset.value;
    if ((key !== "z" && key !== "y") || typing) return;
    event.preventDefault();
    step(key === "y" || event.shiftKey ? "redo" : "undo");
  });
}

listen();
take(wish, true);
