// What stands still on a map: areas, houses, streets, providers, the scale.
import { colour, series_colour } from "../theme.js";

const longest_bar = 120; // pixels, of the scale

function outline(context, view, corners) {
  context.beginPath();
  for (const [x, y] of corners) context.lineTo(view.left(x), view.top(y));
  context.closePath();
}

/// Draws a text that stands out from what is below it.
export function draw_text(context, text, left, top, style, ink) {
  context.font = `${style} system-ui, sans-serif`;
  context.textBaseline = "middle";
  context.lineWidth = 3;
  context.strokeStyle = colour("panel");
  context.strokeText(text, left, top);
  context.fillStyle = ink;
  context.fillText(text, left, top);
}

function draw_provider(context, view, { at, area, sensors }, ink) {
  context.strokeStyle = context.fillStyle = ink;
  context.lineWidth = 1.25;
  context.setLineDash([5, 4]);
  outline(context, view, area);
  context.stroke();
  context.setLineDash([]);
  for (const [x, y] of sensors) {
    context.beginPath();
    context.arc(view.left(x), view.top(y), 6, 0, 2 * Math.PI);
    context.stroke();
  }
  const [left, top] = [view.left(at[0]), view.top(at[1])];
  context.beginPath();
  context.moveTo(left, top - 6);
  context.lineTo(left + 6, top);
  context.lineTo(left, top + 6);
  context.lineTo(left - 6, top);
  context.fill();
}

const letter_width = 7.7; // of a provider's name, pixels
const line_height = 13;

/// Beside each provider, as long as no other name stands there.
function draw_names(context, view, providers) {
  const taken = [];
  providers.forEach(({ name, at }, i) => {
    const [left, top] = [view.left(at[0]) + 11, view.top(at[1])];
    const wide = name.length * letter_width;
    const is_free = taken.every(
      ([a, b, w]) => left + wide < a || a + w < left || Math.abs(top - b) >= line_height,
    );
    if (!is_free) return;
    taken.push([left, top, wide]);
    draw_text(context, name, left, top, "600 12px", series_colour(i));
  });
}

/// Draws a bar of a round number of metres.
function draw_scale(context, { scale, height }) {
  const most = longest_bar / scale;
  const decade = 10 ** Math.floor(Math.log10(most));
  const length = decade * [5, 2, 1].find((one) => one * decade <= most);
  context.fillStyle = colour("soft");
  context.fillRect(8, height - 10, length * scale, 2);
  const text = length < 1000 ? `${length} m` : `${length / 1000} km`;
  draw_text(context, text, 8, height - 20, "11px", colour("soft"));
}

const arrow_gap = 90; // pixels between two on a lane
const shortest_lane = 40; // pixels, with an arrow
const narrowest_lane = 3.5; // pixels, with arrows

/// Draws which way lanes go: an arrow in the middle of each stretch.
function draw_directions(context, view, { x, y, half_width }) {
  const half = Math.min(half_width * view.scale * 0.55, 4);
  if (2 * half_width * view.scale < narrowest_lane) return;
  const [left, top] = [Array.from(x, (one) => view.left(one)), Array.from(y, (one) => view.top(one))];
  const ways = left.map((_, i) => (i ? Math.hypot(left[i] - left[i - 1], top[i] - top[i - 1]) : 0));
  const length = ways.reduce((sum, way) => sum + way, 0);
  if (length < shortest_lane) return;
  const count = Math.max(1, Math.floor(length / arrow_gap));
  let passed = 0;
  let next = length / count / 2;
  for (let i = 1; i < left.length; ++i) {
    for (; passed + ways[i] >= next; next += length / count) {
      const share = (next - passed) / ways[i];
      const [dx, dy] = [(left[i] - left[i - 1]) / ways[i], (top[i] - top[i - 1]) / ways[i]];
      const a = left[i - 1] + share * (left[i] - left[i - 1]);
      const b = top[i - 1] + share * (top[i] - top[i - 1]);
      context.beginPath();
      context.moveTo(a - half * (dx + dy), b - half * (dy - dx));
      context.lineTo(a + half * dx, b + half * dy);
      context.lineTo(a - half * (dx - dy), b - half * (dy + dx));
      context.stroke();
    }
    passed += ways[i];
  }
}

export function draw_scenery(context, view, drive) {
  drive.providers.forEach(({ area }, i) => {
    outline(context, view, area);
    context.globalAlpha = 0.09;
    context.fillStyle = series_colour(i);
    context.fill();
  });
  context.globalAlpha = 1;
  context.fillStyle = colour("house");
  for (const house of drive.houses) {
    outline(context, view, house);
    context.fill();
  }
  context.strokeStyle = colour("street");
  for (const { x, y, half_width } of drive.lanes) {
    context.lineWidth = Math.max(2 * half_width * view.scale, 1.5);
    context.beginPath();
    for (let i = 0; i < x.length; ++i) context.lineTo(view.left(x[i]), view.top(y[i]));
    context.stroke();
  }
  context.strokeStyle = colour("arrow");
  context.lineWidth = 1.1;
  for (const lane of drive.lanes) draw_directions(context, view, lane);
  context.fillStyle = colour("soft");
  for (const obstacle of drive.obstacles) {
    outline(context, view, obstacle);
    context.fill();
  }
  drive.providers.forEach((provider, i) =>
    draw_provider(context, view, provider, series_colour(i)),
  );
  draw_names(context, view, drive.providers);
  draw_scale(context, view);
}
