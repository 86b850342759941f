// The numbers of a figure, as they are drawn: of all vehicles or of one, and of
// tails as the reader wants them.
import { colour, series_colour } from "../theme.js";
import { unpack } from "../unpack.js";

/// Of curves that mean the same wherever they are.
const meanings = { measured: "ink", allowed: "better", admitted: "alarm" };

/// Curves take colours in their order, or their provider's, or what they mean.
/// Somebody else's, dashed, share those of ours; a single one is grey.
export function colours_of(curves) {
  const dashed = curves.filter((curve) => curve.dashed);
  const solid = curves.filter((curve) => !curve.dashed);
  return curves.map((curve) => {
    if (curve.provider !== undefined) return () => series_colour(curve.provider);
    if (curve.means) return () => colour(meanings[curve.means]);
    if (curve.dashed && dashed.length === 1) return () => colour("soft");
    const place = (curve.dashed ? dashed : solid).indexOf(curve);
    return () => series_colour(place);
  });
}

/// @returns the columns of a curve, those that it has.
export function unpacked({ x, y, low, high, stations }) {
  const all = {};
  for (const [name, column] of Object.entries({ x, y, low, high, stations }))
    if (column) all[name] = unpack(column);
  return all;
}

function of_station(columns, station) {
  const kept = [];
  columns.stations.forEach((one, i) => {
    if (one === station) kept.push(i);
  });
  return Object.fromEntries(
    Object.entries(columns).map(([name, column]) => [
      name,
      Float64Array.from(kept, (i) => column[i]),
    ]),
  );
}

/// x ascending: the share of values that are that large, or, with `cumulative`,
/// at most that large.
function shares({ length }, cumulative) {
  return Float64Array.from({ length }, (_, i) => (cumulative ? i + 1 : length - i) / length);
}

/// @param columns     Of one curve, from `unpacked`.
/// @param station     Whose points are wanted; null for all.
/// @param cumulative  Whether a tail is wanted as F instead of 1 − F.
/// @returns { x, y, low, high } as drawn.
export function drawn_columns(curve, columns, { station, cumulative }) {
  const chosen = station === null || !columns.stations ? columns : of_station(columns, station);
  if (curve.style !== "tail") return chosen;
  return { ...chosen, y: shares(chosen.x, cumulative) };
}

/// @returns the stations that have points in any of these figures, ascending.
export function stations_in(blocks) {
  const all = new Set();
  for (const { curves } of blocks)
    for (const { stations } of curves) if (stations) for (const one of unpack(stations)) all.add(one);
  return [...all].sort((a, b) => a - b);
}
