// What is kept of a run in which messages get lost: who closed which session,
// and which promises were broken.
#pragma once

#include "base/geometry.hpp"
#include "base/protocol.hpp"
#include "channel/channel_profile.hpp"
#include "channel/link_faults.hpp"
#include "experiments/conformance/trace_checker.hpp"
#include "messages/protocol/motion.hpp"
#include "messages/protocol/record.hpp"
#include "policies/registry.hpp"
#include "tests/support/echo_service.hpp"
#include "tests/support/toy_streets.hpp"
#include "world/roads/streets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace sofof::test {

/// Counts how often each side closed each session.
struct ledger {
  std::map<messages::session_id, int> closed_by_requester, closed_by_provider;
  std::map<messages::session_id, duration> provider_side; // how long it ran
  std::map<messages::session_id, time_point> accepted;    // by the provider
  std::map<messages::session_id, time_point> left;  // by the requester, ...
  std::map<messages::session_id, time_point> freed; // ... and by the provider
  std::set<messages::end_reason> reasons;
  int remote_episodes = 0;
  int refusals = 0; // that the requester was told of

  void on_record(const messages::record& x) {
    if (const auto* episode = std::get_if<messages::episode_record>(&x))
      add(*episode);
    if (const auto* decision = std::get_if<messages::decision_record>(&x))
      refusals += !decision->accepted;
  }

  void add(const messages::episode_record& r) {
    ++(r.of == messages::side::requester ? closed_by_requester
                                         : closed_by_provider)[r.session];
    reasons.insert(r.reason);
    (r.of == messages::side::requester ? left : freed)[r.session] = r.ended;
    if (r.of == messages::side::provider) {
      provider_side[r.session] = r.ended - r.accepted;
      accepted[r.session] = r.accepted;
    }
    if (r.of == messages::side::requester)
      remote_episodes += r.got_data;
  }

  friend bool operator==(const ledger&, const ledger&) = default;
};

/// What one vehicle's client lives through; every promise is checked at every
/// message, and every step of the protocol against its rules.
struct client_diary {
  struct entry {
    messages::service_name service;
    bool remote = false;
    time_point newest_created{};
    std::map<messages::session_id, time_point> newest_of; // in use since
    bool any_result = false;
    int changes = 0, told = 0; // of its source: that came, in events
    bool told_remote = false;
    // Since its last record of work: results of its own function, and inputs
    // that providers may have got at most.
    std::uint64_t on_board = 0, most_inputs = 0;
    std::uint64_t sessions = 0; // that run
  };
  std::vector<entry> services;
  std::vector<std::string> broken; // promises
  experiments::conformance::trace_checker trace{duration{0}};
  std::map<messages::trace_step, int> made; // steps
  std::map<provider_id, int> used_of;       // results; 0: of own functions
  bool ends = false;                        // its client is told nothing more

  void on_record(const messages::record& x) {
    if (const auto* step = std::get_if<messages::trace_record>(&x)) {
      trace.add(*step, {0, trace.steps() + 1});
      ++made[step->what];
      if (step->by == messages::trace_part::selector) {
        count_work(*step);
        used_of[step->provider] += step->what == messages::trace_step::used;
      }
      ends = ends
             || (step->by == messages::trace_part::requester
                 && step->what == messages::trace_step::shut_down);
    }
    if (const auto* work = std::get_if<messages::work_record>(&x))
      compare(*work);
    const auto* event = std::get_if<messages::event_record>(&x);
    if (event && event->what == messages::event_type::switched && !ends) {
      auto& e = of(event->service); // or from one provider to another
      e.told += std::exchange(e.told_remote, event->remote) != event->remote;
    }
  }

  // A provider gets ten inputs a second, one more at the begin, and one when it
  // is called, or comes to stand by, or no longer does.
  static constexpr std::uint64_t inputs_a_second = 12;

  void count_work(const messages::trace_record& step) {
    using enum messages::trace_step;
    const auto& [name, counter] = step.services.front();
    auto& e = of(name);
    e.on_board += step.what == used && counter == 0;
    if (step.what == begun) {
      ++e.sessions;
      e.most_inputs += inputs_a_second;
    }
    e.sessions -= step.what == end_got;
    e.most_inputs += step.what == called;
    if (step.what == first_data || step.what == end_got || step.what == standby)
      e.most_inputs += e.sessions;
  }

