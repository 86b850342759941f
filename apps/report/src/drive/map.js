// The map of one drive: streets that stand, vehicles that move.
import { element } from "../element.js";
import { downloads } from "../pictures/download.js";
import { SvgContext } from "../pictures/svg_context.js";
import { on_paper } from "../print.js";
import { colour, on_theme } from "../theme.js";
import { draw_car, draw_rings } from "./cars.js";
import { draw_scenery, draw_text } from "./scenery.js";
import { clock_text } from "./timeline.js";
import { View, bounds_of } from "./view.js";

const reach = 18; // pixels from the pointer to a vehicle
const saved_width = 900;
const paper_width = 680;
const letter_width = 6.4; // of a station's digit, pixels

export class DriveMap {
  /// @param look  Is called with the station that the reader looks at.
  constructor(drive, clock, look) {
    this.drive = drive;
    this.clock = clock;
    this.look = look;
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
    // As high as the world needs at this width, but not higher than the CSS says.
    const { west, east, south, north } = this.view.bounds;
    this.ratio = (east - west) / (north - south);
    this.shown.style.aspectRatio = `${this.ratio}`;
    this.paper = on_paper(element("div.on-paper", {}), () => [
      element("p.note", {}, `At ${clock_text(clock.time)}.`),
      this.picture(paper_width),
    ]);
    this.tools = downloads(`Map of ${drive.name}`, { picture: () => this.picture(saved_width) });
    new ResizeObserver(() => this.resize()).observe(this.shown);
    on_theme(() => this.renew());
    drive.groups.on_change(() => this.draw());
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

  draw_streets() {
    draw_scenery(this.context(this.streets), this.view, this.drive);
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
    this.draw_vehicles(context, view, vehicles);
    this.show_tip(vehicles);
  }

  draw_vehicles(context, view, vehicles) {
    for (const vehicle of vehicles) draw_car(context, view, this.drive, vehicle, this.clock.time);
    if (this.labels) this.draw_labels(context, view, vehicles);
    draw_rings(context, view, this.drive, vehicles, this.clock);
  }

  /// Beside each vehicle, where no other label stands, nor a provider's.
  draw_labels(context, view, vehicles) {
    const taken = this.drive.providers.map(({ name, at: [x, y] }) => [
      view.left(x) - 6,
      view.top(y),
      17 + name.length * letter_width * 1.2,
    ]);
    for (const { station, x, y } of vehicles) {
      const text = `${station}`;
      const wide = text.length * letter_width;
      const [left, top] = [view.left(x), view.top(y)];
      const places = [
        [left + 10, top - 11],
        [left + 10, top + 12],
        [left - 10 - wide, top - 11],
        [left - 10 - wide, top + 12],
      ];
      const free = places.find(([a, b]) =>
        taken.every(([c, d, w]) => a + wide < c || c + w < a || Math.abs(b - d) > 12),
      );
      const [a, b] = free ?? places[0];
      taken.push([a, b, wide]);
      draw_text(context, text, a, b, "11px", colour("ink"));
    }
  }

  /// @returns all of the map as it is at this time, as SVG.
  picture(width) {
    const height = Math.round(Math.min(width / this.ratio, 1.2 * width));
    const view = new View(this.view.bounds);
    view.resize(width, height);
    const context = new SvgContext();
    draw_scenery(context, view, this.drive);
    this.draw_vehicles(context, view, this.drive.vehicles_at(this.clock.time));
    return context.picture(width, height, `Map of ${this.drive.name}`);
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
    this.tip.textContent =
      `${vehicle.station} · ${(vehicle.speed * 3.6).toFixed(0)} km/h · ` +
      this.drive.planned_text(vehicle, this.clock.time);
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
      this.look(station);
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
