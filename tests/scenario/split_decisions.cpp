// What the LODM "split" decides in drives, against trying all splits.
#include "base/protocol.hpp"
#include "scenario/load.hpp"
#include "tests/scenario/whole_run.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

using namespace sofof;
using namespace sofof::policies;
using namespace sofof::test;
using namespace std::chrono_literals;

namespace {

constexpr auto impossible = std::numeric_limits<double>::infinity();

/// What all vehicles decided.
struct decision_count {
  int all = 0, not_the_least = 0, change = 0;
};

/// Whether a split is weighed by its response time, else by its energy.
enum class split_measure { energy, response };

/// What a split of what a vehicle sees is worth, as docs/policies/split.md
/// says.
double measured(std::span<const chain_link> chain, const chain_split& split,
                split_measure by) {
  double spent_w = 0;
  std::vector<service_times> times;
  for (std::size_t k = 0; k < chain.size(); ++k) {
    const auto& x = chain[k];
    const auto every =
        x.times.period > duration{0} ? x.times.period : protocol::sensor_period;
    auto service_w = x.on_board.energy_j / to_seconds(every);
    if (split[k])
      for (const auto& there : x.providers)
        if (there.id == *split[k])
          service_w = x.resting_j / to_seconds(every)
                      + there.cost.energy_j
                            / to_seconds(std::max(every, x.times.input_period));
    spent_w += service_w;
    times.push_back(x.times);
  }
  if (by == split_measure::energy && split == chain_split(chain.size()))
    return spent_w;
  const auto late = predicted_response(times, split).quantile(0.99);
  if (!late || (by == split_measure::energy && *late > 400ms))
    return impossible;
  return by == split_measure::energy ? spent_w : to_seconds(*late);
}

/// @returns the least of all splits.
double least_measured(std::span<const chain_link> chain, split_measure by,
                      chain_split split = {}) {
  const auto k = split.size();
  if (k == chain.size())
    return measured(chain, split, by);
  auto least = impossible;
  const auto attempt = [&](const service_place& place) {
    auto longer = split;
    longer.push_back(place);
    least = std::min(least, least_measured(chain, by, longer));
  };
  if (chain[k].moves) {
    attempt(chain[k].place);
    return least;
  }
  attempt(std::nullopt);
  for (const auto& there : chain[k].providers)
    attempt(there.id);
  return least;
}

/// Decides as another one does, and counts how good that is.
class second_guess final : public local_policy {
public:
  second_guess(std::unique_ptr<local_policy> real, split_measure by,
               std::shared_ptr<decision_count> count)
      : real_{std::move(real)}, by_{by}, count_{std::move(count)} {}

  local_decision decide(const local_context& context) override {
    chain_split now, chosen;
    for (const auto& link : context.chain) {
      auto of_this = context;
      of_this.service = link.service;
      of_this.providers = link.providers;
      of_this.current = link.place;
      const auto what = real_->decide(of_this).what;
      const auto* there = std::get_if<run_at>(&what);
      chosen.push_back(there ? service_place{there->provider}
                       : std::holds_alternative<come_home>(what) ? std::nullopt
                                                                 : link.place);
      now.push_back(link.place);
    }
    ++count_->all;
    count_->change += chosen != now;
    const auto least = least_measured(context.chain, by_);
    const auto reached = measured(context.chain, chosen, by_);
    count_->not_the_least += reached > least * (1 + 1e-12);
    return real_->decide(context);
  }
  bool needs_chain() const override { return true; }
  double epoch_s() const override { return real_->epoch_s(); }
  std::string_view name() const override { return real_->name(); }
  std::unique_ptr<local_policy> clone() const override {
    return std::make_unique<second_guess>(real_->clone(), by_, count_);
  }

private:
  std::unique_ptr<local_policy> real_;
  split_measure by_;
  std::shared_ptr<decision_count> count_;
};

decision_count drive(split_measure by, std::string_view search) {
  const auto config = std::filesystem::path{SOFOF_SOURCE_DIR} / "config";
  const std::string text =
      R"(
name = "split_decisions"
duration = "40s"
map = "maps/ulm_lehr.toml"
[traffic]
crossings = "perceived"
[[fleet]]
count = 4
routes = ["round_trip", "round_trip_opposite"]
[[service]]
name = "tracking"
[[service]]
name = "environment_model"
[[service]]
name = "trajectory_planning"
input_period = "10ms"
[[provider]]
name = "mec"
position_m = [0.0, 0.0]
area_radius_m = 1000.0
services = ["tracking", "environment_model", "trajectory_planning"]
[[provider]]
name = "mec_2"
position_m = [50.0, 0.0]
area_radius_m = 1000.0
services = ["tracking", "trajectory_planning"]
[network]
profile = "paper_sim"
[policies]
codm = "always"
[policies.lodm]
name = "split"
margin = 0.0
)" + ("search = \"" + std::string{search} + "\"\nmeasure = \"")
      + (by == split_measure::energy ? "energy" : "response")
      + "\"\nfilter = { name = \"none\" }\n";
  auto s = scenario::parse_scenario(text, config / "chain.toml", {});
  const auto count = std::make_shared<decision_count>();
  s.policies.lodm =
      std::make_shared<second_guess>(s.policies.lodm->clone(), by, count);
  play(s);
  return *count;
}

} // namespace

TEST_CASE("in every decision of a drive the exact search takes the split of "
          "the least predicted measure") {
  decision_count sum;
  for (const auto by : {split_measure::energy, split_measure::response}) {
    const auto of = drive(by, "exact");
    CHECK(of.not_the_least == 0);
    CHECK(of.all > 500);
    sum.all += of.all;
    sum.not_the_least += of.not_the_least;
    sum.change += of.change;
  }
  CHECK(sum.change > 0);
  MESSAGE("decisions " << sum.all << ", changes " << sum.change
                       << ", not the least " << sum.not_the_least);
}

TEST_CASE("of a listed split that is not the least, it is noticed") {
  CHECK(drive(split_measure::response, "fixed").not_the_least > 0);
}
