// Which part of the world a map shows: metres to pixels and back.

const foot = 36; // pixels below, for the scale and what zooms

export class View {
  constructor(bounds) {
    this.bounds = bounds;
    this.width = this.height = 1;
    this.fit();
  }

  /// Shows everything.
  fit() {
    const { west, east, south, north } = this.bounds;
    this.x = (west + east) / 2;
    this.y = (south + north) / 2;
    this.zoom = 1;
  }

  resize(width, height) {
    this.width = width;
    this.height = height;
  }

  /// Pixels per metre.
  get scale() {
    const { west, east, south, north } = this.bounds;
    const whole = Math.min(this.width / (east - west), (this.height - foot) / (north - south));
    return Math.max(whole, 1e-6) * this.zoom;
  }

  /// Where the place in the middle is drawn.
  get middle() {
    return { x: this.width / 2, y: (this.height - foot) / 2 };
  }

  /// Zooms round a place on the map, in pixels.
  zoom_by(factor, at = this.middle) {
    const before = this.place_of(at);
    this.zoom = Math.min(Math.max(this.zoom * factor, 1), 80);
    const after = this.place_of(at);
    this.centre(this.x + before.x - after.x, this.y + before.y - after.y);
  }

  /// Moves the middle, not beyond what there is.
  centre(x, y) {
    const { west, east, south, north } = this.bounds;
    this.x = Math.min(Math.max(x, west), east);
    this.y = Math.min(Math.max(y, south), north);
    if (this.zoom === 1) this.fit();
  }

  left(x) {
    return this.middle.x + (x - this.x) * this.scale;
  }

  top(y) {
    return this.middle.y - (y - this.y) * this.scale;
  }

  place_of({ x, y }) {
    return {
      x: this.x + (x - this.middle.x) / this.scale,
      y: this.y - (y - this.middle.y) / this.scale,
    };
  }
}

function add(bounds, x, y) {
  bounds.west = Math.min(bounds.west, x);
  bounds.east = Math.max(bounds.east, x);
  bounds.south = Math.min(bounds.south, y);
  bounds.north = Math.max(bounds.north, y);
}

const nothing = { west: Infinity, east: -Infinity, south: Infinity, north: -Infinity };

/// @returns what has to be on the map: lanes, vehicles, obstacles and areas. An
/// area that goes farther beyond the streets than these are wide ends there.
export function bounds_of(drive) {
  const bounds = { ...nothing };
  for (const { x, y } of [...drive.lanes, ...drive.vehicles])
    for (let i = 0; i < x.length; ++i) add(bounds, x[i], y[i]);
  for (const obstacle of drive.obstacles) for (const [x, y] of obstacle) add(bounds, x, y);
  const areas = { ...nothing };
  for (const { area, at } of drive.providers) for (const [x, y] of [...area, at]) add(areas, x, y);
  if (bounds.west > bounds.east) Object.assign(bounds, areas);
  if (bounds.west > bounds.east) add(bounds, 0, 0);
  const size = Math.max(bounds.east - bounds.west, bounds.north - bounds.south);
  const rim = 15 + 0.02 * size;
  const grown = (of, areas_reach) => Math.min(Math.max(of, areas_reach), of + size) + rim;
  return {
    west: -grown(-bounds.west, -areas.west),
    east: grown(bounds.east, areas.east),
    south: -grown(-bounds.south, -areas.south),
    north: grown(bounds.north, areas.north),
  };
}
