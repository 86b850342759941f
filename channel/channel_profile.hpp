// What tells one kind of channel from another: its distributions and loss.
#pragma once

#include "base/options/option_helpers.hpp"
#include "base/options/option_visitor.hpp"
#include "base/time.hpp"
#include "channel/core_wait.hpp"
#include "channel/delay_distribution.hpp"
#include "channel/network_area.hpp"
#include "channel/trace.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::channel {

/// Of a trajectory on the air with all that travels with it, about: the message
/// that airtimes were fitted to. Measured: 671 on average, octets.csv of
/// config/ulm_lehr.toml.
inline constexpr std::int64_t usual_octets = 680;

/// Outages of one vehicle's connection: what is sent during one is held back
/// and released together at its end (head-of-line blocking).
struct stall_options {
  double rate_hz = 0; ///< Stalls a second, 0 for none.
  duration shortest{};
  duration longest{};

  void visit_options(option_visitor& s) {
    using namespace std::chrono_literals;
    s.field("rate_hz", rate_hz, {0, 1e3});
    s.field("shortest", shortest, 0ns);
    s.field("longest", longest, 0ns);
    if (longest < shortest)
      s.refuse("longest", "must not be less than shortest");
    if (rate_hz * to_seconds(shortest + longest) / 2 >= 1)
      s.refuse("rate_hz", "leaves no time between two stalls");
    if (rate_hz > 0 && longest == 0ns)
      s.refuse("rate_hz", "has no effect while longest is \"0s\"");
  }
};

/// Two-state loss after Gilbert (1960) and Elliott (1963), in continuous time:
/// a vehicle's connection is good or bad, both for exponentially distributed
/// times, and loses messages with a probability of its own in each state.
struct burst_loss_options {
  duration mean_good{}; ///< 0: never bad, no burst loss.
  duration mean_bad{};
  double loss_good = 0; ///< Probability in [0, 1].
  double loss_bad = 1;  ///< Probability in [0, 1].

  void visit_options(option_visitor& s) {
    using namespace std::chrono_literals;
    s.field("mean_good", mean_good, 0ns);
    s.field("mean_bad", mean_bad, 0ns);
    s.field("loss_good", loss_good, {0, 1});
    s.field("loss_bad", loss_bad, {0, 1});
    if ((mean_good > 0ns) != (mean_bad > 0ns))
      s.refuse(mean_good > 0ns ? "mean_good" : "mean_bad",
               "has no effect alone; mean_good and mean_bad go together");
  }
};

/// Good and bad phases of one vehicle's way to one provider: all its delays at
/// a time are exp(sd · g(t)) as long, with a Gaussian g of mean 0 and deviation
/// 1 that forgets its past within about a period.
struct drift_options {
  double sd = 0;     ///< Of the logarithm of delays; 0: no drift.
  duration period{}; ///< From one independent value of g to the next.

  void visit_options(option_visitor& s) {
    using namespace std::chrono_literals;
    s.field("sd", sd, {0, 3});
    s.field("period", period, 0ns);
    if (sd > 0 && period <= 0ns)
      s.refuse("sd", "has no effect while period is \"0s\"");
  }
};

/// Messages that take longer, at random: nothing before tells which.
struct spike_options {
  double probability = 0; ///< In [0, 1], for each message.
  duration shortest{};    ///< Added to its delay, uniformly up to
  duration longest{};     ///< this.

  void visit_options(option_visitor& s) {
    using namespace std::chrono_literals;
    s.field("probability", probability, {0, 1});
    s.field("shortest", shortest, 0ns);
    s.field("longest", longest, 0ns);
    if (longest < shortest)
      s.refuse("longest", "must not be less than shortest");
    if (probability > 0 && longest == 0ns)
      s.refuse("probability", "has no effect while longest is \"0s\"");
  }
};

/// A time in which nothing gets through, for anybody: what is sent meanwhile is
/// lost.
struct outage_options {
  duration from{};                ///< Since the start of the run,
  duration to{};                  ///< up to here.
  std::string direction = "both"; ///< Or "up", to the provider, or "down".

