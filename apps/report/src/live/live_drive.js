// A run that goes on: what its frames say, as the map wants it.
import { lanes_from } from "../drive/drive.js";
import { EventGroups } from "../drive/event_groups.js";

const kept_s = 4; // of where a car was
const kept_events = 200;
const beyond_s = 1; // of its last place a car goes on as it did

/// Who plans, besides providers by their places.
export const on_board = -1;
export const not_known = -2;

/// @returns the angle between two, the shorter way round.
const turn = (from, to) => Math.atan2(Math.sin(to - from), Math.cos(to - from));

function between(a, b, share) {
  const mixed = (name) => a[name] + share * (b[name] - a[name]);
  return {
    x: mixed("x"),
    y: mixed("y"),
    speed: mixed("speed"),
    heading: a.heading + share * turn(a.heading, b.heading),
  };
}

function beyond(last, seconds) {
  const way = last.speed * Math.min(seconds, beyond_s);
  return {
    x: last.x + way * Math.cos(last.heading),
    y: last.y + way * Math.sin(last.heading),
    speed: last.speed,
    heading: last.heading,
  };
}

export class LiveDrive {
  constructor(scene) {
    Object.assign(this, scene);
    this.lanes = lanes_from(scene.lanes);
    this.vehicles = [];
    this.tracks = new Map();
    this.events = []; // the newest first
    this.last_event = 0;
    this.groups = new EventGroups([]);
    this.loads = [];
    this.counts = {};
  }

  add({ cars, events, loads, counts }) {
    const there = new Set();
    for (const [station, t, x, y, heading, speed, place, latency] of cars) {
      there.add(station);
      const track = this.track_of(station);
      Object.assign(track, { place, latency });
      const last = track.samples.at(-1);
      if (last && t <= last.t) continue;
      track.samples.push({ t, x, y, heading, speed, place });
      while (track.samples.length > 2 && track.samples[0].t < t - kept_s) track.samples.shift();
    }
    for (const station of this.tracks.keys())
      if (!there.has(station)) this.tracks.delete(station);
    this.vehicles = [...this.tracks.values()];
    this.loads = loads;
    this.counts = counts;
    return this.hear(events);
  }

  /// @returns events that are new.
  hear(events) {
    const fresh = events
      .filter(([number]) => number > this.last_event)
      .map(([number, t, what, station, place, service, detail, group]) => ({
        number, t, what, station, service, detail, group,
        provider: this.providers[place]?.name ?? "",
      }));
    if (fresh.length) {
      this.last_event = fresh.at(-1).number;
      this.events.unshift(...[...fresh].reverse());
      this.events.length = Math.min(this.events.length, kept_events);
    }
    return fresh;
  }

  track_of(station) {
    if (!this.tracks.has(station)) this.tracks.set(station, { station, samples: [], x: [], y: [] });
    return this.tracks.get(station);
  }

  place_of(provider) {
    return Math.max(0, this.providers.findIndex(({ name }) => name === provider));
  }

  planner_at(station) {
    return this.providers[this.tracks.get(station)?.place]?.name ?? "";
  }

  /// @returns who plans, in a word.
  planner_text(place) {
    if (place === on_board) return "on board";
    if (place === not_known) return this.role === "provide" ? "not here" : "not known";
    return this.providers[place]?.name ?? "a provider";
  }

  planned_text({ station, remote }) {
    const text = this.planner_text(this.tracks.get(station)?.place);
    return `planned ${remote ? "by " : ""}${text}`;
  }

  vehicle_at({ station, samples }, time) {
    const next = samples.findIndex(({ t }) => t > time);
    if (next === 0 && samples[0].t > time + 1) return null;
    const from = samples.at(next > 0 ? next - 1 : next === 0 ? 0 : -1);
    const to = samples[next] ?? null;
    const at = to && to !== from ? between(from, to, (time - from.t) / (to.t - from.t))
      : beyond(from, Math.max(time - from.t, 0));
    const remote = from.place !== on_board && from.place !== not_known;
    return { station, ...at, remote };
  }

  vehicles_at(time) {
    return this.vehicles
      .map((vehicle) => this.vehicle_at(vehicle, time))
      .filter((vehicle) => vehicle !== null);
  }

  marked_between(from, until) {
    return this.events.filter(
      ({ t, group }) =>
        from < t && t <= until && group !== "other" && group !== "switch" && this.groups.shows(group),
    );
  }
}
