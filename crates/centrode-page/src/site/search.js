// The search for a better design: started, watched, stopped, taken or dropped.

import uPlot from "./uplot.js";
import { axes, line } from "./axes.js";
import { byId, element } from "./elements.js";
import * as server from "./server.js";
import { work } from "./work.js";

/** Time between two looks at a search, ms. */
const EVERY = 400;
const HEIGHT = 110;
const ENDED = {
  Target: "every goal is reached",
  Evaluations: "the evaluations are used up",
  Stopped: "stopped",
  Stuck: "no step helps any more",
};

export class Search {
  /**
   * `design.text()` is the design to start from; `preview(text, goals)` shows the best found without taking it, `left()` is
   * called when it is shown no more, `take(text)` takes it, `drop()` shows the design again; `changed()` is called when a search
   * begins or ends to show.
   */
  constructor(methods, design) {
    this.design = design;
    this.place = byId("search");
    this.best = null;
    /** How the search stood when the program was last asked. */
    this.last = null;
    this.showing = null;
    /** Resolves once the program has heard that the searches before are over. */
    this.over = null;
    this.method = element("select", { id: "search-method" }, ...methods.map((name) => element("option", { value: name }, name)));
    this.seed = element("input", { type: "text", inputmode: "numeric", class: "number", id: "search-seed", value: "1" });
    this.evaluations = element("input", { type: "text", inputmode: "numeric", class: "number", id: "search-evaluations", value: "20000" });
    this.start = element("button", { type: "button", class: "main", id: "search-start", onclick: () => this.begin() }, "Start");
    this.stop = element("button", { type: "button", id: "search-stop", onclick: () => this.end() }, "Stop");
    this.take = element("button", { type: "button", class: "main", id: "search-take", onclick: () => this.close(true) }, "Use it");
    this.drop = element("button", { type: "button", id: "search-drop", onclick: () => this.close(false) }, "Discard");
    this.bar = element("progress", { max: 1, value: 0, "aria-label": "Evaluations done" });
    this.words = element("p", { class: "detail", role: "status" });
    this.missed = element("table", { class: "missed" });
    this.box = element("div", { class: "plot" });
    const row = (words, input) => element("p", { class: "option" }, element("label", { for: input.id }, words), input);
    for (const input of [this.seed, this.evaluations]) {
      input.addEventListener("keydown", (event) => {
        if (event.key === "Enter") this.begin();
      });
    }
    this.place.append(
      element("h2", {}, "Optimise"),
      row("Method", this.method), row("Seed", this.seed), row("Evaluations", this.evaluations),
      element("div", { class: "buttons" }, this.start, this.stop, this.take, this.drop),
      this.bar, this.words, this.missed, this.box);
    this.show(null);
    // A page loaded anew finds its search again.
    server.searched().then((state) => {
      if (!state) return undefined;
      this.toggle();
      return this.follow();
    }).catch((error) => (this.last ? this.fail(error) : this.design.complain("search", error)));
  }

  toggle() {
    const open = this.place.hidden;
    if (!open && this.showing) return;
    this.place.hidden = !open;
    byId("optimise").setAttribute("aria-expanded", String(open));
    if (open) this.method.focus();
  }

  async begin() {
    const stop = new AbortController();
    try {
      const [seed, evaluations] = [whole(this.seed), whole(this.evaluations)];
      if (evaluations === 0) throw new Error("a search needs at least 1 evaluation; evaluations is 0");
      await this.over;
      const options = { text: this.design.text(), method: this.method.value, seed, evaluations };
      await work((signal) => server.search(options, signal), stop);
      this.best = null;
      await this.follow();
    } catch (error) {
      if (!stop.signal.aborted) this.fail(error);
    }
  }

  /** Says why it does not go on; the best found can still be taken. */
  fail(error) {
    if (this.last) this.show({ ...this.last, running: false, ended: null });
    this.words.textContent = error.message;
    this.words.classList.add("error");
  }

  end() {
    this.ending(server.stopSearch(), (error) => this.fail(error));
  }

  /** The program is asked to end the search: heard after the next one has begun, that would end the next one. */
  ending(asked, wrong) {
    this.over = Promise.all([this.over, asked.catch(wrong)]);
  }

