// What happened besides offloading, line by line; a click goes there.
import { element } from "../element.js";
import { on_print } from "../print.js";
import { last_before } from "./drive.js";
import { event_about, event_name } from "./event_text.js";
import { clock_text } from "./timeline.js";

const most = 500;

function line(event, clock) {
  return element(
    `li.${event.group}`,
    {},
    element(
      "button",
      { type: "button", click: () => clock.seek(event.t) },
      element("time", {}, `${clock_text(event.t)}.${Math.floor((event.t % 1) * 10)}`),
      element("b", {}, event.station ? `${event.station}` : ""),
      element("span", {}, event_name(event)),
      element("small", {}, event_about(event)),
    ),
  );
}

const count_text = (count, { one, many }) => `${many[0].toUpperCase()}${many.slice(1)}: ${count}`;

/// A checkbox for each group of events that occurs.
function group_choice({ groups }) {
  const boxes = groups.present
    .filter(({ key }) => groups.counts.get(key) > 0)
    .map((group) => {
      const box = element("input", {
        type: "checkbox",
        change: () => groups.show(group.key, box.checked),
      });
      box.checked = groups.shows(group.key);
      return element("label", {}, box, group.many);
    });
  return element("div.choice", {}, ...boxes);
}

/// @returns the events to list: of those wanted the gravest, should there be
/// too many.
function listed(drive) {
  const rank = new Map(drive.groups.present.map(({ key }, i) => [key, i]));
  const wanted = drive.events.filter(({ group }) => drive.groups.shows(group));
  const chosen = [...wanted]
    .sort((a, b) => rank.get(a.group) - rank.get(b.group))
    .slice(0, most)
    .sort((a, b) => a.t - b.t);
  return { chosen, left_out: wanted.length - chosen.length };
}

export function event_list(drive, clock) {
  const { groups } = drive;
  const list = element("ol", {});
  const note = element("p.note", {});
  let [times, items, current] = [[], [], -1];

  const fill = () => {
    const { chosen, left_out } = listed(drive);
    times = chosen.map((event) => event.t);
    items = chosen.map((event) => line(event, clock));
    current = -1;
    list.replaceChildren(...items);
    note.textContent = left_out ? `${left_out} more are in events.jsonl.` : "";
  };
  const shown = element(
    "details.events",
    { open: ["qos", "implausible", "collision", "lost"].some((key) => groups.counts.get(key) > 0) },
    element(
      "summary",
      {},
      groups.present.map((group) => count_text(groups.counts.get(group.key), group)).join(" · "),
    ),
    group_choice(drive),
    note,
    list,
  );
  fill();
  groups.on_change(fill);
  let was_open = shown.open;
  on_print(
    () => {
      was_open = shown.open;
      shown.open = true;
    },
    () => (shown.open = was_open),
  );
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
