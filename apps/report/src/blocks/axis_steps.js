// Round numbers for axes.

/// @returns round numbers from the last one below `low` to the first above
/// `high`, about `count` of them.
export function round_steps(low, high, count) {
  const wanted = (high - low || Math.abs(high) || 1) / count;
  const power = 10 ** Math.floor(Math.log10(wanted));
  const step = power * [1, 2, 5, 10].find((part) => power * part >= wanted * 0.999999);
  const first = Math.floor(low / step);
  const last = Math.max(Math.ceil(high / step), first + 1);
  return Array.from({ length: last - first + 1 }, (_, i) => (first + i) * step);
}

/// @returns powers of ten from one that is not above `low` to one.
export function decades_to_one(low) {
  const lowest = Math.min(-1, Math.floor(Math.log10(low) + 1e-9));
  return Array.from({ length: 1 - lowest }, (_, i) => 10 ** (lowest + i));
}

const raised = (n) => [...`${n}`].map((c) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[c] ?? "⁻").join("");

/// @returns a power of ten as a reader likes it.
export function decade_text(x) {
  const power = Math.round(Math.log10(x));
  return power >= -3 ? `${Number(x.toPrecision(1))}` : `10${raised(power)}`;
}

export const short = (x) => Number(x.toPrecision(6)).toString().replace("-", "−");
