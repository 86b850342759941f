"""The ten scenarios of docs/gallery.md, and what each picture shows of them."""
from .drive import circle
from .panels import PLANNING, Curves, Legend, Map, Strips, color_of
from .svg import ALARM, INK, SERIES, STRIP, Svg

WIDTH, EDGE, GAP = 760, 14, 18
BOARD = STRIP, "planned on board", "line"
LATE = ALARM, "a result too late, or none", "mark"


def compose(rows):
    """A picture of rows of panels, each with its share of the width."""
    heights, inner = [], WIDTH - 2 * EDGE
    for row in rows:
        whole = sum(share for share, _ in row)
        wide = inner - GAP * (len(row) - 1)
        heights.append(max(panel.height(wide * share / whole)
                           for share, panel in row))
    svg = Svg(WIDTH, round(2 * EDGE + sum(heights) + GAP * (len(rows) - 1)))
    y = EDGE
    for k, (row, height) in enumerate(zip(rows, heights)):
        whole, x = sum(share for share, _ in row), EDGE
        wide = inner - GAP * (len(row) - 1)
        for j, (share, panel) in enumerate(row):
            panel.draw(svg, x, y, wide * share / whole, f"c{k}{j}")
            x += wide * share / whole + GAP
        y += height + GAP
    return str(svg)


def served(drive, *names):
    return [(color_of(drive, x), f"by {x}", "bar") for x in names]


def ulm_lehr(run):
    drive = run("ulm_lehr.toml")
    return compose([
        [(1, Map(drive, at=100.0))],
        [(1, Strips(drive, "Who plans, of each of six cars"))],
        [(1, Legend([*served(drive, "mec"), BOARD]))]])


def occluded_crossing(run):
    remote = run("occluded_crossing.toml", duration="14s")
    board = run("occluded_crossing.toml", "policies.lodm=never", duration="14s")
    at = 4.5

    def sight(panel, svg):
        one, two = board.place(1, at), board.place(2, at)
        mast = (4.0, 4.0)
        svg.path(panel.line([mast, (two["x"], two["y"])]), stroke=SERIES[0],
                 stroke_width=1.4, stroke_dasharray="5 4")
        svg.path(panel.line([(one["x"], one["y"]), (two["x"], two["y"])]),
                 stroke=ALARM, stroke_width=1.4, stroke_dasharray="2 5")

    colors = {"planned on board": (board, ALARM, [1]),
              "planned at the server": (remote, SERIES[0], [1])}
    scene = Map(board, f"After {at:g} s", view=(-75, -80, 50, 40), at=at,
                tracks=False, names=True, car_scale=1.6, extra=sight,
                areas=False, most_height=300)
    return compose([
        [(5, scene), (6, Curves("Speed of the car that has to give way", "m/s",
                                lambda row: row["speed"], colors, height=230,
                                zero=False))],
        [(1, Legend([(color, words, "bar")
                     for words, (_, color, _) in colors.items()]))]])


def four_arms(run):
    alone = run("crossings/four_arms.toml", "policies.lodm=never",
                duration="90s")
    conducted = run("crossings/four_arms.toml", duration="90s")

    def way(drive, title, color):
        return Curves(title, "m driven", lambda row: row["s"],
                      {"": (drive, color, list(drive.tracks))}, height=230,
                      window=(0.0, 90.0))
    scene = Map(conducted, "After 14 s", at=14.0, service="crossing_management",
                view=(-85, -85, 85, 85), tracks=False, areas=False,
                car_scale=1.9)
    return compose([
        [(4, scene), (5, way(alone, "Each by its own rules", ALARM)),
         (5, way(conducted, "Conducted by the server", SERIES[0]))]])


def corridor_3sp(run):
    drive = run("bench/corridor_3sp.toml", "record.tracks=true",
                duration="300s")
    return compose([
        [(1, Map(drive, at=150.0, view=(-110, -340, 1510, 380), tracks=False,
                 names=False))],
        [(1, Strips(drive, "Who plans, of each car from its start to its end",
                    row_height=13))],
        [(1, Legend([*served(drive, "west", "middle", "east"), BOARD, LATE]))]])


