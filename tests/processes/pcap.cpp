// A capture of a run: reproducible, complete, and what Wireshark reads in it
// is what we say.
#include "tests/processes/results_reader.hpp"
#include "tests/processes/workplace.hpp"
#include "tests/support/capture.hpp"

#include <cstdlib>
#include <map>
#include <optional>
#include <sstream>

using namespace sofof::test;
namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

/// Two and a half minutes, driven and captured once for all tests.
const fs::path& captured_run() {
  static const workplace at;
  static const auto folder =
      at.drive("out", {"--duration", "150s", "--pcap", "out/air.pcap"});
  return folder;
}

const std::vector<captured>& frames() {
  static const auto all = read_capture(read_file(captured_run() / "air.pcap"));
  return all;
}

/// @returns where a program is; nothing if this machine lacks it.
std::optional<std::string> find_program(const std::string& name) {
  const auto* folders = std::getenv("PATH");
  std::istringstream in{folders ? folders : ""};
  for (std::string folder; std::getline(in, folder, ':');)
    if (const auto file = fs::path{folder} / name;
        access(file.c_str(), X_OK) == 0)
      return file.string();
  return std::nullopt;
}

std::vector<std::vector<std::string>> table_of(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines{text};
  for (std::string line; std::getline(lines, line);) {
    auto& row = rows.emplace_back();
    std::istringstream fields{line + '\t'};
    for (std::string field; std::getline(fields, field, '\t');)
      row.push_back(field);
  }
  return rows;
}

/// Lists all numbers that go by a name, wherever they stand, as tshark does.
void collect(const ordered_json& in, const std::string& name,
             std::string& numbers) {
  for (const auto& [key, value] : in.items())
    if (value.is_structured())
      collect(value, name, numbers);
    else if (in.is_object() && key == name)
      numbers += (numbers.empty() ? "" : ",") + value.dump();
}

/// Compares what tshark and `sofof decode` read in messages of one kind.
/// @param which   tshark's filter.
/// @param fields  tshark's names; the last part is the standard's.
void compare(const std::string& tshark, const std::string& which,
             const std::vector<std::string>& fields) {
  CAPTURE(which);
  const auto& folder = captured_run();
  std::vector<std::string> words{"-r", "air.pcap", "-Y", which,
                                 "-T", "fields",   "-e", "frame.number"};
  for (const auto& field : fields)
    words.insert(words.end(), {"-e", field});
  const auto theirs = program{words, folder, {.program = tshark}}.wait();
  CAPTURE(theirs.err);
  REQUIRE(theirs.code == 0);
  const auto rows = table_of(theirs.out);

  constexpr std::size_t wanted = 300;
  REQUIRE(rows.size() > wanted);
  std::vector<std::vector<std::string>> some;
  for (std::size_t i = 0; i < wanted; ++i)
    some.push_back(rows[i * rows.size() / wanted]);
  std::vector<std::string> hex{"decode"};
  for (const auto& row : some)
    hex.push_back(to_hex(frames().at(std::stoul(row.at(0)) - 1).message));
  const auto ours = run_sofof(hex, folder);
  REQUIRE(ours.code == 0);
  std::istringstream lines{ours.out};
  std::map<std::string, int> met;
  for (const auto& row : some) {
    std::string line;
    REQUIRE(std::getline(lines, line));
    CAPTURE(line);
    REQUIRE(row.size() == 1 + fields.size());
    const auto message = ordered_json::parse(line);
    for (std::size_t i = 0; i < fields.size(); ++i) {
      std::string numbers;
      collect(message, fields[i].substr(fields[i].rfind('.') + 1), numbers);
      CAPTURE(fields[i]);
      REQUIRE(row[i + 1] == numbers);
      met[fields[i]] += !numbers.empty();
    }
  }
  for (const auto& [field, times] : met) {
    CAPTURE(field);
    CHECK(times > 50);
  }
}

} // namespace

