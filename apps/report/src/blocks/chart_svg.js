// A figure as SVG: on paper, and in a file.
import { picture, svg } from "../pictures/svg.js";
import { SvgContext } from "../pictures/svg_context.js";
import { colour } from "../theme.js";
import { decade_text, decades_to_one, log_axis, round_steps, short } from "./axis_steps.js";
import { draw_strips, legend_of_strips, strips_height } from "./strips.js";

const room = { right: 16, bottom: 46 };
const top_of = (block) => 12 + strips_height(block);
const letter = 6.6; // width, at 12 px
const line_height = 18;
const two = (x) => Number(x.toFixed(1));

function extremes(columns) {
  let [low, high] = [Infinity, -Infinity];
  for (const column of columns)
    for (const x of column ?? []) {
      if (x < low) low = x;
      if (x > high) high = x;
    }
  return [low, high];
}

/// From values to pixels, and where its axis has numbers.
function linear_scale(low, high, from, to, count) {
  const steps = round_steps(low, high, count);
  const [first, last] = [steps[0], steps[steps.length - 1]];
  return { steps, text: short, at: (x) => from + ((x - first) / (last - first)) * (to - from) };
}

function log_scale({ steps, low, high }, from, to) {
  const span = Math.log10(high / low);
  return {
    steps,
    text: decade_text,
    at: (x) => from + (Math.log10(Math.max(x, low) / low) / span) * (to - from),
  };
}

/// Shares end at 1.
function tail_axis(least) {
  const steps = decades_to_one(least);
  return { steps, low: steps[0], high: 1 };
}

function scales(block, curves, width, height, log) {
  const [low, high] = extremes(curves.flatMap(({ y, low: l, high: h }) => [y, l, h]));
  const levels = block.levels.map(([at]) => at);
  const [bottom, top] = [height - room.bottom, top_of(block)];
  const y = log
    ? log_scale(block.log_y ? log_axis(curves.map((one) => one.y)) : tail_axis(low), bottom, top)
    : linear_scale(Math.min(0, low, ...levels), Math.max(0, high, ...levels), bottom, top, 6);
  const left = 30 + letter * Math.max(...y.steps.map((step) => y.text(step).length));
  const [from, until] = extremes(curves.map((curve) => curve.x));
  const marks = block.marks.map(([at]) => at);
  const x = linear_scale(Math.min(from, ...marks), Math.max(until, ...marks), left, width - room.right, (width - left) / 90);
  return { x, y, left };
}

function axes(block, { x, y, left }, width, height) {
  const [top, bottom, right] = [top_of(block), height - room.bottom, width - room.right];
  const grid = (x1, x2, y1, y2) => svg("line", { x1, x2, y1, y2, stroke: colour("line") });
  const text = (x, y, anchor, what, more = {}) =>
    svg("text", { x, y, "text-anchor": anchor, fill: colour("soft"), "font-size": 12, ...more }, what);
  const middle = (top + bottom) / 2;
  return [
    ...x.steps.map((step) => grid(two(x.at(step)), two(x.at(step)), top, bottom)),
    ...y.steps.map((step) => grid(left, right, two(y.at(step)), two(y.at(step)))),
    ...x.steps.map((step) => text(two(x.at(step)), bottom + 16, "middle", x.text(step))),
    ...y.steps.map((step) => text(left - 6, two(y.at(step)) + 4, "end", y.text(step))),
    text((left + right) / 2, height - 10, "middle", block.x_label),
    text(0, 0, "middle", block.y_label, { transform: `translate(14 ${middle}) rotate(-90)` }),
  ];
}

/// @returns [first, behind] of each run of values without a gap.
function stretches_of(ys) {
  const all = [];
  ys.forEach((y, i) => {
    if (Number.isNaN(y)) return;
    const last = all[all.length - 1];
    if (last?.[1] === i) last[1] = i + 1;
    else all.push([i, i + 1]);
  });
  return all;
}

function corners(xs, ys, { x, y }) {
  return [...xs].map((at, i) => `${two(x.at(at))} ${two(y.at(ys[i]))}`);
}

/// Lines begin anew after a gap.
function line_path(xs, ys, scale) {
  return stretches_of(ys)
    .map(([from, until]) => `M${corners(xs.slice(from, until), ys.slice(from, until), scale).join("L")}`)
    .join("");
}

/// Values between two gaps, which no line shows.
function lone_points_path(xs, ys, scale) {
  return stretches_of(ys)
    .filter(([from, until]) => until === from + 1)
    .map(([at, until]) => `M${corners(xs.slice(at, until), ys.slice(at, until), scale)[0]}h0`)
    .join("");
}

/// An area for each stretch that has both ends.
function band_path(xs, lows, highs, scale) {
  return stretches_of(lows.map((low, i) => low + highs[i]))
    .map(([from, until]) => {
      const part = (of) => corners(xs.slice(from, until), of.slice(from, until), scale);
      return `M${[...part(highs), ...part(lows).reverse()].join("L")}Z`;
    })
    .join("");
}

/// @param ahead  Whether a value holds until its x, else from it on.
function steps_path(xs, ys, { x, y }, ahead) {
  let path = "";
  let [last_left, last_top] = [null, null];
  for (let i = 0; i < xs.length; ++i) {
    const [left, top] = [two(x.at(xs[i])), two(y.at(ys[i]))];
    if (left === last_left && i + 1 < xs.length) continue; // no wider than a pixel
    if (!path) path = `M${left} ${top}`;
    else if (ahead) path += `V${top}H${left}`;
    else path += `H${left}V${top}`;
    [last_left, last_top] = [left, top];
  }
  return last_top === null ? "" : path;
}

