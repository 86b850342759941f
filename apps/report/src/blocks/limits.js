// Limits on a chart: lines with their names.
import { colour } from "../theme.js";

const letter_height = 16; // CSS pixels

/// Draws vertical lines, with their names below each other where they are
/// close, and horizontal ones.
export function draw_limits(plot, { marks, levels }) {
  const { ctx, bbox } = plot;
  const pixel = devicePixelRatio;
  const right = bbox.left + bbox.width;
  ctx.save();
  ctx.strokeStyle = ctx.fillStyle = colour("alarm");
  ctx.lineWidth = pixel;
  ctx.setLineDash([4 * pixel, 3 * pixel]);
  ctx.font = `${12 * pixel}px system-ui, sans-serif`;
  const line = (...ends) => {
    ctx.beginPath();
    ctx.moveTo(ends[0], ends[1]);
    ctx.lineTo(ends[2], ends[3]);
    ctx.stroke();
  };
  ctx.textBaseline = "top";
  marks.forEach(([at, name], i) => {
    const x = Math.round(plot.valToPos(at, "x", true));
    if (x < bbox.left || x > right) return;
    line(x, bbox.top, x, bbox.top + bbox.height);
    const left = x - bbox.left > bbox.width / 2;
    ctx.textAlign = left ? "right" : "left";
    ctx.fillText(name, x + (left ? -6 : 6) * pixel, bbox.top + (0.3 + i * 1.4) * 12 * pixel);
  });
  ctx.textAlign = "right";
  for (const [at, name] of levels) {
    const y = Math.round(plot.valToPos(at, "y", true));
    if (y < bbox.top || y > bbox.top + bbox.height) continue;
    line(bbox.left, y, right, y);
    const below = y - bbox.top < letter_height * pixel; // else it is cut off
    ctx.textBaseline = below ? "top" : "bottom";
    ctx.fillText(name, right - 4 * pixel, y + (below ? 4 : -2) * pixel);
  }
  ctx.restore();
}
