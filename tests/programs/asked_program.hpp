// Situations to ask programs about.
#pragma once

#include "policies/api/context.hpp"
#include "tests/support/scratch.hpp"

#include <chrono>
#include <string>
#include <vector>

namespace sofof::test {

/// A vehicle on the way to two providers, as an LODM sees it.
struct asked_vehicle {
  std::vector<point> path{{0, 0}, {5, 0.5}};
  std::vector<policies::provider_view> providers;
  policies::local_context seen;

  asked_vehicle() {
    using namespace std::chrono_literals;
    for (const auto id : {65537, 65538}) {
      policies::provider_view one;
      one.id = static_cast<std::uint64_t>(id);
      one.at = {10.0 * (id - 65537), -20.25};
      one.utilisation = 0.1;
      one.workers = 4;
      one.computing_s = 0.0032;
      one.cost = {0.03, 0.002};
      providers.push_back(one);
    }
    providers.front().link = {0.25, 0.125, 20ms, 45ms};
    seen.now = time_point{12345ms};
    seen.service = "trajectory_planning";
    seen.speed_mps = 8.5;
    seen.noise = random_stream{1, "vehicle"};
    seen.number = 7;
    seen.needs = {100ms, 50ms, 150ms};
    seen.on_board = {0.0055, 0.01485};
    seen.station = 101;
    seen.path = path;
    seen.providers = providers;
  }
  asked_vehicle(const asked_vehicle&) = delete;
  asked_vehicle& operator=(const asked_vehicle&) = delete;
};

/// A provider that is asked by two vehicles and serves one, as a CODM sees it.
struct asked_provider {
  std::vector<point> route{{0, 0}, {5, 0.5}};
  std::vector<candidate> wins{{65537, 0.5, 0.25}};
  polygon area{{{0, 0}, {100, 0}, {100, 100}}};
  world::road_map map{};
  std::vector<policies::request_view> requests;
  std::vector<policies::session_view> sessions;

  asked_provider() {
    using namespace std::chrono_literals;
    const policies::periodic_task task{4ms, 100ms, 50ms, 100ms, 20ms};
    for (const station_id station : {101, 102})
      requests.push_back({.station = station,
                          .service = "trajectory_planning",
                          .route = route,
                          .speed_mps = 8.5,
                          .utilisation = 0.01,
                          .task = task,
                          .at_most = task,
                          .candidates = wins});
    sessions.push_back({.station = 103,
                        .service = "trajectory_planning",
                        .since = time_point{2s},
                        .task = task,
                        .worker = 1,
                        .utilisation = 0.01,
                        .candidates = wins,
                        .at_most = task});
  }
  asked_provider(const asked_provider&) = delete;
  asked_provider& operator=(const asked_provider&) = delete;

  policies::central_context seen() const {
    return {.now = time_point{std::chrono::milliseconds{12500}},
            .requests = requests,
            .sessions = sessions,
            .utilisation = 0.25,
            .workers = 4,
            .area = area,
            .map = map,
            .self = 65537,
            .noise = random_stream{1, "provider"},
            .number = 3};
  }
};

} // namespace sofof::test
