// Builds the page from the document that stands in it.
import { hook } from "./hook.js";
import { render_page } from "./page.js";

const text = document.getElementById("document").textContent;
window.sofof = hook;
addEventListener("beforeprint", () => hook.draw_all());
hook.ready = render_page(document.getElementById("report"), JSON.parse(text));
