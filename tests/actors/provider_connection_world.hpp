// One connection between a vehicle that listens and a provider's host that the
// test plays.
#pragma once

#include "actors/remote/provider_connection.hpp"
#include "actors/remote/provider_proxy.hpp"
#include "actors/remote/type_block.hpp"
#include "tests/support/echo_service.hpp"
#include "tests/support/on_air.hpp"
#include "tests/support/virtual_world.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sofof::test {

using acceptor_promise =
    caf::typed_response_promise<std::uint32_t, std::uint64_t, std::string,
                                caf::strong_actor_ptr>;

/// What a played provider's host answers, and what it was asked.
struct host_script {
  std::uint32_t protocol = messages::remote_protocol;
  std::uint64_t types = actors::fingerprint_of_types();
  std::string nonce = "a number";
  messages::peer_welcome welcome{11, messages::etsi::virtual_epoch_unix_ms};
  std::optional<std::string> refusal;
  bool full = false;
  bool answers = true;
  /// Given to those who are welcome.
  messages::provider_endpoint_actor endpoint;

  std::size_t knocks = 0;
  std::vector<acceptor_promise> unanswered;
  std::vector<messages::peer_hello> hellos;
  messages::vehicle_endpoint_actor peer; ///< The last one who came in.
};

inline messages::handshake_actor::behavior_type
played_handshake(messages::handshake_actor::pointer self,
                 std::shared_ptr<host_script> script) {
  return {[self, script](const messages::peer_hello& hello,
                         const messages::vehicle_endpoint_actor& peer)
              -> caf::result<messages::peer_welcome,
                             messages::provider_endpoint_actor> {
    script->hellos.push_back(hello);
    script->peer = peer;
    self->quit();
    if (script->refusal)
      return caf::make_error(caf::sec::invalid_argument, *script->refusal);
    return {script->welcome, script->endpoint};
  }};
}

inline messages::acceptor_actor::behavior_type
played_acceptor(messages::acceptor_actor::pointer self,
                std::shared_ptr<host_script> script) {
  return {[self, script](std::uint32_t, std::uint64_t)
              -> caf::result<std::uint32_t, std::uint64_t, std::string,
                             caf::strong_actor_ptr> {
    ++script->knocks;
    if (!script->answers) {
      auto promise = self->make_response_promise<acceptor_promise>();
      script->unanswered.push_back(promise);
      return promise;
    }
    caf::strong_actor_ptr in;
    if (!script->full)
      in = caf::actor_cast<caf::strong_actor_ptr>(
          self->spawn(played_handshake, script));
    return {script->protocol, script->types, script->nonce, in};
  }};
}

struct provider_connection_world : virtual_world {
  static constexpr provider_id::rep boot = 11;
  static constexpr station_id::rep station = 101, neighbour = 102;
  /// By then each of them may speak.
  static constexpr duration turns = std::chrono::milliseconds{10};
  const messages::session_id one{boot, station, "one", 7};
  const messages::session_id two{boot, neighbour, "one", 8};

  probe<messages::recorder_actor> recorder = listen<messages::recorder_actor>();
  probe<messages::provider_endpoint_actor> provider =
      listen<messages::provider_endpoint_actor>();
  probe<messages::requester_actor> requester =
      listen<messages::requester_actor>();
  probe<messages::requester_actor> other = listen<messages::requester_actor>();
  std::shared_ptr<host_script> host = std::make_shared<host_script>();
  messages::acceptor_actor acceptor =
      own(system().spawn(played_acceptor, host));
  bool reachable = true;
  bool takes_time = false; ///< Attempts end when the test says so.
  std::vector<std::function<void()>> unfinished;
  std::vector<time_point> attempts, hung_up;
  std::vector<std::string> refusals, news;
  duration ahead{}; ///< What the provider's clock shows more than ours.
  actors::provider_outbox outbox;
  messages::link_actor far, other_far;

