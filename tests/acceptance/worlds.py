"""Random streets and fair traffic on them, as the text of scenario files.

A fair world is one in which nobody has to be lucky: bodies are seen in time,
sensors are as good as sold ones, who starts has room to brake, and no body
stands on a crossing. Everything follows from the world's number.
"""
import math
import random

CAR_FRONT_M, CAR_REAR_M = 4.0175, 1.0825  # of every vehicle, from the rear axle
CAR_WIDTH_M = 1.89
STOPPING_MPS2 = 2.5  # with room to brake at this, nobody has to brake hard
ARMS = {"e": (1, 0), "n": (0, 1), "w": (-1, 0), "s": (0, -1)}


def along(a, b, step_m=15.0):
    """Points from a to b, both included."""
    count = max(1, int(math.dist(a, b) / step_m))
    return [(a[0] + (b[0] - a[0]) * i / count, a[1] + (b[1] - a[1]) * i / count)
            for i in range(count + 1)]


def turning(a, to_a, b, to_b, step_m=1.5):
    """A cubic from a, in the direction to_a, to b, in the direction to_b."""
    reach = 0.39 * math.dist(a, b)
    corners = (a, (a[0] + reach * to_a[0], a[1] + reach * to_a[1]),
               (b[0] - reach * to_b[0], b[1] - reach * to_b[1]), b)
    count = max(4, int(1.15 * math.dist(a, b) / step_m))

    def at(t):
        shares = ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t ** 3)
        return tuple(sum(w * p[k] for w, p in zip(shares, corners))
                     for k in (0, 1))
    return [at(i / count) for i in range(count + 1)]


class Streets:
    """Lanes, and routes along them."""

    def __init__(self, name, half_width_m, limit_mps):
        self.name = name
        self.half_width_m = half_width_m
        self.limit_mps = limit_mps
        self.lanes = {}  # name: points, names of the next, rank
        self.opposite = {}  # of a lane, the one beside it on the left
        self.routes = {}  # name: names of lanes, closed or not
        self.buildings = []
        self.clear_m = 0  # no body within this of the middle: a crossing

    def add(self, name, points, following=(), rank=0):
        self.lanes[name] = (points, list(following), rank)

    def toml(self):
        def places(points):
            return "[" + ", ".join(f"[{x:.3f}, {y:.3f}]" for x, y in points) + "]"

        def words(names):
            return "[" + ", ".join(f'"{x}"' for x in names) + "]"
        lines = [f'name = "{self.name}"']
        for name, (points, following, rank) in self.lanes.items():
            lines += ["[[lane]]", f'name = "{name}"',
                      f"half_width_m = {self.half_width_m}", f"rank = {rank}",
                      "limits = [{ from_m = 0.0, "
                      f"limit_mps = {self.limit_mps} }}]",
                      f"points_m = {places(points)}"]
            if following:
                lines.append(f"next = {words(following)}")
            if name in self.opposite:
                lines.append(f'opposite = "{self.opposite[name]}"')
        for name, (lanes, closed) in self.routes.items():
            lines += ["[[route]]", f'name = "{name}"', f"lanes = {words(lanes)}",
                      f"closed = {str(closed).lower()}"]
        for corners in self.buildings:
            lines += ["[[building]]", "invented = true",
                      f"corners_m = {places(corners)}"]
        return "\n".join(lines) + "\n"

    def line(self, route):
        points = []
        for lane in self.routes[route][0]:
            points += [p for p in self.lanes[lane][0]
                       if not points or math.dist(points[-1], p) > 0.01]
        return points

    def length_m(self, route):
        line = self.line(route)
        return sum(map(math.dist, line, line[1:]))

    def place(self, route, way_m):
        """The point after so long a way, and the direction there."""
        line = self.line(route)
        for a, b in zip(line, line[1:]):
            piece_m = math.dist(a, b)
            if way_m <= piece_m or b is line[-1]:
                to = ((b[0] - a[0]) / piece_m, (b[1] - a[1]) / piece_m)
                return (a[0] + way_m * to[0], a[1] + way_m * to[1]), \
                    math.atan2(to[1], to[0])
            way_m -= piece_m


# --- Streets -----------------------------------------------------------------

