// A vehicle between providers, as LODMs see it, to ask them.
#pragma once

#include "policies/registry.hpp"
#include "tests/support/decisions.hpp"
#include "tests/support/option_list.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

namespace sofof::test {

/// A vehicle that drives along a street at 10 m/s and plans at 20 Hz, for 10 ms
/// and 27 mJ on board. Nobody is there at first.
struct roadside {
  std::vector<point> path;
  std::vector<policies::provider_view> providers;
  policies::local_context seen;

  roadside() {
    using namespace std::chrono_literals;
    for (int k = 0; k <= 100; ++k)
      path.push_back({5.0 * k, 0});
    seen.service = "any";
    seen.speed_mps = 10;
    seen.noise = random_stream{1, "vehicle"};
    seen.needs = {50ms, 50ms, 100ms};
    seen.on_board = {0.01, 0.027};
  }

  /// Adds one that is near: results take 20 ms and are not late, a cycle costs
  /// 10 mJ, computing takes 8 ms on one of two workers.
  policies::provider_view& add(provider_id id, point at = {100, 0}) {
    using namespace std::chrono_literals;
    policies::provider_view one{.id = id, .at = at};
    one.workers = 2;
    one.computing_s = 0.008;
    one.link = {0, 0, 20ms, 30ms};
    one.cost = {0.012, 0.010};
    providers.push_back(one);
    return providers.back();
  }

  policies::local_decision ask(policies::local_policy& lodm) {
    seen.providers = providers;
    seen.path = path;
    return lodm.decide(seen);
  }

  /// Has the service run somewhere; providers that do so stand first.
  void runs_at(service_place place) {
    seen.current = place;
    seen.since = seen.now;
    const auto i =
        std::ranges::find(providers, place, &policies::provider_view::id);
    if (i != providers.end())
      std::iter_swap(providers.begin(), i);
  }
  void pass(duration time) { seen.now += time; }

  /// @returns what a cycle was like that was planned where it runs now.
  policies::cycle_outcome cycle(bool missed = false, double times = 1) const {
    policies::cycle_outcome one{seen.now, seen.service, seen.current};
    const auto here = std::ranges::find(providers, seen.current,
                                        &policies::provider_view::id);
    const auto is_remote = here != providers.end();
    one.latency_s = missed ? 0.06 : is_remote ? 0.02 : seen.on_board.time_s;
    one.missed = missed;
    one.energy_j = is_remote ? here->cost.energy_j : seen.on_board.energy_j;
    one.cycles = times;
    return one;
  }
};

/// @returns an LODM with these options set.
inline std::unique_ptr<policies::local_policy>
make_lodm_with(std::string_view name, option_values values) {
  option_list options{std::move(values)};
  auto lodm = policies::make_lodm(name);
  REQUIRE(lodm);
  lodm->visit_options(options);
  CHECK(options.refused.empty());
  return lodm;
}

} // namespace sofof::test
