// A figure: drawn when it comes into sight, drawn anew when the theme changes.
import uPlot from "uplot";
import { element, marked_up } from "../element.js";
import { hook } from "../hook.js";
import { downloads } from "../pictures/download.js";
import { on_paper } from "../print.js";
import { colour, is_dark, on_theme } from "../theme.js";
import { aligned } from "./aligned.js";
import { decade_text, decades_to_one, log_axis } from "./axis_steps.js";
import { chart_svg } from "./chart_svg.js";
import { colours_of, drawn_columns, unpacked } from "./curves.js";
import { draw_limits } from "./limits.js";
import { draw_strips_on, strips_height, strips_legend } from "./strips.js";
import { unit_of } from "./unit.js";

const curves_height = 280;
const saved_size = { width: 720, height: 400 };
const paper_size = { width: 520, height: 300 };
const font = "12px system-ui, sans-serif";
const crowds = [ // points in sight, at most; their size in CSS pixels, opacity
  [300, 5, 1],
  [3000, 3, 0.8],
  [Infinity, 2, 0.4],
];
const letter_width = 7; // of a figure on an axis, CSS pixels

/// Small squares instead of a path: there may be a hundred thousand.
function squares(plot, series, from, to) {
  const { ctx, data, bbox } = plot;
  const [x, y] = [data[0], data[series]];
  const [, css_size, opacity] = crowds.find(([most]) => to - from < most);
  const size = css_size * devicePixelRatio;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  ctx.fillStyle = plot.series[series].stroke(plot, series);
  ctx.globalAlpha = opacity;
  for (let i = from; i <= to; ++i) {
    if (y[i] == null) continue;
    const left = plot.valToPos(x[i], "x", true) - size / 2;
    const top = plot.valToPos(y[i], "y", true) - size / 2;
    ctx.fillRect(left, top, size, size);
  }
  ctx.restore();
  return null;
}

const paths = {
  line: uPlot.paths.linear(),
  steps: uPlot.paths.stepped({ align: 1 }),
  tail: uPlot.paths.stepped({ align: -1 }),
  points: squares,
};

/// All of x at first, marks too; what the reader zooms to afterwards.
function x_range(plot, low, high, marks) {
  const x = plot.data[0];
  if (low === null) return [0, 1];
  if (low !== x[0] || high !== x[x.length - 1]) return [low, high];
  const places = [low, high, ...marks.map(([at]) => at)];
  const [from, to] = [Math.min(...places), Math.max(...places)];
  const room = (to - from || Math.abs(to) || 1) * 0.03;
  return [from >= 0 ? Math.max(0, from - room) : from - room, to + room];
}

/// Shares end at 1, all else where uPlot likes; levels are in sight.
function y_range(plot, low, high, levels) {
  if (low === null) return [0, 1];
  high = Math.max(high, ...levels.map(([at]) => at));
  if (low >= 0 && high <= 1 && high > 0.99) return [0, 1.03];
  return uPlot.rangeNum(low, high, {
    min: { pad: 0.05, soft: 0, mode: 2 },
    max: { pad: 0.05, soft: 0, mode: 2 },
  });
}

/// Room for the longest of the figures beside an axis.
const width_of = (plot, texts) =>
  18 + letter_width * Math.max(3, ...(texts ?? []).map((text) => text?.length ?? 0));

function axis(label, size) {
  return {
    label,
    size,
    labelFont: font,
    font,
    labelSize: 22,
    stroke: colour("soft"),
    grid: { stroke: colour("line"), width: 1 },
    ticks: { stroke: colour("line"), width: 1, size: 4 },
  };
}

/// The legend: a button for each curve that shows or hides it.
function legend_of(block, colours, toggle) {
  const values = [];
  const entries = block.curves.map((curve, i) => {
    const value = element("output", {});
    const swatch = element("span.swatch" + (curve.dashed ? ".dashed" : ""), {});
    const paint = () => swatch.style.setProperty("--colour", colours[i]());
    paint();
    on_theme(paint);
    values.push(value);
    const flip = () => {
      const shown = button.getAttribute("aria-pressed") !== "true";
      button.setAttribute("aria-pressed", shown);
      toggle(i, shown);
    };
    const button = element(
      "button",
      { type: "button", "aria-pressed": "true", click: flip },
      swatch,
      curve.name,
      value,
    );
    return button;
  });
  return { shown: element("div.legend", {}, ...entries, ...strips_legend(block)), values };
}

const short = (x) => (x == null ? "" : Number(x.toPrecision(5)).toString());

/// What is drawn of a figure now, and its numbers.
class Shown {
  constructor(block) {
    this.block = block;
    this.colours = colours_of(block.curves);
    this.hidden = new Set();
    this.station = null;
    this.cumulative = false;
    this.columns = null;
  }

  get is_tail() {
    return this.block.curves.some(({ style }) => style === "tail");
  }

  get log() {
    return this.is_tail ? !this.cumulative : Boolean(this.block.log_y);
  }

