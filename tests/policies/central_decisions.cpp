// Tests of policies that decide about all who ask and all who are served
// together: assignment, cross_entropy, best_response.
#include "base/protocol.hpp"
#include "tests/policies/scene.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::policies;
using namespace sofof::test;
using namespace std::chrono_literals;

namespace {

const auto batch_codms = {"assignment", "cross_entropy", "best_response"};

// -- the assignment, as its formula is written -------------------------------

std::optional<double> gain_of(std::span<const candidate> told, provider_id id) {
  for (const auto& c : told)
    if (c.provider == id)
      return c.gain;
  return std::nullopt;
}

double local_gain(std::span<const candidate> told, double share) {
  const auto least = price + 0.05 / (1 + share);
  return std::max(gain_of(told, self).value_or(least), least);
}

struct room {
  double here = 0, at_second = 0, at_third = 0;
};

room room_of(const scene& at) {
  double longest_s = 0, used = 0;
  room all;
  bool knows_second = false, knows_third = false;
  for (const auto& r : at.requests) {
    longest_s = std::max(longest_s, r.utilisation * 0.1);
    knows_second |= gain_of(r.candidates, second).has_value();
    knows_third |= gain_of(r.candidates, third).has_value();
  }
  for (const auto& s : at.sessions) {
    longest_s = std::max(longest_s, s.utilisation * 0.1);
    used += s.utilisation;
  }
  all.here = std::max(used, 0.032 / (longest_s + 0.032));
  all.at_second = knows_second ? 0.4 : 0;
  all.at_third = knows_third ? 0.7 : 0;
  return all;
}

/// @returns the objective of the best of all decisions from one on.
double best_by_trying(const scene& at, room left, std::size_t from = 0) {
  if (from == at.requests.size() + at.sessions.size())
    return 0;
  const auto rest = [&](double room::*where, double share) {
    auto less = left;
    less.*where -= share;
    return best_by_trying(at, less, from + 1);
  };
  if (from >= at.requests.size()) {
    const auto& s = at.sessions[from - at.requests.size()];
    auto best = best_by_trying(at, left, from + 1) - price;
    if (s.utilisation <= left.here + rounding)
      best = std::max(best, local_gain(s.candidates, s.utilisation)
                                + rest(&room::here, s.utilisation));
    return best;
  }
  const auto& r = at.requests[from];
  auto best = best_by_trying(at, left, from + 1);
  const auto go = [&](double room::*where, std::optional<double> gain) {
    if (gain && r.utilisation <= left.*where + rounding)
      best = std::max(best, *gain - price + rest(where, r.utilisation));
  };
  go(&room::here, local_gain(r.candidates, r.utilisation));
  go(&room::at_second, gain_of(r.candidates, second));
  go(&room::at_third, gain_of(r.candidates, third));
  return best;
}

/// @returns the objective of decisions; checks that they are possible.
double value_of(const scene& at, const std::vector<central_decision>& all) {
  auto left = room_of(at);
  double sum = 0;
  REQUIRE(all.size() == at.requests.size() + at.sessions.size());
  for (std::size_t k = 0; k < at.requests.size(); ++k) {
    const auto& r = at.requests[k];
    if (is_accepted(all[k])) {
      left.here -= r.utilisation;
      sum += local_gain(r.candidates, r.utilisation) - price;
    } else if (const auto other = instead_of(all[k])) {
      (*other == second ? left.at_second : left.at_third) -= r.utilisation;
      sum += gain_of(r.candidates, *other).value() - price;
    }
  }
  for (std::size_t k = 0; k < at.sessions.size(); ++k) {
    const auto& s = at.sessions[k];
    if (is_accepted(all[at.requests.size() + k])) {
      left.here -= s.utilisation;
      sum += local_gain(s.candidates, s.utilisation);
    } else {
      sum -= price;
    }
  }
  CHECK(left.here >= -rounding);
  CHECK(left.at_second >= -rounding);
  CHECK(left.at_third >= -rounding);
  return sum;
}

} // namespace

