// A table that can be sorted by any column.
import { element } from "../element.js";

const rows_at_first = 200;

/// @returns the number that a cell shows; null for none.
function number_in(cell) {
  const text = cell.replace("−", "-");
  return /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(text) ? Number(text) : null;
}

const is_empty = (cell) => cell === "" || cell === "–";

const is_numeric = (rows, column) =>
  rows.some((row) => number_in(row[column]) !== null) &&
  rows.every((row) => is_empty(row[column]) || number_in(row[column]) !== null);

/// A unit stays in the line of the word before it.
const with_unit = (name) => name.replace(/, (\S+)$/, ",\u00a0$1");

/// Empty cells come last, whatever the direction.
function sorted(rows, column, numeric, sign) {
  const compare = (a, b) => {
    if (is_empty(a) || is_empty(b)) return is_empty(a) - is_empty(b);
    const order = numeric
      ? number_in(a) - number_in(b)
      : a.localeCompare(b, "en", { numeric: true });
    return sign * order;
  };
  return [...rows].sort((a, b) => compare(a[column], b[column]));
}

export function table_block(block) {
  const numeric = block.columns.map((_, i) => is_numeric(block.rows, i));
  const body = element("tbody");
  let rows = block.rows;
  let all_shown = rows.length <= rows_at_first;

  const row_element = (row) =>
    element(
      "tr",
      {},
      ...row.map((cell, i) => element(numeric[i] ? "td.number" : "td", {}, cell)),
    );
  const fill = () => {
    const shown = all_shown ? rows : rows.slice(0, rows_at_first);
    body.replaceChildren(...shown.map(row_element));
  };

  const heads = block.columns.map((name, i) => {
    const sort = () => {
      const up = head.getAttribute("aria-sort") !== "ascending";
      for (const other of heads) other.removeAttribute("aria-sort");
      head.setAttribute("aria-sort", up ? "ascending" : "descending");
      rows = sorted(block.rows, i, numeric[i], up ? 1 : -1);
      fill();
    };
    const head = element(
      numeric[i] ? "th.number" : "th",
      { scope: "col" },
      element("button", { type: "button", click: sort }, with_unit(name)),
    );
    return head;
  });

  const more = element(
    "button.more",
    {
      type: "button",
      click: () => {
        all_shown = true;
        more.remove();
        fill();
      },
    },
    `Show all ${block.rows.length} rows`,
  );
  fill();
  return element(
    "div.table",
    {},
    block.title ? element("h3", {}, block.title) : null,
    element(
      "div.scroller",
      { tabindex: "0", role: "region", "aria-label": block.title || "Table" },
      element("table", {}, element("thead", {}, element("tr", {}, ...heads)), body),
    ),
    all_shown ? null : more,
    block.note ? element("p.note", {}, block.note) : null,
  );
}
