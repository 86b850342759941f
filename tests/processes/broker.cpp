// Providers and vehicles in processes of their own, with a broker between them.
#include "tests/processes/hosts.hpp"
#include "tests/support/contains.hpp"

#include <string>

namespace sofof::test::with_a_broker {

/// `sofof broker`, at a port of its own.
class broker_process {
public:
  broker_process(const workplace& at, const words& more, std::uint16_t port = 0)
      : run_{words{"broker", "--listen", "127.0.0.1:" + std::to_string(port)}
                 + more,
             at.here()} {
    static constexpr std::string_view before = "listens on 127.0.0.1:";
    REQUIRE(wait_until([this] {
      return !run_.runs() || contains(run_.printed(), std::string{before});
    }));
    const auto text = run_.printed();
    const auto found = text.find(before);
    if (found == text.npos)
      FAIL("no broker: ", run_.wait().err);
    port_ = static_cast<std::uint16_t>(
        std::stoi(text.substr(found + before.size())));
  }

  std::uint16_t port() const { return port_; }
  program& run() { return run_; }
  std::string url(const std::string& scheme = "amqp") const {
    return scheme + "://127.0.0.1:" + std::to_string(port_);
  }

private:
  std::uint16_t port_ = 0;
  program run_;
};

/// @returns whether there is something to test; says so if not.
bool has_amqp(const workplace& at) {
  const auto end =
      at.run_sofof({"broker", "--listen", "127.0.0.1:1", "--keys", "missing"});
  if (contains(end.err, "without AMQP"))
    MESSAGE("skipped: this program was built without Qpid Proton");
  return !contains(end.err, "without AMQP");
}

/// A process with a broker instead of an address.
program begin(const workplace& at, const std::string& command,
              const std::string& out, const std::string& url,
              const words& more) {
  return program{
      words{command, scenario_file, "--quiet", "--out", out, "--broker", url}
          + more,
      at.here()};
}

TEST_CASE("vehicles and their provider meet at a broker, and again at the next "
          "one") {
  const workplace at;
  if (!has_amqp(at))
    return;
  std::optional<broker_process> broker{std::in_place, at, words{}};
  const auto port = broker->port();
  const auto settings = patient(3);
  auto provider = begin(at, "provide", "mec", broker->url(), settings);
  auto cars = begin(at, "drive", "cars", broker->url(),
                    settings + words{"--duration", "14s"});
  REQUIRE(wait_until(
      [&] { return contains(cars.printed(), "connected to provider mec"); }));
  pass(3);
  broker->run().send(SIGKILL);
  broker->run().wait();
  broker.reset();
  pass(1);
  broker.emplace(at, words{}, port);
  const auto end = cars.wait();
  CAPTURE(end.err);
  CHECK(end.code == 0);
  const auto summary = summary_of(at / "cars");
  check_safe(summary);
  check_one_source(at / "cars");
  CHECK(summary["episodes"] == 6);
  CHECK(summary["ended_by"]["peer_lost"] == 3);
  CHECK(summary["ended_by"]["shutdown"] == 3);
  CHECK(stop(provider).code == 0);
  CHECK(events_of(at / "mec", "peer_connected").size() == 2);
}

TEST_CASE("with keys a broker lets in whom it knows, and no other provider is "
          "believed") {
  const workplace at;
  if (!has_amqp(at))
    return;
  do_keys(at, {"init", "keys"});
  do_keys(at, {"issue", "keys", "--provider", "broker"});
  do_keys(at, {"issue", "keys", "--provider", "mec"});
  do_keys(at, {"issue", "keys", "--station", "101-103"});
  do_keys(at, {"init", "others"});
  do_keys(at, {"issue", "others", "--station", "101-103"});
  broker_process broker{at, {"--keys", "keys/provider-broker"}};
  const auto url = broker.url("amqps");
  const auto settings = patient(3);
  auto provider = begin(at, "provide", "mec", url,
                        settings + words{"--keys", "keys/provider-mec"});
  auto cars = begin(
      at, "drive", "cars", url,
      settings + words{"--keys", "keys/station-101-103", "--duration", "5s"});
  auto strangers = begin(
      at, "drive", "strangers", url,
      settings + words{"--keys", "others/station-101-103", "--duration", "3s"});
  const auto end = cars.wait();
  CAPTURE(end.err);
  CHECK(end.code == 0);
  check_safe(summary_of(at / "cars"));
  CHECK(summary_of(at / "cars")["episodes"] == 3);
  CHECK(strangers.wait().code == 0);
  check_safe(summary_of(at / "strangers"));
  CHECK(summary_of(at / "strangers")["episodes"] == 0);
  CHECK(stop(provider).code == 0);
  CHECK(stop(broker.run()).code == 0);
}

TEST_CASE("one command runs broker, provider and cars, and ends them all") {
  const workplace at;
  if (!has_amqp(at))
    return;
  const auto end = at.run_sofof(words{"sil", scenario_file, "--quiet", "--out",
                                      "loop", "--duration", "4s"}
                                + patient(3));
  CAPTURE(end.out);
  CAPTURE(end.err);
  CHECK(end.code == 0);
  const auto summary = summary_of(at / "loop/cars");
  check_safe(summary);
  CHECK(summary["episodes"] == 3);
  CHECK(summary_of(at / "loop/provider_mec").contains("wall_s"));
  CHECK(contains(read_file(at / "loop/broker.log"), "listens on"));
  const auto again = at.run_sofof({"sil", scenario_file, "--out", "loop"});
  CHECK(again.code == 2);
  CHECK(contains(again.err, "loop"));

  const auto convoy = at.run_sofof({"sil", "config/convoy.toml"});
  CHECK(convoy.code == 2);
  CHECK(contains(convoy.err, "ride with vehicles"));

  // What it measured is a channel for other runs.
  CHECK(at.run_sofof({"convert", "loop/cars", "-o", "own.latencies.csv"}).code
        == 0);
  at.drive("replayed", {"--duration", "3s", "--set", "network.profile=trace",
                        "--set", "network.trace=../own.latencies.csv"});
}

TEST_CASE("what a broker's URL and the keys lack is said before anything "
          "begins") {
  const workplace at;
  const auto complaint = [&](const words& all) {
    const auto end =
        at.run_sofof(words{"drive", scenario_file, "--duration", "1s"} + all);
    CHECK(end.code == 2);
    return end.err;
  };
  CHECK(contains(complaint({"--broker", "http://127.0.0.1"}),
                 "no URL of a broker, like amqp://127.0.0.1"));
  CHECK(contains(complaint({"--broker", "amqp://10.0.0.1"}),
                 "--broker 10.0.0.1:5672 is not 127.0.0.1"));
  CHECK(contains(complaint({"--broker", "amqps://127.0.0.1"}),
                 "name the folder of the own certificate with --keys"));
  CHECK(contains(complaint({"--broker", "amqp://me:word@127.0.0.1"}),
                 "a password is sent over amqps:// only"));
  CHECK(contains(complaint({"--set", "network.transport=amqp"}),
                 "name the broker with --broker"));
  CHECK(contains(complaint({}), "nobody is named who plans"));
  CHECK(
      contains(complaint({"--broker", "amqp://127.0.0.1", "--c-roads", "Ulm"}),
               "two letters of a country and digits, like DE12345"));
  CHECK(contains(complaint({"--broker", "amqp://127.0.0.1", "--provider",
                            "127.0.0.1:4711"}),
                 "leave --provider and --discover away"));
}

} // namespace sofof::test::with_a_broker
