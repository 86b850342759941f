// A file's text, folded away.
import { element } from "../element.js";
import { on_print } from "../print.js";

export function listing_block(block) {
  const shown = element(
    "details.listing",
    {},
    element("summary", {}, block.title),
    element("pre", { tabindex: "0" }, block.text),
  );
  let was_open = false;
  on_print(
    () => {
      was_open = shown.open;
      shown.open = true;
    },
    () => (shown.open = was_open),
  );
  return shown;
}
