// One table for each computer: of vehicles, of providers, of services.
#include "base/options/option_printer.hpp"
#include "tests/scenario/example.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>

using namespace sofof;
using namespace sofof::channel;
using namespace sofof::scenario;
using namespace std::chrono_literals;

namespace {

/// Both providers of the example; the second one has a network of its own.
const std::string own_network =
    example::with("[network]", "network = { profile = \"paper_5g\" }\n"
                               "[network]");

provider_compute computers(const std::string& text, std::size_t place,
                           const std::vector<std::string>& set = {}) {
  return example::load(text, set).compute_of(place);
}

} // namespace

TEST_CASE("providers compute as was measured with their channel") {
  const auto first = computers(own_network, 0);
  CHECK(first.model == "paper_sim");
  CHECK(first.workers == 1);
  CHECK(first.mean_s() == compute_measured_with("paper_sim").mean_s());
  const auto second = computers(own_network, 1);
  CHECK(second.model == "paper_5g");
  CHECK(second.workers == 2);
  CHECK(second.mean_s() == compute_measured_with("paper_5g").mean_s());
}

TEST_CASE("[compute] is for all providers that have no table of their own") {
  const std::vector<std::string> set{"compute.workers=16",
                                     "compute.more_computing=4ms"};
  for (const std::size_t place : {0, 1}) {
    const auto c = computers(own_network, place, set);
    CHECK(c.workers == 16);
    CHECK(c.more_computing == 4ms);
  }
  CHECK(computers(own_network, 1, set).model == "paper_5g");
  CHECK(computers(own_network, 1, {"compute.model=spiky_5g"}).workers == 8);
}

TEST_CASE("a provider's own table stands in place of [compute]") {
  const std::vector<std::string> set{"compute.workers=16",
                                     "compute.more_computing=4ms",
                                     "provider.cloud.compute.workers=3"};
  const auto own = computers(example::text, 1, set);
  CHECK(own.workers == 3);
  CHECK(own.more_computing == 0ms);
  CHECK(own.model == "paper_sim");
  CHECK(computers(example::text, 0, set).workers == 16);
  const auto other =
      computers(example::text, 1, {"provider.cloud.compute.model=paper_5g"});
  CHECK(other.workers == 2);
  CHECK(other.mean_s() == doctest::Approx(0.003));
}

TEST_CASE("a model is the name of a channel profile") {
  const auto error = example::error_of(example::text, {"compute.model=fast"});
  CHECK(error.find("\"fast\" is no channel profile") != std::string::npos);
}

TEST_CASE("the effective configuration has the tables, and loads to itself") {
  const auto s = example::load(own_network, {"compute.workers=16"});
  const auto text = to_toml(s);
  for (const auto part :
       {"[compute]\nmodel = \"paper_sim\"\nworkers = 16\n"
        "more_computing = \"0s\"\n",
        "[provider.compute]\nmodel = \"paper_5g\"\nworkers = 16\n",
        "[fleet.compute]\nclock_ghz = 3.0\n",
        "[service.compute]\nrun_time_mean = \"5.5ms\"\n"}) {
    CAPTURE(part);
    CHECK(text.find(part) != text.npos);
  }
  CHECK(to_toml(example::load(text)) == text);
  CHECK(example::load(text).notes.empty());
}

TEST_CASE("printing a scenario changes nothing of it") {
  auto s = example::load(own_network, {"network.loss=0.25"});
  const auto channel = s.network.channel;
  print_options([&](option_visitor& visitor) { s.visit_options(visitor); });
  CHECK(s.network.channel == channel);
  CHECK(channel->loss == 0.25);
}

