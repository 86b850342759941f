// A line for each car; a click follows it, another one lets it go.
import { element } from "../element.js";
import { colour, series_colour } from "../theme.js";
import { not_known, on_board } from "./live_drive.js";

const most = 40;

function row(station, map) {
  const parts = {
    dot: element("i.dot", {}),
    speed: element("span", {}),
    planner: element("span", {}),
    latency: element("span", {}),
  };
  const shown = element(
    "button",
    { type: "button", click: () => map.follow({ station }) },
    parts.dot,
    element("b", {}, `${station}`),
    parts.planner,
    parts.speed,
    parts.latency,
  );
  return { ...parts, shown, item: element("li", {}, shown) };
}

/// @returns the cars to list, the followed one among them.
function listed(drive, followed) {
  const all = [...drive.vehicles].sort((a, b) => a.station - b.station);
  if (all.length <= most) return all;
  const chosen = all.slice(0, most);
  const one = drive.tracks.get(followed);
  if (one && !chosen.includes(one)) chosen[most - 1] = one;
  return chosen;
}

export function car_list(drive, map) {
  const list = element("ol.cars", {});
  const note = element("p.note", {});
  const rows = new Map();
  const update = () => {
    const cars = listed(drive, map.followed);
    const items = cars.map((car) => {
      const { station, samples, place, latency } = car;
      if (!rows.has(station)) rows.set(station, row(station, map));
      const one = rows.get(station);
      const remote = place !== on_board && place !== not_known;
      one.dot.style.setProperty("--colour", remote ? series_colour(Math.max(place, 0)) : colour("local"));
      one.dot.classList.toggle("hollow", !remote);
      one.planner.textContent = drive.planner_text(place);
      one.speed.textContent = `${(samples.at(-1).speed * 3.6).toFixed(0)} km/h`;
      one.latency.textContent = latency === null ? "" : `${latency.toFixed(0)} ms`;
      one.shown.setAttribute("aria-pressed", `${station === map.followed}`);
      return one.item;
    });
    const is_same =
      items.length === list.children.length && items.every((item, i) => item === list.children[i]);
    if (!is_same) list.replaceChildren(...items);
    const more = drive.vehicles.length - cars.length;
    const gone = map.followed !== null && !drive.tracks.has(map.followed);
    note.textContent = gone
      ? `${map.followed} has gone.`
      : more > 0
        ? `and ${more} more`
        : cars.length
          ? "A click, here or on the map, follows a car."
          : "No car yet.";
    for (const station of rows.keys()) if (!drive.tracks.has(station)) rows.delete(station);
  };
  return { shown: element("div", {}, list, note), update };
}
