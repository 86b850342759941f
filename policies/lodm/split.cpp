// LODM "split": decides about all services of a vehicle's chain together.
#include "base/options/option_helpers.hpp"
#include "base/protocol.hpp"
#include "policies/algorithms/splits/split_search.hpp"
#include "policies/entry.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <string>
#include <vector>

namespace sofof::policies {

namespace {

using namespace std::chrono_literals;

constexpr std::string_view by_exact = "exact", by_greedy = "greedy",
                           as_listed = "fixed";
constexpr std::array searches{by_exact, by_greedy, as_listed};
constexpr std::string_view of_energy = "energy", of_response = "response";
constexpr std::array measures{of_energy, of_response};

constexpr auto never = std::numeric_limits<double>::infinity();
constexpr double of_most = 0.99; // of responses count

/// @returns the time between two results of a service in the vehicle: one that
/// is called by inputs gives one for each look.
double period_s(const chain_link& link) {
  return to_seconds(link.times.period > duration{0} ? link.times.period
                                                    : protocol::sensor_period);
}

/// @returns what the vehicle spends on a service there, W; infinite if it
/// cannot run there.
double power_w(const chain_link& link, const service_place& place) {
  if (!place)
    return link.on_board.energy_j / period_s(link);
  const auto there =
      std::ranges::find(link.providers, *place, &provider_view::id);
  if (there == link.providers.end())
    return never;
  const auto sends_every_s =
      std::max(period_s(link), to_seconds(link.times.input_period));
  return link.resting_j / period_s(link) + there->cost.energy_j / sends_every_s;
}

/// @returns what the vehicle spends on the whole chain, W.
double power_w(std::span<const chain_link> chain, const chain_split& split) {
  double sum = 0;
  for (std::size_t k = 0; k < chain.size(); ++k)
    sum += power_w(chain[k], split[k]);
  return sum;
}

chain_split places_of(std::span<const chain_link> chain) {
  chain_split split;
  for (const auto& link : chain)
    split.push_back(link.place);
  return split;
}

/// @returns where each service may run: home first; one that moves, where it
/// goes to.
std::vector<std::vector<service_place>>
choices_of(std::span<const chain_link> chain) {
  std::vector<std::vector<service_place>> all;
  for (const auto& link : chain) {
    auto& places = all.emplace_back();
    if (link.moves) {
      places.push_back(link.place);
      continue;
    }
    places.emplace_back();
    for (const auto& provider : link.providers)
      places.emplace_back(provider.id);
  }
  return all;
}

class split_policy final : public local_policy {
public:
  local_decision decide(const local_context& context) override;
  bool needs_chain() const override { return true; }
  double epoch_s() const override { return epoch_s_; }
  void visit_options(option_visitor& s) override;
  std::string_view name() const override { return "split"; }
  std::unique_ptr<local_policy> clone() const override {
    return std::make_unique<split_policy>(*this);
  }

private:
  chain_split choose(std::span<const chain_link> chain) const;
  chain_split fixed(std::span<const chain_link> chain) const;
  double cost(std::span<const chain_link> chain,
              std::span<const service_times> times, const chain_split& split,
              double least) const;

  std::string search_{by_exact};
  std::string measure_{of_energy};
  duration max_response_ = 400ms;
  std::vector<std::string> offload_{"trajectory_planning"};
  double margin_ = 0.05;
  double epoch_s_ = 0.5;
  // Of the services that are decided at one moment, for each of them.
  time_point chosen_at_ = time_point::min();
  chain_split chosen_from_, chosen_;
};

local_decision split_policy::decide(const local_context& context) {
  const auto link =
      std::ranges::find(context.chain, context.service, &chain_link::service);
  if (link == context.chain.end())
    return as_it_is("not in a chain");
  const auto from = places_of(context.chain);
  if (chosen_at_ != context.now || chosen_from_ != from) {
    chosen_ = choose(context.chain);
    chosen_at_ = context.now;
    chosen_from_ = from;
  }
  const auto& place =
      chosen_[static_cast<std::size_t>(link - context.chain.begin())];
  return at_place(context.current, place,
                  search_ == as_listed      ? "the split that is listed"
                  : measure_ == of_response ? "the least response time"
                                            : "the least energy");
}

chain_split split_policy::fixed(std::span<const chain_link> chain) const {
  chain_split split;
  for (const auto& link : chain) {
    const auto is_listed = std::ranges::count(offload_, link.service) > 0;
    split.push_back(!is_listed || link.providers.empty()
                        ? service_place{}
                        : link.providers.front().id);
  }
  return split;
}

chain_split split_policy::choose(std::span<const chain_link> chain) const {
  if (search_ == as_listed)
    return fixed(chain);
  std::vector<service_times> times;
  for (const auto& link : chain)
    times.push_back(link.times);
  auto least = never;
  const auto cost_of = [&](const chain_split& split) {
    const auto found = cost(chain, times, split, least);
    least = std::min(least, found);
    return found;
  };
  const auto now = places_of(chain);
  const auto places = choices_of(chain);
  const auto best = search_ == by_exact && is_few(places)
                        ? best_split(places, cost_of)
                        : greedy_split(places, now, cost_of);
  return cost(chain, times, best, never)
                 < (1 - margin_) * cost(chain, times, now, never)
             ? best
             : now;
}

/// A split that takes too long costs more than any that does not, but the one
/// at home is there always.
/// @param least  Of a split that takes no less energy than this, how late its
///               responses are is not worked out: it costs more than any.
double split_policy::cost(std::span<const chain_link> chain,
                          std::span<const service_times> times,
                          const chain_split& split, double least) const {
  const auto spent_w = power_w(chain, split);
  const auto is_home = std::ranges::none_of(
      split, [](const auto& place) { return place.has_value(); });
  if (measure_ == of_energy && is_home)
    return spent_w;
  if (spent_w == never || (measure_ == of_energy && spent_w >= least))
    return never;
  const auto late = predicted_response(times, split).quantile(of_most);
  if (!late)
    return never;
  if (measure_ == of_response)
    return to_seconds(*late);
  if (*late > max_response_)
    return never;
  return spent_w;
}

void split_policy::visit_options(option_visitor& s) {
  visit_word(s, "search", search_, "search", searches);
  visit_word(s, "measure", measure_, "measure", measures);
  s.field("max_response", max_response_, 1ms);
  s.field("offload", offload_);
  s.field("margin", margin_, {0, 0.99});
  s.field("epoch_s", epoch_s_, {1e-3, 3600});
}

} // namespace

lodm_entry lodm_split() {
  return {
      {"split",
       "Decides about all services of a chain together.",
       "min sum P_k(place) s.t. predicted p99 response <= max_response; or min "
       "that p99",
       "what each service and each link took so far, energy of a cycle here "
       "and there",
       "Dehler et al., arXiv 2606.07067, for compositions of services; the "
       "prediction is ours",
       {{"search", "word", "\"exact\", \"greedy\" or \"fixed\""},
        {"measure", "word", "\"energy\" or \"response\""},
        {"max_response", "time", "that 99 % of responses may take, for energy"},
        {"offload", "names",
         "services that run elsewhere if offered, for fixed"},
        {"margin", "1", "share that a change has to save"},
        {"epoch_s", "s", "between two decisions"}}},
      filtered_by_provider<split_policy>};
}

} // namespace sofof::policies