TEST_CASE("the assignment is the best of all that is possible") {
  dice random{1};
  const auto automatic = codm_of("assignment");
  const auto searched = codm_of("assignment", {{"solver", "branch_and_bound"}});
  const auto greedy = codm_of("assignment", {{"solver", "greedy_regret"}});
  for (int k = 0; k < 300; ++k) {
    CAPTURE(k);
    scene at;
    fill(at, random, 6);
    const auto best = best_by_trying(at, room_of(at));
    CHECK(std::abs(value_of(at, at.decide(*automatic)) - best) < rounding);
    CHECK(std::abs(value_of(at, at.decide(*searched)) - best) < rounding);
    CHECK(value_of(at, at.decide(*greedy)) <= best + rounding);
  }
}

TEST_CASE("sampling finds what is possible, and mostly the best") {
  dice random{2};
  const auto codm = codm_of("cross_entropy");
  int found = 0;
  for (int k = 0; k < 30; ++k) {
    CAPTURE(k);
    scene at;
    fill(at, random, 5);
    const auto best = best_by_trying(at, room_of(at));
    const auto value = value_of(at, at.decide(*codm));
    CHECK(value <= best + rounding);
    found += value >= best - rounding;
  }
  CHECK(found >= 25);
}

TEST_CASE("the same context gives the same decisions, whoever decides and "
          "however often") {
  dice random{3};
  for (const auto* name : batch_codms) {
    CAPTURE(name);
    const auto one = codm_of(name);
    for (int k = 0; k < 10; ++k) {
      scene at;
      fill(at, random, 8);
      const auto first = at.verdicts(*one, k);
      CHECK(first.size() == at.requests.size() + at.sessions.size());
      CHECK(at.verdicts(*one, k) == first);
      CHECK(at.verdicts(*one->clone(), k) == first);
    }
  }
}

TEST_CASE("nobody who asks is nobody who is told to go") {
  for (const auto* name : batch_codms) {
    scene at;
    CHECK(at.verdicts(name).empty());
    for (int k = 0; k < 3; ++k)
      at.run(0.1, {{self, -0.5, 0}});
    CHECK(at.verdicts(name) == "hhh");
  }
}

TEST_CASE("nobody is sent home, and nobody refused, where there is room for "
          "all") {
  dice random{5};
  for (const auto* name : {"assignment", "cross_entropy"}) {
    const auto codm = codm_of(name);
    for (int k = 0; k < 5; ++k) {
      scene at;
      at.workers = 4;
      for (int n = 0; n < 30; ++n)
        at.run(0.02, {{self, random.between(-1, 0.5), 0}},
               static_cast<std::size_t>(n));
      at.ask_alike(2, 0.02, 0.6);
      CHECK(at.verdicts(*codm, k) == std::string(32, 'h'));
    }
  }
}

TEST_CASE("answers come before vehicles give up") {
  for (const auto* name : batch_codms) {
    const auto waits_s = codm_of(name)->epoch_s();
    CHECK(waits_s > 0);
    CHECK(waits_s < to_seconds(protocol::request_timeout) / 1.5);
  }
}

TEST_CASE("the wait that is allowed limits how many are served") {
  scene at;
  at.ask_alike(14, 0.08, 0.3);
  // 2 w / (S + 2 w) = 0.8 of a worker for w = 16 ms, 0.5 for 4 ms.
  for (const auto* name : {"assignment", "cross_entropy"}) {
    const auto usual = at.verdicts(name);
    CHECK(std::ranges::count(usual, 'h') == 10);
    const auto hasty = at.verdicts(*codm_of(name, {}, {{"wait", 4ms}}));
    CHECK(std::ranges::count(hasty, 'h') == 6);
  }
}

TEST_CASE("scarce room goes to who wins most by it") {
  for (const auto* name : {"assignment", "cross_entropy"}) {
    scene at;
    at.ask(0.4, {{self, 0.2, 0}});
    at.ask(0.4, {{self, 0.5, 0}});
    at.ask(0.4, {{self, 0.3, 0}});
    CHECK(at.verdicts(*codm_of(name, {}, {{"wait", 100ms}})) == "-hh");
  }
}

