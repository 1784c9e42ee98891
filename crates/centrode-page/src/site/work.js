// Work that the program does for the page: a line says so where it takes long, and a button cancels it.

import { byId } from "./elements.js";

/** A longer wait is shown, ms. */
const PATIENCE = 1000;

/** Why a job was aborted, where the user did. */
export const CANCELLED = "cancelled";

const jobs = new Map();
let ticking = 0;

/** Does a job, which gets the signal of `stop`. */
export async function work(job, stop = new AbortController()) {
  jobs.set(stop, performance.now());
  ticking ||= setInterval(show, 200);
  try {
    return await job(stop.signal);
  } finally {
    jobs.delete(stop);
    show();
  }
}

/** How far a job is, in words. */
let far = "";

/** Says how far a job is, in words. */
export function progress(words) {
  far = words;
}

function show() {
  const longest = jobs.size ? performance.now() - Math.min(...jobs.values()) : 0;
  if (!jobs.size) progress("");
  byId("working").hidden = longest < PATIENCE;
  byId("working-time").textContent = `${far && `${far}, `}${Math.floor(longest / 1000)} s`;
  if (jobs.size) return;
  clearInterval(ticking);
  ticking = 0;
}

byId("cancel").addEventListener("click", () => {
  for (const stop of jobs.keys()) stop.abort(CANCELLED);
});
