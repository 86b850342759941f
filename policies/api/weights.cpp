// The weights of a cycle's cost as options.
#include "policies/api/weights.hpp"

namespace sofof::policies {

void list_weights(option_visitor& s, cost_weights& weights) {
  s.field("time_weight", weights.time, {0, 1e3});
  s.field("energy_weight", weights.energy, {0, 1e3});
  s.field("violation_weight", weights.violation, {0, 1e3});
}

std::vector<option_info> weights_and(const std::vector<option_info>& others) {
  std::vector<option_info> all{
      {"time_weight", "1", "lambda_T, of latency in parts of its limit"},
      {"energy_weight", "1", "lambda_E, of energy in parts of that on board"},
      {"violation_weight", "1", "lambda_V, of the probability to be late"}};
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

} // namespace sofof::policies
