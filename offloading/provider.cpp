// Stations, offers and ends; requests are in provider_requests.cpp.
#include "offloading/provider.hpp"

#include "base/protocol.hpp"
#include "messages/protocol/record.hpp"
#include "offloading/qos_monitor.hpp"
#include "policies/api/periodic_task.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace sofof::offloading {

cycle_setup cycle_of(const offered_service& service,
                     const session_start& start) {
  assert(service.here);
  assert(service.name == start.session.service);
  return {.session = start.session,
          .function = service.here->make_function(start.session.station),
          .period = service.options.period,
          .phase = start.phase,
          .finish = {},
          .keeps_phase = start.keeps_phase,
          .per_input = service.options.per_input};
}

provider::provider(provider_setup setup, provider_port& port)
    : setup_{std::move(setup)}, area_{setup_.area}, port_{port},
      trace_{messages::trace_part::provider, sink_of(setup_.trace, port)} {
  assert(setup_.policy && setup_.map);
  assert(setup_.computer.workers > 0);
  assert(std::ranges::all_of(setup_.services, [](const offered_service& x) {
    return x.here != nullptr;
  }));
  epoch_ = from_seconds(setup_.policy->epoch_s());
}

const provider::provider_session*
provider::station_record::find(const messages::service_name& service) const {
  const auto i =
      std::ranges::find(sessions, service, [](const provider_session& x) {
        return x.session.service;
      });
  return i == sessions.end() ? nullptr : &*i;
}

bool provider::station_record::is_consistent() const {
  const auto is_only_one = [this](const provider_session& x) {
    return find(x.session.service) == &x && x.session.is_remote();
  };
  return number != 0 && requester && (is_told || sessions.empty())
         && std::ranges::all_of(sessions, is_only_one);
}

// Requests wait for the end of an epoch.
bool provider::is_consistent() const {
  const auto is_sound = [this](const auto& known) {
    const auto& [id, station] = known;
    return station.is_consistent() && station.latest.station == id
           && station.heard <= now_
           && !protocol::is_of_future(station.latest.at, now_)
           && (area_.moved_at() >= station.heard
               || station.is_inside == is_inside(station.latest))
           && std::ranges::all_of(station.sessions, [this](const auto& x) {
                return x.session.counter <= last_session_ && x.since <= now_;
              });
  };
  return std::ranges::all_of(stations_, is_sound)
         && (waiting_.empty() || in_epoch_);
}

void provider::pass(time_point now) {
  assert(now >= now_);
  now_ = now;
}

// -- timers -------------------------------------------------------------------

void provider::wake_at(time_point t, timer what) {
  port_.wake_at(t, timers_.add(what));
}

void provider::on_timer(std::uint64_t number, time_point now) {
  pass(now);
  if (const auto due = timers_.claim(number))
    std::visit([&](const auto& x) { expire(x, now); }, *due);
}

// One timer for each record is under way; it moves on with the latest message.
void provider::expire(const station_check& x, time_point now) {
  const auto i = stations_.find(x.station);
  if (i == stations_.end() || i->second.number != x.record)
    return;
  const auto deadline = i->second.heard + protocol::cam_timeout + duration{1};
  assert(i->second.heard <= now);
  if (now >= deadline)
    forget(
        i,
        {messages::end_reason::cam_timeout,
         in_words("cam_timeout", now - i->second.heard, protocol::cam_timeout)},
        now);
  else
    wake_at(deadline, x);
}

void provider::expire(const digest_due& x, time_point now) {
  const auto i = stations_.find(x.station);
  if (i == stations_.end() || i->second.number != x.record)
    return;
  auto& station = i->second;
  assert(station.is_told && station.requester);
  assert(station.latest.station == x.station);
  assert(!station.sessions.empty() || station.told_until > time_point{});
  messages::session_digest digest{setup_.id, x.station, last_session_, {}};
  for (const auto& session : station.sessions)
    digest.running.push_back(session.session);
  trace_.add(step::digest_sent, digest, now);
  port_.send(*station.requester, digest);
  station.is_told = !station.sessions.empty() || now < station.told_until;
  if (station.is_told)
    wake_at(now + protocol::digest_period, x);
}

