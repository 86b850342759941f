// Tests of vehicles and a provider on two hosts, whatever the hosts, the wire,
// their peers and strangers do.
#include "actors/remote/type_block.hpp"
#include "tests/actors/remote_world.hpp"
#include "tests/messages/random_messages.hpp"

#include <map>
#include <utility>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::test;

namespace {

/// Three vehicles among all sorts of trouble.
struct troubled_world : remote_world {
  filler random;
  probe<vehicle_endpoint_actor> false_vehicles =
      listen<vehicle_endpoint_actor>();
  probe<provider_endpoint_actor> false_provider =
      listen<provider_endpoint_actor>();

  explicit troubled_world(std::uint64_t seed) : remote_world{3}, random{seed} {}

  bool once_in(std::size_t n) { return random.below(n) == 0; }

  // -- nonsense ---------------------------------------------------------------

  template <class Message>
  Message nonsense() {
    Message x;
    random.fill(x);
    return x;
  }
  /// Half of it looks true.
  session_id some_service() {
    if (once_in(2))
      return nonsense<session_id>();
    return {boot, some_station(), once_in(2) ? one : two,
            static_cast<std::uint32_t>(random.below(60))};
  }
  station_id::rep some_station() {
    return once_in(4) ? nonsense<station_id::rep>()
                      : static_cast<station_id::rep>(101 + random.below(4));
  }
  its_pdu some_pdu() {
    auto pdu = nonsense<its_pdu>();
    if (once_in(3))
      return pdu;
    pdu = pdu_of(cam{some_station(), now(), {500, 0}, 0, 10, 0});
    for (auto flips = random.below(4); flips > 0; --flips)
      random.fill(pdu.octets[random.below(pdu.octets.size())]);
    return pdu;
  }
  stream_id some_stream() {
    auto x = nonsense<stream_id>();
    x.station = some_station();
    x.counter = static_cast<std::uint32_t>(random.below(60));
    return x;
  }
  service_end some_end(side from) {
    auto x = nonsense<service_end>();
    x.session = some_service();
    x.from = from;
    return x;
  }
  service_response some_response() {
    auto x = nonsense<service_response>();
    x.provider = boot;
    x.station = some_station();
    x.number = static_cast<std::uint32_t>(random.below(60));
    for (auto& v : x.verdicts)
      v.session = some_service();
    return x;
  }

  /// As a peer that has lost its mind, or as a stranger.
  void babble_to_provider(const caf::actor& from) {
    const auto endpoint =
        caf::actor_cast<provider_endpoint_actor>(line->latest.provider);
    if (!endpoint || !from)
      return;
    auto request = nonsense<service_request>();
    request.station = some_station();
    auto input = nonsense<service_input>();
    input.session = some_service();
    if (once_in(2))
      input.what = payload::of(some_pdu());
    const auto say = [&](const auto&... xs) { tell_as(from, endpoint, xs...); };
    switch (random.below(7)) {
      case 0:
        return say(some_station(), some_pdu());
      case 1:
        return say(request);
      case 2:
        return say(input);
      case 3:
        return say(some_end(side::requester));
      case 4:
        return say(nonsense<ping>());
      case 5:
        return say(nonsense<pong>());
      default:
        return say(some_stream());
    }
  }
  void babble_to_vehicles(const caf::actor& from) {
    if (!from)
      return;
    auto offer = nonsense<service_offer>();
    if (once_in(2))
      offer.services = {one, two};
    auto result = nonsense<service_result>();
    result.session = some_service();
    const auto say = [&](const auto&... xs) { tell_as(from, outbox, xs...); };
    switch (random.below(7)) {
      case 0:
        return say(some_station(), offer);
      case 1:
        return say(some_response());
      case 2:
        return say(result);
      case 3:
        return say(some_end(side::provider));
      case 4:
        return say(nonsense<ping>());
      case 5:
        return say(nonsense<pong>());
      default:
        return say(some_stream());
    }
  }
  /// Somebody introduces himself who is not known.
  void knock() {
    if (!acceptor)
      return;
    const auto hello = nonsense<peer_hello>();
    const auto protocol =
        once_in(2) ? remote_protocol : nonsense<std::uint32_t>();
    system().spawn([=, acceptor = inner_acceptor,
                    as = false_vehicles.handle](caf::event_based_actor* self) {
      const auto ignore = [](const caf::error&) {};
      self->request(acceptor, caf::infinite, protocol, fingerprint_of_types())
          .then(
              [=](std::uint32_t, std::uint64_t, const std::string&,
                  const caf::strong_actor_ptr& in) {
                if (in)
                  self->request(caf::actor_cast<handshake_actor>(in),
                                caf::infinite, hello, as)
                      .then([](const peer_welcome&,
                               const provider_endpoint_actor&) {},
                            ignore);
              },
              ignore);
    });
    settle();
  }

