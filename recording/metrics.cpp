// Adding up what happened.
#include "recording/metrics.hpp"

#include "base/reason.hpp"
#include "base/text/words.hpp"
#include "messages/etsi/cam.hpp"
#include "messages/etsi/mcm.hpp"
#include "messages/etsi/uper.hpp"
#include "recording/safety_line.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::recording {

namespace {

const service_metrics nothing_happened;

/// @param rest         What the input waited for the cycle.
/// @param since_cycle  The time to the input, and before the cycle, is left
///                     out.
/// @returns the part that is half of all, or more; empty if there is none.
std::string_view longest_part(const messages::result_timing& x, duration rest,
                              bool since_cycle) {
  using part = std::pair<std::string_view, duration>;
  const auto before = since_cycle ? 0 : 1;
  const part parts[]{{"the wait for the uplink", before * x.up.wait},
                     {"the way up", before * x.up.travel},
                     {"the wait for the cycle", before * rest},
                     {"the wait for a worker", x.queue},
                     {"the computing", x.computing},
                     {"the wait for the downlink", x.down.wait},
                     {"the way down", x.down.travel}};
  duration all{};
  for (const auto& p : parts)
    all += p.second;
  const auto& longest = std::ranges::max(parts, {}, &part::second);
  return all > duration{} && longest.second >= all / 2 ? longest.first
                                                       : std::string_view{};
}

} // namespace

std::optional<double> service_metrics::offloaded_share(duration driven) const {
  if (driven <= duration::zero())
    return std::nullopt;
  double sum = 0;
  for (const auto& [station, seconds] : remote_s)
    sum += seconds;
  return sum / to_seconds(driven);
}

std::optional<double> service_metrics::fairness(std::size_t vehicles) const {
  double sum = 0, squares = 0;
  for (const auto& [station, seconds] : remote_s) {
    sum += seconds;
    squares += seconds * seconds;
  }
  if (squares <= 0 || vehicles == 0)
    return std::nullopt;
  return sum * sum / (static_cast<double>(vehicles) * squares);
}

void safety_metrics::add(const messages::safety_record& x) {
  driven += x.driven;
  without_fresh_plan += x.without_fresh_plan;
  off_road += x.off_road;
  max_plan_age = std::max(max_plan_age, x.max_plan_age);
}

bool safety_metrics::ok() const {
  return std::ranges::all_of(
      safety_line, [this](const auto& x) { return x.of(*this) == 0; });
}

metrics::metrics(const run_info& run)
    : start_{run.start}, headline_{run.headline_kind},
      names_{run.provider_names}, work_{run.energy.costs},
      energy_terms_{run.energy}, splits_{run}, obstacles_{run.obstacles} {
  for (const auto& name : run.services)
    of(messages::service_name{name});
}

void metrics::on_record(const messages::record& x) {
  std::visit(
      [this](const auto& which) {
        add(which);
        splits_.add(which);
      },
      x);
}

void metrics::add(const messages::event_record& x) {
  switch (x.what) {
    case messages::event_type::offer:
      count_offer(x.detail);
      break;
    case messages::event_type::near_miss:
      ++together_.safety.near_misses;
      break;
    case messages::event_type::implausible:
      ++of(x.service)
            .implausible[std::string{name_of(x.provider, names_)}][x.check];
      break;
    case messages::event_type::refused:
      ++of(x.service).refused[std::string{reason::words_of(x.detail)}];
      break;
    case messages::event_type::stay_local:
      ++of(x.service).stayed[std::string{reason::words_of(x.detail)}];
      break;
    case messages::event_type::switched:
      source_changed(x);
      break;
    default: // scored by other records, or not at all
      break;
  }
}

void metrics::count_offer(std::string_view services) {
  ++offers_;
  for (auto& x : services_)
    x.offers += has_word(services, x.service.view());
}

