// The table in the end, and the line while one waits.
#include "recording/console_summary.hpp"

#include "messages/etsi/cam.hpp"
#include "messages/etsi/mcm.hpp"
#include "messages/v2x/encoded.hpp"
#include "recording/progress.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/made_up_run.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace sofof::made_up {

using namespace messages;
using namespace recording;
using test::contains;

namespace {

std::string table_of(const metrics& m, bool colour = false,
                     bool interrupted = false) {
  return table(m, run(), {100, 2, interrupted}, "results/made_up-7", colour);
}

metrics played() {
  metrics m{run()};
  play(m);
  m.finish(at(100s));
  return m;
}

/// Characters on the screen of each line; all are one column wide.
std::vector<std::size_t> widths(const std::string& text) {
  std::istringstream in{text};
  std::vector<std::size_t> all;
  for (std::string line; std::getline(in, line);)
    all.push_back(static_cast<std::size_t>(std::ranges::count_if(
        line, [](char c) { return (c & 0xc0) != 0x80; }))); // UTF-8 heads
  return all;
}

/// The line of `text` that starts with `label`, blanks left out.
std::string line_of(const std::string& text, std::string_view label) {
  std::istringstream in{text};
  for (std::string line; std::getline(in, line);) {
    const auto from = line.find_first_not_of(' ');
    if (from != line.npos && line.substr(from).starts_with(label))
      return line;
  }
  return {};
}

} // namespace

TEST_CASE("the table shows every figure with its unit") {
  const auto text = table_of(played());
  MESSAGE("\n" << text);
  CHECK(contains(text, "made_up, seed 7"));
  CHECK(contains(text, "2 vehicles for 100.0 s in 2.0 s, 50.0 x real time"));
  CHECK(contains(text, "2 offers"));
  CHECK(contains(line_of(text, "accepted"), " 4 "));
  CHECK(contains(line_of(text, "qos_gap"), " 1 "));
  CHECK(line_of(text, "cam_timeout").empty());
  CHECK(contains(line_of(text, "t_off mean"), "12.50 s"));
  CHECK(contains(line_of(text, "offloaded share"), "17.5 %"));
  CHECK(contains(line_of(text, "latency"), "10.01 ± 1.42 ms"));
  CHECK(contains(line_of(text, "inter-arrival"), "50.00 ms"));
  CHECK(contains(text, "results in results/made_up-7"));
  CHECK_FALSE(contains(text, "\x1b"));
}

TEST_CASE("how late vehicles responded is a line, whatever the split was") {
  metrics m{run()};
  play(m);
  const auto responds = [&m](provider_id where, duration after) {
    response_record x{.station = 101,
                      .sensed_at = at(1s),
                      .control_at = at(1s + after),
                      .parts = {{planning, where}}};
    m.on_record(x);
  };
  for (int i = 0; i < 99; ++i)
    responds(0, i < 60 ? 40ms : 90ms);
  responds(provider, 210ms);
  m.finish(at(100s));
  const auto text = table_of(m);
  CHECK(contains(text, "\nresponse time                     looks          p50"
                       "          p99        worst\n"));
  CHECK(line_of(text, "from look to control")
        == "  from look to control              100        40 ms        90 ms"
           "       210 ms");
  for (const auto width : widths(text))
    CHECK(width <= 80);
  CHECK_FALSE(contains(table_of(played()), "response time"));
}

TEST_CASE("the table ends with the run in three sentences") {
  const auto text = table_of(played());
  const auto end =
      text.find("\nOffloaded trajectory_planning 17.5 % of the time; 1 of 3 ");
  REQUIRE(end != text.npos);
  CHECK(std::ranges::count(text.substr(end + 1), '\n') == 5);
  CHECK(contains(text.substr(end), "Never offloaded environment: accepted 1"));
  CHECK(contains(text.substr(end), "\nSafe: "));
}

TEST_CASE("the columns of a block end together within 80 columns") {
  const auto text = table_of(played());
  for (const auto width : widths(text))
    CHECK(width <= 80);
  const auto width = line_of(text, "offloading").size();
  CHECK(line_of(text, "requests").size() == width);
  CHECK(line_of(text, "t_off max").size() == width);
  CHECK(line_of(text, "latency").size() == width + 1); // ± has two bytes
}

TEST_CASE("columns never touch, however wide a figure is") {
  auto info = run();
  info.services = {"one", "two", "three"};
  metrics m{info};
  for (const auto* kind : {"one", "two", "three"})
    for (const auto latency : {1ms, 1'234'567ms})
      m.on_record(result(running(101, 1, kind), 1, 10s, latency, 50ms));
  m.finish(at(100s));
  const auto text = table(m, info, {100, 2, false}, "out", false);
  MESSAGE("\n" << text);
  const auto figure = "617284.00 ± 872969.99 ms";
  const auto line = line_of(text, "latency");
  CHECK(contains(line, std::string{"  "} + figure + "  " + figure));
  for (const auto width : widths(text))
    CHECK(width <= 80);
  CHECK(contains(line_of(text.substr(text.find("three")), "latency"), figure));
}

