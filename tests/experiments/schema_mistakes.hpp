// Files with one mistake each, that a schema can know of.
#pragma once

#include <string_view>

namespace sofof::test {

inline constexpr std::string_view right_scenario = R"(
name = "right"
duration = "60s"
seed = 1

[street_grid]
columns = 3
rows = 3

[traffic]
crossings = "granted"

[[fleet]]
count = 2
routes = ["block *"]
placement = "equal"
start_m = 60.0
connected = true
appears_at = "0s"

[fleet.compute]
clock_ghz = 3.0
scheduling = "edf"
cores = 2

[sensors]
range_m = 100.0
occlusion = true

[[obstacle]]
position_m = [1000.0, 1000.0]
width_m = 2.0

[[provider]]
name = "mec"
position_m = [150.0, 150.0]
area_corners = 24
fails_at = "20s"

[network]
profile = "paper_5g"
loss = 0.0

[network.stalls]
rate_hz = 0.1
longest = "1s"

[[network.outage]]
from = "10s"
to = "12s"
direction = "up"

[compute]
model = "paper_5g"
workers = 2

[v2x]
cpm = "off"

[[service]]
name = "trajectory_planning"
period = "50ms"
max_latency = "40ms"
per_input = false
planner = { name = "lane_follow", horizon_s = 3.0 }

[service.compute]
run_time_mean = "5ms"

[[service]]
name = "cabin_climate"
set_point_c = 21.0

[policies]
lodm = "nearest"
codm = { name = "location", min_time = "4s" }

[policies.forecast]
source = "learned"
cell_m = 10.0

[record]
tracks = false
tracks_period = "100ms"
)";

inline constexpr std::string_view right_map = R"(
name = "right"

[origin]
utm_zone = 32
lat_deg = 48.4

[[lane]]
name = "a"
half_width_m = 2.0
rank = 1
limits = [{ from_m = 0.0, limit_mps = 14.0 }]
next = []
points_m = [[0.0, 0.0], [50.0, 0.0]]

[[building]]
invented = true
corners_m = [[0.0, 9.0], [9.0, 9.0], [9.0, 20.0]]

[[route]]
name = "way"
lanes = ["a"]
closed = false
)";

inline constexpr std::string_view right_sweep = R"(
name = "right"
scenario = "ulm_lehr.toml"
seeds = 3
most_seeds = 12

[set]
duration = "60s"
record.tracks = false
"fleet.0.count" = 1

[[axis]]
key = "service.trajectory_planning.max_interarrival"
values = ["60ms", "100ms"]

[[axis]]
name = "way"
[[axis.value]]
name = "north"
set = { "policies.lodm" = "nearest" }

[[draw]]
key = "fleet.0.start_m"
from = 2400.0
to = 2750.0
)";

/// What stands in the right file, and what in its place is wrong.
struct mistake {
  std::string_view right, wrong;
};