  /// Once a second.
  void compare(const messages::work_record& work) {
    auto& e = of(work.service);
    if (work.on_board != e.on_board)
      broken.push_back(fmt::format("{} results of {} on board, {} are recorded",
                                   e.on_board, work.service.view(),
                                   work.on_board));
    if (work.inputs > e.most_inputs)
      broken.push_back(
          fmt::format("{} inputs of {} in a second, not {} at most",
                      work.inputs, work.service.view(), e.most_inputs));
    e.on_board = 0;
    e.most_inputs = e.sessions * inputs_a_second;
  }

  /// Everybody has gone.
  void finish() {
    for (const auto& e : services)
      if (e.changes != e.told)
        broken.push_back(
            fmt::format("the source changed {} times, events tell of {}",
                        e.changes, e.told));
    for (const auto& x : trace.finish())
      broken.push_back(fmt::format("step {}: {}", x.at.line, in_words(x)));
  }

  entry& of(const messages::service_name& service) {
    const auto known = std::ranges::find(services, service, &entry::service);
    return known != services.end() ? *known
                                   : services.emplace_back(entry{service});
  }

  void on_source(const messages::service_name& service, bool remote) {
    auto& e = of(service);
    if (e.remote == remote)
      broken.push_back("a source was chosen that was in use already");
    e.remote = remote;
    e.changes += !ends;
    e.newest_of.clear();
  }

  void on_result(const messages::service_result& result) {
    auto& e = of(result.session.service);
    if (e.remote != result.session.is_remote())
      broken.push_back("a result came from the source that is not in use");
    auto& newest = e.newest_of[result.session];
    if (result.created < newest)
      broken.push_back("a source's results came out of order");
    newest = result.created;
    e.newest_created = std::max(e.newest_created, result.created);
    e.any_result = true;
  }

  void check_fresh(time_point now) {
    using namespace std::chrono_literals;
    constexpr auto fresh = 50ms + 100ms + 50ms;
    for (const auto& e : services)
      if (e.any_result && now - e.newest_created > fresh)
        broken.push_back("the newest result is not fresh");
  }
};

/// What a vehicle, its links and its providers are like.
struct conduct {
  std::function<std::unique_ptr<policies::local_policy>()> policy = [] {
    return policies::make_lodm("always");
  };
  /// Of each provider.
  std::function<std::unique_ptr<policies::central_policy>()> provider_policy =
      [] { return policies::make_codm("location"); };
  std::function<offloading::service(const messages::service_name&)> service =
      [](const messages::service_name& name) { return echo_service(name); };
  /// Nothing gets through meanwhile; in order.
  std::vector<channel::outage_options> outages{};

  /// @returns a channel of that name with these outages.
  std::shared_ptr<const channel::channel_profile>
  on(std::string_view channel) const {
    auto profile = *channel::find_channel_profile(channel);
    profile.outages = outages;
    return std::make_shared<const channel::channel_profile>(std::move(profile));
  }
};

/// A vehicle reduced to what the protocol needs drives to and fro over the
/// areas at 15 m/s, sends CAMs at 10 Hz and feeds its services at 20 Hz.
struct shuttle {
  static constexpr station_id station = 101;

  double x_m = -500;
  std::uint64_t said = 0;

  void step() {
    x_m = x_m + 0.75 > 500 ? -500 : x_m + 0.75;
    ++said;
  }
  bool sends_cam() const { return said % 2 == 1; }
  messages::ego_state ego(time_point now) const {
    return {{station, now, {x_m, 0}, 0, 15, 0}, x_m + 500};
  }
};

/// The way ahead of the shuttle, straight on.
inline std::vector<point> path_ahead(const messages::ego_state& ego) {
  std::vector<point> way;
  way.reserve(1
              + static_cast<std::size_t>(protocol::route_ahead_m
                                         / protocol::route_spacing_m));
  for (double m = 0; m <= protocol::route_ahead_m;
       m += protocol::route_spacing_m)
    way.push_back(ego.own.position + point{m, 0});
  return way;
}

inline polygon area_of_provider(int k) {
  return polygon::regular({100.0 * k, 0}, 300, 24);
}

inline world::streets_ptr one_long_street() {
  static const world::streets_ptr street = [] {
    auto world = std::make_shared<world::streets>();
    world->map = world::road_map{
        "street", {}, {toy::straight("street", {-600, 0}, {1400, 0})}};
    return world;
  }();
  return street;
}

} // namespace sofof::test
