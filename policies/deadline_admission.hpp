// Admission by deadlines: every result of every service is to be in time.
#pragma once

#include "policies/context.hpp"

namespace sofof {

/// CODM "edf": accepts a service if some worker keeps all deadlines with it,
/// earliest deadline first; of these workers the one with most room. Sessions
/// that run keep their workers and offsets. Of the time limit of a service, a
/// part goes to the network.
///
/// Which test a worker must pass: "phases" assigns each service its offset in
/// the period, so that they do not wait for each other; "demand" is the exact
/// test for services that may begin together; "utilisation" does not look at
/// deadlines and breaks those shorter than periods, to compare with.
///
/// Source: Liu & Layland 1973; Baruah, Rosier & Howell 1990; phases are ours.
class deadline_admission final : public central_policy {
public:
  std::vector<central_decision> decide(const central_context& context) override;
  void fields(settings& s) override;
  std::string_view name() const override { return "edf"; }
  std::unique_ptr<central_policy> clone() const override;

private:
  periodic_task to_schedule(const periodic_task& told) const;

  std::string test_ = "phases";
  duration network_ = std::chrono::milliseconds{30};
  double margin_ = 0.1; // of the computing time, to be safe
};

} // namespace sofof
