// Tests of the connection to a provider: when it is made, and with whom.
#include "base/protocol.hpp"
#include "tests/actors/provider_connection_world.hpp"

#include <limits>
#include <utility>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::test;

TEST_CASE_FIXTURE(provider_connection_world,
                  "vehicles say which provider they mean, who they are and "
                  "on which map, and prove it") {
  start();
  REQUIRE(host->hellos.size() == 1);
  CHECK(host->hellos[0].provider == "server");
  CHECK(host->hellos[0].stations
        == std::vector<station_id>{station, neighbour});
  CHECK(host->hellos[0].world == 5);
  CHECK(host->hellos[0].certificate == "proof of a number");
  CHECK(news
        == std::vector<std::string>{
            "connected to provider server at 10.0.0.5:4711"});
  CHECK(notes("provider_connected") == 1);
  CHECK(refusals.empty());
  CHECK(provider->count<ping>() == 1);
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "who is refused before the first connection "
                  "is told why") {
  const std::string begin = "provider server at 10.0.0.5:4711 refuses: ";
  std::string why;
  SUBCASE("for its version") {
    host->protocol = remote_protocol + 1;
    why = "it speaks " + spoken(host->protocol, host->types) + ", this program "
          + spoken(remote_protocol, host->types)
          + "; install the same version on both sides";
  }
  SUBCASE("for its types") {
    const auto ours = host->types++;
    why = "it speaks " + spoken(remote_protocol, host->types)
          + ", this program " + spoken(remote_protocol, ours)
          + "; install the same version on both sides";
  }
  SUBCASE("for what the handshake says") {
    host->refusal = "101 is another's station";
    why = *host->refusal;
  }
  SUBCASE("as the provider's time makes no sense") {
    host->welcome.epoch_unix_ms = std::numeric_limits<std::int64_t>::max();
    why = "its clock shows no time of day";
  }
  start();
  REQUIRE(refusals.size() == 1);
  CHECK(refusals.front() == begin + why);
  CHECK(news.empty());
  say_cam();
  run_for(100ms);
  CHECK(provider->entries().empty());
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "who has driven for a while takes a refusal as "
                  "news") {
  reachable = false;
  start();
  run_for(10s);
  news.clear();
  reachable = true;
  host->refusal = "you are too many";
  run_for(5s);
  CHECK(refusals.empty());
  REQUIRE(news.size() == 1);
  CHECK(news.back()
        == "provider server at 10.0.0.5:4711 refuses: you are too many");
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "who was connected once takes a refusal as "
                  "news, once") {
  connect();
  news.clear();
  kill(provider.handle);
  host->refusal = "you are too many";
  run_for(10s);
  CHECK(refusals.empty());
  REQUIRE(news.size() == 2);
  CHECK(news.front()
        == "lost provider server at 10.0.0.5:4711: the connection is gone; "
           "vehicles plan for themselves");
  CHECK(news.back()
        == "provider server at 10.0.0.5:4711 refuses: you are too many");
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "who finds nobody, or no room, or no end to "
                  "talk to, tries again") {
  std::string why;
  SUBCASE("nobody") {
    reachable = false;
    why = "nobody is there";
  }
  SUBCASE("no room") {
    host->full = true;
    why = "it lets nobody in now";
  }
  SUBCASE("no end") {
    host->endpoint = nullptr;
    why = "it has no end of its own";
  }
  start();
  run_for(10s);
  CHECK(refusals.empty());
  CHECK(news
        == std::vector<std::string>{
            "no connection to provider server at 10.0.0.5:4711: " + why
            + "; trying again"});
  reachable = true;
  host->full = false;
  host->endpoint = provider.handle;
  run_for(1050ms);
  CHECK(notes("provider_connected") == 1);
  CHECK(news.back() == "connected to provider server at 10.0.0.5:4711");
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "an acceptor that does not answer is asked one "
                  "thing at a time, for two seconds") {
  host->answers = false;
  start();
  run_for(1950ms);
  CHECK(host->knocks == 1);
  run_for(10s);
  CHECK(host->knocks >= 4);
  CHECK(host->knocks <= 6);
  CHECK(refusals.empty());
  CHECK(news
        == std::vector<std::string>{
            "no connection to provider server at 10.0.0.5:4711: it does not "
            "answer; trying again"});
  host->answers = true;
  const auto end = now() + protocol::handshake_timeout + 1050ms;
  while (notes("provider_connected") == 0 && now() < end)
    run_for(protocol::ping_period);
  CHECK(notes("provider_connected") == 1);
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "pauses between attempts grow to a second at most") {
  reachable = false;
  start();
  run_for(30s);
  REQUIRE(attempts.size() > 30);
  CHECK(attempts.front() == time_point{10s});
  CHECK(attempts[1] - attempts[0] <= 150ms);
  for (std::size_t k = 1; k < attempts.size(); ++k)
    CHECK(attempts[k] - attempts[k - 1] <= 1s + protocol::ping_period);
  CHECK(attempts.back() - attempts[attempts.size() - 2] >= 500ms);
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "a provider that takes everybody in and hangs "
                  "up is not asked without end") {
  start();
  for (int k = 0; k < 200; ++k) { // 10 s
    kill(provider.handle);
    provider = listen<provider_endpoint_actor>();
    host->endpoint = provider.handle;
    run_for(50ms);
  }
  CHECK(attempts.size() < 25);
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "while an attempt takes its time there is no "
                  "other, and the next begins when it fails") {
  takes_time = true;
  reachable = false;
  start();
  run_for(1s);
  for (std::size_t k = 1; k <= 10; ++k) {
    CHECK(attempts.size() == k);
    finish();
    run_for(protocol::ping_period);
    CHECK(attempts.size() == k + 1);
    run_for(1s); // longer than any pause
  }
  reachable = true;
  finish();
  CHECK(notes("provider_connected") == 1);
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "an attempt that hangs is not waited for "
                  "without end, and counts if it gets through") {
  takes_time = true;
  start();
  run_for(10s);
  CHECK(attempts.size() >= 4);
  finish();
  CHECK(notes("provider_connected") == 1);
  CHECK(host->hellos.size() == 1);
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "when the connection is lost during the "
                  "introduction, that begins anew at once") {
  host->answers = false;
  start();
  REQUIRE(host->knocks == 1);
  kill(std::exchange(acceptor, own(system().spawn(played_acceptor, host))));
  host->answers = true;
  run_for(150ms); // the second pause, and until it is noticed
  CHECK(notes("provider_connected") == 1);
  CHECK(host->hellos.size() == 1);
  SUBCASE("and an answer from before does not matter") {
    host->unanswered.front().deliver(host->protocol + 1, host->types,
                                     host->nonce, caf::strong_actor_ptr{});
  }
  SUBCASE("nor does it that there is none") {
    host->unanswered.clear();
  }
  live(3s);
  CHECK(notes("provider_connected") == 1);
  CHECK(refusals.empty());
  CHECK(news.size() == 2);
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "of several attempts the first that gets "
                  "through counts") {
  start();
  REQUIRE(host->hellos.size() == 1);
  live(3s);
  CHECK(attempts.size() == 1);
  CHECK(host->hellos.size() == 1);
}
