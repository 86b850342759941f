// Runs in the formats of other tools, read back.
#include "experiments/convert/convert.hpp"

#include "base/input_error.hpp"
#include "channel/trace.hpp"
#include "experiments/convert/mcap_writer.hpp"
#include "tests/experiments/report_folder.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/files.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <zlib.h>

using namespace sofof;
using namespace sofof::experiments;
using namespace sofof::made_up;
using test::contains;
using test::read_file;

namespace {

constexpr std::string_view mcap_magic{"\x89MCAP0\r\n", 8};

/// A reader of records, which believes nothing.
struct mcap_records {
  std::string_view left;

  std::uint64_t number(std::size_t octets) {
    REQUIRE(left.size() >= octets);
    std::uint64_t x = 0;
    for (std::size_t i = 0; i < octets; ++i)
      x |= std::uint64_t{static_cast<unsigned char>(left[i])} << (8 * i);
    left.remove_prefix(octets);
    return x;
  }
  std::string_view take(std::uint64_t octets) {
    REQUIRE(left.size() >= octets);
    const auto part = left.substr(0, octets);
    left.remove_prefix(octets);
    return part;
  }
  std::string_view text() { return take(number(4)); }
};

std::uint32_t crc_of(std::string_view x) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(x.data()), x.size()));
}

/// How many messages each topic has, as its chunks and as its summary say.
struct mcap_content {
  std::map<std::uint64_t, std::string> topics;
  std::map<std::string, std::uint64_t> messages;
  std::uint64_t told = 0, last_ns = 0;
  bool has_json = true, is_in_order = true;

  explicit mcap_content(std::string_view file) {
    REQUIRE(file.starts_with(mcap_magic));
    REQUIRE(file.ends_with(mcap_magic));
    const auto all = file;
    file.remove_prefix(mcap_magic.size());
    file.remove_suffix(mcap_magic.size());
    mcap_records outer{file};
    while (!outer.left.empty()) {
      const auto op = outer.number(1);
      mcap_records body{outer.take(outer.number(8))};
      if (op == 6)
        read_chunk(body);
      if (op == 11)
        told = body.number(8);
      if (op == 2) {
        const auto summary_at = body.number(8);
        body.number(8);
        const auto end = all.size() - mcap_magic.size() - 4;
        CHECK(body.number(4)
              == crc_of(all.substr(summary_at, end - summary_at)));
      }
    }
  }

  void read_chunk(mcap_records body) {
    body.number(8);
    body.number(8);
    const auto size = body.number(8);
    const auto crc = body.number(4);
    CHECK(body.text().empty());
    REQUIRE(body.number(8) == size);
    CHECK(crc == crc_of(body.left));
    while (!body.left.empty()) {
      const auto op = body.number(1);
      mcap_records of{body.take(body.number(8))};
      if (op == 4) {
        const auto id = of.number(2);
        of.number(2);
        topics[id] = of.text();
      }
      if (op == 5) {
        const auto id = of.number(2);
        of.number(4);
        const auto ns = of.number(8);
        CHECK(of.number(8) == ns);
        is_in_order = is_in_order && ns >= last_ns;
        last_ns = ns;
        ++messages[topics.at(id)];
        has_json = has_json && nlohmann::json::accept(of.left);
      }
    }
  }
};

std::string converted(const played_folder& run, const char* name) {
  const auto file = run.path() / name;
  convert::convert(run.path(), file);
  CHECK_FALSE(std::filesystem::exists(file.string() + ".part"));
  return read_file(file);
}

std::size_t rows_of(const played_folder& run, const char* name) {
  const auto text = read_file(run.path() / name);
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

} // namespace

TEST_CASE("an MCAP file has a message for each row, with checksums that hold") {
  const played_folder run;
  const mcap_content read{converted(run, "run.mcap")};
  CHECK(read.has_json);
  CHECK(read.messages.at("/tf") == rows_of(run, "tracks.csv") - 1);
  CHECK(read.messages.at("/events") == rows_of(run, "events.jsonl"));
  CHECK(read.messages.at("/map") == 1);
  CHECK(read.messages.at("/scene") > 1);
  std::uint64_t sum = 0;
  for (const auto& [topic, count] : read.messages)
    sum += count;
  CHECK(read.told == sum);
}

