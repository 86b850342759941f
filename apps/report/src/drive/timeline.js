// Who planned for each vehicle and when: a strip per vehicle.
import { element } from "../element.js";
import { downloads } from "../pictures/download.js";
import { SvgContext } from "../pictures/svg_context.js";
import { on_paper } from "../print.js";
import { colour, on_theme, series_colour } from "../theme.js";
import { last_before } from "./drive.js";
import { draw_mark } from "./event_groups.js";

const row_height = 24;
const strip_height = 10;
const thin_height = 3; // of further services, below
const link_height = 5; // of a service of a chain
const gutter = 46; // for the stations
const rim = 18;
const axis_height = 22;
const most_height = 384;
const paper_width = 680;
const paper_rows = 30; // of one picture, so that it fits on a sheet
const saved_width = 900;
const searched_from = 20; // rows
const steps = [1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1200, 1800, 3600, 7200, 14400];

export function clock_text(time) {
  const whole = Math.floor(time);
  const two = (x) => `${x}`.padStart(2, "0");
  const hours = Math.floor(whole / 3600);
  const rest = `${two(Math.floor(whole / 60) % 60)}:${two(whole % 60)}`;
  return hours ? `${hours}:${rest}` : rest;
}

export class Timeline {
  /// @param look  Is called with the station that the reader looks at.
  constructor(drive, clock, look) {
    this.drive = drive;
    this.clock = clock;
    this.look = look;
    this.rows = drive.stations;
    const { chain, services } = drive;
    /// Services from above: those of a chain are alike, else the first is broad.
    this.laid_out = [...chain, ...services.filter((one) => !chain.includes(one))];
    const heights = this.laid_out.map((_, i) => {
      if (i < chain.length) return link_height;
      return i ? thin_height : strip_height;
    });
    this.lanes = [[0, strip_height]];
    let lower = 0;
    heights.forEach((height, i) => {
      this.lanes[i] = [lower, height];
      lower += height + 1;
    });
    this.marked = new Map(drive.stations.map((station) => [station, []]));
    this.marked_of_all = [];
    for (const event of drive.marked)
      (this.marked.get(event.station) ?? this.marked_of_all).push(event);
    this.canvas = element("canvas", {
      role: "img",
      "aria-label": `Offloading of each vehicle in ${drive.name}, by time`,
      pointerdown: (event) => this.press(event),
      pointermove: (event) => this.move(event),
      pointerleave: () => (this.tip.hidden = true),
    });
    this.cursor = element("div.cursor", {});
    this.tip = element("div.tip", { hidden: true });
    // Only what is in sight is drawn: the window stays where it is while the
    // strips scroll.
    this.window = element("div.window", {}, this.canvas, this.cursor, this.tip);
    this.room = element("div.room", {}, this.window);
    this.strips = element("div.timeline", { scroll: () => this.draw() }, this.room);
    this.shown = element(
      "div",
      {},
      element(
        "div.head",
        {},
        drive.stations.length > searched_from ? this.search() : null,
        downloads(`Offloading of ${drive.name}`, {
          picture: () => this.picture(saved_width, this.rows),
          rows: () => this.table(),
        }),
      ),
      this.strips,
      on_paper(element("div.on-paper", {}), () => this.on_sheets()),
    );
    new ResizeObserver(() => this.resize()).observe(this.strips);
    on_theme(() => this.draw());
    drive.groups.on_change(() => this.draw());
    clock.on_change(() => this.show_time());
  }

  get rows_height() {
    return this.rows.length * row_height;
  }

  /// Leaves the stations that begin with what is written.
  search() {
    const field = element("input", {
      type: "search",
      inputmode: "numeric",
      placeholder: `one of ${this.drive.stations.length}`,
      input: () => {
        this.rows = this.drive.stations.filter((one) => `${one}`.startsWith(field.value.trim()));
        this.strips.scrollTop = 0;
        this.resize();
      },
    });
    return element("label.choice", {}, "vehicle ", field);
  }

  /// @returns a line for each offloading.
  table() {
    return [
      ["station", "service", "provider", "from_s", "until_s"],
      ...this.drive.offloadings.map((one) => [
        one.station, one.service, one.provider, one.from, one.until,
      ]),
    ];
  }

  /// @returns pictures of all strips, no more on each than a sheet has room for.
  on_sheets() {
    const { stations } = this.drive;
    const sheets = [];
    for (let from = 0; from < stations.length; from += paper_rows)
      sheets.push(this.picture(paper_width, stations.slice(from, from + paper_rows)));
    return sheets;
  }

