// One connection between a peer that the test plays and a provider that
// listens.
#pragma once

#include "actors/remote/provider_endpoint.hpp"
#include "tests/support/echo_service.hpp"
#include "tests/support/on_air.hpp"
#include "tests/support/virtual_world.hpp"

#include <doctest/doctest.h>

#include <set>
#include <string>
#include <vector>

namespace sofof::test {

struct vehicle_connection_world : virtual_world {
  static constexpr sender_id certificate = 77;
  static constexpr provider_id::rep boot = 11;
  static constexpr station_id::rep station = 101, neighbour = 102,
                                   foreign = 999;
  /// How much later the peer's clock stood at 0, by its time of day.
  static constexpr auto gap = 200ms;
  const messages::session_id one{boot, station, "one", 7};
  const messages::session_id two{boot, neighbour, "one", 8};

  probe<messages::recorder_actor> recorder = listen<messages::recorder_actor>();
  probe<messages::provider_actor> provider = listen<messages::provider_actor>();
  probe<messages::provider_manager_actor> manager =
      listen<messages::provider_manager_actor>();
  probe<messages::vehicle_endpoint_actor> peer =
      listen<messages::vehicle_endpoint_actor>();
  probe<messages::vehicle_endpoint_actor> stranger =
      listen<messages::vehicle_endpoint_actor>();
  duration ahead{}; ///< What the peer's clock shows more than ours.
  messages::provider_endpoint_actor endpoint;

  vehicle_connection_world() {
    run_for(10s); // the clock's zero is no special time
    endpoint = join(peer, {station, neighbour});
    settle();
    forget();
  }

  messages::provider_endpoint_actor
  join(const probe<messages::vehicle_endpoint_actor>& with,
       std::set<station_id> stations) {
    const messages::etsi::its_clock ours;
    const messages::etsi::its_clock theirs{
        ours.epoch_unix_ms()
        + std::chrono::duration_cast<std::chrono::milliseconds>(gap).count()};
    return own(actors::spawn_provider_endpoint(
        system(), {provider.handle, with.handle, std::move(stations), ours,
                   theirs, recorder.handle, certificate}));
  }

  void forget() {
    peer->clear();
    stranger->clear();
    provider->clear();
    recorder->clear();
    manager->clear();
  }

  // -- what the peer does -----------------------------------------------------

  template <class... Ts>
  void say(const Ts&... xs) {
    tell_as(peer.handle, endpoint, xs...);
  }
  template <class... Ts>
  void say_strangely(const Ts&... xs) {
    tell_as(stranger.handle, endpoint, xs...);
  }
  void say_cam(station_id::rep of = station) { say(of, cam_of(of)); }
  messages::its_pdu cam_of(station_id of) {
    return pdu_of(messages::cam{of, now(), {1, 2}, 0, 5, 0});
  }
  messages::service_request request_of(station_id of,
                                       std::size_t points = 2) const {
    return {boot, of, 1, {"one"}, std::vector<point>(points), 5};
  }

  /// The peer answers the latest ping, which took these ways.
  void answer(duration up = {}, duration down = {}) {
    const auto signs = peer->all<messages::ping>();
    REQUIRE(!signs.empty());
    const auto there = signs.back().sent + up + ahead;
    run_for(up + down);
    say(messages::pong{signs.back(), there, there});
  }
  /// Life signs and answers to them, without any delay.
  void live(duration d) {
    for (auto left = d; left >= 50ms; left -= 50ms) {
      run_for(50ms);
      say(messages::ping{1, now() + ahead});
      answer();
    }
  }
  /// The provider accepts a service of a station that has asked.
  void accept(const messages::session_id& running) {
    say(request_of(running.station));
    tell_as(provider.handle, voice(),
            messages::service_response{
                boot, running.station, 1, {{running, true, ""}}},
            std::vector{manager.handle});
  }

  // -- what came of it --------------------------------------------------------

  /// @returns how the provider has reached the last one who spoke.
  messages::requester_actor voice() const {
    const auto all = provider->seconds<messages::requester_actor>();
    REQUIRE(!all.empty());
    return all.back();
  }
  std::vector<messages::event_record> notes(std::string_view what) const {
    std::vector<messages::event_record> found;
    for (const auto& e : recorder->all<messages::event_record>())
      if (messages::name_of(e.what) == what)
        found.push_back(e);
    return found;
  }
  bool was_ignored(std::string_view why) const {
    const auto all = notes("peer_ignored");
    return !all.empty() && all.back().detail.starts_with(why);
  }
};

} // namespace sofof::test
