// What operators ask processes by HTTP while these run.
#include "network/http/client.hpp"
#include "tests/processes/hosts.hpp"
#include "tests/support/contains.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <sstream>
#include <string>

using namespace sofof;
using namespace sofof::test;

namespace {

const words with_metrics{"--metrics", "127.0.0.1:0"};

/// @returns the address of a process that has said it.
std::string address_in(const program& of) {
  static constexpr std::string_view before = "figures at ";
  REQUIRE(wait_until([&of] { return contains(of.printed(), "/metrics"); }));
  const auto text = of.printed();
  const auto at = text.find(before) + before.size();
  return text.substr(at, text.find("/metrics", at) - at);
}

network::http::response page_of(const std::string& url) {
  const auto where = network::http::parse_url(url);
  REQUIRE(where);
  return network::http::get(*where, std::chrono::seconds{10});
}

/// @returns the sum of the samples that begin so.
double sum_of(const std::string& page, std::string_view name) {
  double sum = 0;
  std::istringstream lines{page};
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(name))
      sum += std::stod(line.substr(line.rfind(' ') + 1));
  return sum;
}

} // namespace

TEST_CASE("provider and cars tell how they get on, while they do") {
  const workplace at;
  provider_process provider{at, "provider", patient(3) + with_metrics};
  const auto server = address_in(provider.run());
  program cars{drive_words("cars", provider.port(), patient(3) + with_metrics),
               at.here()};
  const auto car = address_in(cars);
  CHECK(at.run_sofof({"health", server}).out == "ready\n");
  CHECK(at.run_sofof({"health", car}).code == 0);
  const auto planning = std::string{"{service=\"trajectory_planning\""};
  CHECK(wait_until([&] {
    const auto of_car = page_of(car + "/metrics").body;
    return sum_of(of_car,
                  "sofof_results_total" + planning + ",outcome=\"used\"}")
               > 30
           && sum_of(of_car, "sofof_sessions" + planning) == 3
           && sum_of(page_of(server + "/metrics").body,
                     "sofof_sessions" + planning)
                  == 3;
  }));
  const auto cars_say = page_of(car + "/metrics");
  CHECK(cars_say.type == "text/plain; version=0.0.4; charset=utf-8");
  CHECK(sum_of(cars_say.body, "sofof_vehicles ") == 3);
  CHECK(sum_of(cars_say.body, "sofof_providers_connected ") == 1);
  CHECK(sum_of(cars_say.body, "sofof_without_fresh_plan_seconds_total ") == 0);
  CHECK(sum_of(cars_say.body, "sofof_messages_sent_total{type=\"cam\"}") > 3);
  const auto provider_says = page_of(server + "/metrics").body;
  CHECK(contains(provider_says, "role=\"provide\""));
  CHECK(sum_of(provider_says, "sofof_peers ") == 1);
  CHECK(sum_of(provider_says, "sofof_sessions{service=\"trajectory_planning\"}")
        == 3);
  CHECK(sum_of(provider_says, "sofof_computing_seconds_total{") > 0);
  CHECK(sum_of(provider_says, "sofof_utilisation_ratio{") > 0);
  CHECK(page_of(server + "/").status == 200);
  CHECK(page_of(server + "/none").status == 404);

  provider.run().send(SIGTERM);
  CHECK(provider.run().wait().code == 0);
  CHECK(at.run_sofof({"health", server}).code == 1);
  REQUIRE(wait_until([&] {
    return sum_of(page_of(car + "/metrics").body, "sofof_providers_connected ")
           == 0;
  }));
  const auto alone = page_of(car + "/metrics").body;
  CHECK(sum_of(alone, "sofof_episodes_ended_total{") >= 3);
  cars.send(SIGINT);
  CHECK(cars.wait().code == 130);
}

TEST_CASE("a run on the wall clock has figures, one in virtual time has none") {
  const workplace at;
  program run{words{"run", scenario_file, "--realtime", "--quiet"}
                  + with_metrics,
              at.here()};
  const auto page = page_of(address_in(run) + "/metrics").body;
  CHECK(sum_of(page, "sofof_vehicles ") == 6);
  CHECK(sum_of(page, "sofof_workers{provider=\"mec\"}") > 0);
  run.send(SIGINT);
  CHECK(run.wait().code == 130);
  const auto refused = at.run_sofof(words{"run", scenario_file} + with_metrics);
  CHECK(refused.code == 2);
  CHECK(contains(refused.err, "add --realtime"));
}

TEST_CASE("a sweep tells how far it is, and how its runs ended") {
  const workplace at;
  at.write("sweep.toml", "name = \"s\"\nscenario = \"config/ulm_lehr.toml\"\n"
                         "seeds = 3\n[[axis]]\nname = \"lasts\"\n"
                         "key = \"duration\"\n"
                         "values = [\"1s\", \"20000s\"]\n");
  program sweep{
      words{"sweep", "sweep.toml", "-j", "2", "--quiet", "--out", "all"}
          + with_metrics,
      at.here()};
  const auto url = address_in(sweep) + "/metrics";
  CHECK(wait_until([&] { // the long ones come first
    return sum_of(page_of(url).body, "sofof_sweep_points ") == 6;
  }));
  CHECK(sum_of(page_of(url).body, "sofof_sweep_points_done_total{") == 0);
  sweep.send(SIGINT);
  CHECK(sweep.wait().code == 130);
}

TEST_CASE("the log of a process may be JSON, an object a line") {
  const workplace at;
  program run{{"provide", scenario_file, "--listen", "127.0.0.1:0",
               "--duration", "500ms", "--log", "json"},
              at.here()};
  const auto end = run.wait();
  CHECK(end.code == 0);
  std::istringstream lines{end.out};
  std::string line;
  REQUIRE(std::getline(lines, line));
  const auto x = nlohmann::json::parse(line);
  CHECK(x.at("role") == "provide");
  CHECK(contains(x.at("message").get<std::string>(), "listens on 127.0.0.1:"));
  CHECK(x.at("time").get<std::string>().ends_with("Z"));
  while (std::getline(lines, line))
    CHECK(nlohmann::json::accept(line));
}

TEST_CASE("health says what is wrong with its address, or who is not there") {
  const workplace at;
  const auto wrong = at.run_sofof({"health", "127.0.0.1:9464"});
  CHECK(wrong.code == 2);
  CHECK(contains(wrong.err, "no URL that begins with http://"));
  const auto nobody = at.run_sofof({"health", "http://127.0.0.1:1"});
  CHECK(nobody.code == 1);
  CHECK(contains(nobody.out, "127.0.0.1:1 does not answer"));
}
