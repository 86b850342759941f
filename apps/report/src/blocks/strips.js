// Bars above the curves of a figure: where something of one vehicle was.
import { draw_mark } from "../drive/event_groups.js";
import { element } from "../element.js";
import { colour, on_theme, series_colour } from "../theme.js";

const head = 18; // CSS pixels, for whose strips they are
const row = 30;
const bar_top = 15; // in its row, below the name
const bar_height = 9;
const least_width = 1.5;
const gap = 4; // from where the curves begin to names
const font = "11px system-ui, sans-serif";

/// @returns the room that strips need above the curves; 0 without any.
export const strips_height = ({ strips }) => (strips ? head + row * strips.length + 6 : 0);

/// @returns what the colours of the strips mean: { name, paint }.
const places_of = ({ places = [] }) =>
  places.map(({ name, provider }) => ({
    name,
    paint: provider === undefined ? colour("street") : series_colour(provider),
  }));

const has_fallbacks = ({ strips }) => strips?.some(({ fallbacks }) => fallbacks.length);

/// @returns the same with what marks mean, for a picture.
export const legend_of_strips = (block) => [
  ...places_of(block),
  ...(has_fallbacks(block) ? [{ name: "▼ fallback", paint: colour("alarm") }] : []),
];

/// @param at  From x to pixels; what is not between `left` and `right` is left out.
export function draw_strips(context, block, station, { left, right, at }) {
  if (!block.strips) return;
  const places = places_of(block);
  context.font = font;
  context.textBaseline = "middle";
  context.fillStyle = colour("ink");
  context.textAlign = "left";
  context.fillText(`vehicle ${station}`, left + gap, head / 2);
  block.strips.forEach(({ name, stays, fallbacks }, i) => {
    const top = head + i * row;
    context.fillStyle = colour("soft");
    context.fillText(name.replaceAll("_", " "), left + gap, top + bar_top / 2);
    for (const [whose, from, until, place] of stays) {
      if (whose !== station) continue;
      const [begin, end] = [Math.max(at(from), left), Math.min(at(until), right)];
      if (begin >= right || end <= left) continue;
      context.fillStyle = places[place].paint;
      context.fillRect(begin, top + bar_top, Math.max(end - begin - 0.5, least_width), bar_height);
    }
    for (const [whose, x] of fallbacks) {
      const place = at(x);
      if (whose === station && place >= left && place <= right)
        draw_mark(context, "qos", place, top + bar_top);
    }
  });
}

/// Draws them above the curves of a plot of uPlot's.
export function draw_strips_on(plot, block, station) {
  const { ctx, bbox } = plot;
  const pixel = devicePixelRatio;
  ctx.save();
  ctx.scale(pixel, pixel);
  draw_strips(ctx, block, station, {
    left: bbox.left / pixel,
    right: (bbox.left + bbox.width) / pixel,
    at: (x) => plot.valToPos(x, "x", true) / pixel,
  });
  ctx.restore();
}

/// @returns what the strips' colours and marks mean.
export function strips_legend(block) {
  if (!block.strips) return [];
  const entries = block.places.map(({ name }, i) => {
    const swatch = element("span.swatch.bar", {});
    const repaint = () => swatch.style.setProperty("--colour", places_of(block)[i].paint);
    repaint();
    on_theme(repaint);
    return element("span.place", {}, swatch, name);
  });
  if (!has_fallbacks(block)) return entries;
  return [...entries, element("span.place", {}, element("span.fallback", {}, "▼"), "fallback")];
}