void metrics::source_changed(const messages::event_record& x) {
  const user who{x.service, x.station};
  const auto open = open_.find(who);
  if (!x.remote) {
    left_[who] = {x.provider, x.at};
    if (open != open_.end())
      open_.erase(open);
    return;
  }
  auto& service = of(x.service);
  const auto straight = open != open_.end();
  service.hand_overs += straight ? 1U : 0U;
  const auto left = left_.find(who);
  if (left != left_.end() && x.at - left->second.at <= ping_pong_limit
      && (!straight || left->second.provider == x.provider))
    ++service.ping_pongs;
  if (straight)
    left_[who] = {open->second.session.provider, x.at};
  open_[who] = {{x.provider, x.station, x.service, x.counter},
                straight ? open->second.remote_since : x.at};
}

void metrics::add(const messages::decision_record& x) {
  auto& service = of(x.service);
  ++(x.accepted ? service.accepted : service.rejected);
}

void metrics::add(const messages::cycle_record& x) {
  auto& service = of(x.session.service);
  service.latency.add(x.received - x.created);
  service.input_age.add(x.received - x.timing.input_at);
  service.results_used += x.used;
  for (const auto& margin : x.margins) {
    const auto [least, is_first] =
        service.margins.emplace(margin.name, margin.left);
    if (!is_first)
      least->second = std::min(least->second, margin.left);
  }
  if (x.interarrival)
    service.interarrival.add(*x.interarrival);
  const auto sent = x.received - x.timing.down.wait - x.timing.down.travel;
  auto& last = results_[{x.session.service, x.session.station}];
  const auto sent_after = last.session == x.session
                              ? std::optional{sent - last.sent}
                              : std::nullopt;
  last = {x.session, sent, x.timing, x.rest(), x.created == x.timing.input_at,
          sent_after};
  work_.add(x);
}

void metrics::add(const messages::episode_record& x) {
  auto& service = of(x.session.service);
  if (x.of == messages::side::provider) {
    service.served_s.add(to_seconds(x.ended - x.accepted));
    ++service.served_until[static_cast<std::size_t>(x.reason)];
    return;
  }
  ++service.ended_by[static_cast<std::size_t>(x.reason)];
  service.fallbacks += x.fallback;
  if (!x.got_data) {
    ++service.no_data;
    return;
  }
  ++service.episodes;
  if (!messages::is_planned(x.reason)) {
    const auto last = results_.find({x.session.service, x.session.station});
    auto& end = service.early.emplace_back(
        early_end{x.reason, std::string{name_of(x.session.provider, names_)},
                  x.session.station, x.ended, x.accepted});
    if (last != results_.end() && last->second.session == x.session) {
      end.last_sent = last->second.sent;
      end.sent_after = last->second.sent_after;
      end.mostly = longest_part(last->second.timing, last->second.rest,
                                x.reason == messages::end_reason::qos_latency
                                    && !last->second.counts_from_input);
    }
  }
  if (!messages::is_cut_off(x.reason, x.because))
    service.t_off_s.add(to_seconds(x.ended - x.first_data));
  // Another provider may have taken over already; that one stays open.
  const auto open = open_.find({x.session.service, x.session.station});
  if (open != open_.end() && open->second.session != x.session)
    return;
  const auto since =
      open == open_.end() ? x.first_data : open->second.remote_since;
  service.remote_s[x.session.station] += to_seconds(x.ended - since);
  if (open != open_.end())
    open_.erase(open);
}

void metrics::add(const messages::safety_record& x) {
  together_.safety.add(x);
  vehicles_[x.station].safety.add(x);
}

void metrics::add(const messages::collision_record& x) {
  ++together_.safety.collisions;
  for (const auto station : {x.first, x.second})
    if (!is_obstacle(station, obstacles_))
      ++vehicles_[station].safety.collisions;
}

void metrics::add(const messages::drive_record& x) {
  for (auto* sum : {&together_, &vehicles_[x.station]}) {
    sum->plans.add(x.plans);
    sum->ride.add(x.ride);
  }
}

void metrics::add(const messages::trip_record& x) {
  vehicles_[x.station].trip = x.trip;
  traffic_.add(x.trip);
}

void traffic_metrics::add(const world::trip_figures& x) {
  arrived_ += x.has_arrived;
  stops_ += x.stops;
  longest_stop_s_ = std::max(longest_stop_s_, x.longest_stop_s);
  delay_s_.add(x.delay_s());
  delays_s_.push_back(x.delay_s());
}

