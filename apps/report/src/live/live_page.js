// Everything round the map: how it goes, and what has happened.
import { element } from "../element.js";
import { on_theme, series_colour, colour, theme_button } from "../theme.js";
import { clock_text } from "../drive/timeline.js";
import { car_list } from "./car_list.js";
import { event_feed } from "./event_feed.js";
import { latency_chart } from "./latency_chart.js";
import { not_known, on_board } from "./live_drive.js";

const panel_ms = 500; // between two looks at numbers

const states = {
  "": "connecting",
  live: "live",
  lost: "connection lost, trying again",
  ended: "the run has ended",
};

const roles = {
  run: () => "a run with all its cars and providers",
  drive: () => "the cars of this process",
  provide: ({ provider }) => `what provider ${provider} hears, and whom it plans for`,
};

function figure(name) {
  const value = element("b", {}, "–");
  return { shown: element("div.figure", {}, value, element("span", {}, name)), value };
}

/// How many, and what should not have been.
function figures(drive) {
  const cars = figure("cars");
  const offloaded = figure("offloaded");
  const violations = figure("QoS violations");
  const fallbacks = figure("fallbacks");
  const unplanned = figure("without a fresh plan");
  const is_provider = drive.role === "provide";
  const shown = element(
    "div.figures-row",
    {},
    cars.shown,
    offloaded.shown,
    ...(is_provider ? [] : [violations.shown, fallbacks.shown, unplanned.shown]),
  );
  const alarm = ({ shown: of }, yes) => of.classList.toggle("alarm", yes);
  const update = () => {
    const all = drive.vehicles;
    const away = all.filter(({ place }) => place !== on_board && place !== not_known).length;
    cars.value.textContent = `${all.length}`;
    offloaded.value.textContent = all.length ? `${Math.round((100 * away) / all.length)} %` : "–";
    const { violations: broken, fallbacks: falls, without_plan_s: bare } = drive.counts;
    violations.value.textContent = `${broken ?? 0}`;
    fallbacks.value.textContent = `${falls ?? 0}`;
    unplanned.value.textContent = `${(bare ?? 0).toFixed(1)} s`;
    alarm(violations, broken > 0);
    alarm(unplanned, bare > 0);
  };
  return { shown, update };
}

/// Providers: for how many they plan, and how busy their workers are.
function providers(drive) {
  const rows = drive.providers.map(({ name }, i) => {
    const dot = element("i.dot", {});
    const paint = () => dot.style.setProperty("--colour", series_colour(i));
    paint();
    on_theme(paint);
    const sessions = element("span.sessions", {});
    const busy = element("span.busy", {});
    const bar = element("div.bar", {}, element("i", {}));
    return { shown: element("li", {}, dot, element("b", {}, name), sessions, busy, bar), sessions, busy, bar };
  });
  const update = () => {
    const loads = new Map(drive.loads.map(([place, workers, share]) => [place, { workers, share }]));
    rows.forEach(({ sessions, busy, bar }, i) => {
      const count = drive.vehicles.filter(({ place }) => place === i).length;
      sessions.textContent = `${count} ${count === 1 ? "car" : "cars"}`;
      const load = loads.get(i);
      bar.hidden = !load;
      busy.textContent = load
        ? `${(100 * load.share).toFixed(0)} % of ${load.workers} ${load.workers === 1 ? "worker" : "workers"}`
        : "";
      if (load) bar.style.setProperty("--share", `${100 * Math.min(load.share, 1)}%`);
      bar.classList.toggle("full", load?.share > 0.9);
    });
  };
  return { shown: element("ul.providers", {}, ...rows.map(({ shown }) => shown)), update };
}

function legend({ role }) {
  const swatch = (classes, name, paint) => {
    const one = element(`span.swatch.${classes}`, {});
    const repaint = () => one.style.setProperty("--colour", paint());
    repaint();
    on_theme(repaint);
    return element("span", {}, one, name);
  };
  const elsewhere = role === "provide" ? "not planned here" : "planned on board";
  return element(
    "div.legend.of-map",
    {},
    swatch("car.hollow", elsewhere, () => colour("local")),
    swatch("car", "planned by a provider, in its colour", () => series_colour(0)),
    swatch("area", "offloading area", () => series_colour(0)),
  );
}

const box = (title, ...children) =>
  element("section.box", {}, element("h2", {}, title), ...children);

export function live_page(drive, clock, map) {
  const state = element("span.state", { role: "status" }, states[""]);
  const time = element("output.time", {});
  const parts = [figures(drive), providers(drive), car_list(drive, map), event_feed(drive, map)];
  const [counts, loads, cars, events] = parts;
  const latency = drive.role === "provide" ? null : latency_chart(drive, clock);
  const update = () => {
    parts.forEach((part) => part.update());
    latency?.update();
    time.textContent = clock_text(Math.max(clock.time, 0));
  };
  setInterval(update, panel_ms);
  document.title = `${drive.name} · live`;
  const shown = element(
    "div.live",
    {},
    element(
      "header",
      {},
      element("div", {}, element("h1", {}, drive.name), element("p", {}, roles[drive.role]?.(drive) ?? "")),
      element("div.now", {}, state, time, theme_button()),
    ),
    element(
      "div.left",
      {},
      element("div.stage", {}, map.shown, legend(drive)),
      box("Events", events.shown),
    ),
    element(
      "aside",
      {},
      counts.shown,
      box("Providers", loads.shown),
      latency ? box("Latency of results", latency.shown) : null,
      box("Cars", cars.shown),
    ),
  );
  return {
    shown,
    on_frame: () => latency?.hear(),
    on_state: (now) => {
      state.textContent = states[now];
      state.dataset.state = now;
      shown.classList.toggle("stale", now !== "live");
    },
  };
}
