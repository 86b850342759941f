// The page: a document as JSON that nothing breaks out of, numbers in few
// characters.
#include "experiments/report/compressed.hpp"
#include "experiments/report/delta_encoding.hpp"
#include "experiments/report/drive_json.hpp"
#include "experiments/report/html.hpp"
#include "experiments/report/page.hpp"
#include "tests/experiments/report_folder.hpp"
#include "tests/support/report_document.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::experiments::report {

using namespace made_up;
using nlohmann::json;

namespace {

/// Reads a column as the page does.
std::vector<double> unpacked(const json& from) {
  const int places = from.at(0);
  const int order = from.at(1);
  auto column = from.at(2).get<std::vector<double>>();
  for (int k = 0; k < order; ++k)
    for (std::size_t i = 1; i < column.size(); ++i)
      column[i] += column[i - 1];
  for (auto& x : column)
    x /= std::pow(10, places);
  if (from.size() > 3)
    for (const std::size_t gap : from.at(3))
      column[gap] = std::numeric_limits<double>::quiet_NaN();
  return column;
}

} // namespace

TEST_CASE("packed numbers come back to their last digit") {
  std::vector<double> line, wave, noise, steps;
  for (int i = 0; i < 1000; ++i) {
    line.push_back(-500 + 0.1 * i);
    wave.push_back(std::round(1e5 * std::sin(i * 0.01)) / 1e3);
    noise.push_back((i * 7919 % 1013) / 1e3);
    steps.push_back(std::floor(i * 0.01));
  }
  for (const auto& column : {line, wave, noise, steps}) {
    const auto back = unpacked(delta_encoding(column, 3));
    REQUIRE(back.size() == column.size());
    for (std::size_t i = 0; i < column.size(); ++i)
      CHECK(back[i] == doctest::Approx(column[i]).epsilon(1e-12));
  }
}

TEST_CASE("what hardly changes packs into little more than nothing") {
  std::vector<double> even(64000);
  for (std::size_t i = 0; i < even.size(); ++i)
    even[i] = 0.05 * static_cast<double>(i);
  CHECK(compressed(delta_encoding(even, 3).dump()).size() < 1500);
}

