// Tests of the acceptor and its handshakes: who is let in, who is not, and why.
#include "actors/remote/acceptor.hpp"

#include "actors/remote/type_block.hpp"
#include "base/protocol.hpp"
#include "tests/support/virtual_world.hpp"

#include <caf/actor_proxy.hpp>
#include <caf/event_based_actor.hpp>
#include <caf/mailbox_element.hpp>
#include <caf/make_actor.hpp>
#include <doctest/doctest.h>

#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::test;

namespace {

struct version_answer {
  std::uint32_t protocol = 0;
  std::uint64_t types = 0;
  std::string nonce;
  caf::strong_actor_ptr in;
};

/// An actor of another process, and what the acceptor has answered to it.
class far_actor : public caf::actor_proxy {
public:
  far_actor(caf::actor_config& config, std::shared_ptr<version_answer> heard)
      : actor_proxy{config}, heard_{std::move(heard)} {}

  bool enqueue(caf::mailbox_element_ptr what, caf::execution_unit*) override {
    const auto& said = what->content();
    if (said.size() == 4)
      *heard_ = {said.get_as<std::uint32_t>(0), said.get_as<std::uint64_t>(1),
                 said.get_as<std::string>(2),
                 said.get_as<caf::strong_actor_ptr>(3)};
    return true;
  }
  void kill_proxy(caf::execution_unit*, caf::error) override {}

private:
  std::shared_ptr<version_answer> heard_;
};

struct acceptor_world : virtual_world {
  struct answer {
    std::optional<peer_welcome> welcome;
    provider_endpoint_actor endpoint;
    std::string error;
  };

  probe<provider_actor> provider = listen<provider_actor>();
  probe<recorder_actor> recorder = listen<recorder_actor>();
  probe<vehicle_endpoint_actor> peer = listen<vehicle_endpoint_actor>();
  int nonces = 0;
  bool draws = true;
  std::vector<std::string> proofs; ///< That were looked at.
  std::optional<std::string> doubt;
  std::vector<std::pair<std::set<station_id>, bool>> comings;
  const std::uint64_t types = fingerprint_of_types();
  const peer_hello hello{"server", {101, 102}, 5, etsi::virtual_epoch_unix_ms,
                         {},       {}};
  acceptor_actor acceptor = own(spawn_acceptor(system(), setup()));

  acceptor_setup setup() {
    acceptor_setup s;
    s.provider = provider.handle;
    s.id = 11;
    s.name = "server";
    s.world = 5;
    s.recorder = recorder.handle;
    s.draw_nonce = [this] {
      if (!draws)
        throw std::runtime_error{"no numbers left"};
      return "nonce " + std::to_string(++nonces);
    };
    s.examine = [this](const peer_hello& from, const std::string& nonce,
                       const caf::node_id&) {
      proofs.push_back(nonce);
      return peer_finding{from.certificate, doubt};
    };
    s.on_peer = [this](const std::set<station_id>& who, bool is_here) {
      comings.emplace_back(who, is_here);
    };
    return s;
  }

  version_answer knock(std::uint32_t protocol, std::uint64_t their_types) {
    auto found = std::make_shared<version_answer>();
    system().spawn([=, this](caf::event_based_actor* self) {
      self->request(acceptor, caf::infinite, protocol, their_types)
          .then([found](std::uint32_t p, std::uint64_t t,
                        const std::string& nonce,
                        const caf::strong_actor_ptr& in) {
            *found = {p, t, nonce, in};
          });
    });
    settle();
    return *found;
  }
  version_answer knock() { return knock(remote_protocol, types); }
  caf::actor somebody_in(std::uint32_t process,
                         const std::shared_ptr<version_answer>& heard) {
    caf::actor_config config;
    caf::node_id::default_data::host_id_type host{1};
    return caf::make_actor<far_actor, caf::actor>(
        1, caf::make_node_id(process, host), &system(), config, heard);
  }
  /// Somebody from another process knocks.
  version_answer knock_from(std::uint32_t process) {
    const auto heard = std::make_shared<version_answer>();
    const auto stranger = somebody_in(process, heard);
    tell_as(stranger, acceptor, remote_protocol, types);
    return *heard;
  }

