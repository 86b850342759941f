// Named points of a plane, as SVG: few enough to call each by its name.
import { element, marked_up } from "../element.js";
import { hook } from "../hook.js";
import { downloads } from "../pictures/download.js";
import { picture, standalone, svg } from "../pictures/svg.js";
import { on_print } from "../print.js";
import { round_steps, short } from "./axis_steps.js";
import { unit_of } from "./unit.js";

const height = 420;
const room = { left: 64, right: 20, top: 16, bottom: 48 };
const radius = 5;
const letter = { width: 6.6, height: 15 }; // at 12 px
const most_names = 3; // of dots that lie upon each other

/// @returns "1.5 (1.2 to 1.9) ms", the interval if there is one.
function value_text(value, interval, label) {
  const between = interval ? ` (${short(interval[0])} to ${short(interval[1])})` : "";
  return `${short(value)}${between}${unit_of(label)}`;
}

/// All figures along an axis, ends of intervals too.
const values_along = (dots, axis) =>
  dots.flatMap((dot) => [dot[axis], ...(dot[`${axis}_interval`] ?? [])]);

/// From figures to pixels; zero is in sight.
function scale_of(values, from, to, count) {
  const steps = round_steps(Math.min(0, ...values), Math.max(0, ...values), count);
  const [low, high] = [steps[0], steps[steps.length - 1]];
  return { steps, at: (x) => from + ((x - low) / (high - low)) * (to - from) };
}

const touch = (a, b) =>
  a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;

const box_round = ({ x, y }, by) => ({ left: x - by, right: x + by, top: y - by, bottom: y + by });

/// Dots that lie upon each other share a name.
function crowds_of(dots) {
  const crowds = [];
  for (const dot of dots) {
    const near = crowds.find(
      (crowd) => Math.hypot(crowd.x - dot.x, crowd.y - dot.y) < radius,
    );
    if (near) near.names.push(dot.name);
    else crowds.push({ x: dot.x, y: dot.y, names: [dot.name] });
  }
  return crowds;
}

function text_of({ names }) {
  const more = names.length - most_names;
  return names.slice(0, most_names).join(", ") + (more > 0 ? ` and ${more} more` : "");
}

/// Where the middle of a name may be, the best place first.
function* places_for({ x, y }, width) {
  for (let away = radius + 5; away < 130; away += letter.height) {
    const aside = away + width / 2;
    yield { x: x + aside, y };
    yield { x: x - aside, y };
    for (const down of [-1, 1])
      for (const to_the_right of [0, 1, -1])
        yield {
          x: x + to_the_right * (width / 2 + radius),
          y: y + down * (away + letter.height / 3),
        };
  }
}

/// @returns the first of these places whose box is inside the frame and touches
/// none of `taken`; null if there is none.
function free_place(crowd, half, width, taken) {
  for (const { x, y } of places_for(crowd, 2 * half.x)) {
    const box = { left: x - half.x, right: x + half.x, top: y - half.y, bottom: y + half.y };
    const inside =
      box.left >= room.left + 2 &&
      box.right <= width - room.right &&
      box.top >= 0 &&
      box.bottom <= height - room.bottom - 2;
    if (inside && !taken.some((other) => touch(box, other))) return { x, y, box };
  }
  return null;
}

/// Names that neither cover each other nor a dot, nor the line unless they
/// must; who finds no place has none.
function named(crowds, line, width) {
  const taken = crowds.map((crowd) => box_round(crowd, radius + 1));
  const all = [];
  for (const crowd of crowds) {
    const text = text_of(crowd);
    const half = { x: (text.length * letter.width) / 2, y: letter.height / 2 };
    const place =
      free_place(crowd, half, width, [...taken, ...line]) ?? free_place(crowd, half, width, taken);
    if (!place) continue;
    taken.push(place.box);
    all.push({ text, crowd, ...place });
  }
  return all;
}

/// From the dot to a name that is not beside it.
function leader_of({ box, crowd }) {
  const x = Math.min(Math.max(crowd.x, box.left), box.right);
  const y = Math.min(Math.max(crowd.y, box.top), box.bottom);
  if (Math.hypot(x - crowd.x, y - crowd.y) < 2.5 * radius) return [];
  return [svg("line", { class: "leader", x1: crowd.x, y1: crowd.y, x2: x, y2: y })];
}

