// Asks for the scene, then follows the events.
import { DriveMap } from "../drive/map.js";
import { LiveClock } from "./live_clock.js";
import { LiveDrive } from "./live_drive.js";
import { live_page } from "./live_page.js";
import { Stream } from "./stream.js";

const again_ms = 2000;
const with_token = (path) => path + location.search;

/// @returns a promise of the scene, sooner or later.
async function ask_for_scene(on_trouble) {
  for (;;) {
    try {
      const answer = await fetch(with_token("/scene"), { cache: "no-store" });
      if (answer.ok) return await answer.json();
      on_trouble(await answer.text());
    } catch {
      on_trouble("connection lost, trying again");
    }
    await new Promise((done) => setTimeout(done, again_ms));
  }
}

async function begin(into) {
  const scene = await ask_for_scene((why) => (into.textContent = why));
  const drive = new LiveDrive(scene);
  const clock = new LiveClock();
  const map = new DriveMap(drive, clock, () => {});
  const page = live_page(drive, clock, map);
  into.replaceChildren(page.shown);
  const stream = new Stream(with_token("/events"), {
    on_frame: (frame) => {
      if (frame.run !== scene.run) location.reload(); // another one has begun
      clock.hear(frame.t);
      const was_empty = drive.vehicles.length === 0;
      drive.add(frame);
      if (was_empty && drive.vehicles.length) map.show_labels(drive.vehicles.length <= 12);
      page.on_frame(frame);
    },
    on_state: (state) => page.on_state(state),
  });
  clock.start();
  return { drive, clock, map, stream };
}

// What tests, and the curious, find: a promise of { drive, clock, map, stream }.
window.sofof = { live: begin(document.getElementById("live")) };