  provider_connection_world() {
    run_for(10s); // the clock's zero is no special time
    host->endpoint = provider.handle;
  }

  actors::provider_connection_setup setup() {
    actors::provider_connection_setup s;
    s.provider = "server";
    s.address = [] { return "10.0.0.5:4711"; };
    s.stations = {station, neighbour};
    s.world = 5;
    s.recorder = recorder.handle;
    s.noise = random_stream{1, "connection"};
    s.connect =
        [this]() -> std::variant<messages::acceptor_actor, std::string> {
      if (reachable)
        return acceptor;
      return "nobody is there";
    };
    s.aside = [this](std::function<void()> attempt) {
      attempts.push_back(now());
      if (takes_time)
        unfinished.push_back(std::move(attempt));
      else
        attempt();
    };
    s.hang_up = [this] { hung_up.push_back(now()); };
    s.prove = [](messages::peer_hello& hello, const std::string& nonce) {
      hello.certificate = "proof of " + nonce;
    };
    s.on_refusal = [this](const std::string& why) { refusals.push_back(why); };
    s.on_news = [this](const std::string& what) { news.push_back(what); };
    return s;
  }

  void start() { start(setup()); }
  void start(actors::provider_connection_setup s) {
    outbox = own(actors::spawn_provider_connection(system(), std::move(s)));
    far = own(actors::spawn_provider_proxy(system(), station, outbox));
    other_far = own(actors::spawn_provider_proxy(system(), neighbour, outbox));
    actors::introduce(outbox, station, far);
    actors::introduce(outbox, neighbour, other_far);
    settle();
  }
  /// The same, up to when vehicles have spoken and the clocks are known.
  void connect() {
    start();
    REQUIRE(host->peer);
    say(messages::ping{1, now() + ahead});
    run_for(protocol::ping_period);
    say_cam();
    tell(other_far, cam_of(neighbour), other.handle);
    acknowledge({station, messages::stream_id::what::cam, 0});
    acknowledge({neighbour, messages::stream_id::what::cam, 0});
    live(100ms);
    forget();
  }
  void forget() {
    recorder->clear();
    provider->clear();
    requester->clear();
    other->clear();
  }

  /// Attempts end, as things are.
  void finish() {
    for (const auto& attempt : std::exchange(unfinished, {}))
      attempt();
    settle();
  }
  /// The connection ends; the next one leads to another endpoint.
  void lose() {
    kill(provider.handle);
    provider = listen<messages::provider_endpoint_actor>();
    host->endpoint = provider.handle;
  }

  // -- what vehicles and the provider do --------------------------------------

  messages::its_pdu cam_of(station_id of, double speed_mps = 5) {
    return pdu_of(messages::cam{of, now(), {1, 2}, 0, speed_mps, 0});
  }
  void say_cam(double speed_mps = 5) {
    tell(far, cam_of(station, speed_mps), requester.handle);
  }
  template <class... Ts>
  void answer_as(const caf::actor& who, const Ts&... xs) {
    tell_as(who, host->peer, xs...);
  }
  template <class... Ts>
  void say(const Ts&... xs) {
    tell_as(provider.handle, host->peer, xs...);
  }
  void acknowledge(const messages::stream_id& stream) { say(stream); }
  void result(const messages::session_id& r, std::uint64_t cycle,
              time_point created) {
    say(messages::service_result{r, cycle, created,
                                 messages::payload::of(echo{cycle})});
  }
  void accept(const messages::session_id& r) {
    say(messages::service_response{boot, r.station, 1, {{r, true, ""}}});
  }
  /// The provider answers the latest ping, which took these ways.
  void answer(duration up = {}, duration down = {}) {
    const auto signs = provider->all<messages::ping>();
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

  // -- what came of it --------------------------------------------------------

  std::size_t notes(std::string_view what) const {
    std::size_t n = 0;
    for (const auto& e : recorder->all<messages::event_record>())
      n += messages::name_of(e.what) == what;
    return n;
  }
};

} // namespace sofof::test