def ring_road(rng, half_width_m):
    """A closed curve with bends, one lane each way, keeping to the right."""
    while True:
        radius_m = rng.uniform(60, 110)
        waves = [(k, rng.uniform(0, 0.28) / k ** 0.7, rng.uniform(0, 2 * math.pi))
                 for k in range(2, 7)]
        count = int(2 * math.pi * radius_m / 5)

        def at(angle):
            r = radius_m * (1 + sum(a * math.cos(k * angle + phase)
                                    for k, a, phase in waves))
            return (r * math.cos(angle), r * math.sin(angle))
        outer = [at(2 * math.pi * i / count) for i in range(count)]
        if max(map(bend_1pm, outer[-1:] + outer[:-1], outer,
                   outer[1:] + outer[:1])) < 0.07:
            break
    streets = Streets("ring_road", half_width_m, rng.choice([8.33, 13.89, 19.4]))
    inner = []
    for i, p in enumerate(outer):
        before, after = outer[i - 1], outer[(i + 1) % count]
        apart_m = math.dist(before, after)
        to = ((after[0] - before[0]) / apart_m, (after[1] - before[1]) / apart_m)
        inner.append((p[0] - 2 * half_width_m * to[1],
                      p[1] + 2 * half_width_m * to[0]))
    inner.reverse()
    streets.add("there", outer + outer[:1], ["there"])
    streets.add("back", inner + inner[:1], ["back"])
    streets.routes = {"there": (["there"], True), "back": (["back"], True)}
    return streets


def bend_1pm(a, b, c):
    """The curvature of the circle through three points."""
    twice = (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])
    return abs(2 * twice / (math.dist(a, b) * math.dist(b, c) * math.dist(a, c)))


def street(rng):
    """A street of two ways, straight or winding."""
    half_width_m = rng.choice([1.6, 1.75, 1.75, 2.0, 2.5])
    streets = Streets("street", half_width_m, rng.choice([8.33, 13.89, 19.4]))
    length_m, wave_m = rng.uniform(600, 1200), rng.uniform(80, 200)
    swing_m = rng.choice([0, 0, 2, 6, 10])
    there, back = [], []
    for i in range(int(length_m / 8) + 1):
        x = 8.0 * i
        y = swing_m * math.sin(2 * math.pi * x / wave_m)
        slope = swing_m * 2 * math.pi / wave_m * math.cos(2 * math.pi * x / wave_m)
        stretch = math.hypot(1, slope)
        there.append((x, y))
        back.append((x - 2 * half_width_m * slope / stretch,
                     y + 2 * half_width_m / stretch))
    streets.add("east", there)
    streets.add("west", back[::-1])
    streets.routes = {"east": (["east"], False), "west": (["west"], False)}
    return streets


def crossing(rng, arms, equal=False):
    """Three or four arms; from west to east is the main road unless equal."""
    names = list("ews" if arms == 3 else "enws")
    streets = Streets("crossing", 1.75, rng.choice([8.33, 13.89, 13.89]))
    streets.clear_m = 32
    mouth_m, arm_m = rng.uniform(12, 15), rng.uniform(110, 180)

    def rank(a, b):
        (ax, ay), (bx, by) = ARMS[a], ARMS[b]
        turns_left = ay * bx - ax * by > 0
        return 0 if equal else 2 * (a in "ns") + turns_left

    def beside(arm, from_m, right):
        x, y = ARMS[arm]
        side = -1.75 if right else 1.75
        return (x * from_m - side * y, y * from_m + side * x)
    for a in names:
        # Inwards on the right: on the left as seen from the middle.
        streets.add(f"in_{a}", along(beside(a, arm_m, False),
                                     beside(a, mouth_m, False)),
                    [a + b for b in names if b != a])
        streets.add(f"out_{a}", along(beside(a, mouth_m, True),
                                      beside(a, arm_m, True)))
    for a in names:
        for b in names:
            if a == b:
                continue
            (x, y), to = ARMS[a], ARMS[b]
            streets.add(a + b, turning(beside(a, mouth_m, False), (-x, -y),
                                       beside(b, mouth_m, True), to),
                        [f"out_{b}"], rank(a, b))
            streets.routes[a + b] = ([f"in_{a}", a + b, f"out_{b}"], False)
    if rng.random() < 0.5:
        corner_m = rng.uniform(5, 12)
        for x, y in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
            if rng.random() < 0.8:
                streets.buildings.append(
                    [(x * a, y * b) for a, b in (
                        (corner_m, corner_m), (corner_m + 40, corner_m),
                        (corner_m + 40, corner_m + 40),
                        (corner_m, corner_m + 40))])
    return streets


