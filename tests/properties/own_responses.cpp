// Random sets of a vehicle's own functions on the cores that they share:
// whether results keep what was stated of them, all at home at once.
#include "actors/offloading/own_function.hpp"
#include "channel/preemptive_core.hpp"
#include "offloading/service_cycle.hpp"
#include "policies/algorithms/scheduling/preemptive.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/echo_service.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::policies;
using namespace sofof::test;
using namespace std::chrono_literals;

namespace {

constexpr time_point at_home{10s};
constexpr auto played_time = 2s;
constexpr int random_plays = 4;

/// A number of sets; SOFOF_SETS asks for more, or for fewer.
std::uint64_t sets() {
  const auto* wanted = std::getenv("SOFOF_SETS");
  return wanted ? std::strtoull(wanted, nullptr, 10) : 100;
}

/// A function of a set.
struct drawn_function {
  periodic_task task;
  bool per_input = false;
  std::optional<std::size_t> after{}; ///< Whose results call it.
};

/// A vehicle's functions and cores.
struct drawn_functions {
  core_order order = core_order::fixed_priority;
  std::size_t cores = 1;
  double load = 0; ///< Of the core that has most to do.
  std::vector<drawn_function> all;
  std::vector<std::size_t> core_of;

  std::vector<periodic_task> tasks() const {
    std::vector<periodic_task> some;
    for (const auto& one : all)
      some.push_back(one.task);
    return some;
  }
  /// @returns those of a core, by their numbers there.
  std::vector<std::size_t> on(std::size_t core) const {
    std::vector<std::size_t> some;
    for (std::size_t k = 0; k < all.size(); ++k)
      if (core_of[k] == core)
        some.push_back(k);
    return some;
  }
};

drawn_functions draw_functions(dice& draw, core_order order) {
  drawn_functions set;
  set.order = order;
  constexpr std::array cores{1, 1, 1, 2, 4};
  set.cores = static_cast<std::size_t>(
      cores[static_cast<std::size_t>(draw.between(0, 5))]);
  const auto count = static_cast<std::size_t>(draw.between(1, 7));
  for (std::size_t k = 0; k < count; ++k) {
    drawn_function one;
    auto& task = one.task;
    task.period = from_seconds(1e-3 * draw.between(10, 200));
    task.deadline = task.period;
    task.wcet = from_seconds(to_seconds(task.period) * draw.between(0.05, 0.5));
    const auto kind = draw.between(0, 4);
    one.per_input = kind >= 2;
    if (kind >= 3 && k > 0)
      one.after = k - 1;
    task.jitter = one.per_input ? jitter_of_calls(task.period)
                                : jitter_with_first_cycle(task.period);
    set.all.push_back(one);
  }
  set.core_of = share_out(set.tasks(), set.cores);
  std::vector<double> loads(set.cores);
  for (std::size_t k = 0; k < count; ++k)
    loads[set.core_of[k]] += utilisation(std::array{set.all[k].task});
  set.load = draw.between(0.1, 0.95);
  const auto scale = set.load / std::ranges::max(loads);
  for (auto& one : set.all)
    one.task.wcet = from_seconds(to_seconds(one.task.wcet) * scale);
  return set;
}

std::vector<std::optional<duration>> stated_of(const drawn_functions& set) {
  std::vector<std::optional<duration>> all(set.all.size());
  for (std::size_t core = 0; core < set.cores; ++core) {
    const auto here = set.on(core);
    std::vector<periodic_task> tasks;
    for (const auto k : here)
      tasks.push_back(set.all[k].task);
    const auto stated = preemptive_responses(tasks, set.order);
    for (std::size_t n = 0; n < here.size(); ++n)
      all[here[n]] = stated[n];
  }
  return all;
}

/// How functions come home: at random, or each so much after the first, with
/// the longest run times, its grid coming right after it, and called whenever
/// that is possible.
using homecoming = std::optional<std::vector<duration>>;

/// The functions of a vehicle as they are run.
class vehicle_at_home {
public:
  vehicle_at_home(const drawn_functions& set, const homecoming& how, dice& draw)
      : set_{set}, how_{how}, draw_{draw} {
    vehicle_.station = 101;
    vehicle_.noise =
        random_stream{static_cast<std::uint64_t>(draw.between(0, 1e9)), "car"};
    std::vector<std::shared_ptr<channel::preemptive_core>> cores;
    for (std::size_t core = 0; core < set.cores; ++core)
      cores.push_back(std::make_shared<channel::preemptive_core>(
          set.order, set.on(core).size()));
    for (std::size_t k = 0; k < set.all.size(); ++k) {
      const auto here = set.on(set.core_of[k]);
      const auto number = std::ranges::find(here, k) - here.begin();
      functions_.push_back(std::make_unique<function>(
          *this, k,
          channel::core_seat{cores[set.core_of[k]],
                             static_cast<std::size_t>(number)}));
    }
  }

