// Paper: all of the page at once, in light colours, as wide as the sheet.
import { force_light } from "./theme.js";

const before = [];
const after = [];

/// Calls when the page is about to be printed, and when it has been.
export function on_print(prepare, restore = () => {}) {
  before.push(prepare);
  after.push(restore);
}

/// @param draw  @returns a picture, or several.
/// @returns an element that is on paper only, and drawn when it comes to it.
export function on_paper(space, draw) {
  on_print(
    () => space.replaceChildren(...[draw()].flat()),
    () => space.replaceChildren(),
  );
  return space;
}

addEventListener("beforeprint", () => {
  force_light(true);
  // What comes to the page by this is prepared, too.
  for (let i = 0; i < before.length; ++i) before[i]();
});
addEventListener("afterprint", () => {
  for (const restore of after) restore();
  force_light(false);
});
