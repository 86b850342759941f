// Governors by name.
#include "policies/governors/governors.hpp"

#include "policies/governors/hysteresis_governor.hpp"
#include "policies/governors/predictive_gate_governor.hpp"
#include "policies/governors/redundancy_governor.hpp"

namespace sofof {

namespace {

struct governor_entry {
  policy_info notes;
  std::unique_ptr<governor> (*make)();
};

template <class Governor>
std::unique_ptr<governor> made() {
  return std::make_unique<Governor>();
}

const option_info epoch{"epoch_s", "s", "between two looks"};

const std::vector<governor_entry>& governors() {
  static const std::vector<governor_entry> all{
      {{"predictive_gate",
        "Offloads only where results will be in time.",
        "P(latency > limit) <= on to go there, > off to come home",
        "latencies of what came from each provider",
        "Wodtko et al., IV 2025, for the forecast; the gate is ours",
        {{"on", "1", "probability to be late up to which a provider is asked"},
         {"off", "1", "probability above which the service comes home"},
         epoch}},
       made<predictive_gate_governor>},
      {{"hysteresis",
        "No hasty changes of where a service runs.",
        "advantage > margin for time_to_trigger without a break, and the last "
        "change is min_dwell ago; who comes home is never kept",
        "what the policy wants",
        "event A3 of 3GPP TS 36.331, with a dwell in addition",
        {{"margin", "1", "an advantage counts above this, as normalised gain"},
         {"time_to_trigger", "time", "so long must it last"},
         {"min_dwell", "time", "between two changes"},
         epoch}},
       made<hysteresis_governor>},
      {{"redundancy",
        "Two providers plan the same cycles; the first result is used.",
        "with another one of least P(latency > limit), if that of the first is "
        "not below least_late",
        "latencies of what came from each provider",
        "Dean & Barroso, CACM 56(2), 2013",
        {{"least_late", "1",
          "probability to be late below which one provider is enough"},
         {"hedge_after", "time",
          "the second plans only cycles that the first has not answered for so "
          "long, well below max_interarrival - period, at most \"10s\"; 0: "
          "all"}}},
       made<redundancy_governor>}};
  return all;
}

} // namespace

std::vector<policy_info> governor_notes() {
  return notes_of(governors());
}

std::unique_ptr<governor> make_governor(std::string_view name) {
  for (const auto& entry : governors())
    if (entry.notes.name == name)
      return entry.make();
  return nullptr;
}

std::vector<std::string_view> governor_names() {
  return names_of(governors());
}

} // namespace sofof
