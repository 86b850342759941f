// Server-sent events: frames, and whether they come.

const quiet_ms = 2000; // without a frame
const again_ms = 2000;

export class Stream {
  /// @param on_frame  Is called with each frame.
  /// @param on_state  Is called with "live", "lost" or "ended" when that changes.
  constructor(address, { on_frame, on_state }) {
    this.address = address;
    this.on_frame = on_frame;
    this.on_state = on_state;
    this.state = "";
    this.frames = 0;
    this.last = performance.now();
    this.ending = false;
    this.open();
    setInterval(() => this.look(), 500);
  }

  open() {
    this.source = new EventSource(this.address);
    this.source.onmessage = ({ data }) => {
      this.last = performance.now();
      ++this.frames;
      const frame = JSON.parse(data);
      this.ending = frame.ending;
      this.change("live");
      this.on_frame(frame);
    };
    this.source.onerror = () => {
      this.change(this.ending ? "ended" : "lost");
      // Once it was refused a browser does not try again.
      if (this.source.readyState === EventSource.CLOSED) setTimeout(() => this.open(), again_ms);
    };
  }

  look() {
    if (performance.now() - this.last > quiet_ms) this.change(this.ending ? "ended" : "lost");
  }

  change(state) {
    if (state === this.state) return;
    this.state = state;
    this.on_state(state);
  }
}