def roundabout(rng, equal=False):
    """Three or four arms; who is on the ring goes first unless equal."""
    radius_m, arms = rng.uniform(13, 20), rng.choice([3, 4])
    streets = Streets("roundabout", 1.75, rng.choice([8.33, 13.89]))
    streets.clear_m = radius_m + 20
    mouth, near_m, far_m = math.radians(32), radius_m + 15, radius_m + 110
    axes = [2 * math.pi * i / arms for i in range(arms)]

    def on_ring(a):
        return (radius_m * math.cos(a), radius_m * math.sin(a))

    def round_to(a, b):
        count = max(4, int(radius_m * (b - a) / 1.5))
        return [on_ring(a + (b - a) * i / count) for i in range(count + 1)]

    def left(a):
        return (-math.sin(a), math.cos(a))
    for i, axis in enumerate(axes):
        out, side = (math.cos(axis), math.sin(axis)), left(axis)

        def beside(from_m, to_left):
            return (out[0] * from_m + to_left * side[0],
                    out[1] * from_m + to_left * side[1])
        after, before = axis + mouth, axis - mouth
        streets.add(f"in_{i}", along(beside(far_m, 1.75), beside(near_m, 1.75))
                    + turning(beside(near_m, 1.75), (-out[0], -out[1]),
                              on_ring(after), left(after))[1:],
                    [f"ring_{i}"], 0 if equal else 1)
        streets.add(f"out_{i}", turning(on_ring(before), left(before),
                                        beside(near_m, -1.75), out)
                    + along(beside(near_m, -1.75), beside(far_m, -1.75))[1:])
        k = (i + 1) % arms
        end = axes[k] if k else 2 * math.pi
        streets.add(f"ring_{i}", round_to(after, end - mouth),
                    [f"out_{k}", f"past_{k}"])
        streets.add(f"past_{k}", round_to(end - mouth, end + mouth),
                    [f"ring_{k}"])
    for i in range(arms):
        for exits in range(1, arms + 1):
            lanes = [f"in_{i}"]
            for j in range(exits):
                lanes.append(f"ring_{(i + j) % arms}")
                if j < exits - 1:
                    lanes.append(f"past_{(i + j + 1) % arms}")
            lanes.append(f"out_{(i + exits) % arms}")
            streets.routes[f"{i}_{exits}"] = (lanes, False)
    return streets


def any_streets(rng, equal):
    kind = rng.choice(["ring", "narrow", "street", "street", "three", "four",
                       "four", "roundabout"])
    if kind == "ring":
        return ring_road(rng, rng.choice([1.6, 1.75, 1.75, 2.0, 2.25]))
    if kind == "narrow":
        return ring_road(rng, rng.choice([1.5, 1.55, 1.6]))
    if kind == "street":
        return street(rng)
    if kind == "roundabout":
        return roundabout(rng, equal)
    return crossing(rng, 3 if kind == "three" else 4, equal)


# --- What stands and drives there ---------------------------------------------

def fleet(first_station, count, route, start_m, spacing_m=0.0, speed_mps=0.0,
          appears_s=0.0, every_s=0.0, connected=True):
    return f"""[[fleet]]
first_station = {first_station}
count = {count}
routes = ["{route}"]
placement = "convoy"
spacing_m = {spacing_m:.2f}
start_m = {start_m:.2f}
start_speed_mps = {speed_mps:.2f}
appears_at = "{appears_s * 1000:.0f}ms"
appear_every = "{every_s * 1000:.0f}ms"
connected = {str(connected).lower()}
"""


def body(at, heading_rad, length_m, width_m):
    return f"""[[obstacle]]
position_m = [{at[0]:.3f}, {at[1]:.3f}]
heading_deg = {math.degrees(math.remainder(heading_rad, 2 * math.pi)):.2f}
length_m = {length_m:.2f}
width_m = {width_m:.2f}
"""


