// Puts curves with points of their own onto one list of x, as uPlot wants it.

/// @param curves  Each { x, columns }, x ascending; equal x stay points of
///                their own.
/// @returns [x, ...columns of all curves]; undefined where a curve has no
/// point, null where it has a gap.
export function aligned(curves) {
  if (curves.length === 1)
    return [curves[0].x, ...curves[0].columns.map((column) => Array.from(column, gap_as_null))];
  const at = curves.map(() => 0);
  const all_x = [];
  const columns = curves.map(({ columns }) => columns.map(() => []));
  for (;;) {
    let x = Infinity;
    curves.forEach((curve, i) => {
      if (at[i] < curve.x.length) x = Math.min(x, curve.x[at[i]]);
    });
    if (x === Infinity) return [all_x, ...columns.flat()];
    all_x.push(x);
    curves.forEach((curve, i) => {
      const here = at[i] < curve.x.length && curve.x[at[i]] === x;
      columns[i].forEach((column, k) =>
        column.push(here ? gap_as_null(curve.columns[k][at[i]]) : undefined),
      );
      if (here) ++at[i];
    });
  }
}

const gap_as_null = (y) => (Number.isNaN(y) ? null : y);