  // -- trouble ----------------------------------------------------------------

  void cause_trouble(bool with_lies) {
    if (once_in(line->cut ? 20 : 100))
      line->cut = !line->cut;
    if (once_in(acceptor ? 150 : 30))
      acceptor ? crash() : boot_up();
    if (once_in(40))
      line->copies = [this, share = 1 + random.below(20)](const auto&) {
        return once_in(share) ? 2 : 1;
      };
    if (once_in(40))
      line->delay = [this, most = 1 + random.below(60)] {
        return std::chrono::milliseconds{random.below(most)};
      };
    const auto& who = line->latest;
    if (once_in(3))
      babble_to_provider(caf::actor_cast<caf::actor>(false_vehicles.handle));
    if (once_in(3))
      babble_to_vehicles(caf::actor_cast<caf::actor>(false_provider.handle));
    if (once_in(20))
      knock();
    if (with_lies && once_in(3))
      babble_to_provider(who.its_peer);
    if (with_lies && once_in(3))
      babble_to_vehicles(who.their_peer);
  }
  void calm_down() {
    line->cut = false;
    line->copies = nullptr;
    line->delay = nullptr;
    if (!acceptor)
      boot_up();
  }

  // -- promises ---------------------------------------------------------------

  /// Results come from the source that was chosen, and from no other.
  void check_sources() const {
    for (const auto& c : cars) {
      std::map<service_name, bool> remote;
      std::size_t broken = 0;
      for (const auto& e : c.vehicle->entries()) {
        if (e.what.match_elements<source_change>()) {
          const auto& change = e.what.get_as<source_change>(0);
          broken += remote[change.service] == change.remote;
          remote[change.service] = change.remote;
        } else if (e.what.match_elements<service_result>()) {
          const auto& r = e.what.get_as<service_result>(0).session;
          broken += remote[r.service] != r.is_remote();
        }
      }
      CHECK(broken == 0);
    }
  }
  /// Of a kind and a vehicle never two run at a time.
  static void check_episodes(const probe<recorder_actor>& at) {
    std::map<std::pair<station_id, service_name>, time_point> ended;
    std::size_t overlaps = 0;
    for (const auto& e : episodes(at)) {
      auto& last = ended[{e.session.station, e.session.service}];
      overlaps += e.accepted < last;
      last = e.ended;
    }
    CHECK(overlaps == 0);
  }
  void check_alive() const {
    CHECK(!is_gone(outbox));
    CHECK(!is_gone(acceptor));
    CHECK(!is_gone(provider));
    for (const auto& c : cars) {
      CHECK(!is_gone(c.far));
      CHECK(!is_gone(c.requester));
    }
  }
};

void live_through(std::uint64_t seed, bool with_lies) {
  CAPTURE(seed);
  troubled_world w{seed};
  for (int round = 0; round < 3; ++round) {
    for (int k = 0; k < 600; ++k) {
      w.cause_trouble(with_lies);
      w.drive(50ms);
    }
    w.calm_down();
    // For a lie about clocks to be forgotten takes a while.
    w.drive(with_lies ? 20s : 5s);
    w.check_alive();
    CHECK(w.all_remote());
    CHECK(w.refusals.empty());
  }
  w.check_sources();
  w.check_episodes(w.here);
  CHECK(remote_world::episodes(w.here).size() > 20);
  CHECK(w.line->carried > 5000);
}

} // namespace

TEST_CASE("vehicles survive cuts, restarts, duplicates, delays and strangers, "
          "and are planned for again soon") {
  for (std::uint64_t seed = 1; seed <= 8; ++seed)
    live_through(seed, false);
}

TEST_CASE("vehicles and a provider survive peers that have lost their mind") {
  for (std::uint64_t seed = 1; seed <= 8; ++seed)
    live_through(seed, true);
}