/// Points on the same half pixel are one.
function points_path(xs, ys, { x, y }) {
  const seen = new Set();
  for (let i = 0; i < xs.length; ++i)
    if (!Number.isNaN(ys[i]))
      seen.add(`M${Math.round(2 * x.at(xs[i])) / 2} ${Math.round(2 * y.at(ys[i])) / 2}h0`);
  return [...seen].join("");
}

function point_size(count) {
  if (count < 300) return 4;
  return count < 3000 ? 2.5 : 1.5;
}

function curve_elements(curve, scale) {
  const { x, y, low, high, style, dashed, paint } = curve;
  const stroke = { fill: "none", stroke: paint, "stroke-width": 1.75 };
  if (style === "points")
    return [
      svg("path", {
        ...stroke,
        d: points_path(x, y, scale),
        "stroke-width": point_size(x.length),
        "stroke-linecap": "round",
        "stroke-opacity": x.length < 3000 ? 0.9 : 0.6,
      }),
    ];
  if (style === "steps" || style === "tail")
    return [
      svg("path", {
        ...stroke,
        d: steps_path(x, y, scale, style === "tail"),
        "stroke-dasharray": dashed ? "6 4" : null,
      }),
    ];
  const area = low && high ? band_path(x, low, high, scale) : "";
  const dots = lone_points_path(x, y, scale);
  return [
    ...(area ? [svg("path", { d: area, fill: paint, "fill-opacity": 0.16 })] : []),
    svg("path", { ...stroke, d: line_path(x, y, scale), "stroke-dasharray": dashed ? "6 4" : null }),
    ...(dots
      ? [svg("path", { ...stroke, d: dots, "stroke-width": point_size(1), "stroke-linecap": "round" })]
      : []),
  ];
}

/// Limits, with their names.
function limit_elements(block, { x, y, left }, width, height) {
  const [top, bottom, right] = [top_of(block), height - room.bottom, width - room.right];
  const line = (x1, x2, y1, y2) =>
    svg("line", { x1, x2, y1, y2, stroke: colour("alarm"), "stroke-dasharray": "4 3" });
  const name = (x, y, anchor, what) =>
    svg("text", { x, y, "text-anchor": anchor, fill: colour("alarm"), "font-size": 12 }, what);
  return [
    ...block.marks.flatMap(([at, what], i) => {
      const place = two(x.at(at));
      const leftwards = place - left > (right - left) / 2;
      return [
        line(place, place, top, bottom),
        name(place + (leftwards ? -6 : 6), top + 14 + 17 * i, leftwards ? "end" : "start", what),
      ];
    }),
    ...block.levels.flatMap(([at, what]) => {
      const place = two(y.at(at));
      const below = place - top < line_height; // else it is cut off
      return [
        line(left, right, place, place),
        name(right - 4, place + (below ? 14 : -5), "end", what),
      ];
    }),
  ];
}

function strip_elements(block, station, { x, left }, width) {
  const context = new SvgContext();
  draw_strips(context, block, station, { left, right: width - room.right, at: x.at });
  return context.elements;
}

/// @returns entries and how many lines of them there are.
function legend_elements(curves, width, top) {
  const all = [];
  let [left, line] = [16, 0];
  for (const { name, paint, dashed } of curves) {
    const long = 30 + letter * name.length;
    if (left + long > width - room.right && left > 16) [left, line] = [16, line + 1];
    const middle = top + line * line_height + 8;
    all.push(
      svg("line", {
        x1: left, x2: left + 16, y1: middle, y2: middle,
        stroke: paint, "stroke-width": 3, "stroke-dasharray": dashed ? "5 3" : null,
      }),
      svg("text", { x: left + 22, y: middle + 4, fill: colour("ink"), "font-size": 12 }, name),
    );
    left += long + 14;
  }
  return { all, height: curves.length ? (line + 1) * line_height + 6 : 0 };
}

/// @param curves  As drawn: { name, style, dashed, paint, x, y, low, high }.
/// @param log     Whether y has a logarithmic axis.
/// @param alone   Whether title and legend are in the picture.
/// @param station Whose strips are above the curves.
export function chart_svg(
  block,
  curves,
  { width, height, log = false, alone = false, station = null },
) {
  const shown = curves.filter(({ x }) => x.length);
  const head = alone && block.title ? 28 : 0;
  const below = alone ? legend_elements([...curves, ...legend_of_strips(block)], width, head + height) : { all: [], height: 0 };
  const scale = shown.length ? scales(block, shown, width, height, log) : null;
  return picture(
    width,
    head + height + below.height,
    block.title,
    ...(alone ? [svg("rect", { width: "100%", height: "100%", fill: colour("panel") })] : []),
    ...(head
      ? [svg("text", { x: 16, y: 20, "font-size": 14, "font-weight": 620, fill: colour("ink") }, block.title)]
      : []),
    svg(
      "g",
      { transform: `translate(0 ${head})` },
      ...(scale
        ? [
            ...axes(block, scale, width, height),
            ...shown.flatMap((curve) => curve_elements(curve, scale)),
            ...limit_elements(block, scale, width, height),
            ...strip_elements(block, station, scale, width),
          ]
        : []),
    ),
    ...below.all,
  );
}
