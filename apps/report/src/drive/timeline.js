// Who planned for each vehicle and when: a strip per vehicle.
import { element } from "../element.js";
import { colour, on_theme, series_colour } from "../theme.js";
import { last_before } from "./drive.js";

const row_height = 24;
const strip_height = 10;
const thin_height = 3; // of further services, below
const gutter = 46; // for the stations
const rim = 18;
const axis_height = 22;
const steps = [1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1200, 1800, 3600, 7200, 14400];

export function clock_text(time) {
  const whole = Math.floor(time);
  const two = (x) => `${x}`.padStart(2, "0");
  const hours = Math.floor(whole / 3600);
  const rest = `${two(Math.floor(whole / 60) % 60)}:${two(whole % 60)}`;
  return hours ? `${hours}:${rest}` : rest;
}

export class Timeline {
  constructor(drive, clock) {
    this.drive = drive;
    this.clock = clock;
    this.canvas = element("canvas", {
      role: "img",
      "aria-label": `Offloading of each vehicle in ${drive.name}, by time`,
      pointerdown: (event) => this.press(event),
      pointermove: (event) => this.move(event),
      pointerleave: () => (this.tip.hidden = true),
    });
    this.cursor = element("div.cursor", {});
    this.tip = element("div.tip", { hidden: true });
    this.body = element("div.strips", {}, this.canvas, this.cursor, this.tip);
    this.shown = element("div.timeline", { tabindex: "-1" }, this.body);
    new ResizeObserver(() => this.resize()).observe(this.shown);
    on_theme(() => this.draw());
    clock.on_change(() => this.show_time());
  }

  get height() {
    return this.drive.stations.length * row_height + axis_height;
  }

  resize() {
    this.width = this.shown.clientWidth;
    if (!this.width) return;
    this.body.style.height = `${this.height}px`;
    this.canvas.width = Math.round(this.width * devicePixelRatio);
    this.canvas.height = Math.round(this.height * devicePixelRatio);
    this.draw();
    this.show_time();
  }

  left(time) {
    const span = this.width - gutter - rim;
    return gutter + (span * time) / (this.clock.until || 1);
  }

  time_at(event) {
    const box = this.canvas.getBoundingClientRect();
    const span = this.width - gutter - rim;
    return ((event.clientX - box.left - gutter) / span) * this.clock.until;
  }

  draw() {
    const context = this.canvas.getContext("2d");
    context.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    context.clearRect(0, 0, this.width, this.height);
    context.font = "11px system-ui, sans-serif";
    context.textBaseline = "middle";
    this.draw_axis(context);
    this.drive.stations.forEach((station, row) => this.draw_row(context, station, row));
    for (const alarm of this.drive.alarms) this.draw_alarm(context, alarm);
  }

  draw_axis(context) {
    const room = (this.width - gutter - rim) / 64; // labels that fit
    const step = steps.find((one) => this.clock.until / one <= room) ?? steps.at(-1);
    const bottom = this.height - axis_height;
    context.textAlign = "center";
    for (let time = 0; time <= this.clock.until; time += step) {
      const left = Math.round(this.left(time)) + 0.5;
      context.fillStyle = colour("line");
      context.fillRect(left - 0.5, 0, 1, bottom + 4);
      context.fillStyle = colour("soft");
      context.fillText(clock_text(time), left, bottom + 13);
    }
  }

  draw_row(context, station, row) {
    const { drive } = this;
    const top = row * row_height + 4;
    context.fillStyle = colour("soft");
    context.textAlign = "right";
    context.fillText(`${station}`, gutter - 8, top + strip_height / 2);
    const vehicle = drive.vehicles.find((one) => one.station === station);
    if (vehicle?.t.length)
      this.bar(context, vehicle.t[0], vehicle.t[vehicle.t.length - 1], top, strip_height, colour("strip"));
    for (const one of drive.offloadings) {
      if (one.station !== station) continue;
      const place = drive.services.indexOf(one.service);
      const paint = series_colour(drive.place_of(one.provider));
      if (place <= 0) this.bar(context, one.from, one.until, top, strip_height, paint);
      else {
        const lower = top + strip_height + 1 + (place - 1) * (thin_height + 1);
        this.bar(context, one.from, one.until, lower, thin_height, paint);
      }
    }
  }

  bar(context, from, until, top, height, paint) {
    const left = this.left(from);
    context.fillStyle = paint;
    context.fillRect(left, top, Math.max(this.left(until) - left, 1.5), height);
  }

  draw_alarm(context, alarm) {
    const row = this.drive.stations.indexOf(alarm.station);
    const left = this.left(alarm.t);
    context.fillStyle = colour("alarm");
    if (row < 0) {
      context.fillRect(left - 0.75, 0, 1.5, this.height - axis_height);
      return;
    }
    const top = row * row_height + 1;
    context.beginPath();
    context.moveTo(left - 4, top);
    context.lineTo(left + 4, top);
    context.lineTo(left, top + 7);
    context.fill();
  }

  show_time() {
    if (this.width) this.cursor.style.transform = `translateX(${this.left(this.clock.time)}px)`;
  }

  press(event) {
    this.canvas.setPointerCapture(event.pointerId);
    this.clock.seek(this.time_at(event));
  }

  move(event) {
    if (event.buttons & 1) this.clock.seek(this.time_at(event));
    const box = this.canvas.getBoundingClientRect();
    const row = Math.floor((event.clientY - box.top) / row_height);
    const time = this.time_at(event);
    const station = this.drive.stations[row];
    const planned = this.drive.planned.get(station) ?? [];
    const one = planned[last_before(planned.map(({ from }) => from), time)];
    this.tip.hidden = !one || time > one.until;
    if (this.tip.hidden) return;
    this.tip.textContent =
      `${station} at ${one.provider || "a provider"}, ` +
      `${one.from.toFixed(1)} to ${one.until.toFixed(1)} s`;
    const left = event.clientX - box.left;
    this.tip.classList.toggle("leftwards", left > this.width / 2);
    this.tip.style.left = `${left}px`;
    this.tip.style.top = `${row * row_height + row_height / 2}px`;
  }
}
