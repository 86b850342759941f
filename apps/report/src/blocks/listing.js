// A file's text, folded away.
import { element } from "../element.js";

export function listing_block(block) {
  return element(
    "details.listing",
    {},
    element("summary", {}, block.title),
    element("pre", { tabindex: "0" }, block.text),
  );
}
