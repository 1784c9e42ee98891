// The machine of a path on its way: the latest wish is solved, and what takes longer once the hand rests.

import { asked } from "./path-form.js";
import * as server from "./server.js";
import { work } from "./work.js";

export class Solving {
  /** `show(answer, more)` takes an answer and whether more figures are to come, `complain(error)` an error; `rested()` is called when nothing is left to do. */
  constructor({ show, complain, rested }) {
    Object.assign(this, { show, complain, rested });
    this.pending = null;
    this.running = null;
    /** What ends the solve under way. */
    this.stop = null;
    /** What ends the figures that take longer. */
    this.resting = null;
  }

  /** Asks for a wish; `final` ends a drag. */
  ask(wish, final) {
    this.pending = { wish, final: final || Boolean(this.pending?.final) };
    this.resting?.abort();
    // The last wish of a drag does not wait for one before it.
    if (final) this.stop?.abort();
    this.running ??= this.run().finally(() => {
      this.running = null;
    });
  }

  /** Ends the running request: another machine is shown than the requested one. */
  end() {
    this.pending = null;
    this.stop?.abort();
    this.resting?.abort();
  }

  async run() {
    while (this.pending) {
      const { wish, final } = this.pending;
      this.pending = null;
      const answer = await this.answer(wish, "stop", {});
      if (answer) this.show(answer, true);
      // Of a path or an axis that is not possible no more is to be reported; of a split, what the others would be.
      if (!final || !answer || this.pending || ["path", "axis"].includes(answer.fault?.of)) continue;
      for (const others of [false, true]) {
        const whole = await this.answer(wish, "resting", { rest: true, others });
        if (!whole || this.pending) break;
        this.show(whole, !others);
        this.rested();
      }
    }
    this.rested();
  }

  /** An answer of the program; none where it was stopped or failed. */
  async answer(wish, mark, options) {
    const stop = new AbortController();
    this[mark] = stop;
    try {
      const answer = await work((signal) => server.solvePath({ ...asked(wish, { placed: true }), ...options }, signal), stop);
      return stop.signal.aborted ? null : answer;
    } catch (error) {
      if (!stop.signal.aborted) this.complain(error);
      return null;
    } finally {
      this[mark] = null;
    }
  }
}
