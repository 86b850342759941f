// One service provider among probes that stand for requesters.
#pragma once

#include "actors/offloading/service_provider.hpp"
#include "tests/actors/spy_policies.hpp"
#include "tests/support/echo_service.hpp"
#include "tests/support/on_air.hpp"
#include "tests/support/virtual_world.hpp"

#include <doctest/doctest.h>

#include <string>
#include <utility>

namespace sofof::test {

struct provider_world : virtual_world {
  static constexpr provider_id::rep boot = 11;
  static constexpr station_id::rep station = 101;
  static constexpr point inside{10, 0}, outside{101, 0};
  const messages::service_name one{"one"}, two{"two"};

  std::shared_ptr<codm_script> codm = std::make_shared<codm_script>();
  channel::provider_compute compute;
  probe<messages::recorder_actor> recorder = listen<messages::recorder_actor>();
  probe<messages::requester_actor> requester =
      listen<messages::requester_actor>();
  probe<messages::requester_actor> neighbour =
      listen<messages::requester_actor>();
  messages::roadside_provider_actor provider =
      own(actors::spawn_service_provider(system(), setup()));
  std::uint32_t last_number = 0;
  point place = inside; ///< Where the station is as it asks.

  provider_world() { run_for(10s); } // the clock's zero is no special time

  actors::provider_actor_setup setup() {
    actors::provider_actor_setup s;
    s.id = boot;
    s.position = {1, 2};
    s.area = polygon{{{-100, -100}, {100, -100}, {100, 100}, {-100, 100}}};
    s.map = std::make_shared<const world::road_map>();
    s.decode = decode_in_ulm();
    s.services = {echo_service("one"), echo_service("two")};
    s.codm = std::make_unique<spy_codm>(codm);
    s.recorder = recorder.handle;
    s.compute = compute;
    s.seed = random_stream{1, "network"};
    return s;
  }

  /// A provider with the computers as they are now takes the place of the
  /// first.
  void restart() {
    provider = own(actors::spawn_service_provider(system(), setup()));
  }

  // -- what happens to the provider ---------------------------------------

  void hear(const messages::cam& own,
            const probe<messages::requester_actor>& from) {
    tell(provider, pdu_of(own), from.handle);
  }
  void hear(point where, const probe<messages::requester_actor>& from,
            station_id who = station) {
    hear(messages::cam{who, now(), where, 0, 10, 0}, from);
  }
  void hear(point where) { hear(where, requester); }

  /// Hears a CPM of one who sees these.
  void see(station_id who,
           const std::vector<messages::known_object>& seen = {}) {
    tell(provider, pdu_of(messages::cam{who, now(), inside, 0, 10, 0}, seen),
         requester.handle);
  }

  /// Hears CAMs at 10 Hz from inside for some time, the last one at its end.
  void stay(duration d) {
    for (auto left = d; left >= 100ms; left -= 100ms) {
      run_for(100ms);
      hear(inside);
    }
  }
  messages::service_request
  make_request(std::vector<messages::service_name> kinds) {
    return {boot, station, ++last_number, std::move(kinds), {place}, 10};
  }
  void ask(const messages::service_request& request) {
    tell(provider, request, requester.handle);
  }
  /// Asks, and starts what was accepted.
  void start(std::vector<messages::service_name> kinds) {
    ask(make_request(std::move(kinds)));
    for (const auto& m : managers())
      tell(m,
           messages::service_input{{}, now(), messages::payload::of(echo{1})});
  }

  // -- what it has done ---------------------------------------------------

  std::vector<messages::service_offer> offers() const {
    return requester->all<messages::service_offer>();
  }
  std::vector<messages::service_response> responses() const {
    return requester->all<messages::service_response>();
  }
  /// The managers that came with the last response.
  std::vector<messages::provider_manager_actor> managers() const {
    const auto all =
        requester->seconds<std::vector<messages::provider_manager_actor>>();
    REQUIRE(!all.empty());
    return all.back();
  }
  std::vector<messages::verdict> verdicts() const {
    REQUIRE(!responses().empty());
    return responses().back().verdicts;
  }
  std::vector<messages::service_end> ends() const {
    return requester->all<messages::service_end>();
  }
  std::vector<messages::episode_record> episodes() const {
    return recorder->all<messages::episode_record>();
  }
  /// @returns whether the provider still computes for the requester.
  bool still_sends() {
    const auto before = requester->count<messages::service_result>();
    run_for(100ms);
    return requester->count<messages::service_result>() > before;
  }
};

} // namespace sofof::test
