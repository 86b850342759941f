// Reading results folders: what is in them, and what is wrong with them.
#include "experiments/report/describe.hpp"
#include "experiments/report/html.hpp"
#include "experiments/report/recorded_run.hpp"
#include "tests/experiments/report_folder.hpp"
#include "tests/experiments/report_sections.hpp"
#include "tests/support/mistakes.hpp"
#include "tests/support/report_document.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>

namespace sofof::experiments::report {

using namespace made_up;
using test::check_says;

namespace {

/// @returns what is said about a folder; empty if it is shown.
std::string error_of(const played_folder& folder) {
  try {
    html({"", "", {{"", {drive{folder.path()}}}}});
    describe_run(folder.path());
    return {};
  } catch (const input_error& problem) {
    return problem.what();
  }
}

std::vector<std::string> titles_of(std::span<const section> sections) {
  std::vector<std::string> all;
  for (const auto& one : sections)
    all.push_back(one.title);
  return all;
}

} // namespace

TEST_CASE("a results folder is read as it was written") {
  const played_folder folder;
  const auto run = open_run(folder.path());
  CHECK(run.label == "made_up-7");
  CHECK(run.what.seed == 7);
  CHECK(run.version == "0.1.0");
  REQUIRE(run.figures);
  CHECK(run.figures->at("episodes") == 3);
  CHECK(run.figures->at("safety.driven_s") == 200);

  REQUIRE(run.episodes.size() == 4);
  CHECK(run.episodes[0].by_requester);
  CHECK(run.episodes[0].first_data_s == 10);
  CHECK(run.episodes[0].t_off_s == 20);
  CHECK(run.episodes[0].reason == "left_area");
  CHECK_FALSE(run.episodes[1].by_requester);
  CHECK_FALSE(run.episodes[1].t_off_s);
  CHECK(run.episodes[2].fallback);

  REQUIRE(run.cycles);
  REQUIRE(run.cycles->size() == 401);
  CHECK(run.cycles->front().of.provider == "mec");
  CHECK(run.cycles->front().of.provider_id == provider);
  CHECK(run.cycles->front().received_s == doctest::Approx(10.008));
  CHECK(run.cycles->front().latency_ms == 8);
  CHECK_FALSE(run.cycles->front().interarrival_ms);
  CHECK(run.cycles->back().latency_ms == doctest::Approx(12.345678));

  const auto tracks = read_tracks(folder.path());
  REQUIRE(tracks);
  REQUIRE(tracks->size() == 3);
  CHECK(tracks->back().x_m == 3);
  CHECK(tracks->back().remote);
  const auto events = read_events(folder.path());
  CHECK(events.back().what == "violation");
  CHECK(events.back().detail == "qos_gap");
}

TEST_CASE("names with commas, quotes and line breaks are read") {
  const played_folder folder;
  folder.spoil("episodes.csv", "101,mec,", "101,\"a \"\"b\"\",\nc\",");
  const auto episodes = read_episodes(folder.path());
  CHECK(episodes[0].of.provider == "a \"b\",\nc");
  CHECK(episodes[1].of.provider == "mec");
}

TEST_CASE("one sentence tells what is wrong with a results folder, and where") {
  struct spoilt {
    std::string_view file, right, wrong;
    std::string_view place;
    std::vector<std::string_view> says;
  };
  const std::array all{
      spoilt{"episodes.csv",
             "left_area,0,\n",
             "left_area,0,",
             "episodes.csv:2: ",
             {"25 fields", "13 columns"}},
      spoilt{"episodes.csv",
             "fallback",
             "fall",
             "episodes.csv:1: ",
             {"\"fallback\" is missing"}},
      spoilt{"episodes.csv",
             "left_area,0",
             "left_area,maybe",
             "episodes.csv:2: ",
             {"fallback \"maybe\"", "neither 0 nor 1"}},
      spoilt{"episodes.csv",
             "requester",
             "nobody",
             "episodes.csv:2: ",
             {"side \"nobody\"", "requester"}},
      spoilt{"cycles.csv",
             "8.000000",
             "eight",
             "cycles.csv:2: ",
             {"latency_ms \"eight\"", "not a number"}},
      spoilt{"cycles.csv",
             "8.000000",
             "inf",
             "cycles.csv:2: ",
             {"latency_ms \"inf\"", "not a number"}},
      spoilt{"cycles.csv",
             "101,",
             "-101,",
             "cycles.csv:2: ",
             {"station \"-101\"", "whole number"}},
      spoilt{"tracks.csv",
             "remote",
             "remote,",
             "tracks.csv:3: ",
             {"12 fields", "11 columns"}},
      spoilt{"tracks.csv",
             "remote",
             "re\"mote",
             "tracks.csv:3: ",
             {"source", "remote"}},
      spoilt{"tracks.csv",
             "local",
             "\"local\"x",
             "tracks.csv:2: ",
             {"a quote stands within"}},
      spoilt{"events.jsonl",
             "\"offer\"",
             "offer",
             "events.jsonl:1: ",
             {"no JSON object"}},
      spoilt{"events.jsonl",
             "\"what\":\"offer\",",
             "",
             "events.jsonl:1: ",
             {"\"what\" is missing"}},
      spoilt{"events.jsonl",
             "\"station\":101",
             "\"station\":-1",
             "events.jsonl:1: ",
             {"\"station\"", "whole number"}},
      spoilt{"events.jsonl",
             "\"detail\":\"trajectory_planning\"",
             "\"detail\":1",
             "events.jsonl:1: ",
             {"\"detail\"", "text"}},
      spoilt{"summary.json", "{", "[", "summary.json: ", {"no JSON object"}},
      spoilt{"config.toml",
             "columns = 2",
             "columns = 0",
             "config.toml:5:11: ",
             {"columns"}},
      spoilt{"vehicles.csv",
             "900.000",
             "far",
             "vehicles.csv:2: ",
             {"distance_m \"far\"", "not a number"}},
  };
  for (const auto& one : all) {
    CAPTURE(one.file);
    CAPTURE(one.wrong);
    const played_folder folder;
    folder.spoil(one.file, one.right, one.wrong);
    check_says(error_of(folder), one.place, one.says);
  }
}

TEST_CASE("a line that was cut off is refused in every file of lines") {
  for (const auto file :
       {"episodes.csv", "cycles.csv", "tracks.csv", "events.jsonl"}) {
    CAPTURE(file);
    const played_folder folder;
    auto text = folder.read(file);
    const auto lines = std::ranges::count(text, '\n');
    text.resize(text.size() - 3);
    folder.write(file, text);
    check_says(error_of(folder), fmt::format("{}:{}: ", file, lines),
               {"cut off"});
  }
}

TEST_CASE("a quote that is never closed does not read on to the file's end") {
  const played_folder folder;
  std::string text = folder.read("episodes.csv");
  const auto lines = std::ranges::count(text, '\n');
  text += '"';
  for (int i = 0; i < 2'000'000; ++i)
    text += "a\n";
  folder.write("episodes.csv", text);
  check_says(error_of(folder), fmt::format("episodes.csv:{}: ", lines + 1),
             {"a quote is opened in this line and not closed"});
}

TEST_CASE("a folder without a configuration is no results folder") {
  const played_folder folder;
  std::filesystem::remove(folder.path() / "config.toml");
  check_says(error_of(folder), folder.path().string(), {"no results folder"});
}

TEST_CASE("a killed run is shown as far as it came, and called killed") {
  const played_folder folder;
  std::filesystem::remove(folder.path() / "summary.json");
  std::filesystem::remove(folder.path() / "vehicles.csv");
  const auto sections = describe_run(folder.path());
  CHECK(titles_of(sections)
        == std::vector<std::string>{"Drive", "Key figures",
                                    "Remote results of trajectory_planning",
                                    "Over time", "Episodes", "Configuration"});
  CHECK(first_of<paragraph>(sections, "Drive").text.find("killed")
        != std::string::npos);
  CHECK(first_of<table>(sections, "Episodes").rows.size() == 3);
}

TEST_CASE("what a kill left of a line is dropped") {
  const played_folder folder;
  std::filesystem::remove(folder.path() / "summary.json");
  const auto whole = describe_run(folder.path());
  for (const auto* name :
       {"episodes.csv", "cycles.csv", "tracks.csv", "events.jsonl"}) {
    std::ofstream file{folder.path() / name, std::ios::app};
    file << (std::string_view{name}.ends_with("csv") ? "101,\"to"
                                                     : "{\"t_s\":");
  }
  CHECK(first_of<table>(describe_run(folder.path()), "Episodes").rows
        == first_of<table>(whole, "Episodes").rows);
  for (const auto* name : {"episodes.csv", "cycles.csv"})
    std::ofstream{folder.path() / name}; // killed before its first line
  CHECK_NOTHROW(describe_run(folder.path()));
}

TEST_CASE("a run without cycles and tracks is shown without them") {
  const played_folder folder;
  std::filesystem::remove(folder.path() / "cycles.csv");
  std::filesystem::remove(folder.path() / "tracks.csv");
  const auto sections = describe_run(folder.path());
  CHECK(titles_of(sections)
        == std::vector<std::string>{"In short", "Drive", "Key figures",
                                    "Over time", "Episodes", "Vehicles",
                                    "Configuration"});
  const auto page = html({"", "", sections});
  const auto text = document_in(page).dump();
  CHECK(text.find("\"has_tracks\":false") != text.npos);
}

TEST_CASE("a run comes down to figures, a point for each result and a row for "
          "each episode") {
  const played_folder folder;
  const auto sections = describe_run(folder.path());
  const auto& key = first_of<table>(sections, "Key figures");
  CHECK(key.columns == std::vector<std::string>{"figure", "value"});
  CHECK(cell(key, "length, s", 1) == "100.0");

  const auto& by_time =
      first_of<figure>(sections, "Remote results of trajectory_planning");
  CHECK(by_time.curves.at(0).y.size() == 401);
  CHECK(by_time.curves.at(0).name == "mec");
  CHECK(by_time.curves.at(0).provider == 0);
  CHECK(by_time.curves.at(0).stations.size() == 401);
  REQUIRE(by_time.levels.size() == 1);
  CHECK(by_time.levels[0].second == "limit 50 ms");
  CHECK(by_time.by_clock);
  CHECK(std::ranges::is_sorted(by_time.curves.at(0).x));

  const auto& episodes = first_of<table>(sections, "Episodes");
  REQUIRE(episodes.rows.size() == 3);
  CHECK(episodes.rows[0].at(0) == "101");
  CHECK(episodes.rows[0].at(10) == "400");   // results
  CHECK(episodes.rows[0].at(11) == "10.00"); // mean latency
  CHECK(episodes.rows[0].at(13) == "50.00"); // longest gap
  CHECK(episodes.rows[1].at(9) == "yes");    // a fallback
  CHECK(episodes.rows[2].at(10) == "");      // no data
}

TEST_CASE("results that stand out of order are drawn in the order of time") {
  const played_folder folder;
  const auto text = folder.read("cycles.csv");
  const auto first = text.find('\n') + 1;
  const auto second = text.find('\n', first) + 1;
  folder.write("cycles.csv", text.substr(0, first) + text.substr(second)
                                 + text.substr(first, second - first));
  const auto sections = describe_run(folder.path());
  const auto& by_time =
      first_of<figure>(sections, "Remote results of trajectory_planning");
  CHECK(by_time.curves.at(0).y.size() == 401);
  CHECK(std::ranges::is_sorted(by_time.curves.at(0).x));
}

TEST_CASE("a tail begins at one and ends with the largest value's share") {
  const played_folder folder;
  const auto sections = describe_run(folder.path());
  auto tails = 0;
  for (const auto& block : sections[3].blocks) {
    const auto& shown = std::get<figure>(block);
    if (shown.by_clock)
      continue;
    ++tails;
    const auto& tail = shown.curves.at(0);
    CHECK(tail.drawn == curve::style::tail);
    CHECK(std::ranges::is_sorted(tail.x));
    CHECK(tail.y.front() == 1);
    CHECK(tail.y.back()
          == doctest::Approx(1.0 / static_cast<double>(tail.y.size())));
    CHECK(tail.stations.size() == tail.x.size());
  }
  CHECK(tails == 3);
}

TEST_CASE("the age of inputs is drawn beside the latency") {
  const played_folder folder;
  const auto title = "Remote results of trajectory_planning";
  const auto sections = describe_run(folder.path());
  std::vector<std::string> titles;
  for (const auto& one : sections)
    if (one.title == title)
      for (const auto& block : one.blocks) {
        titles.push_back(std::get<figure>(block).title);
      }
  CHECK(titles
        == std::vector<std::string>{
            "Latency by time", "Latency, distribution",
            "Age of the input by time", "Age of the input, distribution",
            "Inter-arrival time by time", "Inter-arrival time, distribution"});
}

TEST_CASE("cycles of a version without ages of inputs are shown without them") {
  const played_folder folder;
  folder.spoil("cycles.csv", "input_age_ms", "another");
  const auto sections = describe_run(folder.path());
  for (const auto& one : sections)
    if (one.title == "Remote results of trajectory_planning")
      CHECK(one.blocks.size() == 4);
}

TEST_CASE("a column of episodes.csv that the report does not know is shown") {
  const played_folder folder;
  auto text = folder.read("episodes.csv");
  const auto head = text.find('\n');
  text.insert(head, ",another");
  for (auto at = text.find('\n', head + 9); at != text.npos;
       at = text.find('\n', at + 12))
    text.insert(at, ",31 ms > 30");
  folder.write("episodes.csv", text);
  const auto sections = describe_run(folder.path());
  const auto& episodes = first_of<table>(sections, "Episodes");
  CHECK(episodes.columns.back() == "another");
  for (const auto& row : episodes.rows)
    CHECK(row.back() == "31 ms > 30");
}

TEST_CASE("the table of episodes says why each ended") {
  const played_folder folder;
  folder.spoil("episodes.csv", "left_area,0,", "left_area,0,x_m=300.000");
  const auto sections = describe_run(folder.path());
  const auto& episodes = first_of<table>(sections, "Episodes");
  const auto why = std::ranges::find(episodes.columns, "why");
  REQUIRE(why != episodes.columns.end());
  CHECK(*std::prev(why) == "ended by");
  CHECK(episodes.rows[0][why - episodes.columns.begin()] == "x_m=300.000");
}

TEST_CASE("why an episode ended is told by the side that ended it") {
  const played_folder folder;
  folder.spoil("episodes.csv", "left_area,0,\n",
               "left_area,0,told by the provider\n");
  const auto sections = describe_run(folder.path());
  const auto& episodes = first_of<table>(sections, "Episodes");
  const auto why = std::ranges::find(episodes.columns, "why");
  CHECK(episodes.rows[0][why - episodes.columns.begin()] == "x_m=1 y_m=2");
}

TEST_CASE("the gap that ended an episode is one of its gaps") {
  const auto longest_ms = [](const played_folder& folder) {
    const auto sections = describe_run(folder.path());
    const auto& episodes = first_of<table>(sections, "Episodes");
    const auto gap = std::ranges::find(episodes.columns, "longest gap, ms");
    REQUIRE(gap != episodes.columns.end());
    return std::stod(episodes.rows[0][gap - episodes.columns.begin()]);
  };
  const played_folder folder;
  const auto before = longest_ms(folder);
  folder.spoil("episodes.csv", "30.000000000,20.000000000,left_area,0,",
               "33.000000000,23.000000000,qos_gap,0,");
  CHECK(longest_ms(folder) > before + 2900);
}

TEST_CASE("near misses are counted apart from QoS events") {
  const played_folder folder;
  folder.write(
      "events.jsonl",
      folder.read("events.jsonl")
          + R"({"t_s":66,"what":"near_miss","station":101,)"
            R"("provider":"","provider_id":0,"service":"",)"
            R"("counter":0,"detail":"with 102 ttc_s=1.463 limit_s=1.500"})"
            "\n");
  const auto got = document_in(html({"", "", describe_run(folder.path())}));
  std::map<std::string, int> groups;
  for (const auto& event : got["sections"][1]["blocks"][0]["events"])
    ++groups[event[6]];
  CHECK(groups["qos"] == 1);
  CHECK(groups["near_miss"] == 1);
  const auto sections = describe_run(folder.path());
  for (const auto& one : sections)
    if (one.title == "Key figures")
      for (const auto& block : one.blocks)
        if (const auto& t = std::get<table>(block);
            t.title == "Safety, comfort and energy")
          CHECK(cell(t, "near misses", 1) == "0"); // as the summary says
}

TEST_CASE("folders of the same name are known by their paths") {
  const played_folder one;
  const played_folder other;
  const auto runs = open_runs(std::array{one.path(), other.path()});
  CHECK(runs[0].label == one.path().string());
  CHECK(runs[1].label == other.path().string());
}

} // namespace sofof::experiments::report
