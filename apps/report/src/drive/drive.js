// One run: where its vehicles are at any time, and who plans for them.
import { unpack } from "../unpack.js";
import { EventGroups } from "./event_groups.js";

/// @returns the last index whose value is not after `x`; -1 for none.
export function last_before(column, x) {
  let low = 0;
  let high = column.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (column[middle] <= x) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

function vehicle_from({ station, ...columns }) {
  const vehicle = { station };
  for (const [name, column] of Object.entries(columns)) vehicle[name] = unpack(column);
  const count = vehicle.t.length;
  vehicle.period = count > 1 ? (vehicle.t[count - 1] - vehicle.t[0]) / (count - 1) : 0;
  return vehicle;
}

/// @returns lanes of what `lanes_json` of a report has packed.
export function lanes_from({ counts, half_widths, x, y }) {
  const [all_x, all_y] = [unpack(x), unpack(y)];
  const widths = unpack(half_widths);
  let at = 0;
  return Array.from(unpack(counts), (count, i) => {
    const from = at;
    at += count;
    return { half_width: widths[i], x: all_x.subarray(from, at), y: all_y.subarray(from, at) };
  });
}

export class Drive {
  constructor(block) {
    Object.assign(this, block);
    this.lanes = lanes_from(block.lanes);
    this.vehicles = block.vehicles.map(vehicle_from);
    this.offloadings = block.offloadings.map(([station, service, provider, from, until]) => ({
      station, service, provider, from, until,
    }));
    this.events = block.events.map(
      ([t, what, station, provider, service, detail, group]) => ({
        t, what, station, provider, service, detail, group,
      }),
    );
    this.groups = new EventGroups(this.events);
    this.marked = this.events.filter(({ group }) => group !== "other");
    this.marked_times = this.marked.map((event) => event.t);
    this.stations = [
      ...new Set([
        ...this.vehicles.map((vehicle) => vehicle.station),
        ...this.offloadings.map((one) => one.station),
      ]),
    ].sort((a, b) => a - b);
    // Trajectories are what a vehicle's colour is about.
    this.chain ??= [];
    this.planner = this.chain.at(-1) ?? this.services[0] ?? "";
    this.offloaded = new Map(this.stations.map((station) => [station, []]));
    for (const one of this.offloadings) this.offloaded.get(one.station).push(one);
    this.planned = new Map();
    for (const [station, all] of this.offloaded)
      this.planned.set(station, all.filter(({ service }) => service === this.planner));
    this.driven = new Map(
      this.vehicles.map(({ station, t }) => [station, [t[0], t[t.length - 1]]]),
    );
  }

  /// @returns the place of a provider in the configuration; 0 for others.
  place_of(provider) {
    return Math.max(0, this.providers.findIndex(({ name }) => name === provider));
  }

  /// @returns the provider that plans for a station; "" for none that is known.
  planner_at(station, time) {
    // The track may say remote a moment before or after the switch.
    const slack = 0.2;
    const one = this.planned
      .get(station)
      .find(({ from, until }) => from - slack <= time && time <= until + slack);
    return one?.provider ?? "";
  }

  /// @returns who plans for a vehicle, for readers.
  planned_text({ station, remote }, time) {
    return `planned ${remote ? `by ${this.planner_at(station, time) || "remote"}` : "on board"}`;
  }

  /// @returns where a vehicle is; null before its first line and after its
  /// last one.
  vehicle_at(vehicle, time) {
    const { t, x, y, heading, speed, remote, period } = vehicle;
    const i = last_before(t, time);
    const next = Math.min(i + 1, t.length - 1);
    if (next < 0 || time < t[0] - period || time > t[t.length - 1] + 2 * period) return null;
    const from = Math.max(i, 0);
    const step = t[next] - t[from];
    const share = step > 0 ? (time - t[from]) / step : 0;
    const between = (column) => column[from] + share * (column[next] - column[from]);
    return {
      station: vehicle.station,
      x: between(x),
      y: between(y),
      heading: between(heading),
      speed: between(speed),
      remote: remote[from] === 1,
    };
  }

  vehicles_at(time) {
    return this.vehicles
      .map((vehicle) => this.vehicle_at(vehicle, time))
      .filter((vehicle) => vehicle !== null);
  }

  /// @returns events of (from, until] that the reader wants to see marked.
  marked_between(from, until) {
    return this.marked
      .slice(last_before(this.marked_times, from) + 1, last_before(this.marked_times, until) + 1)
      .filter(({ group }) => this.groups.shows(group));
  }
}
