// Reads what experiments/report/compressed.hpp and delta_encoding.hpp write.

/// @param text  JSON in zlib's format, in Base64.
/// @returns a promise of what it says.
export async function inflate(text) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const inflated = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(inflated).json();
}

/// @returns a Float64Array; gaps are NaN.
export function unpack([places, order, numbers, gaps = []]) {
  const column = Float64Array.from(numbers);
  for (let k = 0; k < order; ++k)
    for (let i = 1; i < column.length; ++i) column[i] += column[i - 1];
  const per = 10 ** Math.abs(places); // whole, so that decimals come out exact
  for (let i = 0; i < column.length; ++i)
    column[i] = places < 0 ? column[i] * per : column[i] / per;
  for (const i of gaps) column[i] = NaN;
  return column;
}
