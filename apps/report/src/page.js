// Header, contents, sections.
import { figures_block } from "./blocks/figures.js";
import { listing_block } from "./blocks/listing.js";
import { scatter_block } from "./blocks/scatter.js";
import { table_block } from "./blocks/table.js";
import { player } from "./drive/player.js";
import { element, marked_up } from "./element.js";
import { on_print } from "./print.js";
import { theme_button } from "./theme.js";

const paragraph_block = (block) => element("p", {}, ...marked_up(block.text));

const single_blocks = {
  paragraph: paragraph_block,
  listing: listing_block,
  scatter: scatter_block,
};

/// Narrow tables stand beside each other.
function table_classes(blocks) {
  const narrow = blocks.length > 1 && blocks.every(({ columns }) => columns.length <= 4);
  return narrow ? "div.tables.narrow" : "div.tables";
}

// What follows its like is shown together with it.
const group_blocks = {
  drive: (blocks) => player(blocks),
  figure: figures_block,
  table: (blocks) => element(table_classes(blocks), {}, ...blocks.map(table_block)),
};

function* blocks_of(section) {
  let like = [];
  for (const block of section.blocks) {
    if (like.length && like[0].kind !== block.kind) {
      yield group_blocks[like[0].kind](like);
      like = [];
    }
    if (block.kind in group_blocks) like.push(block);
    else yield single_blocks[block.kind](block);
  }
  if (like.length) yield group_blocks[like[0].kind](like);
}

function contents(sections) {
  const links = sections.map((section, i) =>
    element("li", {}, element("a", { href: `#section-${i}` }, section.title)),
  );
  const list = () => element("ol", {}, ...links.map((link) => link.cloneNode(true)));
  const wide = element("nav.contents", { "aria-label": "Contents" }, list());
  const narrow = element("details.contents", {}, element("summary", {}, "Contents"), list());
  narrow.addEventListener("click", (event) => {
    if (event.target.tagName === "A") narrow.open = false;
  });
  return [wide, narrow];
}

/// Marks the section in sight in the contents.
function follow_reader(nav, sections) {
  const links = [...nav.querySelectorAll("a")];
  const in_sight = new Set();
  const seen = new IntersectionObserver(
    (changes) => {
      for (const { target, isIntersecting } of changes)
        if (isIntersecting) in_sight.add(target);
        else in_sight.delete(target);
      const first = sections.findIndex((section) => in_sight.has(section));
      links.forEach((link, i) => {
        if (i === first) link.setAttribute("aria-current", "true");
        else link.removeAttribute("aria-current");
      });
    },
    { rootMargin: "-10% 0px -50% 0px" },
  );
  for (const section of sections) seen.observe(section);
}

/// Who shows nothing, a printer, gives no frames.
const NO_FRAME_MS = 50;

/// @returns a promise that the browser has shown what there is so far.
const shown = () =>
  new Promise((done) => {
    requestAnimationFrame(() => setTimeout(done));
    setTimeout(done, NO_FRAME_MS);
  });

/// Shows titles at once and the blocks of each section after them.
/// @returns a promise that all is there.
export async function render_page(into, report) {
  const sections = report.sections.map((section, i) =>
    element("section", { id: `section-${i}` }, element("h2", {}, section.title)),
  );
  const [wide, narrow] = contents(report.sections);
  into.replaceChildren(
    element(
      "header",
      {},
      element("div", {}, element("h1", {}, report.title), element("p", {}, report.subtitle)),
      theme_button(),
    ),
    narrow,
    wide,
    element("div.sections", {}, ...sections),
    element("a.top", { href: "#report", "aria-label": "To the top", title: "To the top" }, "↑"),
  );
  follow_reader(wide, sections);
  const rest = [...report.sections.entries()];
  const fill_next = () => {
    const [i, section] = rest.shift();
    sections[i].append(...blocks_of(section));
  };
  on_print(() => {
    while (rest.length) fill_next();
  });
  while (rest.length) {
    await shown();
    if (rest.length) fill_next();
  }
  document.getElementById(location.hash.slice(1))?.scrollIntoView();
}
