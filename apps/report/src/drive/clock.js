// The time of a drive, and how fast it passes.

export class Clock {
  /// @param until  Where it ends, s.
  constructor(until) {
    this.until = until;
    this.time = 0;
    this.speed = 10;
    this.playing = false;
    this.listeners = [];
  }

  on_change(listener) {
    this.listeners.push(listener);
  }

  seek(time) {
    this.time = Math.min(Math.max(time, 0), this.until);
    this.tell();
  }

  play() {
    if (this.playing) return;
    if (this.time >= this.until) this.time = 0;
    this.playing = true;
    this.last = null;
    requestAnimationFrame((now) => this.pass(now));
    this.tell();
  }

  pause() {
    this.playing = false;
    this.tell();
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  pass(now) {
    if (!this.playing) return;
    const passed = this.last === null ? 0 : (now - this.last) / 1000;
    this.last = now;
    this.time = Math.min(this.time + passed * this.speed, this.until);
    if (this.time >= this.until) this.playing = false;
    else requestAnimationFrame((next) => this.pass(next));
    this.tell();
  }

  tell() {
    for (const listener of this.listeners) listener(this);
  }
}
