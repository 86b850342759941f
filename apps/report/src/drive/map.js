// The map of one drive: streets that stand, vehicles that move.
import { element } from "../element.js";
import { colour, is_calm, on_theme, series_colour } from "../theme.js";
import { View, bounds_of } from "./view.js";

const smallest_car = 15; // pixels long, however far away
const flash_s = 1.4; // of the reader's time
const reach = 18; // pixels from the pointer to a vehicle

export class DriveMap {
  constructor(drive, clock) {
    this.drive = drive;
    this.clock = clock;
    this.view = new View(bounds_of(drive));
    this.labels = drive.vehicles.length <= 12;
    this.followed = null;
    this.pointer = null;
    this.streets = document.createElement("canvas"); // drawn once per view
    this.canvas = element("canvas", {
      role: "img",
      "aria-label": `Map of ${drive.name}`,
      pointermove: (event) => this.move(event),
      pointerdown: (event) => this.press(event),
      pointerup: (event) => this.release(event),
      pointerleave: () => this.leave(),
      wheel: (event) => this.wheel(event),
    });
    this.tip = element("div.tip", { hidden: true });
    this.shown = element(
      "div.map",
      {},
      this.canvas,
      this.tip,
      element(
        "div.zoom",
        {},
        this.button("+", "Zoom in", () => this.view.zoom_by(1.6)),
        this.button("−", "Zoom out", () => this.view.zoom_by(1 / 1.6)),
        this.button("⤢", "Show all", () => {
          this.followed = null;
          this.view.fit();
        }),
      ),
    );
    new ResizeObserver(() => this.resize()).observe(this.shown);
    on_theme(() => this.renew());
    clock.on_change(() => this.draw());
  }

  button(text, name, act) {
    const click = () => {
      act();
      this.renew();
    };
    return element("button", { type: "button", "aria-label": name, title: name, click }, text);
  }

  show_labels(yes) {
    this.labels = yes;
    this.draw();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.shown;
    if (!width || !height) return;
    const pixel = devicePixelRatio;
    for (const canvas of [this.canvas, this.streets]) {
      canvas.width = Math.round(width * pixel);
      canvas.height = Math.round(height * pixel);
    }
    this.view.resize(width, height);
    this.renew();
  }

  /// Draws everything anew, streets included.
  renew() {
    this.canvas.style.touchAction = this.view.zoom > 1 ? "none" : "pan-y";
    this.draw_streets();
    this.draw();
  }

  context(canvas) {
    const context = canvas.getContext("2d");
    context.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    context.clearRect(0, 0, this.view.width, this.view.height);
    context.lineJoin = context.lineCap = "round";
    return context;
  }

  outline(context, corners) {
    context.beginPath();
    for (const [x, y] of corners) context.lineTo(this.view.left(x), this.view.top(y));
    context.closePath();
  }

  draw_streets() {
    const { drive, view } = this;
    const context = this.context(this.streets);
    drive.providers.forEach(({ area }, i) => {
      this.outline(context, area);
      context.globalAlpha = 0.09;
      context.fillStyle = series_colour(i);
      context.fill();
    });
    context.globalAlpha = 1;
    context.fillStyle = colour("house");
    for (const house of drive.houses) {
      this.outline(context, house);
      context.fill();
    }
    context.strokeStyle = colour("street");
    for (const { x, y, half_width } of drive.lanes) {
      context.lineWidth = Math.max(2 * half_width * view.scale, 1.5);
      context.beginPath();
      for (let i = 0; i < x.length; ++i) context.lineTo(view.left(x[i]), view.top(y[i]));
      context.stroke();
    }
    context.fillStyle = colour("soft");
    for (const obstacle of drive.obstacles) {
      this.outline(context, obstacle);
      context.fill();
    }
    drive.providers.forEach((provider, i) => this.draw_provider(context, provider, i));
  }

  draw_provider(context, { name, at, area, sensors }, i) {
    const { view } = this;
    context.strokeStyle = context.fillStyle = series_colour(i);
    context.lineWidth = 1.25;
    context.setLineDash([5, 4]);
    this.outline(context, area);
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
    this.text(context, name, left + 11, top, "600 12px", series_colour(i));
  }

  /// A text that stands out from what is below it.
  text(context, text, left, top, style, ink) {
    context.font = `${style} system-ui, sans-serif`;
    context.textBaseline = "middle";
    context.lineWidth = 3;
    context.strokeStyle = colour("panel");
    context.strokeText(text, left, top);
    context.fillStyle = ink;
    context.fillText(text, left, top);
  }

  colour_of(vehicle) {
    if (!vehicle.remote) return colour("local");
    const planner = this.drive.planner_at(vehicle.station, this.clock.time);
    return series_colour(this.drive.place_of(planner));
  }

  draw() {
    const { view, clock } = this;
    const vehicles = this.drive.vehicles_at(clock.time);
    const leader = vehicles.find(({ station }) => station === this.followed);
    if (leader && (leader.x !== view.x || leader.y !== view.y)) {
      view.centre(leader.x, leader.y);
      this.draw_streets();
    }
    const context = this.context(this.canvas);
    context.drawImage(this.streets, 0, 0, view.width, view.height);
    for (const vehicle of vehicles) this.draw_vehicle(context, vehicle);
    if (this.labels)
      for (const { station, x, y } of vehicles)
        this.text(context, `${station}`, view.left(x) + 10, view.top(y) - 11, "11px", colour("ink"));
    this.draw_flashes(context, vehicles);
    this.show_tip(vehicles);
  }

