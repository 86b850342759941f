// What happened besides offloading, line by line; a click goes there.
import { element } from "../element.js";
import { last_before } from "./drive.js";
import { clock_text } from "./timeline.js";

const most = 500;

const names = {
  violation: "QoS violation",
  collision: "collision",
  peer_lost: "provider lost",
  provider_lost: "connection lost",
  provider_connected: "connection made",
  requester_lost: "requester lost",
  clock_in_doubt: "clock in doubt",
  clock_known: "clock known",
  refused: "refused",
  arrived: "arrived",
};

function line(event, clock) {
  const about = [event.service, event.provider, event.detail].filter((part) => part);
  return element(
    "li" + (event.alarm ? ".alarm" : ""),
    {},
    element(
      "button",
      { type: "button", click: () => clock.seek(event.t) },
      element("time", {}, `${clock_text(event.t)}.${Math.floor((event.t % 1) * 10)}`),
      element("b", {}, event.station ? `${event.station}` : ""),
      element("span", {}, names[event.what] ?? event.what),
      element("small", {}, about.join(" · ")),
    ),
  );
}

export function event_list(drive, clock) {
  // Alarms first, should there be too many.
  const chosen = [...drive.events]
    .sort((a, b) => b.alarm - a.alarm)
    .slice(0, most)
    .sort((a, b) => a.t - b.t);
  const times = chosen.map((event) => event.t);
  const items = chosen.map((event) => line(event, clock));
  const list = element("ol", {}, ...items);
  const left_out = drive.events.length - chosen.length;
  const others = drive.events.length - drive.alarms.length;
  const shown = element(
    "details.events",
    { open: drive.alarms.length > 0 },
    element(
      "summary",
      {},
      `QoS events: ${drive.alarms.length}${others ? `, others: ${others}` : ""}`,
    ),
    left_out ? element("p.note", {}, `${left_out} more are in events.jsonl.`) : null,
    list,
  );
  let current = -1;
  clock.on_change(() => {
    const now = last_before(times, clock.time);
    if (now === current) return;
    items[current]?.removeAttribute("aria-current");
    items[now]?.setAttribute("aria-current", "true");
    current = now;
    // Only the list scrolls, never the page.
    if (shown.open && items[now])
      list.scrollTop = items[now].offsetTop - list.offsetTop - list.clientHeight / 2;
  });
  return shown;
}
