// The time that the page shows: a moment behind the run, so that what lies
// between two frames is known.

const behind_s = 0.3;
const ahead_s = 1; // of the last frame, when none comes
const jump_s = 2; // frames that are so far off are believed at once
const drift = 0.02; // s/s, towards frames that come late

export class LiveClock {
  constructor() {
    this.time = 0;
    this.speed = 1;
    this.offset = null;
    this.heard = 0;
    this.listeners = [];
  }

  on_change(listener) {
    this.listeners.push(listener);
  }

  /// @param time  Of a frame that has just come, s.
  hear(time) {
    const now = performance.now() / 1000;
    const offset = time - now;
    const is_far = this.offset === null || Math.abs(offset - this.offset) > jump_s;
    // The frame that came fastest tells the time best.
    const slow = is_far ? offset : this.offset - drift * Math.max(now - this.heard_at, 0);
    this.offset = Math.max(offset, slow);
    this.heard = time;
    this.heard_at = now;
    if (is_far) this.time = time - behind_s;
  }

  start() {
    requestAnimationFrame(() => this.pass());
  }

  pass() {
    if (this.offset !== null) {
      const wanted = performance.now() / 1000 + this.offset - behind_s;
      this.time = Math.max(this.time, Math.min(wanted, this.heard + ahead_s));
      for (const listener of this.listeners) listener(this);
    }
    requestAnimationFrame(() => this.pass());
  }
}