std::optional<double> traffic_metrics::longest_stop_s() const {
  if (delays_s_.empty())
    return std::nullopt;
  return longest_stop_s_;
}

std::optional<double> traffic_metrics::delay_s(double p) const {
  assert(p > 0 && p <= 1);
  if (delays_s_.empty())
    return std::nullopt;
  auto all = delays_s_;
  const auto rank = std::ceil(p * static_cast<double>(all.size()));
  const auto at = all.begin() + static_cast<std::ptrdiff_t>(rank) - 1;
  std::ranges::nth_element(all, at);
  return *at;
}

void metrics::add(const messages::air_record& x) {
  const auto octets = x.message.view();
  messages::etsi::bit_reader in{octets};
  messages::etsi::pdu_header header;
  messages::etsi::read(in, header);
  const auto downwards = is_provider_station(header.station.value);
  auto& count = header.message_id == messages::etsi::cam::message_id ? air_.cam
                : header.message_id == messages::etsi::mcm::message_id
                    ? downwards ? air_.mcm_down : air_.mcm_up
                    : air_.cpm;
  count.add(octets.size());
}

void metrics::add(const messages::plan_switch_record& x) {
  switches_.d_m.add(x.jump.d_m);
  switches_.curvature_1pm.add(x.jump.curvature_1pm);
  switches_.speed_mps.add(x.jump.speed_mps);
  switches_.accel_mps2.add(x.jump.accel_mps2);
}

void metrics::add(std::span<const disturbed_messages> all, time_point until) {
  // No gap that ends an episode is longer.
  constexpr duration remembered = std::chrono::minutes{1};
  auto& cells = recent_.cells;
  for (const auto& x : all) {
    auto cell = std::ranges::find_if(cells, [&x](const auto& c) {
      return c.provider == x.provider && c.direction == x.direction;
    });
    if (cell == cells.end())
      cell = cells.insert(cell, {x.provider, x.direction, {}, {}});
    cell->disturbed.push_back(x.x);
  }
  for (auto& service : services_)
    for (; service.early_told < service.early.size()
           && service.early[service.early_told].at < until;
         ++service.early_told) {
      auto& end = service.early[service.early_told];
      end.disturbed = disturbance_of(
          recent_, {end.provider, "down", end.station, service.service.view()},
          due_next(end.last_sent - start_, end.sent_after, end.at - start_));
    }
  for (auto& cell : cells)
    std::erase_if(cell.disturbed, [&](const auto& x) {
      return start_ + x.at < until - remembered;
    });
}

void metrics::add(load_table of_all) {
  for (const auto& cell : of_all.cells)
    for (const auto& line : cell.lines) {
      const auto service = std::ranges::find(
          services_, line.what, [](const auto& x) { return x.service.view(); });
      if (service != services_.end())
        (cell.direction == "up" ? service->octets_up : service->octets_down) +=
            line.together().sent.octets;
    }
  load_ = std::move(of_all);
}

void metrics::finish(time_point end) {
  for (const auto& [who, episode] : open_) {
    auto& service = of(who.first);
    ++service.episodes;
    ++service.running_at_end;
    service.remote_s[who.second] += to_seconds(end - episode.remote_since);
  }
  open_.clear();
  energy_ = energy_of(splits_, energy_terms_, load_, end - start_);
  energy_.all.distance_m = together_.ride.distance_m;
}

const service_metrics& metrics::headline() const {
  const auto found =
      std::ranges::find(services_, headline_, &service_metrics::service);
  return found != services_.end() ? *found : nothing_happened;
}

std::size_t metrics::offloaded_now() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(open_, [this](const auto& entry) {
        return entry.first.first == headline_;
      }));
}

service_metrics& metrics::of(const messages::service_name& name) {
  const auto found =
      std::ranges::find(services_, name, &service_metrics::service);
  if (found != services_.end())
    return *found;
  auto& added = services_.emplace_back();
  added.service = name;
  return added;
}

} // namespace sofof::recording
