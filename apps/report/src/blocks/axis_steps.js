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

/// @returns powers of ten from one that is not above `low` to one that is not
/// below `high`, two at least.
export function decades(low, high) {
  const lowest = Math.floor(Math.log10(low) + 1e-9);
  const highest = Math.max(lowest + 1, Math.ceil(Math.log10(high) - 1e-9));
  return Array.from({ length: highest - lowest + 1 }, (_, i) => 10 ** (lowest + i));
}

/// @returns powers of ten from one that is not above `low` to one.
export const decades_to_one = (low) => decades(Math.min(low, 0.1), 1);

const below_first = 0.85; // so that what is on the lowest decade is in sight

/// @returns the ends of a logarithmic axis for these columns, and its steps. What is
/// less than the lower end, 0, is drawn there.
export function log_axis(columns) {
  let [low, high] = [Infinity, 0];
  for (const column of columns)
    for (const y of column) {
      if (y > 0 && y < low) low = y;
      if (y > high) high = y;
    }
  const steps = high > 0 ? decades(low, high) : [1, 10];
  return { steps, low: below_first * steps[0], high: steps[steps.length - 1] };
}

const raised = (n) => [...`${n}`].map((c) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[c] ?? "⁻").join("");

/// @returns a power of ten as a reader likes it.
export function decade_text(x) {
  const power = Math.round(Math.log10(x));
  return power >= -3 ? `${Number(x.toPrecision(1))}` : `10${raised(power)}`;
}

export const short = (x) => Number(x.toPrecision(6)).toString().replace("-", "−");
