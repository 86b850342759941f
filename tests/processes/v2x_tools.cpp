// sofof decode and sofof encode as filters.
#include "tests/processes/workplace.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

using namespace sofof::test;

namespace {

constexpr auto cam_hex =
    "0202000000653039405a508e972e273917206403c7084ca90a00384081a08902c08a6c1c63"
    "66076cc10015ff9b7e0bd8d30018d0063c176ec620";

/// Runs it in a shell, with the program as "$0" and a file as "$1".
ending run_shell(const workplace& at, const std::string& script,
                 const std::string& file = "") {
  conditions how;
  how.program = "/bin/sh";
  return program{{"-c", script, SOFOF_PROGRAM, file}, at.here(), how}.wait();
}

} // namespace

TEST_CASE("a message on the command line is decoded") {
  const workplace at;
  const auto end = at.run_sofof({"decode", cam_hex});
  CHECK(end.code == 0);
  CHECK(end.err == "");
  CHECK(std::ranges::count(end.out, '\n') == 1);
  const auto json = nlohmann::json::parse(end.out);
  CHECK(json["header"]["stationID"] == 101);
  CHECK(json["cam"]["camParameters"]["basicContainer"]["stationType"] == 5);
  const auto back = at.run_sofof({"encode", end.out});
  CHECK(back.code == 0);
  CHECK(back.out == std::string{cam_hex} + "\n");
}

TEST_CASE("what is decoded and encoded again is what it was") {
  const workplace at;
  const std::string hex{cam_hex};
  const auto line = hex + "\n";
  at.write("messages.hex", "0x" + hex + "\r\n\n   " + hex.substr(0, 10) + " "
                               + hex.substr(10) + "\n" + hex);
  const auto end =
      run_shell(at, R"("$0" decode - < "$1" | "$0" encode -)", "messages.hex");
  CHECK(end.code == 0);
  CHECK(end.err == "");
  CHECK(end.out == line + line + line);
}

TEST_CASE("a bad line is told by its number, and the others go on") {
  const workplace at;
  const std::string hex{cam_hex};
  at.write("messages.hex",
           hex + "\n\nzz\n" + hex.substr(0, 20) + "\n01\n" + hex + "\n");
  const auto end = run_shell(at, R"("$0" decode < "$1")", "messages.hex");
  CHECK(end.code == 1);
  CHECK(end.err == "");
  std::istringstream lines{end.out};
  std::vector<nlohmann::json> all;
  for (std::string line; std::getline(lines, line);)
    all.push_back(nlohmann::json::parse(line));
  REQUIRE(all.size() == 5);
  CHECK(all[0].contains("cam"));
  CHECK(all[1]["line"] == 3);
  CHECK(all[2]["line"] == 4);
  CHECK(all[2]["error"]
        == "cam.camParameters.basicContainer.referencePosition.latitude needs "
           "31 bits, more than are left, at bit 76 of 80");
  CHECK(all[3]["line"] == 5);
  CHECK(all[4].contains("cam"));
}

TEST_CASE("an input that cannot be read is an error in a sentence") {
  const workplace at;
  for (const std::string tool : {"decode", "encode"}) {
    const auto end = run_shell(at, "\"$0\" " + tool + " - < .");
    CHECK(end.code == 2);
    CHECK(end.out == "");
    CHECK(end.err.starts_with("sofof: standard input cannot be read: "));
    CHECK(std::ranges::count(end.err, '\n') == 1);
  }
}

TEST_CASE("a line without an end is told, and the others go on") {
  const workplace at;
  const std::string hex{cam_hex};
  constexpr std::size_t limit = 16 * 1024 * 1024;
  at.write("messages.hex",
           hex + "\n" + std::string(limit + 1, '0') + "\n" + hex + "\n");
  const auto end = run_shell(at, R"("$0" decode < "$1")", "messages.hex");
  CHECK(end.code == 1);
  CHECK(std::ranges::count(end.out, '\n') == 3);
  CHECK(end.out.find("\n{\"error\":\"the line is longer than 16 MiB\","
                     "\"line\":2}\n")
        != end.out.npos);
}

TEST_CASE("brackets without an end are told") {
  const workplace at;
  at.write("deep.json", std::string(100'000, '['));
  const auto end = run_shell(at, R"("$0" encode < "$1")", "deep.json");
  CHECK(end.code == 1);
  CHECK(end.out
        == R"({"error":"this is nested deeper than 32 levels","line":1})"
           "\n");
}

TEST_CASE("JSON that is no message is told by its line") {
  const workplace at;
  const auto end = at.run_sofof({"encode", "{\"header\":\"\n\xff\"}", "{}"});
  CHECK(end.code == 1);
  CHECK(std::ranges::count(end.out, '\n') == 2);
  CHECK(
      end.out.ends_with(R"({"error":"the message has no \"header\"","line":2})"
                        "\n"));
}

TEST_CASE("each line is answered before the next one comes") {
  const workplace at;
  // The second line is sent only when the first one has been answered.
  const auto end = run_shell(at, R"(mkfifo in out; "$0" decode < in > out &
    exec 3> in 4< out; echo "$1" >&3; read -r first <&4; echo "$first"
    echo "$1" >&3; read -r second <&4; echo "$second"; exec 3>&-; wait $!)",
                             cam_hex);
  CHECK(end.code == 0);
  CHECK(std::ranges::count(end.out, '\n') == 2);
  CHECK(end.out.find("camParameters") != end.out.npos);
}

TEST_CASE("who stops reading is not complained to") {
  const workplace at;
  std::string many;
  for (int i = 0; i < 20'000; ++i)
    many += std::string{cam_hex} + "\n";
  at.write("messages.hex", many);
  const auto end = run_shell(
      at, R"(trap '' PIPE; "$0" decode < "$1" | head -n 1)", "messages.hex");
  CHECK(end.err == "");
  CHECK(std::ranges::count(end.out, '\n') == 1);
}

TEST_CASE("the tools say what they do, with an example") {
  const workplace at;
  for (const std::string tool : {"decode", "encode"}) {
    const auto end = at.run_sofof({tool, "--help"});
    CHECK(end.code == 0);
    CHECK(end.out.find("\n  sofof decode -") != end.out.npos);
  }
}
