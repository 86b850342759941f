// Providers and vehicles that find each other by a registry of services.
#include "tests/processes/hosts.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/mock_registry.hpp"

#include <optional>

using namespace sofof::test;

namespace {

words listed_by(const mock_registry& at) {
  return {"--register", at.root()};
}

/// Vehicles that know their provider by a registry alone.
drive_process look_for(const workplace& at, const std::string& root,
                       const words& more) {
  return {at, "drive",
          words{"drive", scenario_file, "--quiet", "--out", "drive",
                "--discover", root}
              + more};
}

/// Waits until that is what the registry says of its only provider.
bool wait_for_state(const mock_registry& at, const std::string& state) {
  return wait_until([&] {
    const auto all = at.services();
    return all.size() == 1 && all.front()["state"] == state;
  });
}

int port_in(const mock_registry& at) {
  return at.services()
      .front()["transportInfo"]["endpoint"]["addresses"][0]["port"];
}

} // namespace

TEST_CASE("vehicles find a provider by a registry, and follow it to another "
          "port") {
  const workplace at;
  const mock_registry registry;
  const auto settings = patient(3);
  std::optional<provider_process> provider{std::in_place, at, "first",
                                           settings + listed_by(registry)};
  const auto first = provider->port();
  auto drive = look_for(at, registry.root(), settings);
  REQUIRE(wait_for_offloaded(drive, 3));
  CHECK(port_in(registry) == first);
  CHECK(registry.times("confirm_ready 204") == 1);

  const auto end = stop(provider->run());
  CAPTURE(end.err);
  CHECK(end.code == 0);
  CHECK(wait_for_state(registry, "INACTIVE"));
  CHECK(contains(end.out, "provider mec is no longer ACTIVE"));
  REQUIRE(wait_until([&] { return offloaded(drive.out()) == 0; }));

  provider.emplace(at, "second", settings + listed_by(registry));
  CHECK(provider->port() != first);
  REQUIRE(wait_for_offloaded(drive, 3));
  CHECK(port_in(registry) == provider->port());
  const auto left = stop(drive.run());
  CHECK(left.code == 130);
  CHECK(contains(left.out, "connected to provider mec at 127.0.0.1:"
                               + std::to_string(provider->port())));
  CHECK(stop(provider->run()).code == 0);
  CHECK(events_of(drive.out(), "provider_connected").size() == 2);
  CHECK(events_of(drive.out(), "registry_answered").size() >= 2);
  CHECK(events_of(provider->out(), "registry_answered").size() >= 1);
  check_safe(summary_of(drive.out()));
}

TEST_CASE("an entry that is withdrawn ends no session") {
  const workplace at;
  mock_registry registry;
  const auto settings = patient(2);
  provider_process provider{at, "provider", settings};
  (void)registry.list(service_of("mec", provider.port()));
  auto drive = look_for(at, registry.root(), settings);
  REQUIRE(wait_for_offloaded(drive, 2));
  registry.forget();
  const auto is_told = [&] {
    for (const auto& e : events_of(drive.out(), "registry_answered"))
      if (contains(e["detail"].get<std::string>(), "no provider of the"))
        return true;
    return false;
  };
  REQUIRE(wait_until(is_told));
  pass(0.5);
  CHECK(offloaded(drive.out()) == 2);
  CHECK(events_of(drive.out(), "provider_lost").empty());
  // But once it is lost nobody goes there again.
  CHECK(stop(provider.run()).code == 0);
  provider_process again{at, "again", settings, provider.port()};
  pass(1.5);
  CHECK(events_of(again.out(), "peer_connected").empty());
  CHECK(stop(drive.run()).code == 130);
  CHECK(stop(again.run()).code == 0);
  check_safe(summary_of(drive.out()));
}

TEST_CASE("a registry that is down, lies or comes late delays nobody") {
  const workplace at;
  std::optional<mock_registry> registry{std::in_place};
  const auto port = registry->address().port;
  const auto root = registry->root();
  registry.reset();
  const auto settings = patient(2);
  provider_process provider{at, "provider",
                            settings + words{"--register", root}};
  auto drive = look_for(at, root, settings);
  REQUIRE(wait_until([&] {
    return events_of(drive.out(), "registry_failed").size() == 1
           && events_of(provider.out(), "registry_failed").size() == 1;
  }));
  registry.emplace(port); // and knows nobody
  REQUIRE(wait_for_offloaded(drive, 2));
  for (const auto mood : {registry_mood::garbage, registry_mood::huge,
                          registry_mood::crowded, registry_mood::silent}) {
    registry->be(mood);
    pass(1);
  }
  CHECK(offloaded(drive.out()) == 2);
  const auto stopped = monotonic::now();
  CHECK(stop(provider.run()).code == 0);
  CHECK(seconds(monotonic::now() - stopped) < 8);
  CHECK(stop(drive.run()).code == 130);
  check_safe(summary_of(drive.out()));
  CHECK(events_of(drive.out(), "provider_lost").size() == 1);
}

TEST_CASE("with keys the provider has to prove that it is the one listed") {
  const workplace at;
  do_keys(at, {"init", "keys"});
  do_keys(at, {"issue", "keys", "--provider", "mec"});
  do_keys(at, {"issue", "keys", "--station", "101-102"});
  mock_registry registry;
  const auto settings = patient(2);
  const words of_cars{"--keys", "keys/station-101-102"};
  provider_process provider{at, "provider",
                            settings + listed_by(registry)
                                + words{"--keys", "keys/provider-mec"}};
  REQUIRE(wait_for_state(registry, "ACTIVE"));
  CHECK(registry.services().front()["transportInfo"]["implSpecificInfo"]["tls"]
        == true);
  auto drive = look_for(at, registry.root(), settings + of_cars);
  REQUIRE(wait_for_offloaded(drive, 2));
  CHECK(stop(drive.run()).code == 130);
  CHECK(stop(provider.run()).code == 0);
  check_safe(summary_of(drive.out()));
}

TEST_CASE("what cannot be registered or discovered is refused in a sentence") {
  const workplace at;
  const auto why = [&](const words& all) {
    const auto end = at.run_sofof(all);
    CHECK(end.code == 2);
    return end.err;
  };
  const words provide{"provide", scenario_file, "--listen", "127.0.0.1:0"};
  CHECK(
      contains(why(provide + words{"--register", "https://mep"}), "wants TLS"));
  CHECK(contains(why(provide + words{"--register", "mep"}), "no URL"));
  CHECK(contains(
      why(provide + words{"--register", "http://mep", "--app-instance", "a/b"}),
      "--app-instance"));
  CHECK(contains(
      why(provide
          + words{"--register", "http://mep", "--advertise", "0.0.0.0"}),
      "--advertise"));
  CHECK(
      contains(why(provide + words{"--advertise", "10.0.0.5"}), "--register"));
  CHECK(contains(why({"drive", scenario_file}), "--discover"));
  CHECK(contains(why({"drive", scenario_file, "--discover", "http://mep?x"}),
                 "no URL"));
}
