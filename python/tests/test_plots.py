"""Plots look as they should: compared with pictures that somebody looked at.

Writes them anew with the argument --update."""
import pathlib
import sys

import here
import made_up

import sofof

PICTURES = here.TESTS / "pictures"
TOLERANCE = 12  # root of the mean square of differences, of 255; fonts differ


def drawn(name: str, folder: pathlib.Path, figure) -> None:
    """A picture by its name, drawn on the axes of a figure."""
    ax = figure.add_subplot()
    if name == "t_off":
        sofof.plots.t_off(sofof.load(made_up.run(folder / "a")), ax=ax)
    elif name == "t_off_of_sweep":
        sofof.plots.t_off(sofof.Sweep(made_up.sweep(folder / "s"), "made_up"),
                          ax=ax)
    elif name == "latency_tail":
        sofof.plots.latency_tail(
            {"quick": sofof.load(made_up.run(folder / "q")),
             "slow": sofof.load(made_up.run(folder / "s", 15.0))}, ax=ax)
    elif name == "map_with_tracks":
        sofof.plots.map_with_tracks(sofof.load(made_up.run(folder / "m")),
                                    ax=ax)
    else:
        sofof.plots.leaderboard(sofof.Leaderboard(made_up.bench(folder / "b")),
                                ax=ax)


NAMES = ("t_off", "t_off_of_sweep", "latency_tail", "map_with_tracks",
         "leaderboard")


def save(name: str, folder: pathlib.Path, to: pathlib.Path) -> None:
    import matplotlib.figure

    figure = matplotlib.figure.Figure(figsize=(3.2, 2.4), dpi=100,
                                      layout="constrained")
    drawn(name, folder, figure)
    figure.savefig(to, metadata={"Software": None})


@here.needs("numpy", "pandas", "matplotlib")
class Plots(here.InFolder):

    def difference(self, name: str, changed: bool = False) -> float:
        import numpy
        from matplotlib.image import imread

        seen = self.folder / f"{name}.png"
        save(name, self.folder / "made_up", seen)
        a = imread(PICTURES / f"{name}.png")[..., :3]
        b = imread(seen)[..., :3]
        self.assertEqual(a.shape, b.shape)
        if changed:
            b = numpy.roll(b, 20, axis=1)
        return 255 * float(numpy.sqrt(numpy.mean((a - b) ** 2)))

    def test_each_looks_like_its_reference(self):
        for name in NAMES:
            with self.subTest(name):
                self.setUp()
                self.assertLess(self.difference(name), TOLERANCE)

    def test_one_that_is_moved_would_be_noticed(self):
        self.assertGreater(self.difference("latency_tail", changed=True),
                           TOLERANCE)

    def test_an_axis_that_was_not_varied_is_refused(self):
        sweep = sofof.Sweep(made_up.sweep(self.folder / "s"), "made_up")
        with self.assertRaisesRegex(sofof.SofofError, "varies gap, profile"):
            sofof.plots.t_off(sweep, axis="speed")

    def test_a_service_without_results_has_no_tail(self):
        run = sofof.load(made_up.run(self.folder / "a"))
        with self.assertRaisesRegex(sofof.SofofError, "no results of 'x'"):
            sofof.plots.latency_tail(run, service="x")


if __name__ == "__main__":
    if "--update" in sys.argv:
        import tempfile

        PICTURES.mkdir(exist_ok=True)
        for each in NAMES:
            with tempfile.TemporaryDirectory() as at:
                save(each, pathlib.Path(at), PICTURES / f"{each}.png")
    else:
        here.main()