  answer enter(const version_answer& at, const peer_hello& with,
               const vehicle_endpoint_actor& as) {
    auto found = std::make_shared<answer>();
    system().spawn([=](caf::event_based_actor* self) {
      self->request(caf::actor_cast<handshake_actor>(at.in), caf::infinite,
                    with, as)
          .then(
              [found](const peer_welcome& welcome,
                      const provider_endpoint_actor& endpoint) {
                *found = {welcome, endpoint, {}};
              },
              [found](const caf::error& error) {
                found->error = error.context().match_elements<std::string>()
                                   ? error.context().get_as<std::string>(0)
                                   : to_string(error);
              });
    });
    settle();
    return *found;
  }
  /// Those who show this certificate come in.
  answer enter_as(const std::string& name,
                  const std::vector<station_id>& stations) {
    auto with = hello;
    with.certificate = name;
    with.stations = stations;
    return enter(knock(), with);
  }
  answer enter(const version_answer& at, const peer_hello& with) {
    return enter(at, with, peer.handle);
  }

  std::vector<event_record> refusals() const {
    std::vector<event_record> found;
    for (const auto& e : recorder->all<event_record>())
      if (e.what == event_type::peer_refused)
        found.push_back(e);
    return found;
  }
};

} // namespace

TEST_CASE_FIXTURE(acceptor_world,
                  "who speaks the same gets a number of its own to "
                  "sign, and a handshake") {
  const auto one = knock();
  const auto two = knock();
  CHECK(one.protocol == remote_protocol);
  CHECK(one.types == types);
  CHECK(one.in);
  CHECK(two.in);
  CHECK(one.in != two.in);
  CHECK(one.nonce == "nonce 1");
  CHECK(two.nonce == "nonce 2");
}

TEST_CASE_FIXTURE(acceptor_world,
                  "who speaks another version is told ours, and "
                  "gets no further") {
  for (const auto& there : {knock(remote_protocol + 1, types),
                            knock(remote_protocol, types + 1), knock(0, 0)}) {
    CHECK(there.protocol == remote_protocol);
    CHECK(there.types == types);
    CHECK(there.nonce.empty());
    CHECK(!there.in);
  }
  CHECK(nonces == 0);
}

TEST_CASE_FIXTURE(acceptor_world,
                  "who is welcome gets an endpoint and is told which "
                  "provider this is") {
  const auto in = enter(knock(), hello);
  REQUIRE(in.welcome);
  CHECK(in.welcome->provider == 11);
  CHECK(in.welcome->epoch_unix_ms == etsi::virtual_epoch_unix_ms);
  CHECK(in.endpoint);
  CHECK(peer->count<ping>() == 1);
  CHECK(proofs == std::vector<std::string>{"nonce 1"});
  CHECK(refusals().empty());
}

