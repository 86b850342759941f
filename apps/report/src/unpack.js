// Reads columns of numbers as experiments/report/packed.hpp writes them.

const block_size = 64;

function bytes_of(text) {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

/// Reads the whole numbers of all blocks into `to`.
function read_blocks(bytes, to) {
  let at = 0;
  for (let start = 0; start < to.length; start += block_size) {
    const end = Math.min(start + block_size, to.length);
    const width = bytes[at++];
    let bit = 0;
    for (let i = start; i < end; ++i) {
      let value = 0;
      for (let got = 0; got < width; ) {
        const offset = bit & 7;
        const take = Math.min(8 - offset, width - got);
        const part = (bytes[at + (bit >> 3)] >> offset) & ((1 << take) - 1);
        value += part * 2 ** got;
        got += take;
        bit += take;
      }
      to[i] = value % 2 ? -(value + 1) / 2 : value / 2;
    }
    at += (bit + 7) >> 3;
  }
}

/// @returns a Float64Array; gaps are NaN.
export function unpack([count, places, order, text, gaps = []]) {
  const column = new Float64Array(count);
  read_blocks(bytes_of(text), column);
  for (let k = 0; k < order; ++k)
    for (let i = 1; i < count; ++i) column[i] += column[i - 1];
  const per = 10 ** Math.abs(places); // whole, so that decimals come out exact
  for (let i = 0; i < count; ++i)
    column[i] = places < 0 ? column[i] * per : column[i] / per;
  for (const i of gaps) column[i] = NaN;
  return column;
}
