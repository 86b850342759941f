// What vehicles make of a registry, whatever it says.
#include "messages/protocol/remote.hpp"
#include "network/mec/directory.hpp"
#include "network/mec/repeating_thread.hpp"
#include "tests/network/loopback.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/mock_registry.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace sofof::test::provider_directories {

using namespace network;
using namespace network::mec011;
using nlohmann::json;

namespace {

/// Vehicles of a scenario with providers "mec" and "east", on this machine.
struct vehicles {
  std::vector<registry_news> news;
  directory providers;

  explicit vehicles(registry at, bool is_secured = false)
      : providers{std::move(at),
                  {{"mec", "east"},
                   std::to_string(messages::remote_protocol),
                   is_secured},
                  random_stream{2, "test"},
                  [this](const auto& x) { news.push_back(x); }} {}
  explicit vehicles(const mock_registry& at, bool is_secured = false)
      : vehicles{registry{parse_root(at.root())}, is_secured} {}

  /// @returns the ports of the next attempts; 0: there is nothing to try.
  std::vector<int> next(const std::string& provider, int attempts = 1) {
    std::vector<int> all;
    for (int i = 0; i < attempts; ++i) {
      const auto at = providers.next(provider).at;
      all.push_back(at ? at->port : 0);
    }
    return all;
  }
  std::string last() const { return news.empty() ? "" : news.back().sentence; }
};

/// A registry somewhere else that says always the same.
registry far_registry(const json& list) {
  return registry{parse_root("http://10.0.0.9:8080/mep"),
                  [text = list.dump()](const auto&, const auto&) {
                    return http::response{200, "application/json", text};
                  }};
}

json at_host(json service, const std::string& host) {
  service["serInstanceId"] = "a";
  service["transportInfo"]["endpoint"]["addresses"][0]["host"] = host;
  service["transportInfo"]["implSpecificInfo"]["tls"] = true;
  return service;
}

} // namespace

TEST_CASE("vehicles go where the registry lists a provider as ACTIVE") {
  mock_registry at;
  vehicles cars{at};
  CHECK(cars.next("mec") == std::vector{0});
  CHECK(cars.providers.place_of("mec") == "an address of " + at.root());
  (void)at.list(service_of("mec", 4711));
  auto inactive = service_of("east", 4712);
  inactive["state"] = "INACTIVE";
  (void)at.list(inactive);
  (void)at.list(service_of("elsewhere", 4713));
  const auto pause = cars.providers.step();
  CHECK(pause.at_most <= 5s);
  CHECK(pause.at_most >= 4s);
  CHECK(pause.at_least == 500ms);
  CHECK(cars.next("mec") == std::vector{4711});
  CHECK(cars.next("east") == std::vector{0});
  CHECK(cars.next("elsewhere") == std::vector{0});
  CHECK(cars.providers.place_of("mec") == "127.0.0.1:4711");
  CHECK(cars.last()
        == "the registry " + at.root()
               + " lists provider mec at 127.0.0.1:4711");
  cars.providers.step();
  CHECK(cars.news.size() == 1);
}

TEST_CASE("an entry that is withdrawn leads nowhere, one that moves is "
          "followed") {
  mock_registry at;
  vehicles cars{at};
  (void)at.list(service_of("mec", 4711));
  cars.providers.step();
  at.forget();
  (void)at.list(service_of("mec", 4712));
  cars.providers.step();
  CHECK(cars.next("mec") == std::vector{4712});
  at.forget();
  cars.providers.step();
  CHECK(cars.next("mec") == std::vector{0});
  CHECK(contains(cars.last(), "lists no provider of the scenario"));
}

TEST_CASE("all addresses of a provider have their turn, eight at most") {
  mock_registry at;
  vehicles cars{at};
  for (std::uint16_t port = 1; port <= 12; ++port)
    (void)at.list(service_of("mec", port % 10 + 1));
  cars.providers.step();
  auto tried = cars.next("mec", 16);
  CHECK(std::equal(tried.begin(), tried.begin() + 8, tried.begin() + 8));
  std::ranges::sort(tried);
  tried.erase(std::ranges::unique(tried).begin(), tried.end());
  CHECK(tried.size() == 8);
  CHECK(contains(cars.last(), "more than 8 addresses"));
}

