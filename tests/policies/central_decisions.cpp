// Tests of policies that decide about all who ask and all who are served
// together: assignment, cross_entropy, best_response.
#include "policies/registry.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/option_list.hpp"
#include "world/protocol.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

using namespace sofof;
using namespace std::chrono_literals;
using test::dice;

namespace {

constexpr boot_id self = 11, second = 22, third = 33;
constexpr double price = 0.05;

const auto policies = {"assignment", "cross_entropy", "best_response"};

std::unique_ptr<central_policy>
make(std::string_view name,
     std::map<std::string, std::string, std::less<>> texts = {},
     std::map<std::string, duration, std::less<>> times = {}) {
  auto codm = make_codm(name);
  test::option_list options;
  options.texts = std::move(texts);
  options.texts["filter.name"] = "none";
  options.times = std::move(times);
  codm->fields(options);
  CHECK(options.refused.empty());
  return codm;
}

/// Services that plan every 100 ms within 50 ms: a share of 0.08 of one worker
/// is 8 ms.
struct scene {
  const polygon area{{{0, 0}, {1, 0}, {1, 1}}};
  const road_map map{"street", {}, {}};
  std::deque<std::vector<candidate>> told; // which views look at
  std::vector<request_view> requests;
  std::vector<session_view> sessions;
  std::size_t workers = 1;