void provider::begin_digests(station_record& station, time_point now) {
  assert(!station.sessions.empty());
  if (!std::exchange(station.is_told, true))
    wake_at(now + protocol::digest_period,
            digest_due{station.latest.station, station.number});
}

void provider::expire(const epoch_end&, time_point now) {
  assert(in_epoch_);
  in_epoch_ = false;
  if (!waiting_.empty())
    answer(std::exchange(waiting_, {}), now);
  assert(is_consistent());
}

// -- stations -----------------------------------------------------------------

void provider::on_cam(const messages::cam& c, peer_id from, time_point now) {
  pass(now);
  const auto known = stations_.find(c.station);
  if (known != stations_.end() && c.at < known->second.latest.at)
    return; // overtaken on its way
  if (protocol::is_of_future(c.at, now))
    return; // all true ones would seem overtaken
  if (c.station == carrier_)
    return; // nobody serves itself
  trace_.add(step::heard, setup_.id, c.station, now,
             is_inside(c) ? "inside" : "outside");
  auto [i, is_new] = stations_.try_emplace(c.station);
  auto& station = i->second;
  if (is_new) {
    station.number = ++last_record_;
    wake_at(now + protocol::cam_timeout + duration{1},
            station_check{c.station, station.number});
  }
  if (station.requester != from)
    meet(c.station, station, from, now);
  assert(station.requester == from);
  assert(station.heard <= now);
  assert(station.is_consistent());
  assert(is_new || station.latest.at <= c.at);
  station.latest = c;
  station.heard = now;
  locate(station, now);
  if (now >= station.next_offer)
    offer(station, now);
  assert(is_consistent());
}

void provider::on_ride(const messages::cam& carrier, time_point now) {
  pass(now);
  assert(setup_.reach_m);
  assert(!carrier_ || *carrier_ == carrier.station);
  assert(std::isfinite(carrier.speed_mps));
  carrier_ = carrier.station;
  setup_.position = carrier.position;
  const point ahead{std::cos(carrier.heading_rad),
                    std::sin(carrier.heading_rad)};
  area_.move(carrier.position, carrier.speed_mps * ahead, now);
  assert(is_consistent());
}

bool provider::is_inside(const messages::cam& c) const {
  return area_.contains(c.position, c.at);
}

// Who comes into the area is offered to at once, and who leaves it loses its
// services.
void provider::locate(station_record& station, time_point now) {
  const auto where = station.latest.position;
  const auto was_inside =
      std::exchange(station.is_inside, is_inside(station.latest));
  if (station.is_inside) {
    for (auto& x : station.sessions)
      x.was_inside = true;
    if (!was_inside)
      station.next_offer = now;
    return;
  }
  const auto all = station.sessions;
  assert(!station.is_inside);
  for (const auto& x : all)
    if (x.was_inside)
      end(station, x.session,
          {messages::end_reason::left_area,
           fmt::format("x_m={:.3f} y_m={:.3f}", where.x_m, where.y_m)},
          true, now);
}

// A new requester knows nothing of what ran for the one before.
void provider::meet(station_id id, station_record& station, peer_id requester,
                    time_point now) {
  assert(station.requester != requester);
  if (station.requester) {
    auto dropped = drop_waiting(id);
    dropped.erase(requester); // which may have asked before it was heard
    part_from(dropped);
    leave(station,
          {messages::end_reason::peer_lost, "the station has a new requester"},
          now);
  }
  assert(station.sessions.empty());
  trace_.add(step::met, setup_.id, id, now, {},
             static_cast<std::uint64_t>(requester));
  if (!serves(requester))
    port_.meet(requester);
  station.requester = requester;
  station.next_offer = now;
  station.last_request = 0;
  assert(serves(requester));
}

