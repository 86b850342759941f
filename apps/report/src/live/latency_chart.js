// How late results were in the last minute, second by second: half of them, and
// the latest.
import { element } from "../element.js";
import { colour, on_theme } from "../theme.js";

const shown_s = 60;
const steps_ms = [20, 50, 100, 200, 500, 1000, 2000, 5000];
const [left, right, top, bottom] = [34, 8, 8, 18];

const middle_of = (sorted) => sorted[Math.floor((sorted.length - 1) / 2)];

export function latency_chart(drive, clock) {
  const canvas = element("canvas", { role: "img", "aria-label": "Latency of the last minute" });
  const note = element("p.note", {}, "No results of providers yet.");
  const points = []; // { t, half, worst }
  let second = { t: 0, all: [] };

  const close = ({ t, all }) => {
    if (!all.length) return;
    all.sort((a, b) => a - b);
    points.push({ t, half: middle_of(all), worst: all.at(-1) });
  };

  const hear = () => {
    const now = Math.floor(clock.heard);
    if (now !== second.t) {
      close(second);
      second = { t: now, all: [] };
    }
    for (const { latency } of drive.vehicles) if (latency !== null) second.all.push(latency);
    while (points.length && points[0].t < now - shown_s) points.shift();
  };

  const curve = (context, place, name) => {
    context.beginPath();
    let before = null;
    for (const point of points) {
      const [x, y] = place(point.t, point[name]);
      if (before !== null && point.t - before < 2) context.lineTo(x, y);
      else context.moveTo(x, y);
      before = point.t;
    }
    context.stroke();
  };

  const draw = () => {
    const { clientWidth: width, clientHeight: height } = canvas;
    if (!width || !height) return;
    canvas.width = Math.round(width * devicePixelRatio);
    canvas.height = Math.round(height * devicePixelRatio);
    const context = canvas.getContext("2d");
    context.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    const most = Math.max(...points.map(({ worst }) => worst), 1);
    const high = steps_ms.find((step) => step >= most) ?? most;
    const place = (t, ms) => [
      left + ((t - clock.heard + shown_s) / shown_s) * (width - left - right),
      top + (1 - Math.min(ms / high, 1)) * (height - top - bottom),
    ];
    context.font = "11px system-ui, sans-serif";
    context.textBaseline = "middle";
    context.lineWidth = 1;
    for (const share of [0, 0.5, 1]) {
      const [, y] = place(0, share * high);
      context.strokeStyle = colour("line");
      context.beginPath();
      context.moveTo(left, y);
      context.lineTo(width - right, y);
      context.stroke();
      context.fillStyle = colour("soft");
      context.textAlign = "right";
      context.fillText(`${share * high}`, left - 6, y);
    }
    context.textAlign = "left";
    context.fillText("60 s ago", left, height - 6);
    context.textAlign = "right";
    context.fillText("now, ms", width - right, height - 6);
    context.lineJoin = "round";
    context.strokeStyle = colour("near");
    curve(context, place, "worst");
    context.lineWidth = 1.75;
    context.strokeStyle = colour("accent");
    curve(context, place, "half");
  };

  const update = () => {
    const last = points.at(-1);
    if (last)
      note.textContent = `In the last second half of them took ${last.half.toFixed(0)} ms or less, the latest ${last.worst.toFixed(0)} ms.`;
    draw();
  };
  on_theme(draw);
  return { shown: element("div.latency", {}, canvas, note), hear, update };
}
