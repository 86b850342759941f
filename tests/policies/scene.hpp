// A provider's day: who asks, what runs, and what a CODM says to that.
#pragma once

#include "policies/registry.hpp"
#include "tests/support/decisions.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/option_list.hpp"

#include <doctest/doctest.h>

#include <deque>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sofof::test {

using namespace std::chrono_literals;

inline constexpr provider_id self = 11, second = 22, third = 33;
/// What moving a service that runs must win.
inline constexpr double price = 0.05;
/// Of sums of gains.
inline constexpr double rounding = 1e-8;

/// A CODM without a filter.
inline std::unique_ptr<policies::central_policy>
codm_of(std::string_view name,
        std::map<std::string, std::string, std::less<>> texts = {},
        std::map<std::string, duration, std::less<>> times = {}) {
  auto codm = policies::make_codm(name);
  option_list options;
  options.texts = std::move(texts);
  options.texts["filter.name"] = "none";
  options.times = std::move(times);
  codm->visit_options(options);
  CHECK(options.refused.empty());
  return codm;
}

/// Services that plan every 100 ms within 50 ms: a share of 0.08 of one worker
/// is 8 ms.
struct scene {
  const polygon area{{{0, 0}, {1, 0}, {1, 1}}};
  const world::road_map map{"street", {}, {}};
  std::deque<std::vector<candidate>> told; // which views look at
  std::vector<policies::request_view> requests;
  std::vector<policies::session_view> sessions;
  std::size_t workers = 1;

  void ask(double share, std::vector<candidate> candidates,
           duration period = 100ms) {
    told.push_back(std::move(candidates));
    policies::request_view r;
    r.station = 101;
    r.service = "any";
    r.utilisation = share;
    r.task.period = period;
    r.task.deadline = 50ms;
    r.candidates = told.back();
    requests.push_back(r);
  }
  void run(double share, std::vector<candidate> candidates,
           std::size_t worker = 0) {
    told.push_back(std::move(candidates));
    policies::session_view s;
    s.station = 102;
    s.service = "any";
    s.utilisation = share;
    s.task.period = 100ms;
    s.task.deadline = 50ms;
    s.worker = worker;
    s.candidates = told.back();
    sessions.push_back(s);
  }
  void ask_alike(int count, double share, double gain) {
    for (int k = 0; k < count; ++k)
      ask(share, {{self, gain, 0}});
  }

  time_point now;

  std::vector<policies::central_decision>
  decide(policies::central_policy& codm, std::uint64_t number = 1) const {
    double used = 0;
    for (const auto& s : sessions)
      used += s.utilisation;
    return codm.decide({now, requests, sessions, used, workers, area, map, self,
                        random_stream{1, "codm"}, number});
  }
  /// @returns 'h' for here, 'o' for another provider, '-' for nobody; requests,
  /// and then sessions.
  std::string verdicts(policies::central_policy& codm,
                       std::uint64_t number = 1) const {
    std::string all;
    for (const auto& d : decide(codm, number)) {
      CHECK(!d.why.empty());
      all += is_accepted(d) ? 'h' : instead_of(d) ? 'o' : '-';
    }
    return all;
  }
  std::string verdicts(std::string_view name) const {
    return verdicts(*codm_of(name));
  }
};

/// A scene with gains of either sign, who tells nothing, and other providers.
inline void fill(scene& at, dice& random, int most) {
  const auto below = [&](int end) {
    return static_cast<int>(random.between(0, end));
  };
  const auto candidates = [&] {
    std::vector<candidate> all;
    for (const auto id : {self, second, third})
      if (below(4) > 0)
        all.push_back(
            {id, random.between(-0.2, 0.8), id == second ? 0.6 : 0.3});
    return all;
  };
  const auto share = [&] { return (1 + below(4)) * 0.1; };
  for (int k = below(most) + 1; k > 0; --k)
    at.ask(share(), candidates());
  for (int k = below(3); k > 0; --k)
    at.run(share(), candidates());
}

} // namespace sofof::test