def room_to_brake_m(speed_mps):
    return 12 + 2 * speed_mps + speed_mps ** 2 / (2 * STOPPING_MPS2)


def cars(rng, streets):
    """Fleets, and where each of their cars starts and how fast."""
    tables, starts, station = [], [], 101
    for route, (lanes, closed) in (
            streets.routes.items() if not streets.clear_m else
            rng.sample(sorted(streets.routes.items()),
                       rng.randint(3, min(8, len(streets.routes))))):
        connected = rng.random() < 0.8
        if streets.clear_m:
            count, start_m = rng.randint(1, 5), rng.uniform(8, 45)
            speed_mps = rng.choice([0, 0, 5, min(8, streets.limit_mps)])
            tables.append(fleet(station, count, route, start_m, 0, speed_mps,
                                rng.uniform(0, 20), rng.uniform(2, 12),
                                connected))
            ways = [start_m]
        else:
            length_m = streets.length_m(route)
            spacing_m = rng.uniform(*rng.choice([(10, 14), (20, 50)]))
            longest_m = length_m / 2 if closed else length_m / 3
            count = min(rng.randint(1, 8), int(longest_m / spacing_m))
            start_m = count * spacing_m + 10
            speed_mps = rng.choice([0, 0, 0, 5]) if spacing_m > 20 else 0
            tables.append(fleet(station, count, route, start_m, spacing_m,
                                speed_mps, connected=connected))
            ways = [start_m - i * spacing_m for i in range(count)]
        starts += [(streets.place(route, way)[0], speed_mps) for way in ways]
        station += 100
    return tables, starts


def bodies(rng, streets, starts, range_m):
    """Bodies that stand in or beside lanes, each seen in time."""
    tables = []
    usual = rng.choice([None, None, (2.8, 3.4), (2.44, 2.75), (1.0, 2.4)])
    if not usual:
        return tables
    for _ in range(rng.randint(1, 4)):
        route = rng.choice(sorted(streets.routes))
        length_m = streets.length_m(route)
        size = any_size(rng)
        # Its middle is what is seen; the near end of a long one is nearer.
        in_sight_m = range_m - max(size) / 2
        if in_sight_m < room_to_brake_m(streets.limit_mps):
            continue
        leaves_m = min(rng.uniform(*usual), 2 * streets.half_width_m)
        for _ in range(40):
            way_m = rng.uniform(50, length_m - 20)
            (x, y), heading = streets.place(route, way_m)
            # From the right edge; the left one is the oncoming lane's.
            off_m = -streets.half_width_m + (2 * streets.half_width_m - leaves_m) \
                - size[1] / 2
            at = (x - math.sin(heading) * off_m, y + math.cos(heading) * off_m)
            far_off = max(size) / 2
            if math.hypot(*at) < streets.clear_m + far_off and streets.clear_m:
                continue
            if any(math.dist(at, start) < room_to_brake_m(speed) + far_off
                   for start, speed in starts):
                continue
            tables.append(body(at, heading + rng.choice(
                [0, 0, rng.uniform(-0.14, 0.14)]), *size))
            break
    return tables


def any_size(rng):
    """Length and width, 0.1 to 50 m, every third wider than long."""
    def one():
        return round(rng.choice([rng.uniform(0.1, 1), rng.uniform(1, 5),
                                 rng.uniform(1, 5), rng.uniform(5, 12),
                                 rng.uniform(12, 50)]), 2)
    long_m, short_m = sorted((one(), min(one(), rng.uniform(0.1, 3))),
                             reverse=True)
    return (short_m, long_m) if rng.random() < 1 / 3 else (long_m, short_m)