TEST_CASE("the same file and seed give the same capture") {
  const workplace at;
  for (const auto* name : {"a", "b"})
    at.drive(name,
             {"--duration", "20s", "--pcap", std::string{name} + ".pcap"});
  at.drive("c", {"--duration", "20s", "--pcap", "c.pcap", "--seed", "2"});
  const auto a = read_file(at / "a.pcap");
  CHECK(a.size() > 50'000);
  CHECK((a == read_file(at / "b.pcap")));
  CHECK((a != read_file(at / "c.pcap")));
}

TEST_CASE("a run that is captured is the same run") {
  const workplace at;
  const auto a = at.drive("a", {"--duration", "20s", "--pcap", "air.pcap"});
  const auto b = at.drive("b", {"--duration", "20s"});
  for (const auto* name : {"cycles.csv", "tracks.csv", "events.jsonl"})
    CHECK((read_file(a / name) == read_file(b / name)));
}

TEST_CASE("a capture holds the messages that the summary counts") {
  std::map<std::string, std::pair<std::size_t, std::size_t>> sent;
  for (const auto& frame : frames()) {
    constexpr std::uint64_t roadside_unit = 15;
    auto& [messages, octets] =
        sent[frame.port == 2001                    ? "cam"
             : frame.port == 2009                  ? "cpm"
             : frame.station_type == roadside_unit ? "mcm_down"
                                                   : "mcm_up"];
    ++messages;
    octets += frame.message.size();
  }
  const auto summary = summary_of(captured_run())["v2x"];
  CHECK(sent.size() == summary.size());
  for (const auto& [name, count] : sent) {
    CAPTURE(name);
    CHECK(summary[name]["messages"] == count.first);
    CHECK(summary[name]["octets"] == count.second);
  }
}

TEST_CASE("a frame says no more of its sender than is known") {
  constexpr std::uint64_t roadside_unit = 15;
  constexpr std::uint64_t faster_than_any_car = 5000; // cm/s
  for (const auto& frame : frames()) {
    REQUIRE(!frame.is_accurate);
    REQUIRE(frame.is_mobile == (frame.station_type != roadside_unit));
    REQUIRE(frame.speed < faster_than_any_car);
    REQUIRE(frame.heading < 3600);
  }
}

TEST_CASE("times in a capture rise and are those of the run") {
  constexpr std::uint64_t second = 1'000'000'000;
  constexpr auto start = 1'767'225'600 * second; // 2026-01-01T00:00:00Z
  std::uint64_t before = start;
  for (const auto& frame : frames()) {
    REQUIRE(frame.unix_ns >= before);
    before = frame.unix_ns;
  }
  CHECK(frames().front().unix_ns < start + second);
  CHECK(before > start + 149 * second);
  CHECK(before <= start + 150 * second);
}

TEST_CASE("a run replaces an earlier capture") {
  const workplace at;
  at.write("air.pcap", std::string(1'000'000, 'x'));
  at.drive("out", {"--duration", "2s", "--pcap", "air.pcap"});
  CHECK(read_capture(read_file(at / "air.pcap")).size() > 20);
}

TEST_CASE("a capture never takes the place of what the run reads or writes") {
  const workplace at;
  at.write("trace.csv", "time_s,delay_ms\n0,20\n1,22\n2,21\n");
  fs::create_symlink("config/ulm_lehr.toml", at / "link");
  at.drive("old", {"--duration", "1s"});
  const auto before = at.inventory();
  const auto refuses = [&](const std::string& file, const std::string& why) {
    CAPTURE(file);
    const auto end =
        at.run_sofof({"run", scenario_file, "--out", "old", "--force",
                      "--duration", "1s", "--set", "network.profile=trace",
                      "--set", "network.trace=../trace.csv", "--pcap", file});
    CAPTURE(end.err);
    CHECK(end.code == 2);
    CHECK(end.err.find(why) != end.err.npos);
    CHECK(at.inventory() == before);
  };
  for (const auto* input :
       {"config/ulm_lehr.toml", "config/../config/ulm_lehr.toml", "link",
        "config/maps/ulm_lehr.toml", "trace.csv"})
    refuses(input, "the run reads this file; choose another file with --pcap");
  for (const auto* result : {"old/summary.json", "config/../old/tracks.csv",
                             "old/trace.txt.tmp", "./old/cycles.csv"})
    refuses(result, "the run writes its results there; choose another file");
  const auto end = at.run_sofof({"run", scenario_file, "--out", "new",
                                 "--duration", "1s", "--pcap", "./new"});
  CHECK(end.code == 2);
  CHECK(at.inventory() == before);
  refuses("", "a file's name is expected");
}

TEST_CASE("a disk that gets full ends a captured run in one sentence") {
  const workplace at;
  conditions how;
  how.largest_file = 100'000;
  const auto end =
      at.run_sofof({"run", scenario_file, "--out", "out", "--duration", "300s",
                    "--quiet", "--pcap", "air.pcap", "--set",
                    "record.tracks=false", "--set", "record.cycles=false"},
                   how);
  CAPTURE(end.err);
  CHECK(end.code == 2);
  CHECK(end.err.starts_with("sofof: cannot write air.pcap: "));
  CHECK(end.err.find("another file with --pcap") != end.err.npos);
  CHECK(end.err.find('\n') + 1 == end.err.size());
  CHECK_FALSE(fs::exists(at / "out/summary.json"));
}

TEST_CASE("an interrupted run leaves a whole capture") {
  const workplace at;
  program run{{"run", scenario_file, "--duration", "24h", "--out", "out",
               "--pcap", "air.pcap"},
              at.here()};
  REQUIRE(wait_until([&] {
    std::error_code none;
    return fs::file_size(at / "air.pcap", none) > 100'000 && !none;
  }));
  run.send(SIGINT);
  CHECK(run.wait().code == 130);
  CHECK(read_capture(read_file(at / "air.pcap")).size() > 300);
}

TEST_CASE("tshark finds nothing wrong with ten thousand messages, and reads "
          "in them what we read") {
  const auto tshark = find_program("tshark");
  if (!tshark) {
    MESSAGE("tshark is not installed: nobody looks at the capture.");
    return;
  }
  REQUIRE(frames().size() >= 10'000);
  const auto wrong = program{
      {"-r", "air.pcap", "-Y",
       "_ws.malformed || _ws.expert || !btpb || "
       "!(its || btpb.dstport == 2020)"},
      captured_run(),
      {.program =
           *tshark}}.wait();
  CHECK(wrong.code == 0);
  CHECK(wrong.out == "");

  compare(*tshark, "its.messageID == 2",
          {"its.stationID", "cam.generationDeltaTime", "cam.stationType",
           "its.latitude", "its.longitude", "its.headingValue",
           "its.speedValue", "its.longitudinalAccelerationValue",
           "its.curvatureValue", "its.yawRateValue", "its.vehicleLengthValue",
           "cam.vehicleWidth", "its.deltaLatitude", "its.deltaLongitude",
           "its.pathDeltaTime"});
  // cpm.value: distances, speeds, yaw and sizes of each object.
  compare(*tshark, "its.messageID == 14 && cpm.objectID",
          {"its.stationID", "cpm.generationDeltaTime", "cpm.stationType",
           "its.latitude", "its.longitude", "its.headingValue",
           "its.speedValue", "cpm.objectID", "cpm.timeOfMeasurement",
           "cpm.value", "its.longitudinalAccelerationValue",
           "its.lateralAccelerationValue", "cpm.numberOfPerceivedObjects"});
}

TEST_CASE("decode reads in a capture the messages that the run has sent") {
  const auto& folder = captured_run();
  const auto decoded = run_sofof({"decode", "--pcap", "air.pcap"}, folder);
  CHECK(decoded.code == 0);
  CHECK(decoded.err == "");
  std::istringstream lines{decoded.out};
  std::size_t count = 0;
  std::vector<std::string> some{"decode"}, messages;
  for (std::string line; std::getline(lines, line); ++count) {
    const auto x = ordered_json::parse(line);
    const auto& frame = frames().at(count);
    REQUIRE(x.at("packet") == count + 1);
    REQUIRE(x.at("unix_ns") == frame.unix_ns);
    REQUIRE(x.at("port") == frame.port);
    if (count % 100 != 0)
      continue;
    some.push_back(to_hex(frame.message));
    messages.push_back(x.at("message").dump());
  }
  CHECK(count == frames().size());
  std::istringstream ours{run_sofof(some, folder).out};
  for (const auto& message : messages) {
    std::string line;
    REQUIRE(std::getline(ours, line));
    REQUIRE(ordered_json::parse(line).dump() == message);
  }
}

TEST_CASE("decode reads a capture in Wireshark's own format, and from a pipe") {
  const auto& folder = captured_run();
  const auto whole = run_sofof({"decode", "--pcap", "air.pcap"}, folder).out;
  const auto piped = program{
      {"-c", "exec \"$0\" decode --pcap - < air.pcap", SOFOF_PROGRAM},
      folder,
      {.program =
           "/bin/sh"}}.wait();
  CHECK((piped.out == whole));
  const auto editcap = find_program("editcap");
  if (!editcap) {
    MESSAGE("editcap is not installed: nobody writes a pcapng file.");
    return;
  }
  const auto turned = program{
      {"-F", "pcapng", "air.pcap", "air.pcapng"},
      folder,
      {.program =
           *editcap}}.wait();
  REQUIRE(turned.code == 0);
  CHECK((run_sofof({"decode", "--pcap", "air.pcapng"}, folder).out == whole));
}

TEST_CASE("decode says where a capture ends too early, and what is none") {
  const workplace at;
  const auto capture = read_file(captured_run() / "air.pcap");
  at.write("cut.pcap", capture.substr(0, 1000));
  const auto cut = at.run_sofof({"decode", "--pcap", "cut.pcap"});
  CHECK(cut.code == 1);
  CHECK(cut.out.starts_with("{\"packet\": 1, "));
  CHECK(cut.err.starts_with("sofof: cut.pcap: the capture ends here: "));
  at.write("none.pcap", "t_s,station\n1,101\n, a table and no capture");
  fs::create_directory(at / "folder");
  auto other = capture;
  other[20] = 101; // packets begin with IP
  at.write("other.pcap", other);
  for (const auto* file :
       {"none.pcap", "missing.pcap", "folder", "other.pcap"}) {
    CAPTURE(file);
    const auto end = at.run_sofof({"decode", "--pcap", file});
    CAPTURE(end.err);
    CHECK(end.code == 2);
    CHECK(end.err.starts_with(std::string{"sofof: "} + file + ": "));
    CHECK(end.err.find('\n') + 1 == end.err.size());
  }
}