  /// @returns the worst response of each function.
  std::vector<duration> play() {
    for (std::size_t k = 0; k < functions_.size(); ++k)
      add_events(k);
    const auto end = at_home + played_time;
    while (!events_.empty() && events_.begin()->first.first <= end) {
      auto next = events_.extract(events_.begin());
      now_ = next.key().first;
      next.mapped()();
    }
    std::vector<duration> worst;
    for (const auto& one : functions_)
      worst.push_back(one->worst);
    return worst;
  }

private:
  struct function final : offloading::cycle_port {
    vehicle_at_home& all;
    std::size_t place;
    time_point begun;
    duration worst{};
    offloading::service_cycle cycle;

    function(vehicle_at_home& owner, std::size_t k,
             const channel::core_seat& seat)
        : all{owner}, place{k}, cycle{setup(seat), *this} {}

    offloading::cycle_setup setup(const channel::core_seat& seat) {
      const auto name = fmt::format("f{}", place);
      auto its = echo_service(std::string_view{name});
      const auto& drawn = all.set_.all[place];
      auto& options = its.options;
      options.period = drawn.task.period;
      options.per_input = drawn.per_input;
      const auto most = drawn.task.wcet;
      options.compute.run_time_max = most;
      options.compute.run_time_mean = all.how_ ? most : most / 2;
      options.compute.run_time_sd = all.how_ ? duration{0} : most / 4;
      auto made = actors::own_function(
          all.vehicle_, offloading::in_vehicle(its, {all.vehicle_.station}), {},
          seat);
      made.finish = [this, finish = made.finish](time_point start,
                                                 std::uint64_t number) {
        begun = start;
        return finish(start, number);
      };
      if (all.how_) // the grid comes right after the begin
        made.phase =
            (all.begin_of(place) + 1ns).time_since_epoch() % drawn.task.period;
      return made;
    }

    void wake_at(time_point t, std::uint64_t number) override {
      all.at(t, [this, number] { cycle.on_timer(number, all.now_); });
    }
    void deliver_at(time_point t, service_result) override {
      if (t != all.now_)
        FAIL("a result of another time");
      worst = std::max(worst, t - begun);
      all.on_result(place);
    }
    void call() {
      cycle.on_input({.at = all.now_, .what = payload::of(echo{1})}, all.now_);
    }
    void activate() {
      cycle.on_step(lifecycle_step::configure, all.now_);
      cycle.on_step(lifecycle_step::activate, all.now_);
    }
  };

  time_point begin_of(std::size_t k) const {
    return how_ ? at_home + (*how_)[k] : at_home;
  }

  void at(time_point t, std::function<void()> what) {
    events_.emplace(std::pair{t, ++count_}, std::move(what));
  }

  // All come home together, with an input that has come already; those that
  // nobody else calls are called at random, or as often as can be.
  void add_events(std::size_t k) {
    const auto& drawn = set_.all[k];
    auto& its = *functions_[k];
    const auto begin = begin_of(k);
    if (how_ && drawn.per_input)
      at(begin - 3 * drawn.task.period, [&its] { its.activate(); });
    at(begin, [&its] { its.call(); });
    if (!how_ || !drawn.per_input)
      at(begin, [&its] { its.activate(); });
    if (!drawn.per_input || (!how_ && drawn.after))
      return;
    const auto period = drawn.task.period;
    for (auto t = begin + 1ns; t < at_home + played_time;
         t += how_ ? period : apart(period))
      at(t, [&its] { its.call(); });
  }

  duration apart(duration period) {
    const auto share =
        draw_.between(0, 3) < 1 ? draw_.between(0, 0.1) : draw_.between(0, 2);
    return from_seconds(to_seconds(period) * share) + 1ns;
  }

  void on_result(std::size_t k) {
    if (how_ && set_.all[k].per_input)
      at(now_, [&its = *functions_[k]] { its.call(); });
    for (std::size_t next = 0; !how_ && next < functions_.size(); ++next)
      if (set_.all[next].after == k)
        at(now_, [&its = *functions_[next]] { its.call(); });
  }

