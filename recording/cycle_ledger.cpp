// Cycles are counted, not derived from times.
#include "recording/cycle_ledger.hpp"

namespace sofof::recording {

std::optional<double> cycle_figures::offloaded_share() const {
  const auto all = on_board + offloaded;
  if (all == 0)
    return std::nullopt;
  return static_cast<double>(offloaded) / static_cast<double>(all);
}

cycle_figures& cycle_figures::operator+=(const cycle_figures& x) {
  on_board += x.on_board;
  offloaded += x.offloaded;
  results += x.results;
  inputs += x.inputs;
  along += x.along;
  return *this;
}

std::optional<double> energy_figures::saved_share() const {
  if (all_on_board_j <= 0)
    return std::nullopt;
  return 1 - j() / all_on_board_j;
}

energy_figures& energy_figures::operator+=(const energy_figures& x) {
  on_board_j += x.on_board_j;
  offloading_j += x.offloading_j;
  all_on_board_j += x.all_on_board_j;
  return *this;
}

void cycle_ledger::add(const messages::work_record& x) {
  auto& sum = counts_[{x.station, x.service}].figures;
  sum.on_board += x.on_board;
  sum.inputs += x.inputs;
  sum.along += x.along;
}

void cycle_ledger::add(const messages::cycle_record& x) {
  auto& [sum, newest] = counts_[{x.session.station, x.session.service}];
  ++sum.results;
  if (!x.used)
    return; // the vehicle went by something else
  if (sum.offloaded > 0 && x.cycle <= newest)
    return; // another provider has computed it too
  ++sum.offloaded;
  newest = x.cycle;
}

cycle_figures
cycle_ledger::cycles(const messages::service_name& service) const {
  cycle_figures sum;
  for (const auto& [who, x] : counts_)
    if (who.second == service)
      sum += x.figures;
  return sum;
}

cycle_figures cycle_ledger::cycles(const messages::service_name& service,
                                   station_id station) const {
  const auto found = counts_.find({station, service});
  return found != counts_.end() ? found->second.figures : cycle_figures{};
}

energy_figures cycle_ledger::energy() const {
  energy_figures sum;
  for (const auto& [who, x] : counts_)
    sum += energy_of(who, x.figures);
  return sum;
}

energy_figures
cycle_ledger::energy(const messages::service_name& service) const {
  energy_figures sum;
  for (const auto& [who, x] : counts_)
    if (who.second == service)
      sum += energy_of(who, x.figures);
  return sum;
}

energy_figures cycle_ledger::energy(station_id station) const {
  energy_figures sum;
  for (auto x = counts_.lower_bound({station, {}});
       x != counts_.end() && x->first.first == station; ++x)
    sum += energy_of(x->first, x->second.figures);
  return sum;
}

energy_figures cycle_ledger::energy_of(const user& who,
                                       const cycle_figures& x) const {
  const auto& [station, service] = who;
  const auto found = costs_.find({station, std::string{service.view()}});
  if (found == costs_.end())
    return {};
  const auto& cost = found->second;
  const auto times = [](std::uint64_t count, double energy_j) {
    return static_cast<double>(count) * energy_j;
  };
  return {times(x.on_board + x.along, cost.on_board_j),
          times(x.inputs, cost.input_j) + times(x.results, cost.result_j),
          times(x.on_board + x.offloaded, cost.on_board_j)};
}

} // namespace sofof::recording