  void visit_options(option_visitor& s) {
    using namespace std::chrono_literals;
    s.field("from", from, 0ns);
    s.field("to", to, 0ns);
    if (to <= from)
      s.refuse("to", "must be later than from");
    constexpr std::array<std::string_view, 3> directions{"both", "down", "up"};
    visit_word(s, "direction", direction, "direction", directions);
  }
};

/// Messages that come twice, or after later ones, as datagrams may.
struct disorder_options {
  double copied = 0;    ///< Probability in [0, 1]: a copy comes later.
  double overtaken = 0; ///< Likewise: it takes longer, and later ones do not
                        ///< wait for it.
  duration longest{};   ///< So much later at most, uniformly, in both cases.

  void visit_options(option_visitor& s) {
    using namespace std::chrono_literals;
    s.field("copied", copied, {0, 1});
    s.field("overtaken", overtaken, {0, 1});
    s.field("longest", longest, 0ns);
    if ((copied > 0 || overtaken > 0) && longest == 0ns)
      s.refuse(copied > 0 ? "copied" : "overtaken",
               "has no effect while longest is \"0s\"");
  }
};

/// Everything that tells one kind of channel from another; computing times are
/// in `provider_compute`. docs/channels.md has the sources and the measured
/// figures.
struct channel_profile {
  std::string name = "ideal";

  delay_distribution network; ///< Delay of any message, one way.
  delay_distribution airtime; ///< Time that a message of `usual_octets` takes
                              ///< in the radio cell that all share; others take
                              ///< it in proportion to their size.
  double cell_mbps = 0; ///< What the cell carries, Mbit/s, which takes time
                        ///< besides; 0: as much as there is.

  /// One draw X a message, on top of the above, which a `provider_compute` may
  /// have in common: `joint_share` · X is network delay.
  delay_distribution joint;
  double joint_share = 0; ///< In [0, 1].

  stall_options stalls;
  double loss = 0; ///< Probability in [0, 1] for each message.
  burst_loss_options burst_loss;
  drift_options drift; ///< Of network delays, without `more_delay`.
  spike_options spikes;
  disorder_options disorder;
  std::vector<outage_options> outages; ///< `outage` in files.
  std::vector<network_area> areas;     ///< `area` in files.

  /// Replays `trace`: a result takes the measured round trip, messages to the
  /// provider take no time, so that the loop takes what was measured; both on
  /// top of the above.
  bool replays = false;
  std::vector<trace_sample> trace;
  /// Each vehicle starts at its own place in the trace, else all at its begin.
  bool scatters_trace = true;

  /// Of any message, one way, on top of the above and of a trace.
  duration more_delay{};
  core_wait vehicle_host; ///< Likewise: in the vehicle, for a core.

  /// What a scenario may change about a named profile.
  void visit_options(option_visitor& s) {
    using namespace std::chrono_literals;
    s.field("more_delay", more_delay, 0ns);
    s.field("loss", loss, {0, 1});
    s.field("cell_mbps", cell_mbps, {0, 1e6});
    s.field("scatters_trace", scatters_trace);
    s.table("stalls", [this](option_visitor& t) { stalls.visit_options(t); });
    s.table("burst_loss",
            [this](option_visitor& t) { burst_loss.visit_options(t); });
    s.table("drift", [this](option_visitor& t) { drift.visit_options(t); });
    s.table("spikes", [this](option_visitor& t) { spikes.visit_options(t); });
    s.table("disorder",
            [this](option_visitor& t) { disorder.visit_options(t); });
    visit_list(s, "outage", outages);
    visit_list(s, "area", areas);
  }
};

/// @returns the names of all profiles, `trace` included.
std::vector<std::string_view> channel_profile_names();

/// @returns the profile of that name; nullopt when there is none. `trace`
/// comes without samples.
std::optional<channel_profile> find_channel_profile(std::string_view name);

} // namespace sofof::channel