function axes(block, x, y, width) {
  const bottom = height - room.bottom;
  const right = width - room.right;
  return [
    ...x.steps.map((step) =>
      svg("line", { class: "grid", x1: x.at(step), x2: x.at(step), y1: room.top, y2: bottom }),
    ),
    ...y.steps.map((step) =>
      svg("line", { class: "grid", x1: room.left, x2: right, y1: y.at(step), y2: y.at(step) }),
    ),
    ...x.steps.map((step) =>
      svg("text", { class: "tick", x: x.at(step), y: bottom + 17, "text-anchor": "middle" }, short(step)),
    ),
    ...y.steps.map((step) =>
      svg("text", { class: "tick", x: room.left - 8, y: y.at(step) + 4, "text-anchor": "end" }, short(step)),
    ),
    svg(
      "text",
      { class: "axis", x: (room.left + right) / 2, y: height - 8, "text-anchor": "middle" },
      block.x_label,
    ),
    svg(
      "text",
      {
        class: "axis",
        transform: `translate(14 ${(room.top + bottom) / 2}) rotate(-90)`,
        "text-anchor": "middle",
      },
      block.y_label,
    ),
  ];
}

/// What nobody beats: to the right at a height, then up.
/// @returns the corners of that line.
function steps_through(dots, right) {
  const next = (i) => dots[i + 1]?.x ?? right;
  return dots.flatMap(({ x, y }, i) => [{ x, y }, { x: next(i), y }]);
}

const line_through = (corners) =>
  corners.length
    ? [svg("path", { class: "front", d: `M${corners.map(({ x, y }) => `${x} ${y}`).join("L")}` })]
    : [];

/// @returns a box round each part of a line.
const boxes_of = (corners) =>
  corners.slice(1).map((to, i) => ({
    left: Math.min(corners[i].x, to.x) - 1,
    right: Math.max(corners[i].x, to.x) + 1,
    top: Math.min(corners[i].y, to.y) - 1,
    bottom: Math.max(corners[i].y, to.y) + 1,
  }));

/// Bars as long as the intervals.
function interval_bars({ of, x, y }, scale) {
  const bar = (x1, x2, y1, y2) => svg("line", { class: "interval", x1, x2, y1, y2 });
  return [
    ...(of.x_interval ? [bar(...of.x_interval.map(scale.x.at), y, y)] : []),
    ...(of.y_interval ? [bar(x, x, ...of.y_interval.map(scale.y.at))] : []),
  ];
}

function dot_mark(dot, { x_label, y_label }) {
  const { x, y, x_interval, y_interval } = dot.of;
  const says = svg(
    "title",
    {},
    `${dot.name}: ${value_text(x, x_interval, x_label)}; ${value_text(y, y_interval, y_label)}`,
  );
  return svg(
    "circle",
    { class: dot.of.hollow ? "hollow" : dot.best ? "best" : "", cx: dot.x, cy: dot.y, r: radius },
    says,
  );
}

function drawing(block, width) {
  const x = scale_of(values_along(block.dots, "x"), room.left, width - room.right, width / 110);
  const y = scale_of(values_along(block.dots, "y"), height - room.bottom, room.top, 6);
  const best = new Set(block.joined);
  const dots = block.dots.map((of, i) => ({
    of,
    name: of.name,
    x: x.at(of.x),
    y: y.at(of.y),
    best: best.has(i),
  }));
  // The best are named first, while there is room.
  const order = [...block.joined, ...dots.keys()].filter((n, i, all) => all.indexOf(n) === i);
  const line = steps_through(
    block.joined.map((i) => dots[i]),
    width - room.right,
  );
  const names = named(crowds_of(order.map((i) => dots[i])), boxes_of(line), width);
  return picture(
    width,
    height,
    block.title,
    ...axes(block, x, y, width),
    ...line_through(line),
    ...names.flatMap(leader_of),
    ...dots.flatMap((dot) => interval_bars(dot, { x, y })),
    ...order.reverse().map((i) => dot_mark(dots[i], block)),
    ...names.map(({ text, x: at, y: height_of_middle }) =>
      svg("text", { class: "name", x: at, y: height_of_middle + 4, "text-anchor": "middle" }, text),
    ),
  );
}

const paper_width = 680;

export function scatter_block(block) {
  const space = element("div.scatter", {});
  const draw = () => space.replaceChildren(drawing(block, Math.max(space.clientWidth, 280)));
  const entry = { title: block.title, drawn: false, points: { dots: block.dots.length }, draw };
  hook.charts.push(entry);
  new ResizeObserver(() => {
    if (!space.clientWidth) return;
    draw();
    entry.drawn = true;
  }).observe(space);
  on_print(() => space.replaceChildren(drawing(block, paper_width)), draw);
  return element(
    "figure.alone",
    {},
    element(
      "div.head",
      {},
      block.title ? element("figcaption.title", {}, block.title) : null,
      downloads(block.title, {
        picture: () => standalone(space.firstChild),
        rows: () => [
          ["name", block.x_label, block.y_label, "x low", "x high", "y low", "y high"],
          ...block.dots.map(({ name, x, y, x_interval: a, y_interval: b }) => [
            name, x, y, a?.[0], a?.[1], b?.[0], b?.[1],
          ]),
        ],
      }),
    ),
    space,
    block.caption ? element("p.note", {}, ...marked_up(block.caption)) : null,
  );
}