  /// @returns the strips of some stations, as SVG.
  picture(width, stations) {
    const context = new SvgContext();
    context.font = "11px system-ui, sans-serif";
    const bottom = stations.length * row_height;
    const own = this.width;
    this.width = width;
    this.draw_strips(context, stations, bottom, 0);
    this.width = own;
    return context.picture(width, bottom + axis_height, `Offloading in ${this.drive.name}`);
  }

  resize() {
    this.width = this.strips.clientWidth;
    if (!this.width) return;
    this.height = Math.min(this.rows_height + axis_height, most_height);
    this.room.style.height = `${this.rows_height + axis_height}px`;
    this.window.style.height = `${this.height}px`;
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

  /// @returns the row at a place in the window.
  row_at(top) {
    return Math.floor((top + this.strips.scrollTop) / row_height);
  }

  draw() {
    if (!this.width) return;
    const context = this.canvas.getContext("2d");
    context.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    context.clearRect(0, 0, this.width, this.height);
    context.font = "11px system-ui, sans-serif";
    this.draw_strips(context, this.rows, this.height - axis_height, this.strips.scrollTop);
  }

  /// Draws those strips that are in sight.
  draw_strips(context, stations, bottom, scrolled) {
    context.textBaseline = "middle";
    this.draw_axis(context, bottom);
    context.save();
    context.beginPath();
    context.rect(0, 0, this.width, bottom);
    context.clip();
    const first = Math.floor(scrolled / row_height);
    const last = Math.min(Math.floor((bottom + scrolled) / row_height), stations.length - 1);
    for (let row = first; row <= last; ++row)
      this.draw_row(context, stations[row], row * row_height - scrolled);
    context.fillStyle = colour("alarm");
    for (const { t, group } of this.marked_of_all)
      if (this.drive.groups.shows(group)) context.fillRect(this.left(t) - 0.75, 0, 1.5, bottom);
    context.restore();
  }

  draw_axis(context, bottom) {
    const { until } = this.clock;
    const room = (this.width - gutter - rim) / 64; // labels that fit
    const step = steps.find((one) => until / one <= room) ?? until / room;
    context.textAlign = "center";
    for (let time = 0; time <= until; time += step) {
      const left = Math.round(this.left(time)) + 0.5;
      context.fillStyle = colour("line");
      context.fillRect(left - 0.5, 0, 1, bottom + 4);
      context.fillStyle = colour("soft");
      context.fillText(clock_text(time), left, bottom + 13);
    }
  }

  draw_row(context, station, row_top) {
    const { drive } = this;
    const top = row_top + 4;
    context.fillStyle = colour("soft");
    context.textAlign = "right";
    context.fillText(`${station}`, gutter - 8, top + strip_height / 2);
    const driven = drive.driven.get(station);
    for (const [lower, height] of this.lanes.slice(0, drive.chain.length || 1))
      if (driven) this.bar(context, driven, top + lower, height, colour("strip"));
    for (const { from, until, service, provider } of drive.offloaded.get(station)) {
      const [lower, height] = this.lanes[Math.max(0, this.laid_out.indexOf(service))];
      const paint = series_colour(drive.place_of(provider));
      this.bar(context, [from, until], top + lower, height, paint);
    }
    for (const { t, group } of this.marked.get(station))
      if (drive.groups.shows(group)) draw_mark(context, group, this.left(t), row_top + 1);
  }

  bar(context, [from, until], top, height, paint) {
    const left = this.left(from);
    context.fillStyle = paint;
    context.fillRect(left, top, Math.max(this.left(until) - left, 1.5), height);
  }

  show_time() {
    if (this.width) this.cursor.style.transform = `translateX(${this.left(this.clock.time)}px)`;
  }

  press(event) {
    this.canvas.setPointerCapture(event.pointerId);
    this.clock.seek(this.time_at(event));
    const top = event.clientY - this.canvas.getBoundingClientRect().top;
    const station = this.rows[this.row_at(top)];
    if (station !== undefined) this.look(station);
  }

  /// Seeks while the button is down; tells about the offloading below.
  move(event) {
    if (event.buttons & 1) this.clock.seek(this.time_at(event));
    const box = this.canvas.getBoundingClientRect();
    const [left, top] = [event.clientX - box.left, event.clientY - box.top];
    const time = this.time_at(event);
    const station = this.rows[this.row_at(top)];
    const planned = this.drive.planned.get(station) ?? [];
    const one = planned[last_before(planned.map(({ from }) => from), time)];
    this.tip.hidden = !one || time > one.until;
    if (this.tip.hidden) return;
    this.tip.textContent =
      `${station} at ${one.provider || "a provider"}, ` +
      `${one.from.toFixed(1)} to ${one.until.toFixed(1)} s`;
    this.tip.classList.toggle("leftwards", left > this.width / 2);
    this.tip.style.left = `${left}px`;
    this.tip.style.top = `${top}px`;
  }
}
