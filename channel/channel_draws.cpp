// How long messages travel: the draws of one vehicle.
#include "channel/channel_draws.hpp"

#include "channel/draw_lanes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace sofof::channel {

namespace {

double network_draw_s(const channel_profile& p, const random_stream& draws,
                      std::uint64_t number) {
  return p.network.draw_s(draws, number, network_lane)
         + p.joint_share * p.joint.draw_s(draws, number, joint_lane);
}

duration spike(const spike_options& p, const random_stream& draws,
               std::uint64_t number) {
  if (p.probability <= 0 || draws.uniform(number, spike_lane) >= p.probability)
    return {};
  return from_seconds(draws.uniform(to_seconds(p.shortest),
                                    to_seconds(p.longest), number,
                                    spike_length_lane));
}

/// Whether all messages travel for the same time.
bool draws_no_delay(const channel_profile& p) {
  return !p.replays && p.network.is_none() && p.joint.is_none()
         && p.spikes.probability <= 0 && p.vehicle_host.probability <= 0;
}

random_stream radio_of(const random_stream& seed, station_id station,
                       std::string_view name) {
  const auto vehicle = seed.part("channel").part(station.value());
  return name.empty() ? vehicle : vehicle.part("radio").part(name);
}

random_stream provider_part(const random_stream& radio,
                            std::string_view direction,
                            std::uint32_t provider) {
  return radio.part(direction).part(provider);
}

constexpr std::string_view results_part = "results";

} // namespace

channel_draws::channel_draws(std::shared_ptr<const channel_profile> profile,
                             random_stream seed, station_id station,
                             std::uint32_t provider, std::string_view radio)
    : of_radio_{radio_of(seed, station, radio)},
      drift_{of_radio_.part("drift").part(provider)}, // stalls by radio
      up_{split("up", provider)}, // the rest by provider, too
      down_{split("down", provider)}, profile_{std::move(profile)} {
  if (!profile_->replays)
    return;
  if (profile_->trace.empty())
    throw std::invalid_argument{"the trace to replay has no samples"};
  if (profile_->scatters_trace)
    trace_start_s_ =
        of_radio_.part("trace").uniform(0, replay_length_s(profile_->trace), 0);
}

duration channel_draws::network_delay(const message_id& m,
                                      time_point sent) const {
  return draws_no_delay(*profile_) ? profile_->more_delay
                                   : drawn_delay(m, sent);
}

duration channel_draws::drawn_delay(const message_id& m,
                                    time_point sent) const {
  const auto& p = *profile_;
  const auto extra = p.more_delay + spike(p.spikes, of(m), m.number)
                     + p.vehicle_host.draw(of(m), m.number);
  auto network_s = network_draw_s(p, of(m), m.number);
  if (p.replays && m.to == direction::down)
    network_s += replayed_delay_s(p.trace, trace_start_s_ + to_seconds(sent));
  return extra + from_seconds(drift(sent) * network_s);
}

// Between values that are drawn for the ends of each period the weights turn
// from one to the other; their squares add up to 1, so g is as wide anywhere.
double channel_draws::drift(time_point sent) const {
  const auto& [sd, period] = profile_->drift;
  if (sd <= 0 || period <= duration{})
    return 1;
  const auto periods = to_seconds(sent) / to_seconds(period);
  const auto before = std::floor(periods);
  const auto angle = std::numbers::pi / 2 * (periods - before);
  const auto number = static_cast<std::uint64_t>(before);
  const auto g = std::cos(angle) * drift_.normal(0, 1, number)
                 + std::sin(angle) * drift_.normal(0, 1, number + 1);
  return std::exp(sd * g);
}

duration channel_draws::burst_delay(direction to, std::uint64_t stall) const {
  return from_seconds(network_draw_s(*profile_, of(to).bursts, stall));
}

duration channel_draws::airtime(const message_id& m, std::size_t octets) const {
  const auto& p = *profile_;
  if (p.airtime.is_none() && p.cell_mbps <= 0)
    return {};
  const auto size = static_cast<double>(octets);
  const auto usual = p.airtime.draw_s(of(m), m.number, airtime_lane);
  const auto share = size / static_cast<double>(usual_octets);
  const auto bits = p.cell_mbps > 0 ? size * 8 / (p.cell_mbps * 1e6) : 0;
  return from_seconds(usual * share + bits);
}

bool channel_draws::lost(const message_id& m, bool fading, double more) const {
  const auto& burst = profile_->burst_loss;
  const auto arrives = (1 - profile_->loss)
                       * (1 - (fading ? burst.loss_bad : burst.loss_good))
                       * (1 - more);
  return arrives < 1 && of(m).uniform(m.number, loss_lane) >= arrives;
}

place_quality
channel_draws::quality_at(const std::optional<point>& vehicle) const {
  if (!vehicle || profile_->areas.empty())
    return {};
  return channel::quality_at(profile_->areas, *vehicle);
}

outage_process channel_draws::stalls() const {
  const auto& [rate_hz, shortest, longest] = profile_->stalls;
  if (rate_hz <= 0)
    return {};
  const auto mean_quiet = from_seconds(1 / rate_hz) - (shortest + longest) / 2;
  if (mean_quiet <= duration{})
    throw std::invalid_argument{"no time is left between two stalls"};
  return {of_radio_.part("stalls"), delay_distribution::exponential(mean_quiet),
          delay_distribution::uniform(shortest, longest)};
}

outage_process channel_draws::fades() const {
  const auto& burst = profile_->burst_loss;
  if (burst.mean_good <= duration{} || burst.mean_bad <= duration{})
    return {};
  return {of_radio_.part("fades"),
          delay_distribution::exponential(burst.mean_good),
          delay_distribution::exponential(burst.mean_bad)};
}

bool channel_draws::is_out(direction to, duration since_start) const {
  const auto* other = to == direction::up ? "down" : "up";
  return std::ranges::any_of(profile_->outages, [&](const auto& x) {
    return x.from <= since_start && since_start < x.to && x.direction != other;
  });
}

duration channel_draws::overtaken_by(const message_id& m) const {
  return disordered(m, profile_->disorder.overtaken, overtaken_lane,
                    overtaken_by_lane)
      .value_or(duration{});
}

std::optional<duration> channel_draws::copied_after(const message_id& m) const {
  return disordered(m, profile_->disorder.copied, copied_lane,
                    copied_after_lane);
}

std::optional<duration> channel_draws::disordered(const message_id& m,
                                                  double probability,
                                                  std::uint32_t lane,
                                                  std::uint32_t by_lane) const {
  if (probability <= 0 || of(m).uniform(m.number, lane) >= probability)
    return std::nullopt;
  return from_seconds(to_seconds(profile_->disorder.longest)
                      * of(m).uniform(m.number, by_lane));
}

channel_draws::streams channel_draws::split(std::string_view direction,
                                            std::uint32_t provider) const {
  const auto s = provider_part(of_radio_, direction, provider);
  return {s.part(results_part), s.part("others"), s.part("digests"),
          s.part("bursts")};
}

const channel_draws::streams& channel_draws::of(direction to) const {
  return to == direction::up ? up_ : down_;
}

const random_stream& channel_draws::of(const message_id& m) const {
  const auto& streams = of(m.to);
  switch (m.kind) {
    case message_class::result:
      return streams.results;
    case message_class::digest:
      return streams.digests;
    case message_class::other:
      break;
  }
  return streams.others;
}

random_stream result_draws(const random_stream& seed, station_id station,
                           std::uint32_t provider, std::string_view radio) {
  return provider_part(radio_of(seed, station, radio), "down", provider)
      .part(results_part);
}

} // namespace sofof::channel