TEST_CASE_FIXTURE(acceptor_world,
                  "who is refused is told why, and never gets a "
                  "endpoint") {
  auto bad = hello;
  auto as = peer.handle;
  std::string why;
  SUBCASE("for its map") {
    bad.world = 6;
    why = "provider server has another map or other services; start both "
          "sides with the same scenario file, or both with --own-map";
  }
  SUBCASE("as it means another provider") {
    bad.provider = "elsewhere";
    why = "it is provider server";
  }
  SUBCASE("for its proof") {
    doubt = "the certificate is for station 7, not 101";
    why = *doubt;
  }
  SUBCASE("as it speaks for nobody") {
    bad.stations.clear();
    why = "speaks for 0 stations; 1 to 10000 are possible";
  }
  SUBCASE("as it speaks for too many") {
    bad.stations.resize(10'001);
    why = "speaks for 10001 stations; 1 to 10000 are possible";
  }
  SUBCASE("as its time makes no sense") {
    SUBCASE("far ahead") {
      bad.epoch_unix_ms = std::numeric_limits<std::int64_t>::max();
    }
    SUBCASE("far back") {
      bad.epoch_unix_ms = std::numeric_limits<std::int64_t>::min();
    }
    why = "its clock shows no time of day";
  }
  SUBCASE("as nobody listens there") {
    as = nullptr;
    why = "it has no end of its own";
  }
  const auto in = enter(knock(), bad, as);
  CHECK(!in.welcome);
  CHECK(!in.endpoint);
  CHECK(in.error == why);
  CHECK(peer->entries().empty());
  REQUIRE(refusals().size() == 1);
  CHECK(refusals().front().detail == why + "; 1 so far");
}

TEST_CASE_FIXTURE(acceptor_world,
                  "those who are refused again and again are noted "
                  "once a second") {
  doubt = "no";
  for (int k = 0; k < 100; ++k) {
    enter(knock(), hello);
    run_for(50ms);
  }
  const auto all = refusals();
  REQUIRE(all.size() == 5);
  CHECK(all.back().detail == "no; 81 so far");
}

TEST_CASE_FIXTURE(acceptor_world, "a handshake is used once, whoever fails") {
  const auto at = knock();
  doubt = "no";
  CHECK(enter(at, hello).error == "no");
  doubt.reset();
  CHECK(!enter(at, hello).welcome);
  CHECK(is_gone(at.in));
  CHECK(enter(knock(), hello).welcome);
}

TEST_CASE_FIXTURE(acceptor_world,
                  "one nonce lets one in, of two that come at once") {
  const auto at = knock();
  int welcomes = 0;
  std::string error;
  system().spawn([&](caf::event_based_actor* self) {
    for (int k = 0; k < 2; ++k)
      self->request(caf::actor_cast<handshake_actor>(at.in), caf::infinite,
                    hello, peer.handle)
          .then([&](const peer_welcome&,
                    const provider_endpoint_actor&) { ++welcomes; },
                [&](const caf::error& x) {
                  error = x.context().get_as<std::string>(0);
                });
  });
  settle();
  CHECK(welcomes == 1);
  CHECK(error == "introduces itself twice");
}

TEST_CASE_FIXTURE(acceptor_world,
                  "who does not introduce himself in time finds "
                  "the handshake closed") {
  const auto at = knock();
  run_for(protocol::handshake_timeout - 1ns);
  CHECK(!is_gone(at.in));
  run_for(1ns);
  CHECK(is_gone(at.in));
}

TEST_CASE_FIXTURE(acceptor_world, "a process that knocks without end has two "
                                  "handshakes, the latest") {
  const auto other = knock_from(7);
  std::vector<version_answer> all;
  for (int k = 0; k < 1000; ++k)
    all.push_back(knock_from(8));
  for (std::size_t k = 0; k < 998; ++k)
    CHECK(is_gone(all[k].in));
  CHECK(!is_gone(all[998].in));
  CHECK(!is_gone(all[999].in));
  CHECK(!is_gone(other.in));
}

TEST_CASE_FIXTURE(acceptor_world, "processes that come by a broker do not take "
                                  "each other's handshakes") {
  std::vector<version_answer> all;
  for (int k = 0; k < 100; ++k)
    all.push_back(knock()); // each an actor of this process
  for (const auto& one : all)
    CHECK(!is_gone(one.in));
  CHECK(enter(all.front(), hello).welcome);
}

TEST_CASE_FIXTURE(acceptor_world,
                  "when too many introduce themselves, the oldest "
                  "has to begin anew") {
  const auto honest = knock();
  std::vector<version_answer> all;
  for (std::uint32_t k = 0; k < 256; ++k)
    all.push_back(knock_from(1 + k));
  CHECK(is_gone(honest.in));
  CHECK(!is_gone(all.front().in));
  CHECK(enter(knock(), hello).welcome);
  CHECK(is_gone(all.front().in));
  CHECK(!is_gone(all.back().in));
}

TEST_CASE_FIXTURE(acceptor_world,
                  "who comes in again takes the place of the one "
                  "who spoke for its stations") {
  const auto first = enter_as("car", {101, 102});
  const auto other = enter_as("other car", {101, 103});
  const auto trailer = enter_as("car", {104});
  const auto second = enter_as("car", {102});
  CHECK(second.welcome);
  CHECK(is_gone(first.endpoint));
  CHECK(!is_gone(second.endpoint));
  CHECK(!is_gone(other.endpoint));
  CHECK(!is_gone(trailer.endpoint));
}

TEST_CASE_FIXTURE(acceptor_world,
                  "nobody has more than 16 connections at a time") {
  std::vector<provider_endpoint_actor> all;
  for (station_id::rep k = 1; k <= 16; ++k)
    all.push_back(enter_as("car", {k}).endpoint);
  const auto more = enter_as("car", {17});
  CHECK(!more.welcome);
  CHECK(more.error
        == "the certificate of car has 16 connections already, the most it may "
           "have");
  REQUIRE(refusals().size() == 1);
  CHECK(refusals().front().detail == more.error + "; 1 so far");
  CHECK(enter_as("other car", {17}).welcome);
  CHECK(enter_as("car", {16}).welcome); // again
  kill(all.front());
  CHECK(enter_as("car", {17}).welcome);
}

TEST_CASE_FIXTURE(acceptor_world,
                  "a handshake is for the process that asked for "
                  "it, and no other one uses it up") {
  const auto at = knock();
  tell_as(somebody_in(7, std::make_shared<version_answer>()),
          caf::actor_cast<handshake_actor>(at.in), hello, peer.handle);
  CHECK(proofs.empty());
  CHECK(enter(at, hello).welcome);
}

TEST_CASE_FIXTURE(acceptor_world,
                  "a name that comes in again and again is let in "
                  "once a second, and others are not kept out") {
  for (int k = 0; k < 32; ++k)
    kill(enter_as("one", {103}).endpoint);
  CHECK(enter_as("one", {103}).error == "one comes in too often");
  CHECK(enter_as("other", {104}).welcome);
  run_for(1s);
  CHECK(enter_as("one", {103}).welcome);
  CHECK(!enter_as("one", {103}).welcome);
}

TEST_CASE_FIXTURE(acceptor_world, "peers do not let one another in") {
  const auto far = somebody_in(7, std::make_shared<version_answer>());
  tell_as(far, acceptor, hello, peer.handle, std::string{"car"});
  CHECK(peer->entries().empty());
}

TEST_CASE_FIXTURE(acceptor_world,
                  "an acceptor without numbers to sign lets nobody in, "
                  "and lives") {
  draws = false;
  CHECK(!knock().in);
  REQUIRE(refusals().size() == 1);
  CHECK(refusals().front().detail == "no numbers left; 1 so far");
  draws = true;
  CHECK(enter(knock(), hello).welcome);
}

TEST_CASE_FIXTURE(
    acceptor_world,
    "a handshake that fails takes neither acceptor nor others along") {
  const auto other = knock();
  kill(knock().in);
  CHECK(!is_gone(acceptor));
  CHECK(enter(other, hello).welcome);
  CHECK(enter(knock(), hello).welcome);
}

TEST_CASE_FIXTURE(acceptor_world, "a handshake does not outlive the acceptor") {
  const auto at = knock();
  kill(acceptor);
  CHECK(is_gone(at.in));
}

TEST_CASE_FIXTURE(acceptor_world,
                  "who comes and goes is told, in this order, and "
                  "one who does so all the time not each time") {
  using coming = std::pair<std::set<station_id>, bool>;
  const auto first = enter_as("one", {101, 102});
  const auto second = enter_as("one", {102}); // takes its place
  CHECK(comings == std::vector<coming>{{{101, 102}, true}, {{102}, true}});
  kill(second.endpoint);
  CHECK(comings.back() == coming{{102}, false});
  for (int k = 0; k < 200; ++k)
    kill(enter_as("car " + std::to_string(k), {103}).endpoint);
  CHECK(comings.size() < 110);
}
