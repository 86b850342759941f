// Input that cannot be used is refused in one sentence, and leaves no trace.
#include "tests/processes/workplace.hpp"
#include "tests/support/mistakes.hpp"

#include <sys/stat.h>

using namespace sofof;
using namespace sofof::test;
namespace fs = std::filesystem;

namespace {

/// Checks that `sofof run` refuses, says where and why in one line, and leaves
/// everything as it was.
void check_refused(const workplace& at, std::vector<std::string> arguments,
                   std::string_view place,
                   const std::vector<std::string_view>& words) {
  const auto before = at.inventory();
  arguments.insert(arguments.begin(), "run");
  const auto end = at.run_sofof(arguments);
  CAPTURE(end.err);
  CAPTURE(place);
  CHECK(end.code == 2);
  CHECK(end.out == "");
  CHECK(end.err.starts_with("sofof: "));
  CHECK(end.err.find(place) != end.err.npos);
  for (const auto word : words) {
    CAPTURE(word);
    CHECK(end.err.find(word) != end.err.npos);
  }
  CHECK(end.err.find('\n') + 1 == end.err.size());
  CHECK(at.inventory() == before);
}

/// The same for our scenario with a mistake in it; see mistakes.hpp.
void check_mistake(const mistake& m) {
  CAPTURE(m.wrong);
  const workplace at;
  auto text = scenario_with(m.right, m.wrong);
  const auto place = "sofof: config/wrong.toml" + take_mark(text);
  at.write("config/wrong.toml", text);
  check_refused(at, {"config/wrong.toml"}, place, m.says);
  check_refused(at, {"config/wrong.toml", "--out", "new/folder"}, place,
                m.says);
}

const std::string_view area = "area_corners = 24";

} // namespace

TEST_CASE("a missing file is refused") {
  check_refused({}, {"nowhere/town.toml"},
                "sofof: nowhere/town.toml: ", {"cannot be read"});
  check_refused({}, {"config"}, "sofof: config: ", {"cannot be read"});
}

TEST_CASE("what is no regular file, or a huge one, is refused at once") {
  const workplace at;
  REQUIRE(mkfifo((at / "pipe").c_str(), 0600) == 0);
  at.write("huge", "");
  fs::resize_file(at / "huge", std::uintmax_t{10} << 30);
  for (const auto& [file, why] :
       std::vector<std::pair<std::string, std::string_view>>{
           {"pipe", "it is a pipe"},
           {"/dev/zero", "it is a device"},
           {"huge", "it is longer than 16 MiB"}}) {
    CAPTURE(file);
    const auto named = file.starts_with('/') ? file : "../" + file;
    check_refused(at, {file}, "sofof: " + file + ": ", {why});
    check_refused(at, {scenario_file, "--set", "map=" + named}, "the file ",
                  {why});
    check_refused(at,
                  {scenario_file, "--set", "network.profile=trace", "--set",
                   "network.trace=" + named},
                  "the file ", {why});
  }
}

