// Tests of what policies of a provider make of a vehicle's chain: a link may
// count for little without another one.
#include "policies/algorithms/chains/leaning.hpp"
#include "tests/policies/scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::policies;
using namespace sofof::test;
using namespace std::chrono_literals;

namespace {

constexpr std::array<std::string_view, 3> chain_names{
    "tracking", "environment_model", "trajectory_planning"};

/// Vehicles with a chain of three services each. A word has a letter for each
/// service in its order: 'a' asked for now, 'r' running here, '.' neither.
struct chain_scene : scene {
  station_id::rep last_station = 100;

  void add(std::string_view word, const std::vector<double>& shares,
           const std::vector<double>& gains) {
    const station_id station = ++last_station;
    const auto place_of = [&](std::size_t k) {
      return word[k] == 'a'   ? link_place::asked
             : word[k] == 'r' ? link_place::here
                              : link_place::elsewhere;
    };
    const auto mark = [&](auto& view, std::size_t k) {
      view.station = station;
      view.service = chain_names[k];
      view.task.wcet = from_seconds(shares[k] * to_seconds(view.task.period));
      view.at_most = view.task;
      if (k > 0)
        view.links.follows = {chain_names[k - 1], place_of(k - 1)};
      if (k + 1 < chain_names.size())
        view.links.followed_by = {chain_names[k + 1], place_of(k + 1)};
    };
    for (std::size_t k = 0; k < word.size(); ++k) {
      if (word[k] == 'a') {
        ask(shares[k], {{self, gains[k], 0}});
        mark(requests.back(), k);
      } else if (word[k] == 'r') {
        run(shares[k], {{self, gains[k], 0}});
        mark(sessions.back(), k);
      }
    }
  }
  void add(std::string_view word, double share, double gain) {
    add(word, std::vector<double>(3, share), std::vector<double>(3, gain));
  }

  central_context context() const {
    return {now, requests, sessions, 0, workers, area, map, self};
  }

  std::size_t size() const { return requests.size() + sessions.size(); }
  bool is_request(std::size_t k) const { return k < requests.size(); }
  station_id station_of(std::size_t k) const {
    return is_request(k) ? requests[k].station
                         : sessions[k - requests.size()].station;
  }
  std::string_view service_of(std::size_t k) const {
    return is_request(k) ? requests[k].service
                         : sessions[k - requests.size()].service;
  }
  double share_of(std::size_t k) const {
    return is_request(k) ? requests[k].utilisation
                         : sessions[k - requests.size()].utilisation;
  }
  double gain_of(std::size_t k) const {
    const auto told = is_request(k) ? requests[k].candidates
                                    : sessions[k - requests.size()].candidates;
    return told.front().gain;
  }

  /// @returns whether a link of a set is without the one that it follows,
  /// though that is asked for with it or runs here; as it is said, not as it is
  /// done.
  bool is_alone(std::size_t k, const std::vector<bool>& served) const {
    for (std::size_t on = 0; on < size(); ++on) {
      const auto follows =
          station_of(k) == station_of(on)
          && std::ranges::find(chain_names, service_of(k))
                 == std::ranges::find(chain_names, service_of(on)) + 1;
      const auto leans = follows && (is_request(k) || !is_request(on));
      if (leans && served[k] && !served[on])
        return true;
    }
    return false;
  }
};

chain_scene any_chains(dice& random, int most) {
  chain_scene at;
  const auto below = [&](int end) {
    return static_cast<int>(random.between(0, end));
  };
  for (int k = below(most) + 1; k > 0; --k) {
    std::string word;
    std::vector<double> shares, gains;
    for (std::size_t link = 0; link < chain_names.size(); ++link) {
      word += "aar."[below(4)];
      shares.push_back((1 + below(4)) * 0.1);
      gains.push_back(random.between(-0.2, 0.8));
    }
    at.add(word, shares, gains);
  }
  return at;
}

std::vector<bool> served_by(const chain_scene& at, central_policy& codm) {
  std::vector<bool> all;
  for (const auto& d : at.decide(codm))
    all.push_back(is_accepted(d));
  for (auto k = all.size(); k < at.size(); ++k)
    all.push_back(true); // goes on
  return all;
}

/// @returns the objective of the assignment, as its formula is written; minus
/// infinity where there is no room.
double objective_of(const chain_scene& at, const std::vector<bool>& served) {
  double longest_s = 0, in_use = 0, used = 0, sum = 0;
  for (std::size_t k = 0; k < at.size(); ++k) {
    longest_s = std::max(longest_s, at.share_of(k) * 0.1);
    if (!at.is_request(k))
      in_use += at.share_of(k);
    if (served[k]) {
      const auto least = price + 0.05 / (1 + at.share_of(k));
      used += at.share_of(k);
      sum += at.is_alone(k, served) ? least : std::max(at.gain_of(k), least);
    }
    if (served[k] == at.is_request(k))
      sum -= price;
  }
  const auto room = std::max(in_use, 0.032 / (longest_s + 0.032));
  return used <= room + rounding ? sum
                                 : -std::numeric_limits<double>::infinity();
}

double best_set(const chain_scene& at) {
  auto best = -std::numeric_limits<double>::infinity();
  for (unsigned set = 0; set < 1U << at.size(); ++set) {
    std::vector<bool> served;
    for (std::size_t k = 0; k < at.size(); ++k)
      served.push_back((set >> k & 1U) != 0);
    best = std::max(best, objective_of(at, served));
  }
  return best;
}

} // namespace