  const drawn_functions& set_;
  const homecoming& how_;
  dice& draw_;
  actors::requester_actor_setup vehicle_;
  std::vector<std::unique_ptr<function>> functions_;
  std::map<std::pair<time_point, std::uint64_t>, std::function<void()>> events_;
  std::uint64_t count_ = 0;
  time_point now_;
};

/// What was measured of a set.
class worst_responses {
public:
  worst_responses(const drawn_functions& set, dice& draw)
      : set_{set}, draw_{draw}, seen_(set.all.size()) {}

  const std::vector<duration>& seen() const { return seen_; }

  void play(const homecoming& how) {
    last_ = vehicle_at_home{set_, how, draw_}.play();
    for (std::size_t k = 0; k < seen_.size(); ++k)
      seen_[k] = std::max(seen_[k], last_[k]);
  }

  /// Looks for what delays a function most: all together, each deadline with
  /// its own, and from there on by chance.
  void search(std::size_t k) {
    std::vector<duration> best(seen_.size());
    play(best);
    auto longest = last_[k];
    const auto attempt = [&](const std::vector<duration>& begins) {
      play(begins);
      if (last_[k] < longest)
        return;
      longest = last_[k];
      best = begins;
    };
    auto alike = best;
    const auto latest = std::ranges::max(set_.tasks(), {}, deadline).deadline;
    for (std::size_t j = 0; j < alike.size(); ++j)
      alike[j] = latest - set_.all[j].task.deadline;
    attempt(alike);
    for (int step = 0; step < steps; ++step) {
      auto begins = best;
      const auto j = static_cast<std::size_t>(
          draw_.between(0, static_cast<double>(begins.size())));
      const auto period_s = to_seconds(set_.all[j].task.period);
      begins[j] = std::max(
          begins[j] + from_seconds(period_s * draw_.between(-1, 1)), 0ns);
      attempt(begins);
    }
  }

private:
  static constexpr int steps = 60;
  static duration deadline(const periodic_task& task) { return task.deadline; }

  const drawn_functions& set_;
  dice& draw_;
  std::vector<duration> seen_, last_;
};

std::vector<duration> measure(const drawn_functions& set, dice& draw) {
  worst_responses worst{set, draw};
  for (std::size_t k = 0; k < set.all.size(); ++k)
    worst.search(k);
  for (int k = 0; k < random_plays; ++k)
    worst.play(std::nullopt);
  return worst.seen();
}

/// How far bounds were from what was measured.
struct closeness {
  int sets = 0, functions = 0, exceeded = 0, loaded = 0, near = 0;
  int late = 0, late_named = 0; ///< Sets that were seen not to come home.

  void add(const drawn_functions& set,
           const std::vector<std::optional<duration>>& stated,
           const std::vector<duration>& seen) {
    double ratio = 0;
    bool is_late = false, is_named = false;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      REQUIRE(seen[k] > duration{0});
      const auto limit = set.all[k].task.deadline;
      const auto at_most = stated[k].value_or(duration::max());
      exceeded += seen[k] > at_most;
      is_late = is_late || seen[k] > limit;
      is_named = is_named || at_most > limit;
      ratio = std::max(ratio, to_seconds(at_most) / to_seconds(seen[k]));
    }
    ++sets;
    functions += static_cast<int>(seen.size());
    loaded += set.load >= 0.5;
    near += set.load >= 0.5 && ratio <= 1.5;
    late += is_late;
    late_named += is_late && is_named;
  }
};

void check_bounds(std::string_view name, core_order order) {
  closeness all;
  for (std::uint64_t seed = 1; seed <= sets(); ++seed) {
    CAPTURE(seed);
    dice draw{seed};
    const auto set = draw_functions(draw, order);
    all.add(set, stated_of(set), measure(set, draw));
  }
  MESSAGE(name << ": sets " << all.sets << ", functions " << all.functions
               << ", exceeded " << all.exceeded << ", loaded " << all.loaded
               << ", near " << all.near << ", late " << all.late << ", named "
               << all.late_named);
  CHECK(all.exceeded == 0);
  CHECK(2 * all.near >= all.loaded);
  CHECK(all.late > 0);
  CHECK(all.late_named == all.late);
}

} // namespace

TEST_CASE("no own function takes longer than stated, which is near, by fixed "
          "priorities") {
  check_bounds("fixed priorities", core_order::fixed_priority);
}

TEST_CASE("no own function takes longer than stated, which is near, by "
          "deadlines") {
  check_bounds("deadlines", core_order::edf);
}
