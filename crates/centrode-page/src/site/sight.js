// What is out of sight is drawn last: once it comes into sight, or once nothing else has been requested.

/** How long nothing is requested before what is out of sight has its turn, ms. */
const REST = 500;
/** How long it goes on before whatever else is due has a turn, ms. */
const SLICE = 8;
/** How near to the edge is in sight, pixels. */
const NEAR = "200px";

export class Sight {
  constructor() {
    /** Elements that are known to be out of sight. */
    this.away = new WeakSet();
    /** The latest job of each element that waits. */
    this.waiting = new Map();
    this.observer = new IntersectionObserver((entries) => {
      for (const { target, isIntersecting } of entries) {
        if (!isIntersecting) this.away.add(target);
        else if (this.away.delete(target)) this.run(target);
      }
    }, { rootMargin: NEAR, scrollMargin: NEAR });
  }

  watch(place) {
    this.observer.observe(place);
  }

  forget(place) {
    this.observer.unobserve(place);
    this.waiting.delete(place);
  }

  /** Does a job for an element, instead of any that it waits for. */
  draw(place, job) {
    if (!this.away.has(place)) {
      this.waiting.delete(place);
      job();
      return;
    }
    this.waiting.set(place, job);
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.next(), REST);
  }

  run(place) {
    const job = this.waiting.get(place);
    this.waiting.delete(place);
    job?.();
  }

  /** A few, then the next: a hand that comes back is not kept waiting for all of them. */
  async next() {
    const end = performance.now() + SLICE;
    for (const place of [...this.waiting.keys()]) {
      this.run(place);
      // A chart is drawn once the job is done.
      await null;
      if (performance.now() > end) break;
    }
    if (this.waiting.size) this.timer = setTimeout(() => this.next());
  }

  /** Does all that waits. */
  all() {
    for (const place of [...this.waiting.keys()]) this.run(place);
  }
}