TEST_CASE("TOML that nests without end is refused") {
  const workplace at;
  for (const std::string_view part : {"a.", "[", "{a="}) {
    std::string text = part == "a." ? "[" : "x = ";
    for (int i = 0; i < 200'000; ++i)
      text += part;
    at.write("config/deep.toml", text);
    check_refused(at, {"config/deep.toml"},
                  "sofof: config/deep.toml:1:", {"nested deeper than 64"});
  }
}

TEST_CASE("a TOML syntax error is refused") {
  check_mistake({"seed = 1", "seed = @= 1", {}});
  check_mistake({"[network]", "[network@\n", {}});
}

TEST_CASE("an unknown key is refused") {
  check_mistake({"seed = 1", "@sede = 1", {"\"sede\"", "\"seed\""}});
  check_mistake({"count = 6", "@cuont = 6", {"\"cuont\"", "\"count\""}});
}

TEST_CASE("a wrong type is refused") {
  check_mistake({"seed = 1", "seed = @\"one\"", {"seed", "whole number"}});
  check_mistake({"\"600s\"", "@600", {"duration", "unit"}});
}

TEST_CASE("a negative duration is refused") {
  check_mistake({"\"600s\"", "@\"-600s\"", {"duration", "-600s"}});
  check_refused({}, {scenario_file, "--duration", "-5s"},
                "--duration -5s: ", {"more than \"0s\""});
}

TEST_CASE("a polygon with two points is refused") {
  check_mistake(
      {area, "area_m = @[[0, 0], [90, 0]]", {"area_m", "three corners"}});
}

TEST_CASE("a polygon that crosses itself is refused") {
  check_mistake({area,
                 "area_m = @[[0, 0], [90, 90], [90, 0], [0, 90]]",
                 {"area_m", "crosses itself"}});
}

TEST_CASE("a route that is not on the map is refused") {
  check_mistake({"\"round_trip\",",
                 "@\"round_tripp\",",
                 {"\"round_tripp\"", "did you mean \"round_trip\"?"}});
}

TEST_CASE("an unknown policy is refused") {
  check_mistake({"codm = { name = \"location\"",
                 "codm = { name = @\"astrology\"",
                 {"\"astrology\"", "location"}});
}

TEST_CASE("an unknown service is refused") {
  check_mistake({"name = \"cabin_climate\"",
                 "name = @\"cabin_music\"",
                 {"\"cabin_music\"", "cabin_climate"}});
}

TEST_CASE("an unknown channel profile is refused") {
  check_mistake({"profile = \"paper_sim\"",
                 "profile = @\"paper_7g\"",
                 {"\"paper_7g\"", "did you mean \"paper_5g\"?"}});
}

TEST_CASE("an unknown rule for messages is refused") {
  check_mistake({"[network]",
                 "[v2x]\ncpm = @\"sometimes\"\n[network]",
                 {"\"sometimes\"", "triggered", "fixed_10hz", "off"}});
}

TEST_CASE("a capture that cannot be written is refused before the run") {
  const workplace at;
  at.write("plain", "text");
  at.drive("done", {"--duration", "2s"});
  for (const std::string file :
       {"plain/air.pcap", "nowhere/air.pcap", "config", "/proc/sofof/air"}) {
    CAPTURE(file);
    const std::vector<std::string_view> says{file,
                                             "choose another file with --pcap"};
    check_refused(at, {scenario_file, "--pcap", file}, "cannot write", says);
    check_refused(at, {scenario_file, "--pcap", file, "--out", "new/folder"},
                  "cannot write", says);
    check_refused(at,
                  {scenario_file, "--pcap", file, "--out", "done", "--force"},
                  "cannot write", says);
  }
  // Nor is an earlier capture lost, if the results are what is refused.
  check_refused(at, {scenario_file, "--pcap", "plain", "--out", "done"},
                "not empty", {});
}

TEST_CASE("an output folder that cannot be written is refused") {
  // Even for root: below a file, and where the kernel lets nobody write.
  const workplace at;
  at.write("plain", "text");
  for (const std::string out : {"plain", "plain/below", "/proc/sofof/new"}) {
    CAPTURE(out);
    check_refused(at, {scenario_file, "--out", out}, out, {"--out"});
    check_refused(at, {scenario_file, "--out", out, "--force"}, out, {"--out"});
  }
}

TEST_CASE("an output folder that is not empty is refused") {
  const workplace at;
  fs::create_directories(at / "full");
  at.write("full/note", "mine");
  check_refused(at, {scenario_file, "--out", "full"}, "full",
                {"not empty", "--force"});

  at.write("full/cycles.csv", "of an earlier run");
  at.drive("full", {"--duration", "2s", "--force"});
  CHECK(read_file(at / "full/note") == "mine");
  CHECK(read_file(at / "full/cycles.csv").starts_with("station,"));
  CHECK(fs::exists(at / "full/summary.json"));
}

TEST_CASE("an empty output folder is taken") {
  const workplace at;
  fs::create_directories(at / "empty");
  at.drive("empty", {"--duration", "2s"});
  CHECK(fs::exists(at / "empty/summary.json"));
}

TEST_CASE("a disk that gets full ends a run in one sentence, and what is "
          "there is not taken for the results of a whole run") {
  for (const std::string clock : {"--quiet", "--realtime"}) {
    CAPTURE(clock);
    const workplace at;
    conditions how;
    how.largest_file = clock == "--quiet" ? 100'000 : 20'000;
    const auto end =
        at.run_sofof({"run", scenario_file, "--out", "out", "--duration",
                      "300s", clock, "--set", "record.tracks_period=10ms"},
                     how);
    CAPTURE(end.err);
    CHECK(end.code == 2);
    CHECK(end.err.starts_with("sofof: cannot write out/"));
    CHECK(end.err.find('\n') + 1 == end.err.size());
    CHECK(fs::exists(at / "out/tracks.csv"));
    CHECK_FALSE(fs::exists(at / "out/summary.json"));
  }
}

TEST_CASE("sofof check refuses what sofof run refuses") {
  const workplace at;
  const auto end = at.run_sofof({"check", scenario_file, "--set", "sede=2"});
  CHECK(end.code == 2);
  CHECK(end.out == "");
  CHECK(end.err.starts_with("sofof: --set sede=2: "));
  CHECK(end.err == at.run_sofof({"run", scenario_file, "--set", "sede=2"}).err);
}
