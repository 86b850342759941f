// What moves on a map: vehicles, and rings round those that something befell.
import { colour, is_calm, series_colour } from "../theme.js";
import { event_groups } from "./event_groups.js";

// However far away a car is, it is as many pixels long; of many, fewer.
const smallest_car = 15;
const smallest_of = [
  [2000, 2],
  [100, 5],
]; // from so many cars on
const shapeless = 4; // pixels: shorter cars are dots
const ring_s = 1.4; // of the reader's time

function colour_of(vehicle, drive, time) {
  if (!vehicle.remote) return colour("local");
  return series_colour(drive.place_of(drive.planner_at(vehicle.station, time)));
}

function smallest_among(count) {
  return smallest_of.find(([many]) => count > many)?.[1] ?? smallest_car;
}

/// Draws a car as large as it is, or as can be seen: filled with its
/// provider's colour, hollow when it plans for itself.
export function draw_car(context, view, drive, vehicle, time) {
  const { front, rear, width } = drive.car;
  const length = front + rear;
  const least = smallest_among(drive.vehicles.length);
  const scale = Math.max(view.scale, least / length);
  // The middle stays in its place, however large the car is drawn.
  const to_middle = length / 2 - rear;
  const x = vehicle.x + to_middle * Math.cos(vehicle.heading);
  const y = vehicle.y + to_middle * Math.sin(vehicle.heading);
  const ink = colour_of(vehicle, drive, time);
  const [long, wide] = [length * scale, Math.max(width * scale, 0.45 * least)];
  if (long < shapeless) {
    context.fillStyle = ink;
    context.fillRect(view.left(x) - long / 2, view.top(y) - long / 2, long, long);
    return;
  }
  context.save();
  context.translate(view.left(x), view.top(y));
  context.rotate(-vehicle.heading);
  context.beginPath();
  context.roundRect(-long / 2, -wide / 2, long, wide, wide / 4);
  context.lineWidth = 3.5;
  context.strokeStyle = colour("panel");
  context.stroke();
  context.lineWidth = 1.5;
  context.strokeStyle = ink;
  context.fillStyle = vehicle.remote ? ink : colour("panel");
  context.fill();
  context.stroke();
  context.fillStyle = vehicle.remote ? colour("panel") : ink;
  context.fillRect(0.12 * long, -0.3 * wide, 0.16 * long, 0.6 * wide);
  context.restore();
}

function provider_of({ provider }, drive) {
  const found = drive.providers.find(({ name }) => name === provider);
  return found && { x: found.at[0], y: found.at[1] };
}

/// Draws a ring round whom an event concerned just now, the latest of each.
export function draw_rings(context, view, drive, vehicles, { time, speed }) {
  const lasts = ring_s * Math.max(speed, 1);
  const events = drive.marked_between(time - lasts, time);
  const latest = new Map(events.map((event) => [event.station || event.provider, event]));
  for (const event of latest.values()) {
    const at =
      vehicles.find(({ station }) => station === event.station) ?? provider_of(event, drive);
    if (!at) continue;
    const age = (time - event.t) / lasts;
    const { paint, quiet } = event_groups.find(({ key }) => key === event.group);
    context.strokeStyle = colour(paint);
    context.lineWidth = quiet ? 1.5 : 3;
    context.globalAlpha = 1 - age;
    context.beginPath();
    context.arc(view.left(at.x), view.top(at.y), is_calm() ? 16 : 10 + 18 * age, 0, 2 * Math.PI);
    context.stroke();
  }
  context.globalAlpha = 1;
}
