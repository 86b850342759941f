// What is counted of runs: hours, episodes, and each class of faults.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace sofof::experiments::torture {

inline constexpr double hour_s = 3600;

/// All that is counted; each is a column of the log of seeds, in this order.
enum class counted : std::size_t {
  driven_s,      ///< Of all vehicles together,
  al_ilqr_s,     ///< of these with this planner,
  offloaded_s,   ///< while trajectory planning was at a provider,
  chain_s,       ///< and with a chain of services:
  tracking_s,    ///< of these while this one was at a provider,
  environment_s, ///< or the environment model.
  episodes,      ///< That got data, of all services.
  sessions,      ///< Closed by both sides,
  late_2_s,      ///< of these by one more than 2 s later than by the other.
  disbelieved,   ///< Results of who did not lie that were not believed.
  // Classes of faults: incidents, of the first two messages.
  loss,
  slow,
  burst,
  outage,
  one_way,
  stall,
  copied,
  overtaken,
  crash,
  reboot,
  dead_car,
  lie,
  hostile,
  deaf_map,
  full,
  refusal,
};

inline constexpr std::array<std::string_view, 26> counted_names{
    "driven_s",      "al_ilqr_s", "offloaded_s", "chain_s",  "tracking_s",
    "environment_s", "episodes",  "sessions",    "late_2_s", "disbelieved",
    "loss",          "slow",      "burst",       "outage",   "one_way",
    "stall",         "copied",    "overtaken",   "crash",    "reboot",
    "dead_car",      "lie",       "hostile",     "deaf_map", "full",
    "refusal"};

/// What a fault class is, for people.
struct fault_class {
  counted what;
  std::string_view meaning;
};

inline constexpr std::array<fault_class, 16> fault_classes{
    {{counted::loss, "messages lost by chance"},
     {counted::slow, "messages 50 ms late or more by a slow network"},
     {counted::burst, "times of loss of a vehicle's connection"},
     {counted::outage, "times in which nothing got through to a vehicle"},
     {counted::one_way, "times in which nothing got through in one direction"},
     {counted::copied, "messages that came twice"},
     {counted::overtaken, "messages that later ones overtook"},
     {counted::lie, "results that vehicles did not believe, of liars"},
     {counted::hostile, "messages of a station that makes up cars, or octets"},
     {counted::dead_car, "vehicles whose computer died"},
     {counted::stall, "times in which a vehicle's messages were held back"},
     {counted::crash, "providers that died"},
     {counted::reboot, "providers that came back"},
     {counted::deaf_map, "sessions of a provider without a map: no results"},
     {counted::full, "half seconds of full workers or a full cell"},
     {counted::refusal, "requests refused or not answered in time"}}};

/// Sums of all that is counted.
class tally {
public:
  double& operator[](counted what) {
    return sums_[static_cast<std::size_t>(what)];
  }
  double operator[](counted what) const {
    return sums_[static_cast<std::size_t>(what)];
  }

  tally& operator+=(const tally& other) {
    for (std::size_t k = 0; k < sums_.size(); ++k)
      sums_[k] += other.sums_[k];
    return *this;
  }

  auto& sums() { return sums_; }
  const auto& sums() const { return sums_; }

  friend bool operator==(const tally&, const tally&) = default;

private:
  std::array<double, counted_names.size()> sums_{};
};

} // namespace sofof::experiments::torture
