// A figure: drawn when it comes into sight, drawn anew when the theme changes.
import uPlot from "uplot";
import { element, marked_up } from "../element.js";
import { hook } from "../hook.js";
import { colour, is_dark, on_theme, series_colour } from "../theme.js";
import { unpack } from "../unpack.js";
import { aligned } from "./aligned.js";

const height = 280;
const font = "12px system-ui, sans-serif";
const crowds = [ // points in sight, at most; their size in CSS pixels, opacity
  [300, 5, 1],
  [3000, 3, 0.8],
  [Infinity, 2, 0.4],
];
const letter_width = 7; // of a figure on an axis, CSS pixels

/// Curves take colours in their order. Somebody else's, dashed, share those of
/// ours; a single one, a limit perhaps, is grey.
function colours_of(curves) {
  const dashed = curves.filter((curve) => curve.dashed);
  const solid = curves.filter((curve) => !curve.dashed);
  return curves.map((curve) => {
    if (curve.dashed && dashed.length === 1) return () => colour("soft");
    const place = (curve.dashed ? dashed : solid).indexOf(curve);
    return () => series_colour(place);
  });
}

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
  points: squares,
};

/// Vertical lines with their names, below each other where they are close.
function draw_marks(plot, marks) {
  const { ctx, bbox } = plot;
  const pixel = devicePixelRatio;
  ctx.save();
  ctx.strokeStyle = ctx.fillStyle = colour("alarm");
  ctx.lineWidth = pixel;
  ctx.setLineDash([4 * pixel, 3 * pixel]);
  ctx.font = `${12 * pixel}px system-ui, sans-serif`;
  ctx.textBaseline = "top";
  marks.forEach(([at, name], i) => {
    const x = Math.round(plot.valToPos(at, "x", true));
    if (x < bbox.left || x > bbox.left + bbox.width) return;
    ctx.beginPath();
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    ctx.stroke();
    const left = x - bbox.left > bbox.width / 2;
    ctx.textAlign = left ? "right" : "left";
    const lower = bbox.height - (1.8 + i * 1.4) * 12 * pixel;
    ctx.fillText(name, x + (left ? -6 : 6) * pixel, bbox.top + lower);
  });
  ctx.restore();
}

/// All of x at first, marks too; what the reader zooms to afterwards.
function x_range(plot, low, high, marks) {
  const x = plot.data[0];
  if (low === null || low !== x[0] || high !== x[x.length - 1]) return [low, high];
  const places = [low, high, ...marks.map(([at]) => at)];
  const [from, to] = [Math.min(...places), Math.max(...places)];
  const room = (to - from || Math.abs(to) || 1) * 0.03;
  return [from >= 0 ? Math.max(0, from - room) : from - room, to + room];
}

/// Shares end at 1, all else where uPlot likes.
function y_range(plot, low, high) {
  if (low === null) return [0, 1];
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
  return { shown: element("div.legend", {}, ...entries), values };
}

const short = (x) => (x == null ? "" : Number(x.toPrecision(5)).toString());

export function figure_block(block) {
  const colours = colours_of(block.curves);
  const space = element("div.chart", { role: "img", "aria-label": block.title });
  space.style.height = `${height}px`;
  const hidden = new Set();
  let plot = null;
  let data = null;
  let layout = null; // of the series: [curve, role]

  const legend = legend_of(block, colours, (i, shown) => {
    if (shown) hidden.delete(i);
    else hidden.add(i);
    layout?.forEach(([curve], k) => {
      if (curve === i) plot?.setSeries(k + 1, { show: shown });
    });
  });
  const at_x = element("output.at");
  legend.shown.append(at_x);

  function load() {
    layout = [];
    const curves = block.curves.map((curve, i) => {
      const roles = curve.low ? ["y", "low", "high"] : ["y"];
      for (const role of roles) layout.push([i, role]);
      return { x: unpack(curve.x), columns: roles.map((role) => unpack(curve[role])) };
    });
    entry.points = Object.fromEntries(
      block.curves.map((curve, i) => [curve.name, curves[i].x.length]),
    );
    data = aligned(curves);
  }

  function series() {
    return layout.map(([i, role]) => {
      const { style, dashed, name } = block.curves[i];
      const line = role === "y";
      return {
        label: name,
        show: !hidden.has(i),
        stroke: line ? colours[i] : () => "transparent",
        width: line ? 1.75 : 0,
        dash: dashed ? [6, 4] : undefined,
        paths: line ? paths[style] : paths.line,
        points: { show: false },
        spanGaps: false,
      };
    });
  }

  function bands() {
    const all = [];
    layout.forEach(([i, role], k) => {
      if (role === "high")
        all.push({ series: [k + 1, k], fill: `${colours[i]()}${is_dark() ? "38" : "2e"}` });
    });
    return all;
  }

  function show_values() {
    const { idx, idxs } = plot.cursor;
    at_x.textContent = idx == null ? "" : `${short(plot.data[0][idx])}`;
    layout.forEach(([i, role], k) => {
      if (role !== "y") return;
      const place = idxs?.[k + 1] ?? idx;
      legend.values[i].textContent =
        idx == null || place == null ? "" : short(plot.data[k + 1][place]);
    });
  }

  function draw() {
    if (!data) load();
    plot?.destroy();
    plot = new uPlot(
      {
        width: Math.max(space.clientWidth, 100),
        height,
        legend: { show: false },
        scales: {
          x: { time: false, range: (u, low, high) => x_range(u, low, high, block.marks) },
          y: { range: y_range },
        },
        axes: [axis(block.x_label, 26), axis(block.y_label, width_of)],
        padding: [8, 12, 0, 0],
        series: [{}, ...series()],
        bands: bands(),
        cursor: {
          points: { size: 6 },
          hover: { skip: [null, undefined] },
          drag: { x: true, y: false },
        },
        hooks: {
          draw: [(u) => draw_marks(u, block.marks)],
          setCursor: [show_values],
        },
      },
      data,
      space,
    );
    entry.drawn = true;
  }

  const entry = { title: block.title, drawn: false, points: null, draw };
  hook.charts.push(entry);
  new IntersectionObserver(
    (changes, observer) => {
      if (!changes.some((change) => change.isIntersecting)) return;
      observer.disconnect();
      draw();
    },
    { rootMargin: "300px" },
  ).observe(space);
  new ResizeObserver(() => {
    if (plot && space.clientWidth) plot.setSize({ width: space.clientWidth, height });
  }).observe(space);
  on_theme(() => plot && draw());

  return element(
    "figure",
    {},
    block.title ? element("figcaption.title", {}, block.title) : null,
    space,
    legend.shown,
    block.caption ? element("p.note", {}, ...marked_up(block.caption)) : null,
  );
}
