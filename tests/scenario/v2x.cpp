// ITS messages of a run: what is counted of them, and how they are captured.
#include "base/input_error.hpp"
#include "messages/etsi/message.hpp"
#include "recording/pcap_file.hpp"
#include "recording/results.hpp"
#include "scenario/load.hpp"
#include "tests/scenario/whole_run.hpp"
#include "tests/support/capture.hpp"
#include "tests/support/files.hpp"
#include "tests/support/made_up_run.hpp"
#include "tests/support/scratch.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <unistd.h>
#include <vector>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::recording;
using namespace sofof::scenario;
using namespace sofof::test;
namespace fs = std::filesystem;

namespace {

/// Half a minute in which two of six vehicles are planned for.
const memory_sink& half_a_minute() {
  static const auto records =
      play(load_scenario(SOFOF_SOURCE_DIR "/config/ulm_lehr.toml",
                         std::vector<std::string>{"duration=30s"}));
  return records;
}

// Of the header that all messages begin with.
int message_id_of(const octets& x) {
  return std::to_integer<int>(x.at(1));
}
std::uint32_t station_of(const octets& x) {
  std::uint32_t station = 0;
  for (std::size_t i = 2; i < 6; ++i)
    station = station << 8 | std::to_integer<std::uint32_t>(x.at(i));
  return station;
}

constexpr auto cam_id = 2, cpm_id = 14, mcm_id = 20;
constexpr std::uint32_t first_provider = 900'000'001;

std::string name_of(const octets& x) {
  const auto id = message_id_of(x);
  return id == cam_id   ? "cam"
         : id == cpm_id ? "cpm"
         : id == mcm_id
             ? station_of(x) == first_provider ? "mcm_down" : "mcm_up"
             : "?";
}

/// Captures what is recorded.
/// @returns the file's content.
std::string capture(const std::vector<air_record>& air) {
  const scratch dir;
  pcap_file file{dir / "air.pcap", etsi::its_clock{}};
  for (const auto& x : air)
    file.write(x);
  file.close();
  return read_file(dir / "air.pcap");
}

} // namespace

TEST_CASE("the summary's figures of messages are those that were sent") {
  struct count {
    std::uint64_t messages = 0, octets = 0;
  };
  std::map<std::string, count> sent;
  const scratch dir;
  results r{dir.path(), made_up::run()};
  for (const auto& x : half_a_minute().air) {
    auto& of_its_kind = sent[name_of(x.message.octets)];
    ++of_its_kind.messages;
    of_its_kind.octets += x.message.octets.size();
    r.on_record(x);
  }
  r.finish(made_up::at(std::chrono::seconds{30}), 2, false);
  REQUIRE(sent.size() == 4);
  const auto summary =
      nlohmann::json::parse(read_file(dir / "summary.json"))["v2x"];
  CHECK(summary.size() == 4);
  for (const auto& [name, of_its_kind] : sent) {
    CAPTURE(name);
    const auto& told = summary[name];
    CHECK(told["messages"] == of_its_kind.messages);
    CHECK(told["octets"] == of_its_kind.octets);
    CHECK(told["mean_octets"].get<double>()
          == doctest::Approx(static_cast<double>(of_its_kind.octets)
                             / static_cast<double>(of_its_kind.messages))
                 .epsilon(1e-4));
  }
}

TEST_CASE("where nothing was sent there is no mean length") {
  const scratch dir;
  results r{dir.path(), made_up::run()};
  r.finish(made_up::start, 0, false);
  const auto summary =
      nlohmann::json::parse(read_file(dir / "summary.json"))["v2x"];
  for (const auto* name : {"cam", "cpm", "mcm_up", "mcm_down"}) {
    CHECK(summary[name]["messages"] == 0);
    CHECK(summary[name]["octets"] == 0);
    CHECK(summary[name]["mean_octets"].is_null());
  }
}