  void ask(double share, std::vector<candidate> candidates,
           duration period = 100ms) {
    told.push_back(std::move(candidates));
    request_view r;
    r.station = 101;
    r.kind = "any";
    r.utilisation = share;
    r.task.period = period;
    r.task.deadline = 50ms;
    r.candidates = told.back();
    requests.push_back(r);
  }
  void run(double share, std::vector<candidate> candidates,
           std::size_t worker = 0) {
    told.push_back(std::move(candidates));
    session_view s;
    s.station = 102;
    s.kind = "any";
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

  std::vector<central_decision> decide(central_policy& codm,
                                       std::uint64_t number = 1) const {
    double used = 0;
    for (const auto& s : sessions)
      used += s.utilisation;
    return codm.decide({now, requests, sessions, used, workers, area, map, self,
                        random_stream{1, "codm"}, number});
  }
  /// @returns 'h' for here, 'o' for another provider, '-' for nobody; requests,
  /// and then sessions.
  std::string verdicts(central_policy& codm, std::uint64_t number = 1) const {
    std::string all;
    for (const auto& d : decide(codm, number)) {
      CHECK(!d.why.empty());
      CHECK((!d.accept || d.instead == 0));
      all += d.accept ? 'h' : d.instead != 0 ? 'o' : '-';
    }
    return all;
  }
  std::string verdicts(std::string_view name) const {
    return verdicts(*make(name));
  }
};

/// A scene with gains of either sign, who tells nothing, and other providers.
void fill(scene& at, dice& random, int most) {
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

// -- the assignment, as its formula is written -------------------------------

std::optional<double> gain_of(std::span<const candidate> told, boot_id id) {
  for (const auto& c : told)
    if (c.provider == id)
      return c.gain;
  return std::nullopt;
}

double gain_here(std::span<const candidate> told, double share) {
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

constexpr double rounding = 1e-8;

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
      best = std::max(best, gain_here(s.candidates, s.utilisation)
                                + rest(&room::here, s.utilisation));
    return best;
  }
  const auto& r = at.requests[from];
  auto best = best_by_trying(at, left, from + 1);
  const auto go = [&](double room::*where, std::optional<double> gain) {
    if (gain && r.utilisation <= left.*where + rounding)
      best = std::max(best, *gain - price + rest(where, r.utilisation));
  };
  go(&room::here, gain_here(r.candidates, r.utilisation));
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
    if (all[k].accept) {
      left.here -= r.utilisation;
      sum += gain_here(r.candidates, r.utilisation) - price;
    } else if (all[k].instead != 0) {
      (all[k].instead == second ? left.at_second : left.at_third) -=
          r.utilisation;
      sum += gain_of(r.candidates, all[k].instead).value() - price;
    }
  }
  for (std::size_t k = 0; k < at.sessions.size(); ++k) {
    const auto& s = at.sessions[k];
    if (all[at.requests.size() + k].accept) {
      left.here -= s.utilisation;
      sum += gain_here(s.candidates, s.utilisation);
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
  const auto automatic = make("assignment");
  const auto searched = make("assignment", {{"solver", "branch_and_bound"}});
  const auto greedy = make("assignment", {{"solver", "greedy_regret"}});
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
  const auto codm = make("cross_entropy");
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
  for (const auto* name : policies) {
    CAPTURE(name);
    const auto one = make(name);
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
  for (const auto* name : policies) {
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
    const auto codm = make(name);
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
  for (const auto* name : policies) {
    const auto waits_s = make(name)->epoch_s();
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
    const auto hasty = at.verdicts(*make(name, {}, {{"wait", 4ms}}));
    CHECK(std::ranges::count(hasty, 'h') == 6);
  }
}

TEST_CASE("scarce room goes to who wins most by it") {
  for (const auto* name : {"assignment", "cross_entropy"}) {
    scene at;
    at.ask(0.4, {{self, 0.2, 0}});
    at.ask(0.4, {{self, 0.5, 0}});
    at.ask(0.4, {{self, 0.3, 0}});
    CHECK(at.verdicts(*make(name, {}, {{"wait", 100ms}})) == "-hh");
  }
}

TEST_CASE("who wins more elsewhere is told so, as long as there is room") {
  for (const auto* name : {"assignment", "cross_entropy"}) {
    scene at;
    at.ask(0.2, {{self, 0.2, 0}, {second, 0.4, 0.5}});
    CHECK(at.decide(*make(name)).front().instead == second);
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
      return at.verdicts(*make(name, {}, {{"wait", 50ms}}));
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
    CHECK(at.verdicts(*make(name, {}, {{"wait", 250ms}})) == "-hhh");
    at.ask(0.3, {{self, 0.15, 0}});
    const auto all = at.verdicts(*make(name, {}, {{"wait", 250ms}}));
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
  for (boot_id id = 100; id < 5000; ++id)
    many.push_back({id, -1, 0.5});
  at.ask(0.3, many);
  CHECK(at.verdicts(*make("assignment", {}, {{"wait", 50ms}})) == "h--h-");
  for (const auto* name : policies) {
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
  make_codm("assignment")->fields(options);
  options.names.clear();
  make_codm("best_response")->fields(options);
  CHECK(options.refused.contains("solver"));
  CHECK(options.refused.contains("model"));
  scene at;
  at.ask_alike(3, 0.08, 0.2);
  CHECK(
      at.verdicts(*make("best_response", {{"model", "interference"}})->clone())
      == at.verdicts(*make("best_response", {{"model", "interference"}})));
}

// -- the game ----------------------------------------------------------------

namespace {

/// What computing 8 ms alone within 50 ms costs.
constexpr double computes_alone = 0.3 * 8 / 50;

} // namespace

TEST_CASE("as many play on a worker as it pays beside the others") {
  scene at;
  at.ask_alike(14, 0.08, 5.5 * computes_alone);
  CHECK(std::ranges::count(at.verdicts("best_response"), 'h') == 6);
  scene two;
  two.workers = 2;
  two.ask_alike(14, 0.04, 5.5 * computes_alone); // of two workers
  const auto all = two.decide(*make("best_response"));
  CHECK(std::ranges::count(all, true, &central_decision::accept) == 12);
  CHECK(std::ranges::count_if(
            all, [](const auto& d) { return d.accept && d.worker == 1; })
        == 6);
}

TEST_CASE("where each is the other's noise, fewer play") {
  scene at;
  at.ask_alike(14, 0.08, 5.5 * computes_alone);
  const auto all =
      at.verdicts(*make("best_response", {{"model", "interference"}}));
  // Two cost log2(101) / log2(1 + 1 / 1.01) = 6.7 times as much as one.
  CHECK(std::ranges::count(all, 'h') == 1);
}

TEST_CASE("nobody would rather have decided differently") {
  dice random{4};
  for (int k = 0; k < 100; ++k) {
    CAPTURE(k);
    scene at;
    at.workers = 1 + k % 3;
    const auto share = 0.08 / static_cast<double>(at.workers);
    std::vector<double> wins;
    for (int n = 0; n < 12; ++n) {
      wins.push_back(random.between(0.11, 0.5));
      at.ask(share, {{self, wins.back(), 0}});
    }
    for (int n = 0; n < 4; ++n) {
      const auto gain = random.between(0.11, 0.5);
      wins.push_back(gain + price);
      at.run(share, {{self, gain, 0}}, static_cast<std::size_t>(n));
    }
    const auto all = at.decide(*make("best_response"), k);
    std::vector<int> on(at.workers);
    for (const auto& d : all)
      if (d.accept)
        ++on.at(d.worker);
    const auto least = *std::ranges::min_element(on);
    for (std::size_t n = 0; n < all.size(); ++n) {
      if (all[n].accept) {
        CHECK(wins[n] >= computes_alone * (on[all[n].worker] - 1) - rounding);
        CHECK(on[all[n].worker] <= least + 1);
      } else {
        CHECK(wins[n] <= computes_alone * least + rounding);
      }
    }
  }
}

TEST_CASE("a player is crowded out by others, never by itself") {
  scene at;
  at.run(0.08, {{self, -3, 0}});
  CHECK(at.verdicts("best_response") == "h");
  at.ask_alike(1, 0.08, 0.5);
  CHECK(at.verdicts("best_response") == "hh");
  at.ask_alike(9, 0.08, 0.5);
  CHECK(at.verdicts("best_response").ends_with('-'));
}

TEST_CASE("who finds it too crowded is told who would be better, if there is "
          "room") {
  scene at;
  at.ask_alike(11, 0.08, 0.5);
  at.ask(
      0.08,
      {{self, 0.1, 0}, {second, 0.3, 0.95}, {third, 0.2, 0.1}, {44, 0.1, 0.1}});
  at.ask(0.08, {{self, 0.1, 0}, {third, -0.2, 0.1}});
  const auto all = at.decide(*make("best_response"));
  CHECK(!all[11].accept);
  CHECK(all[11].instead == third);
  CHECK(!all[12].accept);
  CHECK(all[12].instead == 0);
}

// -- behind a filter ---------------------------------------------------------

namespace {

/// Says yes to so many, and is rid of all sessions if it comes to them.
class brief final : public central_policy {
public:
  explicit brief(std::size_t count) : count_{count} {}
  std::vector<central_decision>
  decide(const central_context& context) override {
    std::vector<central_decision> all;
    for (std::size_t k = 0; k < count_; ++k)
      all.push_back({k < context.requests.size(), "brief"});
    return all;
  }
  std::string_view name() const override { return "brief"; }
  std::unique_ptr<central_policy> clone() const override {
    return std::make_unique<brief>(*this);
  }

private:
  std::size_t count_;
};

/// Four requests, of which the filter stops the second, and two sessions.
std::string behind_a_filter(std::size_t count) {
  scene at;
  at.ask_alike(4, 0.1, 0.2);
  at.run(0.1, {});
  at.run(0.1, {});
  const polygon area{{{-100, -100}, {200, -100}, {200, 100}, {-100, 100}}};
  const road_map map{
      "street",
      {},
      {{"street", {{-500, 0}, {500, 0}}, 1.75, {{0, 14}}, {}, 0}}};
  const std::vector<point> inside{{0, 0}, {200, 0}}, off{{0, 50}, {200, 50}};
  for (auto& r : at.requests)
    r.route = inside;
  at.requests[1].route = off;
  filtered_codm codm{std::make_unique<brief>(count)};
  std::string all;
  for (const auto& d :
       codm.decide({time_point{}, at.requests, at.sessions, 0, 1, area, map})) {
    CHECK(!d.why.empty());
    all += d.accept ? 'h' : d.why == "not decided" ? '?' : '-';
  }
  return all;
}

} // namespace

TEST_CASE("what a choice leaves out is refused, also behind a filter") {
  CHECK(behind_a_filter(0) == "?-??");
  CHECK(behind_a_filter(1) == "h-??");
  CHECK(behind_a_filter(2) == "h-h?");
}

TEST_CASE(
    "what a choice says of sessions is of the same ones behind a filter") {
  CHECK(behind_a_filter(3) == "h-hh");
  CHECK(behind_a_filter(4) == "h-hh-");
  CHECK(behind_a_filter(5) == "h-hh--");
}

// -- drift_plus_penalty: of one who asks, and whose results are late ----------

namespace {

episode_outcome late_after(double remote_s) {
  return {"any", self, remote_s, "qos_latency", 101};
}

} // namespace

TEST_CASE("without debts drift-plus-penalty decides as assignment does") {
  dice random{7};
  for (int k = 0; k < 50; ++k) {
    scene at;
    fill(at, random, 8);
    CHECK(at.verdicts("drift_plus_penalty") == at.verdicts("assignment"));
  }
}

TEST_CASE("who is late too often is refused until its debt is paid") {
  scene at;
  at.ask(0.08, {{self, 0.5, 0}});
  const auto codm = make("drift_plus_penalty");
  int lates = 0;
  while (at.verdicts(*codm) == "h") {
    REQUIRE(++lates < 20);
    codm->observe(late_after(0.5));
  }
  CHECK(lates > 1); // one is no reason
  CHECK(at.decide(*codm).front().why == "late too often");
  scene other;
  other.ask(0.08, {{self, 0.5, 0}});
  other.requests.front().station = 103;
  CHECK(other.verdicts(*codm) == "h"); // nobody pays for another one
  auto waited = 0s;
  while (at.verdicts(*codm) == "-") {
    REQUIRE(++waited < 300s);
    at.now += 1s;
  }
  CHECK(waited > 1s);
}

TEST_CASE("who is late seldom enough is never refused") {
  scene at;
  at.ask(0.08, {{self, 0.5, 0}});
  const auto codm = make("drift_plus_penalty");
  for (int k = 0; k < 1000; ++k) {
    CHECK(at.verdicts(*codm) == "h");
    codm->observe(late_after(20)); // 200 cycles, of which 2 may be
    at.now += 20s;
  }
}
