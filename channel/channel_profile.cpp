// The named channel profiles.
#include "channel/channel_profile.hpp"

#include "base/options/option_helpers.hpp"
#include "channel/measured_over_amqp.hpp"
#include "channel/provider_compute.hpp"

#include <array>

namespace sofof::channel {

using namespace std::chrono_literals;

namespace {

channel_profile ideal() {
  return {};
}

// Ours, fitted to 10.54 ± 9.83 ms and nearly nothing over 50 ms (Dehler &
// Buchholz 2025, figure "delay-plot"): a light tail.
channel_profile like_paper_sim(std::string_view name) {
  const auto computing = compute_measured_with(name);
  channel_profile p;
  p.joint = computing.joint;
  p.joint_share = 1 - computing.joint_share;
  return p;
}

channel_profile paper_sim() {
  return like_paper_sim("paper_sim");
}

// The same mean and deviation, but each latency is that of the result before
// with a probability of 0.9: for half a second in the mean, as where others use
// the link for a while.
channel_profile paper_sim_correlated() {
  return like_paper_sim("paper_sim_correlated");
}

// The other reading of the same mean and deviation: a narrow body and rare
// stalls like those in the CICV5G data.
channel_profile paper_sim_stalls() {
  channel_profile p;
  p.network = delay_distribution::lognormal(4ms, 6060us, 3200us);
  p.stalls = {0.0135, 240ms, 295ms};
  return p;
}

// Ours, fitted to the drives of Dehler & Buchholz 2025: 11.94 ± 2.98 ms.
channel_profile paper_5g() {
  channel_profile p;
  p.network = delay_distribution::lognormal(5ms, 3740us, 2800us);
  p.airtime = delay_distribution::exponential(200us);
  return p;
}

// Fitted to the measured round trips of CICV5G (Zhang et al. 2025, doi
// 10.5281/zenodo.17475688): private 5G in town.
channel_profile cicv5g_n8() {
  channel_profile p;
  p.network = delay_distribution::lognormal_about(12090us, 6220us, 0.424);
  p.stalls = {0.0116, 240ms, 295ms};
  return p;
}

// As before: public 5G in town.
channel_profile cicv5g_n78() {
  channel_profile p;
  p.network = delay_distribution::lognormal_about(10740us, 4970us, 0.472);
  p.stalls = {0.0137, 240ms, 295ms};
  return p;
}

// Ours, of no measured network: 20 ms in the median, phases of some seconds
// in which it is late, which can be foreseen, and single messages that are,
// which cannot. docs/channels.md tells what it does.
channel_profile spiky_5g() {
  channel_profile p;
  p.network = delay_distribution::lognormal_about(0ms, 16500us, 0.17);
  p.drift = {0.45, 15s};
  p.spikes = {0.01, 5ms, 32ms};
  return p;
}

channel_profile trace() {
  channel_profile p;
  p.replays = true;
  return p;
}

// Ours: what was measured over a broker on one machine, and no radio.
channel_profile amqp_loopback() {
  channel_profile p;
  p.replays = true;
  p.trace = measured_over_amqp();
  return p;
}

// The same with the radio of `paper_5g`.
channel_profile amqp_lab() {
  auto p = amqp_loopback();
  const auto radio = paper_5g();
  p.network = radio.network;
  p.airtime = radio.airtime;
  return p;
}

struct entry {
  std::string_view name;
  channel_profile (*make)();
};

constexpr std::array known_profiles{
    entry{"ideal", ideal},
    entry{"paper_sim", paper_sim},
    entry{"paper_sim_correlated", paper_sim_correlated},
    entry{"paper_sim_stalls", paper_sim_stalls},
    entry{"paper_5g", paper_5g},
    entry{"cicv5g_n8", cicv5g_n8},
    entry{"cicv5g_n78", cicv5g_n78},
    entry{"spiky_5g", spiky_5g},
    entry{"amqp_loopback", amqp_loopback},
    entry{"amqp_lab", amqp_lab},
    entry{"trace", trace},
};

} // namespace

std::vector<std::string_view> channel_profile_names() {
  std::vector<std::string_view> names;
  for (const auto& e : known_profiles)
    names.push_back(e.name);
  return names;
}

std::optional<channel_profile> find_channel_profile(std::string_view name) {
  for (const auto& e : known_profiles) {
    if (e.name != name)
      continue;
    auto profile = e.make();
    profile.name = name;
    return profile;
  }
  return std::nullopt;
}

} // namespace sofof::channel