inline constexpr mistake scenario_mistakes[]{
    {"name = \"right\"", "name = 7"},
    {"duration = \"60s\"", "duration = 60"},
    {"duration = \"60s\"", "duration = \"60\""},
    {"duration = \"60s\"", "duration = \"0s\""},
    {"duration = \"60s\"", "duration = \"60 s\""},
    {"duration = \"60s\"", "lasts = \"60s\""},
    {"seed = 1", "seed = -1"},
    {"seed = 1", "seed = \"1\""},
    {"columns = 3", "columns = 1"},
    {"columns = 3", "columns = 65"},
    {"rows = 3", "row = 3"},
    {"\"granted\"", "\"taken\""},
    {"count = 2", "count = 0"},
    {"count = 2", "number = 2"},
    {"[\"block *\"]", "\"block *\""},
    {"[\"block *\"]", "[1]"},
    {"\"equal\"", "\"even\""},
    {"start_m = 60.0", "start_m = -1.0"},
    {"start_m = 60.0", "start_m = \"60\""},
    {"connected = true", "connected = \"yes\""},
    {"appears_at = \"0s\"", "appears_at = \"-1s\""},
    {"clock_ghz = 3.0", "clock_ghz = 0.0"},
    {"\"edf\"", "\"fifo\""},
    {"cores = 2", "cores = 1025"},
    {"range_m = 100.0", "range_m = 1001.0"},
    {"occlusion = true", "occlusion = 1"},
    {"[1000.0, 1000.0]", "[1000.0]"},
    {"[1000.0, 1000.0]", "[1000.0, 1000.0, 0.0]"},
    {"[1000.0, 1000.0]", "{ x_m = 1000.0, y_m = 1000.0 }"},
    {"width_m = 2.0", "width_m = 0.0"},
    {"area_corners = 24", "area_corners = 2"},
    {"area_corners = 24", "corners = 24"},
    {"fails_at = \"20s\"", "fails_at = \"0s\""},
    {"profile = \"paper_5g\"", "profile = \"paper_6g\""},
    {"loss = 0.0", "loss = 1.5"},
    {"loss = 0.0", "losses = 0.0"},
    {"rate_hz = 0.1", "rate_hz = true"},
    {"[network.stalls]", "[network.stall]"},
    {"[[network.outage]]", "[network.outage]"},
    {"direction = \"up\"", "direction = \"across\""},
    {"model = \"paper_5g\"", "model = \"fast\""},
    {"workers = 2", "workers = 0"},
    {"workers = 2", "workers = \"two\""},
    {"cpm = \"off\"", "cpm = \"on\""},
    {"name = \"trajectory_planning\"", "name = \"planning\""},
    {"name = \"trajectory_planning\"", ""},
    {"period = \"50ms\"\n", "period = 50\n"},
    {"period = \"50ms\"\n", "periode = \"50ms\"\n"},
    {"max_latency = \"40ms\"", "max_latency = \"soon\""},
    {"per_input = false", "per_input = 0"},
    {"\"lane_follow\"", "\"lane_follower\""},
    {"horizon_s = 3.0", "horizon = 3.0"},
    {"run_time_mean = \"5ms\"", "run_time = \"5ms\""},
    {"set_point_c = 21.0", "horizon_m = 21.0"},
    {"lodm = \"nearest\"", "lodm = \"nearby\""},
    {"lodm = \"nearest\"", "lodm = \"edf\""},
    {"lodm = \"nearest\"", "lodm = { name = \"nearest\", radius_m = 9.0 }"},
    {"lodm = \"nearest\"",
     "lodm = { name = \"nearest\", govern = [\"none\"] }"},
    {"lodm = \"nearest\"", "lodm = { name = \"nearest\", filter = \"far\" }"},
    {"min_time = \"4s\"", "min_time = 4"},
    {"min_time = \"4s\"", "min_times = \"4s\""},
    {"source = \"learned\"", "source = \"guessed\""},
    {"cell_m = 10.0", "cell_m = 0.5"},
    {"[record]", "[records]"},
    {"tracks = false", "tracks = \"no\""},
    {"tracks_period = \"100ms\"", "tracks_period = \"fast\""},
};

inline constexpr mistake map_mistakes[]{
    {"name = \"right\"", "title = \"right\""},
    {"utm_zone = 32", "utm_zone = 61"},
    {"lat_deg = 48.4", "lat_deg = 100.0"},
    {"half_width_m = 2.0", "half_width_m = 0.0"},
    {"rank = 1", "rank = -1"},
    {"rank = 1", "rank = 1.5"},
    {"limit_mps = 14.0", "limit_kmh = 50.0"},
    {"next = []", "next = \"a\""},
    {"[[0.0, 0.0], [50.0, 0.0]]", "[0.0, 0.0, 50.0, 0.0]"},
    {"invented = true", "invented = \"yes\""},
    {"[[building]]", "[[house]]"},
    {"lanes = [\"a\"]", "lanes = \"a\""},
    {"closed = false", "close = false"},
};

inline constexpr mistake sweep_mistakes[]{
    {"name = \"right\"", "name = \"a/b\""},
    {"name = \"right\"", ""},
    {"scenario = \"ulm_lehr.toml\"", ""},
    {"scenario =", "base ="},
    {"seeds = 3", "seeds = 0"},
    {"seeds = 3", "seeds = [1, 1]"},
    {"seeds = 3", "seeds = \"three\""},
    {"seeds = 3", "seeds = []"},
    {"most_seeds = 12", "most_seeds = 0"},
    {"values = [\"60ms\", \"100ms\"]", "values = []"},
    {"values = [\"60ms\", \"100ms\"]", "values = \"60ms\""},
    {"values = [\"60ms\", \"100ms\"]", "value = 1"},
    {"set = { \"policies.lodm\" = \"nearest\" }", ""},
    {"from = 2400.0", "from = \"2400\""},
    {"from = 2400.0", ""},
    {"to = 2750.0", "until = 2750.0"},
};

/// A sweep's keys are looked up where its scenario is read: `sofof sweep` does.
inline constexpr mistake sweep_key_mistakes[]{
    {"duration = \"60s\"", "lasts = \"60s\""},
    {"duration = \"60s\"", "duration = 60"},
    {"record.tracks = false", "record.track = false"},
    {"record.tracks = false", "record.tracks = 0"},
    {"\"fleet.0.count\"", "\"fleet.0.counts\""},
    {"max_interarrival", "max_interarival"},
    {"\"policies.lodm\" = ", "\"policy.lodm\" = "},
};

} // namespace sofof::test