  /** Looks at the search until it ends. */
  async follow() {
    const own = this.hold(true);
    for (;;) {
      const state = await server.searched();
      if (this.showing !== own) return;
      if (!state) {
        // Ended from another window, or with the program.
        this.leave();
        this.design.drop();
        return;
      }
      this.last = state;
      this.show(state);
      if (state.text !== this.best) {
        this.best = state.text;
        this.design.preview(state.text, state.goals);
      }
      if (!state.running) return;
      await new Promise((resume) => setTimeout(resume, EVERY));
    }
  }

  /** Ends to show the best: it becomes the design, or the design is shown again. */
  close(taken) {
    const best = this.best;
    this.leave();
    this.ending(server.stopSearch(), (error) => this.design.complain("search", error));
    if (taken && best !== null) this.design.take(best);
    else this.design.drop();
  }

  /** Another design has come: the search for the old one is over, wherever it is. */
  abandon() {
    this.leave();
    this.ending(server.forgetSearch(), (error) => this.design.complain("search", error));
  }

  /** Nothing of the search stays in sight. */
  leave() {
    this.last = null;
    this.best = null;
    this.hold(false);
    this.show(null);
    this.design.left();
  }

  /** The numbers of the design cannot be changed while the best found is shown instead. */
  hold(on) {
    // A name that differs from any other, so that a follower of one that is over notices it.
    this.showing = on ? Symbol("search") : null;
    document.body.classList.toggle("searching", on);
    byId("form").inert = on;
    this.design.changed();
    return this.showing;
  }

  show(state) {
    const running = Boolean(state?.running);
    this.start.hidden = Boolean(state);
    this.stop.hidden = !running;
    this.take.hidden = this.drop.hidden = !state || running;
    for (const input of [this.method, this.seed, this.evaluations]) input.disabled = Boolean(state);
    if (state) [this.method.value, this.evaluations.value] = [state.method, String(state.evaluations)];
    this.words.classList.remove("error");
    this.bar.hidden = !state;
    this.tell(state?.missed ?? []);
    this.box.hidden = !state || state.history.length < 2;
    if (!state) {
      this.words.textContent = "";
      return;
    }
    const last = state.history.at(-1);
    const done = last?.evaluations ?? 0;
    this.bar.value = Math.min(1, done / state.evaluations);
    const worth = !last ? "" : last.violation > 0 ? `; total miss ${last.violation.toPrecision(4)} (0 = every goal met)` : `; goals reached, objective ${last.objective.toPrecision(6)}`;
    this.words.textContent = `${done} evaluations${worth}${state.ended ? `; ${ENDED[state.ended] ?? state.ended}` : ""}${state.remark ? `; ${state.remark}` : ""}`;
    if (!this.box.hidden) this.draw(state.history);
  }

  /** What is counted as missed: at the start, by the best found, and the range it is required in. */
  tell(list) {
    this.missed.hidden = list.length === 0;
    const cell = (value, unit) => element("td", {}, `${value}${unit && ` ${unit}`}`);
    this.missed.replaceChildren(
      element("caption", {}, "Not yet met"),
      element("thead", {}, element("tr", {}, ...["", "start", "now", "required"].map((words) => element("th", { scope: "col" }, words)))),
      element("tbody", {}, ...list.map(({ title, unit, start, best, required, met }) => element("tr", { class: met ? "met" : "unmet" },
        element("th", { scope: "row" }, title), cell(start, unit), cell(`${met ? "✓ " : ""}${best}`, unit), cell(required, unit)))));
  }

  /** The history: what the goals are missed by, then the objective. */
  draw(history) {
    const data = [
      history.map((p) => p.evaluations),
      history.map((p) => (p.violation > 0 ? p.violation : null)),
      history.map((p) => (p.violation > 0 ? null : p.objective)),
    ];
    const width = Math.max(this.box.clientWidth, 160);
    if (this.plot) {
      this.plot.setSize({ width, height: HEIGHT });
      this.plot.setData(data);
      return;
    }
    this.plot = new uPlot({
      width,
      height: HEIGHT,
      legend: { show: false },
      cursor: { show: false },
      scales: { x: { time: false } },
      series: [{}, line("warning"), line("good")],
      axes: axes(),
    }, data, this.box);
  }

  recolor() {
    this.plot?.redraw(false);
  }
}

function whole(input) {
  const value = Number(input.value.trim());
  if (!Number.isSafeInteger(value) || value < 0) throw new Error(`${input.value} is not a whole number`);
  return value;
}