TEST_CASE("who wins more elsewhere is told so, as long as there is room") {
  for (const auto* name : {"assignment", "cross_entropy"}) {
    scene at;
    at.ask(0.2, {{self, 0.2, 0}, {second, 0.4, 0.5}});
    CHECK(instead_of(at.decide(*codm_of(name)).front()) == second);
    scene full;
    full.ask(0.2, {{self, 0.2, 0}, {second, 0.4, 0.9}});
    CHECK(full.verdicts(name) == "h");
  }
}

TEST_CASE("the fullest that is told of a provider counts") {
  scene at;
  at.ask(0.2, {{self, 0.2, 0}, {second, 0.4, 0.1}});
  at.ask(0.2, {{self, 0.2, 0}, {second, 0.4, 0.9}});
  CHECK(at.verdicts("assignment") == "hh");
}

TEST_CASE("what runs goes only for another one who wins more by two prices") {
  for (const auto* name : {"assignment", "cross_entropy"}) {
    const auto with = [&](double gain) {
      scene at;
      at.run(0.5, {{self, 0.2, 0}});
      at.ask(0.5, {{self, gain, 0}});
      return at.verdicts(*codm_of(name, {}, {{"wait", 50ms}}));
    };
    CHECK(with(0.2) == "-h");
    CHECK(with(0.29) == "-h");
    CHECK(with(0.31) == "h-");
  }
}

TEST_CASE("what runs stays where a long job asks, and less would be allowed") {
  for (const auto* name : {"assignment", "cross_entropy"}) {
    scene at;
    for (int k = 0; k < 9; ++k)
      at.run(0.08, {{self, 0.2, 0}});
    at.ask(0.5, {{self, 0.1, 0}}, 1s); // of 500 ms: allows only 6 %
    CHECK(at.verdicts(name) == "-hhhhhhhhh");
  }
}

TEST_CASE("who tells no gain, or one below zero, is served last, the smaller "
          "first") {
  for (const auto* name : {"assignment", "cross_entropy"}) {
    scene at;
    at.ask(0.5, {});
    at.ask(0.3, {{second, -0.1, 0}});
    at.ask(0.3, {{self, -0.7, 0}});
    at.ask(0.3, {{self, 0.15, 0}});
    CHECK(at.verdicts(*codm_of(name, {}, {{"wait", 250ms}})) == "-hhh");
    at.ask(0.3, {{self, 0.15, 0}});
    const auto all = at.verdicts(*codm_of(name, {}, {{"wait", 250ms}}));
    CHECK(all.starts_with('-'));
    CHECK(all.ends_with("hh"));
    CHECK(std::ranges::count(all, 'h') == 3);
  }
}

TEST_CASE("absurd numbers of one do the others no harm") {
  scene at;
  at.ask(0.3, {{self, 1e300, -1e300}, {second, 1e300, 1e300}});
  at.ask(0.3, {{self, -1e300, 1e300}, {third, -1e300, -1e300}, {0, 1, 0}});
  at.ask(0.3, {{self, 0.2, 0}});
  at.ask(0.3, {{self, 0.4, 0}});
  std::vector<candidate> many;
  for (provider_id::rep id = 100; id < 5000; ++id)
    many.push_back({id, -1, 0.5});
  at.ask(0.3, many);
  CHECK(at.verdicts(*codm_of("assignment", {}, {{"wait", 50ms}})) == "h--h-");
  for (const auto* name : batch_codms) {
    const auto all = at.verdicts(name);
    CHECK(all.size() == 5);
    CHECK(all[0] == 'h');
    CHECK(all[3] != 'o');
  }
}

TEST_CASE("an unknown solver or model is refused, and a clone keeps a known "
          "one") {
  test::option_list options;
  options.texts = {{"solver", "simplex"}, {"model", "collision"}};
  make_codm("assignment")->visit_options(options);
  options.names.clear();
  make_codm("best_response")->visit_options(options);
  CHECK(options.refused.contains("solver"));
  CHECK(options.refused.contains("model"));
  scene at;
  at.ask_alike(3, 0.08, 0.2);
  CHECK(at.verdicts(
            *codm_of("best_response", {{"model", "interference"}})->clone())
        == at.verdicts(*codm_of("best_response", {{"model", "interference"}})));
}