  /// Labels as they are now.
  get labels() {
    const { block } = this;
    return this.is_tail && this.cumulative
      ? { ...block, y_label: block.y_label.replace("1 − F", "F") }
      : block;
  }

  /// @returns { x, y, low, high } of each curve.
  get drawn() {
    this.columns ??= this.block.curves.map(unpacked);
    return this.block.curves.map((curve, i) => drawn_columns(curve, this.columns[i], this));
  }

  style_of({ style }) {
    return style === "tail" && this.cumulative ? "steps" : style;
  }

  /// @returns all that is in sight, for a picture.
  get curves() {
    return this.drawn
      .map((columns, i) => {
        const curve = this.block.curves[i];
        return {
          ...columns,
          name: curve.name,
          dashed: curve.dashed,
          style: this.style_of(curve),
          paint: this.colours[i](),
        };
      })
      .filter((_, i) => !this.hidden.has(i));
  }

  /// @param alone  Whether title and legend are in it.
  picture({ width, height }, alone = false) {
    const { station, log } = this;
    const size = { width, height: height + strips_height(this.block) };
    return chart_svg(this.labels, this.curves, { ...size, log, alone, station });
  }

  /// @returns a line for each point: the curve's name, x, y and what else.
  get rows() {
    const { x_label, y_label } = this.labels;
    const rows = [["curve", x_label, y_label, "low", "high", "station"]];
    this.drawn.forEach(({ x, y, low, high, stations }, i) => {
      for (let k = 0; k < x.length; ++k)
        rows.push([this.block.curves[i].name, x[k], y[k], low?.[k], high?.[k], stations?.[k]]);
    });
    for (const [at, name] of this.labels.marks) rows.push([name, at, "", "", "", ""]);
    for (const [at, name] of this.labels.levels) rows.push([name, "", at, "", "", ""]);
    return rows;
  }
}

/// @returns the places of values that have a gap on either side; no line shows
/// them.
function lone_points(ys) {
  const own = [...ys.keys()].filter((i) => ys[i] !== undefined);
  const is_gap = (k) => (ys[own[k]] ?? null) === null;
  const places = own.filter((_, k) => !is_gap(k) && is_gap(k - 1) && is_gap(k + 1));
  return places.length ? places : null;
}

function series_of(shown, layout) {
  return layout.map(([i, role]) => {
    const curve = shown.block.curves[i];
    const line = role === "y";
    const dots = line && shown.style_of(curve) === "line";
    return {
      label: curve.name,
      show: !shown.hidden.has(i),
      stroke: line ? shown.colours[i] : () => "transparent",
      width: line ? 1.75 : 0,
      dash: curve.dashed ? [6, 4] : undefined,
      paths: line ? paths[shown.style_of(curve)] : paths.line,
      points: { show: false, filter: (u, k) => (dots ? lone_points(u.data[k]) : null), size: 4 },
      spanGaps: false,
    };
  });
}

function bands_of(shown, layout) {
  const all = [];
  layout.forEach(([i, role], k) => {
    if (role === "high")
      all.push({ series: [k + 1, k], fill: `${shown.colours[i]()}${is_dark() ? "38" : "2e"}` });
  });
  return all;
}

function scales_of(shown) {
  const { marks, levels } = shown.block;
  const ends = (low) => {
    if (shown.is_tail) return [low === null ? 0.1 : decades_to_one(low)[0], 1];
    return [shown.log_axis.low, shown.log_axis.high];
  };
  return {
    x: { time: false, range: (u, low, high) => x_range(u, low, high, marks) },
    y: shown.log
      ? { distr: 3, log: 10, range: (u, low) => ends(low) }
      : { range: (u, low, high) => y_range(u, low, high, levels) },
  };
}

function axes_of(shown) {
  const { x_label, y_label } = shown.labels;
  const of_decades = shown.log
    ? {
        splits: (u) => (shown.is_tail ? decades_to_one(u.scales.y.min) : shown.log_axis.steps),
        filter: (u, splits) => splits,
        values: (u, splits) => splits.map(decade_text),
      }
    : {};
  return [axis(x_label, 26), { ...axis(y_label, width_of), ...of_decades }];
}

/// The time of the drives, on charts by time; a click there goes to its time.
/// @param above  Pixels above the curves that are by time, too.
function follow_clock(space, plot_now, above) {
  const clock = hook.players.at(-1)?.clock;
  if (!clock) return () => {};
  const line = element("div.clock-line", { hidden: true });
  line.style.top = `${-above}px`;
  let pressed_at = null;
  space.addEventListener("pointerdown", (event) => (pressed_at = event.clientX), true);
  space.addEventListener("click", (event) => {
    const plot = plot_now();
    if (!plot || Math.abs(event.clientX - pressed_at) > 3) return;
    const left = event.clientX - plot.over.getBoundingClientRect().left;
    if (left >= 0 && left <= plot.over.clientWidth) clock.seek(plot.posToVal(left, "x"));
  });
  const show = () => {
    const plot = plot_now();
    if (!plot) return;
    const left = plot.valToPos(clock.time, "x");
    line.hidden = !(left >= 0 && left <= plot.over.clientWidth);
    line.style.transform = `translateX(${left}px)`;
    if (line.parentElement !== plot.over) plot.over.append(line);
  };
  clock.on_change(show);
  return show;
}

