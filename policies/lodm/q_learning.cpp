// LODM "q_learning": has learned when a change pays.
#include "policies/algorithms/learning/learning_lodm.hpp"
#include "policies/algorithms/learning/snapshots.hpp"
#include "policies/entry.hpp"

namespace sofof::policies {

namespace {

class table_lodm final : public learning_lodm {
public:
  table_lodm()
      : learning_lodm{make_q_table,
                      {0.95, {0.1, 0.01, 100'000}},
                      snapshot_of("q_learning")} {}
  std::string_view name() const override { return "q_learning"; }
  std::unique_ptr<local_policy> clone() const override {
    return std::make_unique<table_lodm>(*this);
  }
};

} // namespace

lodm_entry lodm_q_learning() {
  return {{"q_learning",
           "Has learned from a table of 160 states when a change pays.",
           "max_a Q(s, a), a: keep or change; r = -(lambda_E E / E_0 + "
           "lambda_V missed + lambda_S changed)",
           "time left in the area, forecast of the latency, utilisation, where "
           "it runs",
           "Watkins & Dayan, Machine Learning 8, 1992", learning_notes()},
          filtered_by_provider<table_lodm>};
}

} // namespace sofof::policies
