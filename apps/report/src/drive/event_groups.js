// Kinds of events: what they are called, how they are marked, and which of them
// the reader wants to see.
import { colour } from "../theme.js";

/// In the order in which they are listed. What is `quiet` is not shown at
/// first: a near miss is a figure of traffic, not a failure of offloading.
export const event_groups = [
  { key: "qos", one: "QoS event", many: "QoS events", paint: "alarm", always: true },
  { key: "collision", one: "collision", many: "collisions", paint: "crash" },
  { key: "implausible", one: "implausible result", many: "implausible results", paint: "alarm" },
  { key: "lost", one: "lost connection", many: "lost connections", paint: "alarm" },
  { key: "near_miss", one: "near miss", many: "near misses", paint: "near", quiet: true, always: true },
  { key: "other", one: "other event", many: "other events", paint: "soft" },
];

export class EventGroups {
  constructor(events) {
    this.counts = new Map(event_groups.map(({ key }) => [key, 0]));
    for (const { group } of events) this.counts.set(group, this.counts.get(group) + 1);
    this.shown = new Set(event_groups.filter(({ quiet }) => !quiet).map(({ key }) => key));
    this.listeners = [];
  }

  /// @returns those that occur, and those whose absence is worth a word.
  get present() {
    return event_groups.filter(({ key, always }) => always || this.counts.get(key) > 0);
  }

  shows(key) {
    return this.shown.has(key);
  }

  show(key, yes) {
    if (yes) this.shown.add(key);
    else this.shown.delete(key);
    for (const listener of this.listeners) listener();
  }

  on_change(listener) {
    this.listeners.push(listener);
  }
}

/// Draws the mark of a group, 8 pixels wide, hanging from a place on a strip.
export function draw_mark(context, group, left, top) {
  const { paint } = event_groups.find(({ key }) => key === group);
  context.fillStyle = context.strokeStyle = colour(paint);
  context.lineWidth = 1.5;
  context.beginPath();
  if (group === "collision") {
    context.moveTo(left - 4, top);
    context.lineTo(left + 4, top + 8);
    context.moveTo(left + 4, top);
    context.lineTo(left - 4, top + 8);
    context.lineWidth = 2.5;
    context.stroke();
  } else if (group === "near_miss") {
    context.arc(left, top + 3.5, 3, 0, 2 * Math.PI);
    context.stroke();
  } else if (group === "lost") {
    context.fillRect(left - 3.5, top, 7, 7);
  } else {
    context.moveTo(left - 4, top);
    context.lineTo(left + 4, top);
    context.lineTo(left, top + 7);
    context.fill();
  }
}
