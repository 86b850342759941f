// A small town to rank policies in.
#pragma once

namespace sofof::test {

inline constexpr auto bench_town = R"([street_grid]
columns = 3
rows = 2
[[fleet]]
count = 4
routes = ["block *"]
[[provider]]
position_m = [100.0, 50.0]
[network]
profile = "ideal"
[compute]
more_computing = "8ms"
[[service]]
name = "trajectory_planning"
planner = "lane_follow"
period = "100ms"
max_interarrival = "150ms"
[policies]
lodm = { name = "nearest", filter = "none" }
codm = "never"
)";

} // namespace sofof::test
