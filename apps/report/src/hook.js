// What tests, and the curious, find under `window.sofof`.

/// players: { clock, vehicles() } for each group of maps; charts: { title,
/// drawn, points }, the numbers of points by the names of the curves.
export const hook = {
  players: [],
  charts: [],
  draw_all() {
    for (const chart of this.charts) chart.draw();
  },
};
