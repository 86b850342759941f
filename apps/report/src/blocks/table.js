// A table that can be sorted by any column, searched if it is long, and saved.
import { element } from "../element.js";
import { downloads } from "../pictures/download.js";
import { on_print } from "../print.js";

const rows_at_first = 200;
const rows_in_sight = 60; // of a longer table a part scrolls

/// @returns the number that a cell shows; null for none.
function number_in(cell) {
  const text = cell.replace("−", "-").replace(/ (\/min|=)$/, "");
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

/// A word whose meaning a pointer shows, and a press too, for there is none on
/// a phone.
function with_meaning(text, meaning) {
  if (!meaning) return [text];
  const note = element("small.meaning", { hidden: true }, meaning);
  const button = element(
    "button.term",
    {
      type: "button",
      title: meaning,
      "aria-expanded": "false",
      click: () => {
        note.hidden = !note.hidden;
        button.setAttribute("aria-expanded", !note.hidden);
      },
    },
    text,
  );
  return [button, note];
}

class Table {
  constructor(block) {
    this.block = block;
    this.numeric = block.columns.map((_, i) => is_numeric(block.rows, i));
    this.places = new Map(block.rows.map((row, i) => [row, i]));
    this.rows = block.rows;
    this.body = element("tbody");
    this.whole = block.rows.length <= rows_at_first;
    this.with_same = false;
    this.sought = "";
    this.heads = block.columns.map((_, i) => this.head(i));
    on_print(
      () => this.fill(true),
      () => this.fill(),
    );
    this.fill();
  }

  verdict_of(row) {
    return this.block.verdicts?.[this.places.get(row)] ?? "";
  }

  get same_count() {
    return this.block.verdicts?.filter((one) => one === "same").length ?? 0;
  }

  row_element(row) {
    const place = this.places.get(row);
    return element(
      `tr${this.verdict_of(row) ? `.${this.verdict_of(row)}` : ""}`,
      {},
      ...row.map((cell, i) =>
        element(
          this.numeric[i] ? "td.number" : "td",
          {},
          ...(i === 0 ? with_meaning(cell, this.block.row_meanings?.[place]) : [cell]),
        ),
      ),
    );
  }

  /// @param everything  On paper there are no buttons to ask for more.
  fill(everything = false) {
    const wanted = this.rows.filter(
      (row) =>
        everything ||
        ((this.with_same || this.verdict_of(row) !== "same") && this.is_sought(row)),
    );
    const shown = everything || this.whole ? wanted : wanted.slice(0, rows_at_first);
    this.body.replaceChildren(...shown.map((row) => this.row_element(row)));
  }

  is_sought(row) {
    return row.some((cell) => cell.toLowerCase().startsWith(this.sought));
  }

  /// Leaves the rows with a cell that begins with what is written.
  search() {
    const field = element("input", {
      type: "search",
      placeholder: `in ${this.block.rows.length} rows`,
      input: () => {
        this.sought = field.value.trim().toLowerCase();
        this.fill();
      },
    });
    return element("label.choice", {}, "find ", field);
  }

  sort(i) {
    const head = this.heads[i];
    const up = head.getAttribute("aria-sort") !== "ascending";
    for (const other of this.heads) other.removeAttribute("aria-sort");
    head.setAttribute("aria-sort", up ? "ascending" : "descending");
    this.rows = sorted(this.block.rows, i, this.numeric[i], up ? 1 : -1);
    this.fill();
  }

  head(i) {
    return element(
      this.numeric[i] ? "th.number" : "th",
      { scope: "col" },
      element(
        "button",
        {
          type: "button",
          title: this.block.column_meanings?.[i] || null,
          click: () => this.sort(i),
        },
        with_unit(this.block.columns[i]),
      ),
    );
  }

  /// A button that is gone once it has been pressed.
  once(text, act) {
    const button = element(
      "button.more",
      {
        type: "button",
        click: () => {
          act();
          button.remove();
          this.fill();
        },
      },
      text,
    );
    return button;
  }
}

export function table_block(block) {
  const table = new Table(block);
  const same = table.same_count;
  return element(
    "div.table",
    {},
    element(
      "div.head",
      {},
      block.title ? element("h3", {}, block.title) : null,
      table.whole ? null : table.search(),
      downloads(block.title, { rows: () => [block.columns, ...block.rows] }),
    ),
    element(
      block.rows.length > rows_in_sight ? "div.scroller.long" : "div.scroller",
      { tabindex: "0", role: "region", "aria-label": block.title || "Table" },
      element(
        "table",
        {},
        element("thead", {}, element("tr", {}, ...table.heads)),
        table.body,
      ),
    ),
    table.whole
      ? null
      : table.once(`Show all ${block.rows.length} rows`, () => (table.whole = true)),
    same
      ? table.once(`Show ${same} equal row${same > 1 ? "s" : ""}`, () => (table.with_same = true))
      : null,
    block.note ? element("p.note", {}, block.note) : null,
  );
}
