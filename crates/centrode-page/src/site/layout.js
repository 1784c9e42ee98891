// Room for the panes: tabs below the picture of a narrow window, borders to be moved in a wide one.

import { byId, element } from "./elements.js";

/** A window that is narrower has one column. */
const NARROW = matchMedia("(max-width: 1060px)");
/** Tabs of a narrow window: name, pane, and the word of the style sheet. */
const TABS = [["Design", "form", "design"], ["Goals", "verdict", "goals"], ["Curves", "curves", "curves"]];
/** Borders: pane, name, its width as it comes, and the way in which the pane grows. */
const BORDERS = [["form", "Width of the numbers", 312, 1], ["verdict", "Width of the report", 360, -1]];
const LEAST = 220;
/** What is left for the picture at least, pixels. */
const MIDDLE = 360;
/** A step of the arrow keys, pixels. */
const STEP = 16;
const COOKIE = "centrode-panes";

/** Widths of the last visit: a cookie, since the program has another port each time. */
function kept() {
  const found = document.cookie.split("; ").find((pair) => pair.startsWith(`${COOKIE}=`));
  const widths = found?.split("=")[1].split("-").map(Number) ?? [];
  return BORDERS.map(([, , width], i) => (widths[i] >= LEAST ? widths[i] : width));
}

/** Starts tabs and borders; tabs may have other names, by their words. */
export function start(names = {}) {
  tabs(names);
  borders();
}

function tabs(names) {
  const list = byId("tabs");
  const buttons = TABS.map(([name, pane, word]) => element("button", { type: "button", role: "tab", id: `tab-${word}`, "aria-controls": pane, onclick: () => {
    choose(word);
    // A pane begins below the picture, however far the one before it was scrolled.
    const main = document.querySelector("main");
    if (main.getBoundingClientRect().top < 0) main.scrollIntoView();
  } }, names[word] ?? name));
  const choose = (word) => {
    document.body.dataset.tab = word;
    TABS.forEach(([, , own], i) => {
      buttons[i].setAttribute("aria-selected", String(own === word));
      buttons[i].tabIndex = own === word ? 0 : -1;
    });
    // Canvases that had no room while they were hidden are drawn anew.
    dispatchEvent(new Event("resize"));
  };
  list.append(...buttons);
  list.addEventListener("keydown", (event) => {
    const at = buttons.indexOf(document.activeElement);
    const next = { ArrowLeft: at - 1, ArrowRight: at + 1, Home: 0, End: buttons.length - 1 }[event.key];
    if (next === undefined) return;
    event.preventDefault();
    const button = buttons[(next + buttons.length) % buttons.length];
    button.click();
    button.focus();
  });
  choose("goals");
  // Panes are tab panels only while there are tabs.
  const fit = () => TABS.forEach(([, pane, word]) => {
    if (NARROW.matches) byId(pane).setAttribute("role", "tabpanel");
    else byId(pane).removeAttribute("role");
    if (NARROW.matches) byId(pane).setAttribute("aria-labelledby", `tab-${word}`);
    else byId(pane).removeAttribute("aria-labelledby");
  });
  NARROW.addEventListener("change", fit);
  fit();
}

function borders() {
  const main = document.querySelector("main");
  // What was chosen, and what a window has room for: a narrow one is not to spoil the wide one it becomes.
  const chosen = kept();
  const widths = [...chosen];
  const marks = BORDERS.map(([pane, name], i) => element("div", { class: `border border-${pane}`, role: "separator", tabindex: 0,
    "aria-orientation": "vertical", "aria-label": name, "aria-controls": pane, title: "Drag to move; double-click for the usual width", ondblclick: () => set(i, BORDERS[i][2]) }));
  const most = (i) => Math.max(LEAST, main.clientWidth - MIDDLE - widths[1 - i]);
  const set = (i, width) => {
    widths[i] = Math.round(Math.min(Math.max(width, LEAST), most(i)));
    chosen[i] = widths[i];
    show();
    document.cookie = `${COOKIE}=${chosen.join("-")}; path=/; max-age=31536000; samesite=strict`;
  };
  const show = () => marks.forEach((mark, i) => {
    main.style.setProperty(`--${BORDERS[i][0]}-width`, `${widths[i]}px`);
    for (const [name, value] of [["min", LEAST], ["max", most(i)], ["now", widths[i]]]) mark.setAttribute(`aria-value${name}`, value);
  });
  marks.forEach((mark, i) => {
    const way = BORDERS[i][3];
    let start = null;
    mark.addEventListener("pointerdown", (event) => {
      mark.setPointerCapture(event.pointerId);
      start = widths[i] - way * event.clientX;
    });
    mark.addEventListener("pointermove", (event) => {
      if (start !== null) set(i, start + way * event.clientX);
    });
    for (const end of ["pointerup", "pointercancel"]) {
      mark.addEventListener(end, () => {
        start = null;
      });
    }
    mark.addEventListener("keydown", (event) => {
      const next = { ArrowLeft: widths[i] - way * STEP, ArrowRight: widths[i] + way * STEP, Home: LEAST, End: most(i) }[event.key];
      if (next === undefined) return;
      event.preventDefault();
      set(i, next);
    });
  });
  main.append(...marks);
  // A window that has become smaller has less room for panes.
  addEventListener("resize", () => {
    widths.splice(0, widths.length, ...chosen);
    BORDERS.forEach((_, i) => {
      widths[i] = Math.max(LEAST, Math.min(widths[i], most(i)));
    });
    show();
  });
  show();
}