TEST_CASE("files of before say the same, with a note for each old place") {
  const auto before = example::load(
      example::text,
      {"network.workers=3", "network.more_computing=2ms",
       "provider.cloud.network={ profile = \"ideal\", workers = 5 }",
       "fleet.1.computer.clock_ghz=1.5", "service.0.demand=2.0",
       "service.0.run_time_mean=6ms", "service.0.run_time_sd=1ms",
       "service.0.run_time_max=40ms", "service.1.task.input_octets=40"});
  const auto now = example::load(
      example::text,
      {"compute.workers=3", "compute.more_computing=2ms",
       "provider.cloud.network.profile=ideal",
       "provider.cloud.compute.workers=5", "fleet.1.compute.clock_ghz=1.5",
       "service.0.compute.demand=2.0", "service.0.compute.run_time_mean=6ms",
       "service.0.compute.run_time_sd=1ms",
       "service.0.compute.run_time_max=40ms",
       "service.1.compute.input_octets=40"});
  CHECK(to_toml(before) == to_toml(now));
  CHECK(now.notes.empty());
  CHECK(before.notes.size() == 9);
  CHECK(std::ranges::count_if(before.notes,
                              [](const option_note& x) {
                                return x.text.starts_with(
                                    "run_time_max is compute.run_time_max now");
                              })
        == 1);
}

TEST_CASE("what two numbers said is refused, with what says it now") {
  const auto cycles =
      example::error_of(example::text, {"service.0.compute.gigacycles=0.03"});
  CHECK(cycles.find("gigacycles: is no more; run_time_mean says it, at 3 GHz")
        != cycles.npos);
  const auto kbit =
      example::error_of(example::text, {"service.0.compute.input_kbit=160"});
  CHECK(kbit.find("say input_octets, 125 to the kbit") != kbit.npos);
}

TEST_CASE("a busy worker takes the power that its provider says") {
  CHECK(computers(example::text, 0, {}).worker_w == doctest::Approx(2.76));
  const std::vector<std::string> set{"compute.worker_w=12"};
  CHECK(computers(example::text, 0, set).worker_w == 12);
}

TEST_CASE("a worker takes for being there what its provider says") {
  CHECK(computers(example::text, 0, {}).worker_idle_w == doctest::Approx(0.74));
  const std::vector<std::string> set{"compute.worker_idle_w=3"};
  CHECK(computers(example::text, 0, set).worker_idle_w == 3);
}

TEST_CASE("what [network] said of workers was not for other networks") {
  const std::vector<std::string> set{"network.workers=16",
                                     "compute.more_computing=4ms"};
  CHECK(computers(own_network, 0, set).workers == 16);
  const auto other = computers(own_network, 1, set);
  CHECK(other.workers == 2);
  CHECK(other.more_computing == 4ms);
}

TEST_CASE("what --set says of workers is for all, whatever [network] says") {
  const auto old =
      example::with("[network]", "[network]\nworkers = 16", own_network);
  const std::vector<std::string> set{"compute.workers=4"};
  CHECK(computers(old, 0, set).workers == 4);
  CHECK(computers(old, 1, set).workers == 4);
}

TEST_CASE("hyphens in names of channel profiles are read, with a note") {
  const auto before =
      example::load(example::text, {"network.profile=paper-sim-stalls",
                                    "compute.model=paper-5g"});
  const auto now =
      example::load(example::text, {"network.profile=paper_sim_stalls",
                                    "compute.model=paper_5g"});
  CHECK(before.network.channel->name == "paper_sim_stalls");
  CHECK(to_toml(before) == to_toml(now));
  CHECK(now.notes.empty());
  REQUIRE(before.notes.size() == 2);
  CHECK(before.notes[0].text.starts_with(
      "\"paper-sim-stalls\" is \"paper_sim_stalls\" now"));
  CHECK(before.notes[0].place == "--set network.profile=paper-sim-stalls");
  const auto error =
      example::error_of(example::text, {"network.profile=paper-6g"});
  CHECK(error.find("\"paper-6g\" is no channel profile") != error.npos);
}

TEST_CASE("an option at its old and at its new place is refused") {
  const auto text = example::with("[network]", "[compute]\nworkers = 2\n"
                                               "[network]\nworkers = 3");
  const auto error = example::error_of(text);
  CHECK(error.find("example.toml:37:11: network.workers") != error.npos);
  CHECK(error.find("compute.workers") != error.npos);
}