def coverage_hole(run):
    blind = run("coverage_hole.toml", "policies.forecast.source=none",
                duration="240s")
    learned = run("coverage_hole.toml", duration="240s")
    holes = [circle(150, 150, 35),
             [(280.0, 50.0), (320.0, 50.0), (320.0, 110.0), (280.0, 110.0)]]

    def bad(panel, svg):
        for hole in holes:
            svg.path(panel.line(hole), close=True, stroke=ALARM,
                     stroke_width=1.2, fill_opacity="0.2",
                     style=f"fill:{ALARM}")

    def town(drive, title):
        return Map(drive, title, view=(-15, -15, 335, 315), areas=False,
                   extra=bad, window=(150.0, 240.0), most_height=330)

    strips = [Strips(x, "Who plans", row_height=15) for x in (blind, learned)]
    return compose([
        [(1, town(blind, "Without a forecast")),
         (1, town(learned, "With one that each car has learned"))],
        [(1, strips[0]), (1, strips[1])],
        [(1, Legend([*served(blind, "mec"), BOARD, LATE,
                     (ALARM, "where the radio is bad", "bar")]))]])


def sp_crash(run):
    drive = run("bench/sp_crash.toml", "record.tracks=true")
    return compose([
        [(4, Map(drive, "After 290 s", view=(-15, -15, 315, 315), areas=False,
                 at=290.0, tracks=False, most_height=180)),
         (9, Strips(drive, "", row_height=30,
                    shades=[(300.0, 420.0, "the server is dead")]))],
        [(1, Legend([*served(drive, "mec"), BOARD, LATE]))]])


def rush_hour(run):
    def strips(policy, title):
        drive = run("bench/rush_hour.toml", "record.tracks=true",
                    f"policies.codm={policy}", duration="560s")
        return drive, Strips(drive, title, window=(400.0, 560.0))

    all_in, first = strips("location", "The server accepts everybody")
    _, second = strips("capacity", "The server accepts what it has room for")
    return compose([
        [(1, first), (1, second)],
        [(1, Legend([*served(all_in, "mec"), BOARD, LATE]))]])


def convoy(run):
    drive = run("convoy.toml", duration="240s")
    moments = (20.0, 85.0, 150.0)

    def leader(panel, svg):
        panel.car_scale = 6
        for at in moments:
            row = drive.place(101, at)
            svg.path(panel.line(circle(row["x"], row["y"], 600)), close=True,
                     stroke=SERIES[0], stroke_dasharray="4 4",
                     fill_opacity="0.05", style=f"fill:{SERIES[0]}")
            panel.at = at
            panel._cars(svg)
            u, v = panel.to(row["x"], row["y"])
            svg.text(u + 9, v - 8, f"after {at:g} s", "h o")
        panel.at = None

    return compose([
        [(1, Map(drive, tracks=False, extra=leader, most_height=430,
                 view=(-1370, -1180, 740, 640)))],
        [(1, Strips(drive, "Who plans: 101 leads, and serves the others"))],
        [(1, Legend([(color_of(drive, "leader"), "by the leader", "bar"),
                     BOARD]))]])


def chain_light(run):
    drive = run("chain/light.toml", duration="200s")
    services = ("tracking", "environment_model", PLANNING)
    colors = (SERIES[2], SERIES[1], SERIES[0])
    return compose([
        [(4, Map(drive, at=60.0, tracks=False, most_height=250,
                 service=PLANNING)),
         (6, Strips(drive, "Where the three services of each car run",
                    services=services, colors=colors))],
        [(1, Legend([*((c, f"{s.replace('_', ' ')} at mec", "bar")
                       for c, s in zip(colors, services)),
                     (STRIP, "on board", "line")]))]])


def scale(run):
    drive = run("scale.toml", "record.tracks_period=5s", duration="16s")
    names = drive.providers()
    return compose([
        [(1, Map(drive, at=15.0, tracks=False, car_scale=3.4,
                 most_height=680))],
        [(1, Legend([(SERIES[0], "in its server's colour, of "
                      f"{len(names)}: planned there", "bar"),
                     (INK, "hollow: planned on board", "line")]))]])


GALLERY = (ulm_lehr, occluded_crossing, four_arms, corridor_3sp, coverage_hole,
           sp_crash, rush_hour, convoy, chain_light, scale)