TEST_CASE("whatever a registry answers, what it said before counts") {
  using enum registry_mood;
  const std::vector<std::pair<registry_mood, std::string>> all = {
      {garbage, "it is no JSON"},
      {huge, "body limit exceeded"},
      {crowded, "10000 services, more than 256"},
      {redirects, "status 302"},
      {broken, "status 500: no disk?[2J"},
      {silent, "has not answered within 1000 ms"}};
  mock_registry at;
  vehicles cars{at};
  (void)at.list(service_of("mec", 4711));
  cars.providers.step();
  for (const auto& [mood, why] : all) {
    at.be(mood);
    const auto pause = cars.providers.step();
    CHECK(pause.at_least == pause.at_most);
    CHECK(pause.at_most <= 5s);
    CAPTURE(cars.last());
    CHECK(contains(cars.last(), why));
    CHECK(!cars.news.back().is_well);
    CHECK(cars.next("mec") == std::vector{4711});
  }
  at.be(well);
  cars.providers.step();
  CHECK(cars.news.back().is_well);
}

TEST_CASE("a registry that is down is asked at least every 5 s, and told of "
          "once") {
  std::optional<mock_registry> at{std::in_place};
  vehicles cars{*at};
  at.reset();
  duration longest{};
  for (int i = 0; i < 10; ++i)
    longest = std::max(longest, cars.providers.step().at_most);
  CHECK(longest > 2500ms);
  CHECK(longest <= 5s);
  CHECK(cars.news.size() == 1);
  CHECK(contains(cars.last(), "tells nothing"));
}

TEST_CASE("entries that cannot be meant are left out, and why is said") {
  const auto why = [](const json& entry, bool is_secured) {
    vehicles cars{far_registry(json::array({entry})), is_secured};
    cars.providers.step();
    const auto found = cars.next("mec") != std::vector{0};
    return found ? "" : cars.last();
  };
  const auto good = at_host(service_of("mec", 4711), "10.0.0.5");
  CHECK(why(good, true) == "");
  auto plain = good;
  plain["transportInfo"]["implSpecificInfo"]["tls"] = false;
  CHECK(contains(why(good, false), "it has --keys, and we have none"));
  CHECK(contains(why(plain, true), "it has no --keys, and we have"));
  CHECK(contains(why(plain, false), "10.0.0.5:4711 is another machine"));
  auto older = good;
  older["version"] = "9";
  CHECK(contains(why(older, true), "speaks version 9 of the protocol, not "));
  for (const auto* here : {"127.0.0.1", "127.1.2.3", "localhost", "::1"})
    CHECK(contains(why(at_host(good, here), true), "is this machine"));
  auto broken = good;
  broken.erase("state");
  CHECK(contains(why(broken, true), "left out: state is missing"));
}

TEST_CASE("a registry is asked in a hurry from a loss on, but not for ever") {
  mock_registry at;
  (void)at.list(service_of("mec", 4711));
  vehicles cars{at};
  const auto urgent_ones = [&](int steps) {
    int urgent = 0;
    for (int i = 0; i < steps; ++i) {
      cars.providers.step();
      (void)cars.providers.next("east"); // never there
      urgent += cars.providers.next("mec").is_urgent ? 1 : 0;
    }
    return urgent;
  };
  const auto in_all = urgent_ones(20);
  CHECK(in_all >= 5);
  CHECK(in_all <= 7);
  CHECK(urgent_ones(20) == 0);
  for (int i = 0; i < 3; ++i) // there is a connection
    cars.providers.step();
  CHECK(urgent_ones(20) == 6);
  at.forget(); // news
  (void)at.list(service_of("mec", 4712));
  CHECK(urgent_ones(20) == 6);
}

TEST_CASE("vehicles wait for the first answer, and no longer than they like") {
  mock_registry at;
  (void)at.list(service_of("mec", 4711));
  vehicles cars{at};
  cars.providers.await_first(1ms);
  CHECK(cars.next("mec") == std::vector{0});
  {
    const repeating_thread asking{[&] { return cars.providers.step(); }};
    cars.providers.await_first(patience);
  }
  CHECK(cars.next("mec") == std::vector{4711});
}

TEST_CASE("what is repeated waits its pause, unless somebody is in a hurry") {
  std::atomic<int> steps = 0;
  std::atomic<bool> has_ended = false;
  {
    repeating_thread x{[&] {
                         ++steps;
                         return pause_between{1h, 1ms};
                       },
                       [&] { has_ended = true; }};
    CHECK(wait_until([&] { return steps == 1; }));
    std::this_thread::sleep_for(20ms);
    CHECK(steps == 1);
    x.hurry();
    CHECK(wait_until([&] { return steps == 2; }));
    CHECK(!has_ended);
    x.end();
    CHECK(wait_until([&] { return has_ended.load(); }));
  }
  CHECK(steps == 2);
}

} // namespace sofof::test::provider_directories