  draw_vehicle(context, vehicle) {
    const { front, rear, width } = this.drive.car;
    const length = front + rear;
    const scale = Math.max(this.view.scale, smallest_car / length);
    // The middle stays in its place, however large the car is drawn.
    const to_middle = length / 2 - rear;
    const x = vehicle.x + to_middle * Math.cos(vehicle.heading);
    const y = vehicle.y + to_middle * Math.sin(vehicle.heading);
    const paint = this.colour_of(vehicle);
    const [long, wide] = [length * scale, Math.max(width * scale, 7)];
    context.save();
    context.translate(this.view.left(x), this.view.top(y));
    context.rotate(-vehicle.heading);
    context.beginPath();
    context.roundRect(-long / 2, -wide / 2, long, wide, wide / 4);
    context.lineWidth = 3.5;
    context.strokeStyle = colour("panel");
    context.stroke();
    context.lineWidth = 1.5;
    context.strokeStyle = paint;
    context.fillStyle = vehicle.remote ? paint : colour("panel");
    context.fill();
    context.stroke();
    context.fillStyle = vehicle.remote ? colour("panel") : paint;
    context.fillRect(0.12 * long, -0.3 * wide, 0.16 * long, 0.6 * wide);
    context.restore();
  }

  draw_flashes(context, vehicles) {
    const { clock, drive, view } = this;
    const lasts = flash_s * Math.max(clock.speed, 1);
    const alarms = drive.alarms_between(clock.time - lasts, clock.time);
    const latest = new Map(alarms.map((alarm) => [alarm.station || alarm.provider, alarm]));
    for (const alarm of latest.values()) {
      const at =
        vehicles.find(({ station }) => station === alarm.station) ?? this.provider_at(alarm);
      if (!at) continue;
      const age = (clock.time - alarm.t) / lasts;
      context.globalAlpha = 1 - age;
      context.strokeStyle = colour("alarm");
      context.lineWidth = 3;
      context.beginPath();
      const radius = is_calm() ? 16 : 10 + 18 * age;
      context.arc(view.left(at.x), view.top(at.y), radius, 0, 2 * Math.PI);
      context.stroke();
      context.globalAlpha = 1;
    }
  }

  provider_at({ provider }) {
    const found = this.drive.providers.find(({ name }) => name === provider);
    return found && { x: found.at[0], y: found.at[1] };
  }

  nearest(vehicles, { x, y }) {
    let best = null;
    let least = reach;
    for (const vehicle of vehicles) {
      const away = Math.hypot(this.view.left(vehicle.x) - x, this.view.top(vehicle.y) - y);
      if (away < least) [best, least] = [vehicle, away];
    }
    return best;
  }

  show_tip(vehicles) {
    const vehicle = this.pointer && !this.dragged && this.nearest(vehicles, this.pointer);
    this.tip.hidden = !vehicle;
    this.canvas.style.cursor = vehicle ? "pointer" : this.view.zoom > 1 ? "grab" : "";
    if (!vehicle) return;
    const planner = this.drive.planner_at(vehicle.station, this.clock.time) || "remote";
    this.tip.textContent =
      `${vehicle.station} · ${(vehicle.speed * 3.6).toFixed(0)} km/h · ` +
      `planned ${vehicle.remote ? `by ${planner}` : "on board"}`;
    const left = this.view.left(vehicle.x);
    this.tip.classList.toggle("leftwards", left > this.view.width / 2);
    this.tip.style.left = `${left}px`;
    this.tip.style.top = `${this.view.top(vehicle.y)}px`;
  }

  place_in(event) {
    const box = this.canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  press(event) {
    this.pressed = this.place_in(event);
    this.dragged = false;
    if (this.view.zoom > 1) this.canvas.setPointerCapture(event.pointerId);
  }

  move(event) {
    const here = this.place_in(event);
    if (this.pressed && this.view.zoom > 1) {
      const [right, down] = [here.x - this.pressed.x, here.y - this.pressed.y];
      if (this.dragged || Math.hypot(right, down) > 4) {
        this.dragged = true;
        this.followed = null;
        const { view } = this;
        view.centre(view.x - right / view.scale, view.y + down / view.scale);
        this.pressed = here;
        this.pointer = here;
        this.renew();
        return;
      }
    }
    this.pointer = here;
    this.draw();
  }

  /// A click on a vehicle follows it.
  release(event) {
    if (this.pressed && !this.dragged) {
      const here = this.place_in(event);
      const vehicle = this.nearest(this.drive.vehicles_at(this.clock.time), here);
      if (vehicle) this.follow(vehicle);
    }
    this.pressed = null;
    this.dragged = false;
  }

  follow({ station }) {
    if (this.followed === station) {
      this.followed = null;
      this.view.fit();
    } else {
      this.followed = station;
      const wanted = 4; // pixels per metre
      if (this.view.scale < wanted) this.view.zoom_by(wanted / this.view.scale);
    }
    this.renew();
  }

  leave() {
    this.pointer = this.pressed = null;
    this.draw();
  }

  /// The wheel scrolls the page; with Ctrl, or two fingers, it zooms.
  wheel(event) {
    if (!event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    this.view.zoom_by(Math.exp(-event.deltaY / 300), this.place_in(event));
    this.renew();
  }
}