TEST_CASE("whatever is compressed comes back") {
  std::string all;
  for (std::uint32_t i = 0; i < 70'000; ++i)
    all += static_cast<char>(i * i % 251);
  for (const auto& text : {std::string{}, std::string{"<script>"}, all})
    CHECK(inflated(compressed(text)) == text);
}

TEST_CASE("no numbers, gaps, and numbers of any size can be delta_encoding") {
  CHECK(unpacked(delta_encoding({}, 3)).empty());
  constexpr auto gap = std::numeric_limits<double>::quiet_NaN();
  const auto gaps =
      unpacked(delta_encoding(std::vector{gap, 1.5, gap, 2.5}, 1));
  CHECK(std::isnan(gaps[0]));
  CHECK(gaps[1] == 1.5);
  CHECK(std::isnan(gaps[2]));
  CHECK(gaps[3] == 2.5);
  for (const auto size : {1e-9, 1.0, 1e9, 1e200}) {
    CAPTURE(size);
    const std::vector column{-size, size * std::numbers::pi, 0., size, -size};
    const auto back = unpacked(delta_encoding(column));
    for (std::size_t i = 0; i < column.size(); ++i)
      CHECK(std::abs(back[i] - column[i]) <= size * 1e-6);
  }
}

TEST_CASE("dots with names stand in their page as they are") {
  const document what{
      "",
      "",
      {{"Plane",
        {scatter{
            "t", "x", "y", {{"a", 1, 2.5}, {"b", 0, 0, true}}, {1, 0}, "c"}}}}};
  const auto block = document_in(html(what))["sections"][0]["blocks"][0];
  CHECK(block["kind"] == "scatter");
  CHECK(block["x_label"] == "x");
  CHECK(block["dots"][0]["name"] == "a");
  CHECK(block["dots"][0]["y"] == 2.5);
  CHECK(block["dots"][1]["hollow"] == true);
  CHECK(block["joined"] == json{1, 0});
}

TEST_CASE("a line that has a single point is drawn as that point") {
  constexpr auto gap = std::numeric_limits<double>::quiet_NaN();
  const auto style_of = [](std::vector<double> y) {
    figure f;
    f.curves.push_back({"c", {1, 2}, std::move(y), {}, {}});
    const document what{"t", "", {{"s", {f}}}};
    const auto block = document_in(html(what))["sections"][0]["blocks"][0];
    return block["curves"][0]["style"].get<std::string>();
  };
  CHECK(style_of({3, gap}) == "points");
  CHECK(style_of({3, 4}) == "line");
}

TEST_CASE("a document stands in its page as it is") {
  const document what{
      "A title",
      "below",
      {{"First",
        {paragraph{"some `code`"}, table{"t", {"a", "b"}, {{"1", "x"}}, "n"},
         figure{"f",
                "x, m",
                "y, s",
                {{.name = "c",
                  .x = {1, 2, 3},
                  .y = {4, 5, 6},
                  .low = {3, 4, 5},
                  .high = {5, 6, 7},
                  .dashed = true}},
                {{2, "limit"}},
                "caption"},
         listing{"l", "text\n"}}}}};
  const auto page = html(what);
  CHECK(page.find("<title>A title</title>") != page.npos);
  const auto got = document_in(page);
  CHECK(got["title"] == "A title");
  const auto& blocks = got["sections"][0]["blocks"];
  CHECK(blocks[0]["text"] == "some `code`");
  CHECK(blocks[1]["rows"][0][1] == "x");
  const auto& curve = blocks[2]["curves"][0];
  CHECK(unpacked(curve["y"]) == std::vector<double>{4, 5, 6});
  CHECK(unpacked(curve["high"]) == std::vector<double>{5, 6, 7});
  CHECK(curve["dashed"] == true);
  CHECK(blocks[2]["marks"][0] == json{2.0, "limit"});
  CHECK(blocks[3]["kind"] == "listing");
}

TEST_CASE("nothing in a document ends the page's script, whatever it says") {
  const std::string evil = "</script><script>alert(1)</script><!-- & \" "
                           "%document% \xff\xfe";
  const auto whole =
      html({evil, evil, {{evil, {paragraph{evil}, listing{evil, evil}}}}});
  const auto scripts = [](std::string_view text) {
    std::size_t count = 0;
    for (auto at = text.find("</script"); at != text.npos;
         at = text.find("</script", at + 1))
      ++count;
    return count;
  };
  CHECK(scripts(whole) == scripts(page));
  CHECK(whole.find("<title>&lt;/script>&lt;script>") != whole.npos);
  const auto got = document_in(whole);
  const std::string back = got["sections"][0]["blocks"][0]["text"];
  CHECK(back.starts_with("</script><script>alert(1)</script><!-- & \" "
                         "%document% "));
}

/// Lines of so many points each never turn back.
void check_lines(const std::vector<double>& counts,
                 const std::vector<double>& x_m,
                 const std::vector<double>& y_m) {
  std::size_t begin = 0;
  for (const auto count : counts) {
    const auto end = begin + static_cast<std::size_t>(count);
    REQUIRE(end <= x_m.size());
    for (auto k = begin + 2; k < end; ++k)
      CHECK((x_m[k] - x_m[k - 1]) * (x_m[k - 1] - x_m[k - 2])
                + (y_m[k] - y_m[k - 1]) * (y_m[k - 1] - y_m[k - 2])
            > 0);
    begin = end;
  }
}

TEST_CASE("a drive has streets, tracks, offloadings and events") {
  const played_folder folder;
  const auto drive = drive_json(folder.path());
  CHECK(drive["name"] == "made_up-7");
  CHECK(drive["until"] == 100);
  CHECK(drive["providers"][0]["name"] == "mec");
  CHECK(drive["providers"][0]["area"].size() == 24);
  const auto counts = unpacked(drive["lanes"]["counts"]);
  CHECK(counts.size() > 4);
  check_lines(counts, unpacked(drive["lanes"]["x"]),
              unpacked(drive["lanes"]["y"]));
  REQUIRE(drive["vehicles"].size() == 1);
  CHECK(drive["vehicles"][0]["station"] == 101);
  CHECK(unpacked(drive["vehicles"][0]["x"]) == std::vector<double>{0, 1.5, 3});
  CHECK(unpacked(drive["vehicles"][0]["remote"])
        == std::vector<double>{0, 1, 1});
  REQUIRE(drive["offloadings"].size() == 3);
  CHECK(drive["offloadings"][0]
        == json{101, "trajectory_planning", "mec", 10.0, 30.0});
  CHECK(drive["offloadings"][2][4] == 100); // nobody ended it
  REQUIRE(drive["events"].size() == 1);
  CHECK(drive["events"][0][1] == "violation");
}

TEST_CASE("where no vehicle ran, offloadings are those that were served") {
  const played_folder folder;
  folder.write("events.jsonl", "");
  folder.write("tracks.csv",
               folder.read("tracks.csv")
                   .substr(0, folder.read("tracks.csv").find('\n') + 1));
  const auto drive = drive_json(folder.path());
  CHECK(drive["vehicles"].empty());
  REQUIRE(drive["offloadings"].size() == 1);
  CHECK(drive["offloadings"][0]
        == json{101, "trajectory_planning", "mec", 9.0, 30.0});
}

} // namespace sofof::experiments::report