// Its requester speaks for the station no longer.
void provider::leave(station_record& station, const ending& why,
                     time_point now) {
  assert(station.requester);
  while (!station.sessions.empty())
    end(station, station.sessions.front().session, why, true, now);
  const auto requester = *std::exchange(station.requester, std::nullopt);
  if (!serves(requester))
    port_.leave(requester);
}

bool provider::serves(peer_id requester) const {
  const auto waits =
      std::ranges::find(waiting_, requester, &open_request::from);
  return waits != waiting_.end()
         || std::ranges::any_of(stations_, [requester](const auto& known) {
              return known.second.requester == requester;
            });
}

void provider::offer(station_record& station, time_point now) {
  assert(station.requester);
  assert(now >= station.next_offer);
  std::vector<messages::service_name> idle;
  for (const auto& service : setup_.services)
    if (!station.find(service.name))
      idle.push_back(service.name);
  assert(idle.size() + station.sessions.size() == setup_.services.size());
  if (idle.empty() && !setup_.reach_m)
    return;
  station.next_offer = now + protocol::offer_period;
  assert(station.requester);
  assert(station.next_offer > now);
  const messages::service_offer made{
      .provider = setup_.id,
      .position = setup_.position,
      .services = std::move(idle),
      .utilisation = utilisation(),
      .workers = static_cast<std::uint32_t>(setup_.computer.workers),
      .computing = from_seconds(setup_.computer.mean_s),
      .created = now,
      .moves = motion()};
  trace_.add(step::offer_sent, made, station.latest.station, now);
  port_.send(*station.requester, made);
}

// @returns how the provider moves; nothing if it stands where it is.
std::optional<messages::provider_motion> provider::motion() const {
  if (!setup_.reach_m)
    return std::nullopt;
  assert(*setup_.reach_m > 0);
  return messages::provider_motion{area_.velocity_mps(), *setup_.reach_m};
}

void provider::forget(stations::iterator i, const ending& why, time_point now) {
  assert(why.reason != messages::end_reason::cam_timeout
         || now - i->second.heard > protocol::cam_timeout);
  trace_.add(step::forgotten, setup_.id, i->first, now,
             messages::name_of(why.reason));
  part_from(drop_waiting(i->first));
  leave(i->second, why, now);
  stations_.erase(i);
}

void provider::on_lost(peer_id peer, messages::end_reason why, time_point now) {
  assert(why == messages::end_reason::peer_lost
         || why == messages::end_reason::shutdown);
  pass(now);
  trace_.add(step::peer_lost, setup_.id, 0, now, messages::name_of(why),
             static_cast<std::uint64_t>(peer));
  for (auto i = stations_.begin(); i != stations_.end();) {
    const auto next = std::next(i);
    if (i->second.requester == peer)
      forget(i,
             {why, why == messages::end_reason::shutdown
                       ? "its requester has ended"
                       : "its requester is gone"},
             now);
    i = next;
  }
  assert(is_consistent());
}

void provider::shut_down(time_point now) {
  pass(now);
  trace_.add(step::shut_down, setup_.id, 0, now);
  while (!stations_.empty())
    forget(stations_.begin(), messages::end_reason::shutdown, now);
}

// -- the end of a session -----------------------------------------------------

void provider::on_end(const messages::service_end& e, time_point now) {
  pass(now);
  if (e.from != messages::side::requester)
    return;
  const auto i = stations_.find(e.session.station);
  if (i != stations_.end()) {
    if (e.session.provider == setup_.id) // not before it was started again
      trace_.add(step::end_got, e, now);
    end(i->second, e.session,
        {e.reason, std::string{messages::told_by_vehicle}}, false, now);
  }
  assert(is_consistent());
}

