// Light or dark: as the system wants, until somebody presses the button.
import { element } from "./element.js";

const system = window.matchMedia("(prefers-color-scheme: dark)");
const calm = window.matchMedia("(prefers-reduced-motion: reduce)");
const listeners = [];
let chosen = null;
let on_paper = false;

export const is_dark = () =>
  !on_paper && (chosen ?? (system.matches ? "dark" : "light")) === "dark";

/// @returns whether movement that nobody asked for is to be left out.
export const is_calm = () => calm.matches;

/// Calls when colours have changed; what is on a canvas has to be drawn anew.
export const on_theme = (listener) => listeners.push(listener);

const known = new Map(); // of this theme

/// @returns the value of a colour's variable in style.css.
export function colour(name) {
  if (!known.has(name)) {
    const style = getComputedStyle(document.documentElement);
    known.set(name, style.getPropertyValue(`--${name}`).trim());
  }
  return known.get(name);
}

const series_count = 12;

/// @returns the colour of the i-th curve or provider; the first six are safe
/// for the colour-blind (Okabe and Ito).
export const series_colour = (i) => colour(`series-${i % series_count}`);

function change() {
  document.documentElement.dataset.theme = is_dark() ? "dark" : "light";
  known.clear();
  for (const listener of listeners) listener();
}

system.addEventListener("change", change);
change();

/// Ink is dark, whatever the screen shows.
export function force_light(yes) {
  on_paper = yes;
  change();
}

export function theme_button() {
  const flip = () => {
    chosen = is_dark() ? "light" : "dark";
    change();
  };
  return element(
    "button.theme",
    { type: "button", click: flip, "aria-label": "Light or dark", title: "Light or dark" },
    "◐",
  );
}
