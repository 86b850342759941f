// What has happened, the newest first.
import { element } from "../element.js";
import { event_about, event_name } from "../drive/event_text.js";
import { clock_text } from "../drive/timeline.js";

const most = 60;

function words_of(event) {
  if (event.what !== "switch") return [event_name(event), event_about(event)];
  return event.detail === "remote"
    ? [`planned by ${event.provider || "a provider"}`, ""]
    : ["planned on board", ""];
}

function line(event, map) {
  const [name, about] = words_of(event);
  return element(
    `li.${event.group}`,
    {},
    element(
      "button",
      {
        type: "button",
        click: () => {
          if (event.station && map.followed !== event.station) map.follow(event);
        },
      },
      element("time", {}, clock_text(Math.max(event.t, 0))),
      element("b", {}, event.station ? `${event.station}` : ""),
      element("span", {}, name),
      element("small", {}, about),
    ),
  );
}

export function event_feed(drive, map) {
  const list = element("ol", {});
  let last = 0;
  const update = () => {
    const fresh = drive.events.filter(({ number }) => number > last).slice(0, most);
    if (!fresh.length) return;
    last = drive.events[0].number;
    list.prepend(...fresh.map((event) => line(event, map)));
    while (list.children.length > most) list.lastChild.remove();
  };
  return { shown: element("div.events.feed", {}, list), update };
}
