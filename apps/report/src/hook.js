// What tests, and the curious, find under `window.sofof`.

/// ready: a promise that all of the page is there; players: { clock, drives,
/// on_look, views, vehicles() } for each group of maps; charts: { title, drawn, points },
/// the numbers of points by the names of the curves.
export const hook = {
  ready: null,
  players: [],
  charts: [],
  draw_all() {
    for (const chart of this.charts) chart.draw();
  },
};
