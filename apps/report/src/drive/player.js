// Drives side by side under one clock, and what moves it.
import { element } from "../element.js";
import { hook } from "../hook.js";
import { on_theme, colour, series_colour } from "../theme.js";
import { Clock } from "./clock.js";
import { Drive } from "./drive.js";
import { event_groups } from "./event_groups.js";
import { event_list } from "./event_list.js";
import { DriveMap } from "./map.js";
import { Timeline, clock_text } from "./timeline.js";

const speeds = [1, 2, 5, 10, 20, 60];
const small_step = 1; // s, of an arrow key
const large_step = 10; // s, with Shift
const most_named = 12; // providers, in the legend

const players = []; // all of the page

function controls(clock, maps) {
  const play = element("button.play", {
    type: "button",
    click: () => clock.toggle(),
  });
  const slider = element("input", {
    type: "range",
    min: 0,
    max: clock.until,
    step: "any",
    value: 0,
    "aria-label": "Time",
    input: () => clock.seek(Number(slider.value)),
  });
  const time = element("output.time", {});
  const speed = element(
    "select",
    { "aria-label": "Speed", change: () => (clock.speed = Number(speed.value)) },
    ...speeds.map((one) =>
      element("option", { value: one, selected: one === clock.speed }, `${one} ×`),
    ),
  );
  const labels = element("input", {
    type: "checkbox",
    change: () => maps.forEach((map) => map.show_labels(labels.checked)),
  });
  labels.checked = maps.some((map) => map.labels);
  const show = () => {
    play.textContent = clock.playing ? "❚❚" : "▶";
    play.setAttribute("aria-label", clock.playing ? "Pause" : "Play");
    slider.value = clock.time;
    slider.style.setProperty("--share", `${(100 * clock.time) / (clock.until || 1)}%`);
    time.textContent = `${clock_text(clock.time)} / ${clock_text(clock.until)}`;
  };
  clock.on_change(show);
  show();
  return element(
    "div.controls",
    {},
    play,
    slider,
    time,
    speed,
    element("label", {}, labels, "stations"),
  );
}

function legend(drives) {
  const entry = (classes, name, paint) => {
    const swatch = element(`span.swatch.${classes}`, {});
    const repaint = () => swatch.style.setProperty("--colour", paint());
    repaint();
    on_theme(repaint);
    return element("span", {}, swatch, name);
  };
  const providers = new Map();
  for (const drive of drives)
    drive.providers.forEach(({ name }, i) => providers.set(`${name}/${i}`, [name, i]));
  return element(
    "div.legend.of-map",
    {},
    entry("car.hollow", "planned on board", () => colour("local")),
    ...(providers.size > most_named
      ? [entry("car", "planned by a provider, in the colour of its area", () => series_colour(0))]
      : [...providers.values()].map(([name, i]) =>
          entry("car", `planned by ${name}`, () => series_colour(i)),
        )),
    entry("area", "offloading area", () => series_colour(0)),
    ...event_groups
      .filter(({ key }) => key !== "other" && drives.some(({ groups }) => groups.counts.get(key)))
      .map(({ one, paint }) => entry("ring", one, () => colour(paint))),
  );
}

function remark_on(drive) {
  if (!drive.has_tracks) return "This run was told not to write tracks: no vehicles on the map.";
  if (!drive.vehicles.length) return "No vehicle ran here; the strips are services that ran at the provider.";
  return "";
}

/// @returns the player that the reader sees most of; null for none.
function in_sight() {
  let best = null;
  let most = 0;
  for (const player of players) {
    const box = player.shown.getBoundingClientRect();
    const visible = Math.min(box.bottom, innerHeight) - Math.max(box.top, 0);
    if (visible > most) [best, most] = [player, visible];
  }
  return best;
}

function obey_key(event) {
  if (event.ctrlKey || event.altKey || event.metaKey) return;
  const { target } = event;
  const is_slider = target.type === "range";
  if (/^(INPUT|SELECT|TEXTAREA)$/.test(target.tagName) && !is_slider && target.type !== "checkbox")
    return;
  const presses = /^(BUTTON|SUMMARY|A)$/.test(target.tagName) || target.type === "checkbox";
  const clock = in_sight()?.clock;
  if (!clock) return;
  const step = event.shiftKey ? large_step : small_step;
  const acts = {
    " ": () => clock.toggle(),
    ArrowLeft: () => clock.seek(clock.time - step),
    ArrowRight: () => clock.seek(clock.time + step),
  };
  if (is_slider) {
    acts.Home = () => clock.seek(0);
    acts.End = () => clock.seek(clock.until);
  }
  const act = acts[event.key];
  if (!act || (event.key === " " && presses)) return;
  event.preventDefault();
  act();
}

export function player(blocks) {
  const drives = blocks.map((block) => new Drive(block));
  const clock = new Clock(Math.max(...drives.map((drive) => drive.until)));
  const watchers = [];
  const look = (station) => watchers.forEach((tell) => tell(station));
  const maps = drives.map((drive) => new DriveMap(drive, clock, look));
  const several = drives.length > 1;
  const columns = drives.map((drive, i) => {
    const remark = remark_on(drive);
    return element(
      "div.drive",
      {},
      element("div.head", {}, several ? element("h3", {}, drive.name) : null, maps[i].tools),
      maps[i].shown,
      maps[i].paper,
      remark ? element("p.note", {}, remark) : null,
    );
  });
  const below = drives.map((drive) =>
    element(
      "div.drive",
      {},
      several ? element("h3", {}, drive.name) : null,
      drive.stations.length ? new Timeline(drive, clock, look).shown : null,
      drive.chain.length
        ? element("p.note", {}, `Strips of a vehicle, from above: ${drive.chain.join(", ")}.`)
        : null,
      event_list(drive, clock),
    ),
  );
  const shown = element(
    "div.player",
    {},
    element("div.drives", {}, ...columns),
    controls(clock, maps),
    legend(drives),
    element("div.drives", {}, ...below),
    element("p.note.keys", {}, "Space plays and pauses, the arrow keys step by 1 s, with Shift by 10 s. ",
      "A click on a vehicle follows it, one on a strip goes to that time."),
  );
  if (!players.length) document.addEventListener("keydown", obey_key);
  players.push({ shown, clock });
  hook.players.push({
    clock,
    drives,
    on_look: (tell) => watchers.push(tell),
    views: maps.map((map) => map.view),
    vehicles: () => drives.map((drive) => drive.vehicles_at(clock.time)),
    track_rows: drives.map((drive) =>
      drive.vehicles.reduce((sum, { t }) => sum + t.length, 0),
    ),
  });
  return shown;
}