/// F or 1 − F.
function tail_choice(shown, redraw) {
  const flip = () => {
    shown.cumulative = !shown.cumulative;
    button.textContent = shown.cumulative ? "1 − F, log" : "F";
    redraw();
  };
  const button = element(
    "button",
    { type: "button", click: flip, title: "Show the distribution, or its tail on a logarithmic axis" },
    "F",
  );
  return button;
}

/// @returns { shown, of_station }: the figure, and what makes it show one
/// vehicle's points, or all for null.
export function figure_block(block) {
  const shown = new Shown(block);
  const strips = strips_height(block);
  const height = curves_height + strips;
  const space = element("div.chart", { role: "img", "aria-label": block.title });
  space.style.height = `${height}px`;
  let plot = null;
  let layout = []; // of the series: [curve, role]
  let values = []; // of the series, as they are

  const legend = legend_of(block, shown.colours, (i, yes) => {
    if (yes) shown.hidden.delete(i);
    else shown.hidden.add(i);
    layout.forEach(([curve], k) => {
      if (curve === i) plot?.setSeries(k + 1, { show: yes });
    });
  });
  const at_x = element("output.at");
  legend.shown.append(at_x);

  function load() {
    layout = [];
    const curves = shown.drawn.map((columns, i) => {
      const roles = ["y", "low", "high"].filter((role) => columns[role]);
      for (const role of roles) layout.push([i, role]);
      return { x: columns.x, columns: roles.map((role) => columns[role]) };
    });
    entry.points = Object.fromEntries(
      block.curves.map((curve, i) => [curve.name, curves[i].x.length]),
    );
    values = aligned(curves);
    if (!shown.log || shown.is_tail) return values;
    const [x, ...columns] = values;
    shown.log_axis = log_axis(columns);
    const { low } = shown.log_axis;
    return [x, ...columns.map((column) => column.map((y) => (y < low && y !== null ? low : y)))];
  }

  function show_values() {
    const { idx, idxs } = plot.cursor;
    const { x_label, y_label } = shown.labels;
    at_x.textContent = idx == null ? "" : `${short(plot.data[0][idx])}${unit_of(x_label)}`;
    layout.forEach(([i, role], k) => {
      if (role !== "y") return;
      const place = idxs?.[k + 1] ?? idx;
      legend.values[i].textContent =
        idx == null || place == null || values[k + 1][place] == null
          ? ""
          : `${short(values[k + 1][place])}${unit_of(y_label)}`;
    });
  }

  function draw() {
    const data = load();
    plot?.destroy();
    plot = null;
    plot = new uPlot(
      {
        width: Math.max(space.clientWidth, 100),
        height,
        legend: { show: false },
        scales: scales_of(shown),
        axes: axes_of(shown),
        padding: [8 + strips, 12, 0, 0],
        series: [{}, ...series_of(shown, layout)],
        bands: bands_of(shown, layout),
        cursor: {
          points: { size: 6 },
          hover: { skip: [null, undefined] },
          drag: { x: true, y: false },
        },
        hooks: {
          draw: [(u) => draw_limits(u, block), (u) => draw_strips_on(u, block, shown.station)],
          setCursor: [show_values],
          setScale: [() => show_time()],
          setSize: [() => show_time()],
        },
      },
      data,
      space,
    );
    entry.drawn = true;
    show_time();
  }
  const redraw = () => plot && draw();
  const show_time = block.by_clock ? follow_clock(space, () => plot, strips) : () => {};

  const entry = { title: block.title, drawn: false, points: null, draw };
  hook.charts.push(entry);
  new IntersectionObserver(
    (changes, observer) => {
      if (!changes.some((change) => change.isIntersecting)) return;
      observer.disconnect();
      if (!plot) draw();
    },
    { rootMargin: "300px" },
  ).observe(space);
  new ResizeObserver(() => {
    if (plot && space.clientWidth) plot.setSize({ width: space.clientWidth, height });
  }).observe(space);
  on_theme(redraw);

  const tools = downloads(block.title, {
    picture: () => shown.picture(saved_size, true),
    rows: () => shown.rows,
  });
  if (shown.is_tail) tools.prepend(tail_choice(shown, redraw));
  const whole = element(
    "figure",
    {},
    element(
      "div.head",
      {},
      block.title ? element("figcaption.title", {}, block.title) : null,
      tools,
    ),
    space,
    on_paper(element("div.on-paper", {}), () => shown.picture(paper_size)),
    legend.shown,
    block.caption ? element("p.note", {}, ...marked_up(block.caption)) : null,
  );
  return {
    shown: whole,
    of_station(station) {
      shown.station = station;
      redraw();
    },
  };
}