void provider::on_function_lost(const messages::session_id& session,
                                messages::end_reason why, time_point now) {
  pass(now);
  const auto i = stations_.find(session.station);
  if (i == stations_.end())
    return;
  trace_.add(step::function_lost, session, now, messages::name_of(why));
  end(i->second, session,
      {why, why == messages::end_reason::no_data
                ? "no input of the vehicle came"
                : "its function has died"},
      true, now);
  assert(is_consistent());
}

// Closes a session, once; one that is not known has been closed before.
void provider::end(station_record& station, messages::session_id session,
                   const ending& why, bool tell, time_point now) {
  const auto i =
      std::ranges::find(station.sessions, session, &provider_session::session);
  if (i == station.sessions.end())
    return;
  assert(station.requester);
  assert(i->since <= now);
  const auto reason = why.reason;
  messages::service_end e{session, reason, messages::side::provider};
  trace_.add(step::closed, e, now);
  port_.end(e);
  if (tell) {
    if (const auto* service = find(session.service))
      e.what = service->here->termination_message(e, now);
    trace_.add(step::end_sent, e, now);
    port_.send(*station.requester, e);
  }
  port_.record(messages::episode_record{.session = session,
                                        .of = messages::side::provider,
                                        .accepted = i->since,
                                        .first_data = i->since,
                                        .got_data = true,
                                        .ended = now,
                                        .reason = reason,
                                        .because = why.because});
  setup_.policy->observe(policies::episode_outcome{
      session.service.view(), setup_.id, to_seconds(now - i->since),
      messages::name_of(reason), session.station});
  station.sessions.erase(i);
  assert(!station.find(session.service));
  station.next_offer = now + protocol::offer_period;
  station.told_until = now + protocol::digest_goes_on;
}

// -- services -----------------------------------------------------------------

const offered_service*
provider::find(const messages::service_name& service) const {
  const auto i =
      std::ranges::find(setup_.services, service, &offered_service::name);
  return i == setup_.services.end() ? nullptr : &*i;
}

// @returns how a service computes, without an offset.
policies::periodic_task
provider::task_of(const offered_service& service) const {
  const auto& options = service.options;
  assert(options.period > duration{0});
  const auto demand = world::demand_of(options.compute);
  assert(demand >= 0);
  constexpr double deviations = 3;
  const auto& computer = setup_.computer;
  const auto longest_s = computer.mean_s + deviations * computer.deviation_s;
  return {.wcet = from_seconds(longest_s * demand),
          .period = options.period,
          .deadline = options.limits.max_latency};
}

// @returns how a service computes at most.
policies::periodic_task
provider::at_most(const offered_service& service) const {
  const auto& options = service.options;
  const auto demand = world::demand_of(options.compute);
  const auto& computer = setup_.computer;
  assert(options.period > duration{0} && demand >= 0);
  assert(computer.longest_s >= 0 && computer.overrun.mean_s >= 0);
  assert(computer.overrun.probability >= 0
         && computer.overrun.probability <= 1);
  return {.wcet = from_seconds(computer.longest_s * demand),
          .period = options.period,
          .deadline = options.limits.max_latency,
          .jitter = options.per_input
                        ? policies::jitter_of_calls(options.period)
                        : duration{0},
          .overrun = {computer.overrun.probability,
                      computer.overrun.mean_s * demand}};
}

// @returns the share of the workers that a service takes.
double provider::utilisation_by(const messages::service_name& service) const {
  const auto* found = find(service);
  if (!found)
    return 0;
  return policies::worker_share(setup_.computer.mean_s
                                    * world::demand_of(found->options.compute),
                                found->options.period, setup_.computer.workers);
}

// @returns what all that runs here takes of them.
double provider::utilisation() const {
  double all = 0;
  for (const auto& [id, station] : stations_)
    for (const auto& session : station.sessions)
      all += utilisation_by(session.session.service);
  return all;
}

} // namespace sofof::offloading