TEST_CASE("a link leans on the one that it follows if that is asked for with "
          "it or runs here, and what runs only on what runs") {
  const auto leaning = [](std::string_view word) {
    chain_scene at;
    at.add(word, 0.1, 0.2);
    return leaning_of(at.context());
  };
  using all = leaning_list;
  CHECK(leaning("aaa") == all{std::nullopt, 0, 1});
  CHECK(leaning("a.a") == all{std::nullopt, std::nullopt});
  CHECK(leaning(".aa") == all{std::nullopt, 0});
  CHECK(leaning("ra.") == all{1, std::nullopt});
  CHECK(leaning("ar.") == all{std::nullopt, std::nullopt});
  CHECK(leaning("rrr") == all{std::nullopt, 0, 1});
}

TEST_CASE("nobody leans on a link of another vehicle") {
  chain_scene at;
  at.add("a..", 0.1, 0.2);
  at.add(".a.", 0.1, 0.2);
  at.requests.back().links.follows.at = link_place::elsewhere;
  CHECK(leaning_of(at.context()) == leaning_list{std::nullopt, std::nullopt});
}

TEST_CASE("exact assignment takes the best set of chains") {
  dice random{21};
  const auto automatic = codm_of("assignment");
  const auto searched = codm_of("assignment", {{"solver", "branch_and_bound"}});
  const auto greedy = codm_of("assignment", {{"solver", "greedy_regret"}});
  const auto sampled = codm_of("cross_entropy");
  int alone_is_better = 0, sampled_is_best = 0;
  constexpr int trials = 300;
  for (int k = 0; k < trials; ++k) {
    CAPTURE(k);
    const auto at = any_chains(random, 4);
    const auto best = best_set(at);
    for (auto* codm : {automatic.get(), searched.get()})
      CHECK(std::abs(objective_of(at, served_by(at, *codm)) - best) < rounding);
    for (auto* codm : {greedy.get(), sampled.get()}) {
      const auto reached = objective_of(at, served_by(at, *codm));
      CHECK(std::isfinite(reached));
      CHECK(reached <= best + rounding);
    }
    sampled_is_best +=
        objective_of(at, served_by(at, *sampled)) >= best - rounding;
    // The same services, as if no chain was known.
    auto apart = at;
    for (auto& x : apart.requests)
      x.links = {};
    for (auto& x : apart.sessions)
      x.links = {};
    alone_is_better +=
        objective_of(at, served_by(apart, *automatic)) < best - rounding;
  }
  CHECK(alone_is_better > trials / 10);
  CHECK(sampled_is_best > trials * 8 / 10);
}

TEST_CASE("no link is refused, and none goes, where there is room for all") {
  for (const auto* name :
       {"assignment", "cross_entropy", "drift_plus_penalty"}) {
    chain_scene at;
    at.workers = 4;
    at.add("aaa", 0.02, -0.5);
    at.add("r.a", 0.02, 0.1);
    at.add(".ra", 0.02, -0.5);
    CHECK(at.verdicts(name) == "hhhhhhh");
  }
}

TEST_CASE("of a chain that does not fit as a whole its first links are "
          "served") {
  chain_scene at;
  at.add("aaa", 0.3, 0.5);
  for (const auto* name : {"assignment", "cross_entropy"})
    CHECK(at.verdicts(*codm_of(name, {}, {{"wait", 40ms}})) == "hh-");
}

TEST_CASE("a link takes the room that is left though the one that it leans on "
          "finds none") {
  chain_scene at;
  at.add("aa.", {0.9, 0.2, 0}, {0.5, 0.5, 0});
  for (const auto* name : {"assignment", "cross_entropy"})
    CHECK(at.verdicts(name) == "-h");
}

TEST_CASE("a link that wins much alone as well takes no room from others if "
          "the one that it leans on finds none") {
  for (const auto* name : {"assignment", "cross_entropy"}) {
    chain_scene at;
    at.add("aa.", {0.9, 0.2, 0}, {0.5, 0.5, 0});
    at.add("a..", {0.2, 0, 0}, {0.2, 0, 0});
    // Of jobs of 90 ms only a quarter of the time would be used.
    CHECK(at.verdicts(name) == "--h");
    at.requests[1].links = {};
    CHECK(at.verdicts(name) == "-h-");
  }
}

TEST_CASE("of what runs that goes which others do not lean on") {
  const auto with = [](double share, double gain, bool chain) {
    chain_scene at;
    at.add("rrr", {0.2, 0.2, 0.2}, {0.1, 0.3, 0.25});
    at.add("a..", {share, 0, 0}, {gain, 0, 0});
    if (!chain)
      for (auto& x : at.sessions)
        x.links = {};
    return at.verdicts(*codm_of("assignment"));
  };
  CHECK(with(0.2, 0.8, false) == "h-hh");
  CHECK(with(0.2, 0.8, true) == "hhh-");
  // For all three: 0.65, and four changes at 0.05 each.
  CHECK(with(0.6, 0.8, true) == "-hhh");
  CHECK(with(0.6, 0.9, true) == "h---");
}

TEST_CASE("a chain is not torn between two providers for little") {
  const auto with = [](double elsewhere, bool chain) {
    chain_scene at;
    at.add("aa.", 0.2, 0.2);
    const std::vector<candidate> told{{self, 0.2, 0}, {second, elsewhere, 0.7}};
    at.requests[0].candidates = told;
    if (!chain)
      at.requests[1].links = {};
    return at.verdicts(*codm_of("assignment"));
  };
  CHECK(with(0.25, false) == "oh");
  CHECK(with(0.25, true) == "hh");
  CHECK(with(0.4, true) == "oh");
}