def network(rng, duration_s):
    """An edge server, the air to it, and when there is none."""
    sensor = """[[provider.sensor]]
position_m = [3.0, 3.0]
""" if rng.random() < 0.7 else ""
    outages = ""
    for _ in range(rng.choice([0, 0, 1, 2, 4])):
        begins_s = rng.uniform(2, duration_s - 10)
        outages += f"""[[network.outage]]
from = "{begins_s * 1000:.0f}ms"
to = "{(begins_s + rng.uniform(0.2, 6)) * 1000:.0f}ms"
"""
    profile = rng.choice(["ideal", "paper_sim", "paper_sim_stalls", "paper_5g",
                          "spiky_5g"])
    policies = rng.choice(['lodm = "always"\ncodm = "always"',
                           'lodm = { name = "location", radius_m = 80.0, '
                           'min_distance_m = 20.0 }\ncodm = "location"'])
    return f"""[[provider]]
name = "mec"
position_m = [0.0, 0.0]
area_radius_m = 1500.0
services = ["trajectory_planning"]
{sensor}[network]
profile = "{profile}"
loss = {rng.choice([0.0, 0.0, 0.01, 0.05])}
{outages}[compute]
workers = {rng.choice([4, 16])}
[policies]
{policies}
"""


def scenario(rng, name, duration_s, perceived, tables):
    """The text of one, in seven of ten cases with a server."""
    server = network(rng, duration_s) if rng.random() < 0.7 else ""
    head = f"""name = "{name}"
duration = "{duration_s}s"
seed = {rng.randint(1, 999)}
map = "map.toml"
[traffic]
crossings = "{'perceived' if perceived else 'granted'}"
"""
    tail = """[[service]]
name = "trajectory_planning"
[record]
cycles = false
tracks_period = "200ms"
"""
    return "".join([head, *tables, server, tail])


def fair(number, duration_s=180):
    """A world's map and scenario; the latter names the former `map.toml`."""
    rng = random.Random(f"fair {number}")
    equal, perceived = rng.random() < 0.3, rng.random() < 0.5
    streets = any_streets(rng, equal)
    # Who drives faster needs to see farther.
    range_m = rng.choice([r for r in (30, 40, 60, 100, 100)
                          if streets.limit_mps < 10 or r > 30])
    fleets, starts = cars(rng, streets)
    noise_m, noise_mps = rng.choice([0.1, 0.1, 0.2, 0.3]), rng.choice([0.1, 0.3])
    noise_rad, field_deg = rng.choice([0.01, 0.03]), rng.choice([360.0, 360.0, 180.0])
    if perceived:  # who waits where two ways join looks back over its shoulder
        field_deg = max(field_deg, 270.0)
    noise = f"""[sensors]
range_m = {float(range_m)}
position_noise_m = {noise_m}
speed_noise_mps = {noise_mps}
heading_noise_rad = {noise_rad}
field_of_view_deg = {field_deg}
"""
    obstacles = bodies(rng, streets, starts, range_m)
    return streets, scenario(rng, f"fair {number}", duration_s, perceived,
                             [*fleets, noise, *obstacles])


def narrow(room_m, noise_m, at_server, seed):
    """One car on a straight street, past a parked one that leaves so much of
    the lane of 3.5 m: map and scenario."""
    streets = Streets("narrow", 1.75, 13.89)
    streets.add("e", along((0, 0), (400, 0)))
    streets.routes["e"] = (["e"], False)
    parked = body((200, 1.75 - room_m - 0.9), 0, 4.5, 1.8)
    server = """[[provider]]
name = "mec"
position_m = [200.0, 20.0]
area_radius_m = 1500.0
services = ["trajectory_planning"]
[[provider.sensor]]
position_m = [190.0, 6.0]
[network]
profile = "paper_5g"
[policies]
lodm = "always"
codm = "always"
""" if at_server else ""
    return streets, f"""name = "narrow {room_m:.2f}"
duration = "45s"
seed = {seed}
map = "map.toml"
{fleet(101, 1, "e", 10, speed_mps=8)}[sensors]
position_noise_m = {noise_m}
{parked}{server}[[service]]
name = "trajectory_planning"
[record]
cycles = false
tracks_period = "200ms"
"""


BLOCKED_M, BLOCKS_M = 250, 6.0  # where what blocks a street begins, its length


