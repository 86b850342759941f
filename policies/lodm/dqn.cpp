// LODM "dqn": has learned when a change pays.
#include "policies/algorithms/learning/learning_lodm.hpp"
#include "policies/algorithms/learning/snapshots.hpp"
#include "policies/entry.hpp"

namespace sofof::policies {

namespace {

class network_lodm final : public learning_lodm {
public:
  network_lodm()
      : learning_lodm{
          make_q_network, {0.95, {1, 0.01, 10'000}}, snapshot_of("dqn")} {}
  std::string_view name() const override { return "dqn"; }
  std::unique_ptr<local_policy> clone() const override {
    return std::make_unique<network_lodm>(*this);
  }
};

} // namespace

lodm_entry lodm_dqn() {
  return {
      {"dqn", "Has learned with a neural network when a change pays.",
       "max_a Q(s, a), a: keep or change; r as of q_learning",
       "12 features: time left, distance, speed, forecasts of the link, "
       "utilisation, computing time, energy, where it runs and for how long",
       "Mnih et al., Nature 518, 2015; van Hasselt et al., AAAI 2016; Wang et "
       "al., ICML 2016",
       learning_notes()},
      filtered_by_provider<network_lodm>};
}

} // namespace sofof::policies