TEST_CASE("the table counts what was on the air, and what a capture holds") {
  metrics m{run()};
  CHECK_FALSE(contains(table_of(m), "on the air"));
  const auto send = [&m](const auto& message) {
    m.on_record(air_record{at(1s), encoded(message)});
  };
  send(etsi::cam{});
  send(etsi::cam{});
  etsi::mcm down;
  down.header.station = 900'000'001; // a provider's
  send(down);
  const auto text = table_of(m);
  MESSAGE("\n" << text);
  CHECK(contains(line_of(text, "CAM"), " 2 "));
  CHECK(contains(line_of(text, "CAM"),
                 fmt::format(" {:.1f}", *m.air().cam.mean_octets())));
  CHECK(line_of(text, "CPM").ends_with(" 0             -"));
  CHECK(line_of(text, "MCM up").ends_with(" 0             -"));
  CHECK(contains(line_of(text, "MCM down"), " 1 "));
  CHECK_FALSE(contains(text, "messages in"));
  auto info = run();
  info.pcap = "air.pcap";
  CHECK(contains(table(m, info, {100, 2, false}, "out", false),
                 "results in out\n3 messages in air.pcap\n"));
}

TEST_CASE("many services stand below each other") {
  auto info = run();
  info.services = {planning, "environment", "cooperative_intersection",
                   "parking", "a_name_of_as_many_characters_as"};
  metrics m{info};
  play(m);
  m.finish(at(100s));
  const auto text = table(m, info, {100, 2, false}, "out", false);
  for (const auto& kind : info.services)
    CHECK(contains(text, kind));
  for (const auto width : widths(text))
    CHECK(width <= 80);
}

TEST_CASE("a violated safety line cannot be overlooked") {
  auto m = played();
  CHECK(contains(line_of(table_of(m), "without a fresh plan"), "ok"));
  CHECK(contains(line_of(table_of(m), "collisions"), "ok"));
  CHECK_FALSE(contains(table_of(m), "VIOLATED"));
  m.on_record(collision_record{at(3s), 101, 102});
  CHECK(contains(line_of(table_of(m), "collisions"), "VIOLATED"));
  CHECK(contains(line_of(table_of(m), "off the road"), "ok"));
}

TEST_CASE("the table says how the ride felt") {
  const auto text = table_of(played());
  CHECK(contains(line_of(text, "lateral acceleration"), " 1.75 m/s²"));
  CHECK(contains(line_of(text, "jerk"), " 2.00 m/s³"));
  CHECK(contains(line_of(text, "hard brakes"), " 2"));
  CHECK(contains(line_of(text, "emergency plans"), " 3"));
  CHECK_FALSE(contains(table_of(metrics{run()}), "comfort"));
}

TEST_CASE("the table says what services took and what offloading saved") {
  const auto text = table_of(played());
  CHECK(contains(line_of(text, "in the vehicles"), " 1100.1 J"));
  CHECK(contains(line_of(text, "per km"), " 646.9 J"));
  CHECK(contains(line_of(text, "saved by offloading"), " 12.0 %"));
  CHECK_FALSE(contains(table_of(metrics{run()}), "energy"));
}

TEST_CASE("the table says how busy each cell was, and who waited for it") {
  auto m = played();
  channel::load_meter meter{1, at(0s)};
  for (int k = 0; k < 1000; ++k)
    meter.add(at(k * 100ms), 5ms, 25ms);
  m.add(load_table{{{"mec", "uplink", meter.read()}}, {}});
  const auto line = line_of(table_of(m), "mec uplink");
  CHECK(contains(line, " 25.0 % "));
  CHECK(contains(line, " 5.00 ms "));
}

TEST_CASE("nobody is called safe whose driving was not recorded") {
  const metrics m{run()};
  CHECK(contains(table_of(m), "not recorded"));
  CHECK_FALSE(contains(table_of(m), "ok"));
}

TEST_CASE("an interrupted run says so in the table") {
  CHECK(contains(table_of(played(), false, true), "INTERRUPTED"));
}

TEST_CASE("colour is for terminals") {
  CHECK(contains(table_of(played(), true), "\x1b[32mok\x1b[0m"));
}

TEST_CASE("a terminal shows one line, redrawn at most five times a second") {
  std::ostringstream out;
  progress p{out, progress::output::terminal};
  p.update(0, 1800, 0, 0);
  CHECK(contains(out.str(), "0 %"));
  out.str("");
  p.update(40, 1800, 1, 0.19);
  CHECK(out.str().empty());
  p.update(42, 1800, 1, 0.21);
  CHECK(out.str()
        == "\r\x1b[K  2 %  42 of 1800 s  200.0 x real time  1 offloaded"
           "  ETA 9 s");
  out.str("");
  p.clear();
  CHECK(out.str() == "\r\x1b[K");
}

TEST_CASE("a log gets a plain line every ten seconds") {
  std::ostringstream out;
  progress p{out, progress::output::plain};
  for (int i = 0; i <= 250; ++i)
    p.update(i, 14'400, 3, 0.1 * i);
  p.clear();
  CHECK(out.str()
        == "  1 %  100 of 14400 s  10.0 x real time  3 offloaded"
           "  ETA 23 min 50 s\n"
           "  1 %  200 of 14400 s  10.0 x real time  3 offloaded"
           "  ETA 23 min 40 s\n");
}

TEST_CASE("whoever wants silence gets it") {
  std::ostringstream out;
  progress p{out, progress::output::quiet};
  for (int i = 0; i < 100; ++i)
    p.update(i, 100, 0, i);
  p.clear();
  CHECK(out.str().empty());
}

} // namespace sofof::made_up