def blocked(seed, at_server):
    """A street of two ways of which one is blocked 220 m before a car, while
    others come on the other one, half of them without a radio."""
    rng = random.Random(f"blocked {seed}")
    streets = Streets("blocked", 1.75, 8.33)
    streets.add("east", along((0, 0), (600, 0)))
    streets.add("west", along((600, 3.5), (0, 3.5)))
    streets.opposite = {"east": "west", "west": "east"}
    streets.routes = {"east": (["east"], False), "west": (["west"], False)}
    fleets, station, at_s = [fleet(101, 1, "east", 30)], 201, 0.0
    while True:
        at_s += rng.expovariate(1 / 20)
        if at_s > 130:
            break
        fleets.append(fleet(station, 1, "west", 10, speed_mps=8.0,
                            appears_s=at_s, connected=rng.random() < 0.5))
        station += 1
    width_m = rng.uniform(1.8, 2.5)
    truck = body((BLOCKED_M + BLOCKS_M / 2, rng.uniform(-0.5, 0.0)), 0, BLOCKS_M,
                 width_m)
    server = """[[provider]]
name = "mec"
position_m = [250.0, 20.0]
area_radius_m = 1500.0
services = ["trajectory_planning"]
[network]
profile = "paper_5g"
[policies]
lodm = "always"
codm = "always"
""" if at_server else ""
    return streets, f"""name = "blocked {seed}"
duration = "180s"
seed = {seed}
map = "map.toml"
[traffic]
crossings = "perceived"
{"".join(fleets)}[sensors]
range_m = 130.0
{truck}{server}[[service]]
name = "trajectory_planning"
[record]
cycles = false
tracks_period = "200ms"
"""


# --- Hostile worlds -------------------------------------------------------------

def tailgating(rng, streets):
    """Fleets that start close behind each other and fast, and whether each car
    could stop if the one ahead does."""
    tables, starts, station, fair_start = [], [], 101, True
    for route, (_, closed) in (
            streets.routes.items() if not streets.clear_m else
            rng.sample(sorted(streets.routes.items()),
                       rng.randint(2, min(6, len(streets.routes))))):
        connected = rng.random() < 0.8
        speed_mps = min(rng.choice([0.0, 5.0, 8.0, 10.0, 13.0]),
                        streets.limit_mps)
        if streets.clear_m:
            start_m, spacing_m = rng.uniform(8, 45), 0.0
            ahead_m = streets.length_m(route) / 2 - streets.clear_m - start_m
            fair_start &= ahead_m > room_to_brake_m(speed_mps) - 12
            tables.append(fleet(station, rng.randint(1, 3), route, start_m, 0,
                                speed_mps, rng.uniform(0, 3),
                                rng.uniform(1.5, 5), connected))
            ways = [start_m]
        else:
            spacing_m = rng.uniform(8.2, 16)
            gap_m = spacing_m - CAR_FRONT_M - CAR_REAR_M
            fair_start &= gap_m > 2 + 0.6 * speed_mps
            longest_m = streets.length_m(route) / (2 if closed else 3)
            count = max(1, min(rng.randint(1, 8), int(longest_m / spacing_m)))
            start_m = count * spacing_m + 10
            tables.append(fleet(station, count, route, start_m, spacing_m,
                                speed_mps, connected=connected))
            ways = [start_m - i * spacing_m for i in range(count)]
        starts += [(streets.place(route, way)[0], speed_mps) for way in ways]
        station += 100
    return tables, starts, fair_start


def hostile(number, duration_s=60):
    """As `fair`, but sensors see little and badly, who starts is fast and close
    behind others, and the air loses much: map, scenario, and whether the start
    leaves everybody room to stop and sensors reach 20 m at least."""
    rng = random.Random(f"hostile {number}")
    equal, perceived = rng.random() < 0.3, rng.random() < 0.5
    streets = any_streets(rng, equal)
    range_m = rng.choice([100, 50, 30, 20, 12, 9])
    fleets, starts, fair_start = tailgating(rng, streets)
    noise = f"""[sensors]
range_m = {float(range_m)}
position_noise_m = {rng.choice([0.1, 0.3, 0.5, 1.0])}
speed_noise_mps = {rng.choice([0.1, 0.5, 1.0])}
heading_noise_rad = {rng.choice([0.01, 0.05, 0.1])}
field_of_view_deg = {rng.choice([360.0, 360.0, 180.0, 120.0])}
"""
    obstacles = bodies(rng, streets, starts, 100)
    return streets, scenario(rng, f"hostile {number}", duration_s, perceived,
                             [*fleets, noise, *obstacles]), \
        fair_start and range_m >= 20

