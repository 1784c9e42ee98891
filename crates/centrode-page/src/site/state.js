// What the page knows: the design that is shown, what it was requested to do, and what is running.

export const state = {
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
