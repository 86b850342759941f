// What of the load stands in the summary, and who is warned of.
#include "recording/load_table.hpp"

#include "channel/shared_server_queue.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <string>

using namespace sofof;
using namespace sofof::recording;
using namespace std::chrono_literals;

namespace {

/// One server that is asked for `work` every 100 ms for 10 s.
channel::load_figures asked_for(duration work) {
  const auto meter = std::make_shared<channel::load_meter>(1U, time_point{});
  channel::shared_server_queue queue{1, meter};
  for (int k = 0; k < 100; ++k)
    queue.finish(time_point{k * 100ms}, work);
  return meter->read();
}

} // namespace

TEST_CASE(
    "an uplink of 50 kB frames at 10 Hz on 1 Mbit/s is asked for 400 % of "
    "what it carries, and is busy all the time") {
  const auto sum = summary_of(asked_for(400ms), 10s);
  CHECK(sum.jobs == 100);
  CHECK(sum.asked_share == doctest::Approx(4));
  CHECK(sum.peak_share == doctest::Approx(4));
  CHECK(sum.busy_share == doctest::Approx(1));
  CHECK(sum.full_s == 10);
  CHECK(sum.max_wait_ms == 99 * 300.0);
  CHECK(sum.mean_wait_ms == doctest::Approx(99 * 150.0));
}

TEST_CASE("shares are of all servers' time") {
  const auto meter = std::make_shared<channel::load_meter>(4U, time_point{});
  channel::shared_server_queue queue{4, meter};
  for (int k = 0; k < 20; ++k)
    queue.finish(time_point{k * 100ms}, 80ms);
  const auto sum = summary_of(meter->read(), 2s);
  CHECK(sum.busy_share == doctest::Approx(0.2));
  CHECK(sum.asked_share == doctest::Approx(0.2));
  CHECK(sum.peak_share == doctest::Approx(0.2));
}

TEST_CASE("at nine tenths nobody is full, above all are, the fullest first") {
  const load_table calm{{{"mec", "uplink", asked_for(90ms)}}, {}};
  CHECK(full_ones(calm, 10s).empty());
  const load_table full{{{"mec", "uplink", asked_for(90ms)},
                         {"east", "workers", asked_for(91ms)},
                         {"west", "downlink", asked_for(200ms)}},
                        {}};
  const auto found = full_ones(full, 10s);
  REQUIRE(found.size() == 2);
  CHECK(found[0].of->provider == "west");
  CHECK(found[0].sum.peak_share == doctest::Approx(2));
  CHECK(found[1].of->provider == "east");
  CHECK(found[1].sum.full_s == 10);
}

TEST_CASE("a run that is over before a second is counts its shares") {
  const auto sum = summary_of(asked_for(50ms), 300ms);
  CHECK(sum.asked_share == doctest::Approx(0.5));
  CHECK(sum.peak_share == 0);
  CHECK(sum.full_s == 0);
}

TEST_CASE("load.csv has a line for each second of the run") {
  const load_table table{{{"mec", "uplink", asked_for(50ms)}}, {}};
  CHECK(load_csv(table, 2500ms)
        == "t_s,provider,what,jobs,asked_share,busy_share,mean_wait_ms,"
           "max_wait_ms\n"
           "0,mec,uplink,10,0.500000,0.500000,0.000000,0.000000\n"
           "1,mec,uplink,10,0.500000,0.500000,0.000000,0.000000\n"
           "2,mec,uplink,5,0.500000,0.500000,0.000000,0.000000\n");
  const auto after = load_csv(table, 11s);
  CHECK(after.ends_with("10,mec,uplink,0,0.000000,0.000000,,\n"));
}

TEST_CASE("a run that ends within a tenth of a second leaves it out") {
  const load_table table{{{"mec", "uplink", asked_for(400ms)}}, {}};
  const auto text = load_csv(table, 1010ms);
  CHECK(text.ends_with(
      "0,mec,uplink,10,4.000000,1.000000,1350.000000,2700.000000\n"));
  const auto sum = summary_of(asked_for(400ms), 1010ms);
  CHECK(sum.busy_share == doctest::Approx(1));
  CHECK(sum.asked_share == doctest::Approx(4));
}

TEST_CASE(
    "octets.csv has a line for each second, cell, direction and purpose") {
  using channel::disturbance;
  channel::octet_ledger ledger{time_point{}};
  ledger.send({"CAM", 101, 100, time_point{}}, time_point{20ms});
  ledger.send({"one", 101, 400, time_point{999ms}, disturbance::stall},
              time_point{9s});
  ledger.lose({"CAM", 102, 90, time_point{2s}, disturbance::outage});
  ledger.lose({"CAM", 102, 80, time_point{2s}, disturbance::loss});
  CHECK(octets_csv({{}, {{"mec", "up", ledger.read(time_point{3s})}}})
        == "t_s,provider,direction,what,messages,sent,delivered,lost,"
           "under_way\n"
           "0,mec,up,CAM,1,100,100,0,0\n"
           "2,mec,up,CAM,2,170,0,170,0\n"
           "0,mec,up,one,1,400,0,0,400\n");
}

TEST_CASE("what disturbed the first of a vehicle's messages is told of those "
          "that were sent in a window, without its beginning") {
  using channel::disturbance;
  const load_table table{{},
                         {{"mec",
                           "down",
                           {},
                           {{7s, 101, "one", {0, 0, 2}},
                            {7050ms, 101, "one", {0, 3, 0}},
                            {7050ms, 101, "CAM", {9, 0, 0}},
                            {7100ms, 102, "one", {9, 0, 0}}}}}};
  const message_path path{"mec", "down", 101, "one"};
  CHECK(disturbance_of(table, path, {6s, 7s}) == disturbance::stall);
  CHECK(disturbance_of(table, path, {6s, 8s}) == disturbance::stall);
  CHECK(disturbance_of(table, path, {7s, 7050ms}) == disturbance::outage);
  CHECK(disturbance_of(table, path, {7050ms, 8s}) == disturbance::none);
  CHECK_FALSE(disturbance_of(table, {"mec", "up", 101, "one"}, {6s, 8s}));
}

TEST_CASE("the result that makes a gap is due within three periods, or before "
          "the gap is too long") {
  const auto sent = due_next(10s, 50ms, 12s);
  CHECK(sent.after == 10s);
  CHECK(sent.until == 10s + 150ms);
  CHECK(due_next(10s, 50ms, 10'100ms).until == 10'100ms);
  CHECK(due_next(10s, std::nullopt, 12s).until == 12s);
}

TEST_CASE("a service takes a worker's power for as long as it is busy with "
          "it, at all providers") {
  const auto busy = [](duration work) {
    channel::load_meter meter{1, time_point{}};
    meter.add(time_point{1s}, 0ms, work, "planning");
    meter.add(time_point{4s}, 0ms, 500ms, "cabin");
    return meter.read();
  };
  const load_table two{{{"mec", "workers", busy(1s), 2.5},
                        {"mec", "uplink", asked_for(90ms)},
                        {"far", "workers", busy(3s), 4}},
                       {}};
  CHECK(server_energy_j(two, 10s, "planning") == 1 * 2.5 + 3 * 4.0);
  CHECK(server_energy_j(two, 10s, "cabin") == 0.5 * 2.5 + 0.5 * 4);
  CHECK(server_energy_j(two, 2s, "planning") == 1 * 2.5 + 1 * 4.0);
  CHECK(server_energy_j(two, 10s, "nothing") == 0.);
  CHECK_FALSE(server_energy_j({}, 10s, "planning").has_value());
}