TEST_CASE("an MCAP file of many chunks is read back as it was written") {
  std::string file;
  convert::mcap_writer to{[&file](std::string_view x) { file += x; }};
  const auto a = to.add_channel("/a", "own.A", "{}");
  const auto big = "\"" + std::string(400'000, 'x') + "\"";
  for (std::uint64_t ns = 1; ns <= 10; ++ns)
    to.write(a, ns, big);
  const auto b = to.add_channel("/b", "own.A", "{}");
  to.write(b, 11, "{}");
  to.finish();
  const mcap_content read{file};
  CHECK(read.messages == decltype(read.messages){{"/a", 10}, {"/b", 1}});
  CHECK(read.told == 11);
  CHECK(read.is_in_order);
  CHECK(read.last_ns == 11);
}

TEST_CASE("floating car data are steps of equal times, in order") {
  const played_folder run;
  const auto text = converted(run, "run.fcd.xml");
  CHECK(text.starts_with("<?xml"));
  CHECK(text.ends_with("</fcd-export>\n"));
  double last_s = -1;
  for (auto at = text.find("<timestep time=\""); at != text.npos;
       at = text.find("<timestep time=\"", at + 1)) {
    const auto t_s = std::stod(text.substr(at + 16));
    CHECK(t_s > last_s);
    last_s = t_s;
  }
  CHECK(contains(text, "<vehicle id=\"101\""));
}

TEST_CASE("GeoJSON has each lane and way on Earth") {
  const played_folder run;
  const auto all = nlohmann::json::parse(converted(run, "run.geojson"));
  CHECK(all.at("type") == "FeatureCollection");
  std::map<std::string, int> kinds;
  for (const auto& one : all.at("features")) {
    ++kinds[one.at("properties").at("kind")];
    if (one.at("geometry").at("type") == "LineString")
      for (const auto& place : one.at("geometry").at("coordinates")) {
        CHECK(place.at(0).get<double>() == doctest::Approx(9.95).epsilon(0.01));
        CHECK(place.at(1).get<double>()
              == doctest::Approx(48.42).epsilon(0.01));
      }
  }
  CHECK(kinds["lane"] > 0);
  CHECK(kinds["way"] > 0);
  CHECK(kinds["area"] == 1);
}

TEST_CASE("latencies are a trace that a channel replays") {
  const played_folder run;
  const auto trace = channel::parse_trace(converted(run, "run.latencies.csv"));
  CHECK(trace.size() == rows_of(run, "cycles.csv") - 1);
  for (const auto& one : trace)
    CHECK(one.delay_s > 0);
}

TEST_CASE(
    "another ending and a broken folder are refused, and nothing is left") {
  const played_folder run;
  CHECK_THROWS_AS(convert::convert(run.path(), run.path() / "run.bag"),
                  input_error);
  run.write("tracks.csv", "t_s,station\n1,2\n");
  const auto file = run.path() / "run.mcap";
  CHECK_THROWS_AS(convert::convert(run.path(), file), input_error);
  CHECK_FALSE(std::filesystem::exists(file));
  CHECK_FALSE(std::filesystem::exists(file.string() + ".part"));
}

TEST_CASE("planned paths that were recorded are lines of the scene") {
  const played_folder run;
  const mcap_content before{converted(run, "without.mcap")};
  run.write("plans.csv", "t_s,station,ahead_s,x_m,y_m,speed_mps\n"
                         "0.2,101,0,0,0,8\n0.2,101,0.5,4,0,8\n"
                         "0.2,102,0,50,0,8\n"
                         "0.4,101,0,1,0,8\n0.4,101,0.5,5,0,8\n");
  const auto file = converted(run, "with.mcap");
  const mcap_content after{file};
  CHECK(after.messages.at("/scene") == before.messages.at("/scene") + 3);
  CHECK(test::contains(file, "\"plan of 101\""));
  run.write("plans.csv",
            "t_s,station,ahead_s,x_m,y_m,speed_mps\n0.2,101,0,a,0,8\n");
  CHECK_THROWS_AS(convert::convert(run.path(), run.path() / "run.mcap"),
                  input_error);
}