TEST_CASE("vehicles send what the scenario says, when it says so") {
  const auto cams_and_cpms = [](std::vector<std::string> options) {
    options.emplace_back("duration=10s");
    std::map<std::string, int> sent;
    for (const auto& x :
         play(load_scenario(SOFOF_SOURCE_DIR "/config/ulm_lehr.toml", options))
             .air)
      ++sent[name_of(x.message.octets)];
    return std::pair{sent["cam"], sent["cpm"]};
  };
  constexpr auto all = 6 * 100;
  const auto [cams, cpms] = cams_and_cpms({});
  CHECK(cams > 6 * 10);
  CHECK(cams < all);
  CHECK(cpms >= 6 * 10);
  CHECK(cpms < all);
  const auto fixed =
      cams_and_cpms({"v2x.cam=fixed_10hz", "v2x.cpm=fixed_10hz"});
  CHECK(fixed == std::pair{all, all});
  CHECK(cams_and_cpms({"v2x.cpm=off"}).second == 0);
  CHECK(cams_and_cpms({"fleet.0.connected=false"}) == std::pair{0, 0});
}

TEST_CASE("a capture holds every message as it was sent, in the order of "
          "time") {
  const auto& air = half_a_minute().air;
  const auto frames = read_capture(capture(air));
  REQUIRE(frames.size() == air.size());
  REQUIRE(frames.size() > 1000);
  const etsi::its_clock clock;
  std::uint64_t before = 0;
  for (std::size_t i = 0; i < air.size(); ++i) {
    const auto& frame = frames[i];
    REQUIRE(frame.message == air[i].message.octets);
    REQUIRE(frame.unix_ns
            == static_cast<std::uint64_t>(clock.unix_time(air[i].at).count()));
    REQUIRE(frame.timestamp
            == static_cast<std::uint32_t>(clock.timestamp(air[i].at)));
    REQUIRE(frame.unix_ns >= before);
    before = frame.unix_ns;
  }
}

TEST_CASE("what the layers below a message say is what the message says") {
  std::map<std::string, int> seen;
  for (const auto& frame : read_capture(capture(half_a_minute().air))) {
    const auto id = message_id_of(frame.message);
    const auto station = station_of(frame.message);
    ++seen[name_of(frame.message)];
    CAPTURE(station);
    REQUIRE(frame.port == (id == cam_id ? 2001 : id == cpm_id ? 2009 : 2020));
    constexpr std::uint64_t made_up_by_its_owner = 0x0200;
    REQUIRE(frame.address == (made_up_by_its_owner << 32 | station));
    REQUIRE(frame.ethernet_source == frame.address);
    constexpr auto passenger_car = 5, roadside_unit = 15;
    REQUIRE(frame.station_type
            == (station == first_provider ? roadside_unit : passenger_car));

    const auto [message, error] = etsi::decode_message(frame.message);
    CAPTURE(error);
    REQUIRE(message);
    if (const auto* told = std::get_if<etsi::cam>(&*message)) {
      const auto& body = told->body.parameters;
      REQUIRE(frame.latitude == body.basic.position.latitude);
      REQUIRE(frame.longitude == body.basic.position.longitude);
      const auto& motion = std::get<0>(body.high_frequency.value);
      REQUIRE(frame.speed == motion.speed.value);
      REQUIRE(frame.heading == motion.heading.value);
    }
  }
  CHECK(seen.size() == 4);
  for (const auto& [name, count] : seen) {
    CAPTURE(name);
    CHECK(count > 50);
  }
}

TEST_CASE("what cannot be captured is refused with the option to change") {
  const scratch dir;
  const auto complaint = [](const fs::path& path) {
    for (const auto open : {false, true})
      try {
        if (open)
          pcap_file{path, etsi::its_clock{}};
        else
          pcap_file::check(path);
        FAIL_CHECK("nothing is said");
      } catch (const input_error& e) {
        const std::string says = e.what();
        CAPTURE(says);
        CHECK(says.find(path.string()) != says.npos);
        CHECK(says.find("choose another file with --pcap") != says.npos);
      }
  };
  complaint(dir.path());
  complaint(dir / "nowhere/air.pcap");
  std::ofstream{dir / "plain"} << "text";
  complaint(dir / "plain/air.pcap");
  pcap_file::check(dir / "plain");
  pcap_file::check(dir / "new");
  CHECK(read_file(dir / "plain") == "text");
  CHECK_FALSE(fs::exists(dir / "new"));
}
