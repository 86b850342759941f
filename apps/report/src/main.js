// Builds the page from the document that stands in it.
import { hook } from "./hook.js";
import { render_page } from "./page.js";
import { inflate } from "./unpack.js";

const text = document.getElementById("document").textContent;
window.sofof = hook;
hook.ready = inflate(text).then((report) => render_page(document.getElementById("report"), report));
