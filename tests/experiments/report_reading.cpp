// Reading results folders: what is in them, and what is wrong with them.
#include "experiments/report/describe.hpp"
#include "experiments/report/html.hpp"
#include "experiments/report/recorded_run.hpp"
#include "tests/experiments/report_folder.hpp"
#include "tests/support/mistakes.hpp"
#include "tests/support/report_document.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <fstream>

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

/// @returns the first block of a kind.
template <class Block>
const Block& first_of(std::span<const section> sections,
                      std::string_view title) {
  for (const auto& one : sections)
    if (one.title == title)
      for (const auto& block : one.blocks)
        if (const auto* found = std::get_if<Block>(&block))
          return *found;
  FAIL("there is no such block in ", title);
  throw std::logic_error{"unreachable"};
}

const std::string& cell(const table& in, std::string_view row,
                        std::size_t column) {
  const auto found = std::ranges::find(in.rows, row, [](const auto& cells) {
    return std::string_view{cells[0]};
  });
  REQUIRE(found != in.rows.end());
  return found->at(column);
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
             {"23 fields", "12 columns"}},
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
             "\"detail\":\"\"",
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
                                    "Episodes", "Configuration"});
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
        == std::vector<std::string>{"Drive", "Key figures", "Episodes",
                                    "Vehicles", "Configuration"});
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
  CHECK(by_time.curves.at(1).name == "limit 50 ms");
  CHECK(std::ranges::is_sorted(by_time.curves.at(0).x));

  const auto& episodes = first_of<table>(sections, "Episodes");
  REQUIRE(episodes.rows.size() == 3);
  CHECK(episodes.rows[0].at(0) == "101");
  CHECK(episodes.rows[0].at(9) == "400");    // results
  CHECK(episodes.rows[0].at(10) == "10.00"); // mean latency
  CHECK(episodes.rows[0].at(12) == "50.00"); // longest gap
  CHECK(episodes.rows[1].at(8) == "yes");    // a fallback
  CHECK(episodes.rows[2].at(9) == "");       // no data
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

TEST_CASE("a distribution reaches one at its largest value") {
  const played_folder folder;
  const auto sections = describe_run(folder.path());
  for (const auto& block : sections[2].blocks) {
    const auto& shown = std::get<figure>(block);
    if (shown.y_label != "share of results")
      continue;
    CHECK(std::ranges::is_sorted(shown.curves.at(0).x));
    CHECK(shown.curves.at(0).y.back() == 1);
    CHECK(shown.marks.size() == 1);
  }
}

TEST_CASE("two runs are compared side by side") {
  const played_folder one{"one"};
  const played_folder other{"other"};
  other.spoil("summary.json", "\"virtual_s\": 100", "\"virtual_s\": 80");
  other.spoil("config.toml", "seed = 7", "seed = 8");
  const auto sections = compare_runs(one.path(), other.path());
  const auto& key = first_of<table>(sections, "Key figures");
  CHECK(key.columns
        == std::vector<std::string>{"figure", "one", "other", "difference"});
  CHECK(cell(key, "length, s", 1) == "100.0");
  CHECK(cell(key, "length, s", 2) == "80.0");
  CHECK(cell(key, "length, s", 3) == "-20.0");
  CHECK(cell(key, "vehicles", 3) == "0");
  CHECK(std::ranges::count_if(sections[0].blocks,
                              [](const auto& block) {
                                return std::holds_alternative<drive>(block);
                              })
        == 2);
  const auto& by_time =
      first_of<figure>(sections, "Remote results of trajectory_planning");
  CHECK(by_time.curves.at(0).name == "one");
  CHECK(by_time.curves.at(1).name == "other");
  const auto& options = first_of<table>(sections, "Configuration");
  REQUIRE(options.rows.size() == 1);
  CHECK(options.rows[0] == std::vector<std::string>{"seed", "7", "8"});
}

TEST_CASE("of more than two runs the key figures come first, then each run") {
  const played_folder one{"a"};
  const played_folder two{"b"};
  const played_folder three{"c"};
  const std::array folders{one.path(), two.path(), three.path()};
  const auto whole = describe(folders, "0.1.0");
  CHECK(whole.title == "a · b · c");
  CHECK(whole.sections.front().title == "Key figures");
  CHECK(first_of<table>(whole.sections, "Key figures").columns
        == std::vector<std::string>{"figure", "a", "b", "c"});
  CHECK(first_of<drive>(whole.sections, "c: Drive").folder == three.path());
}

TEST_CASE("folders of the same name are known by their paths") {
  const played_folder one;
  const played_folder other;
  const auto runs = open_runs(std::array{one.path(), other.path()});
  CHECK(runs[0].label == one.path().string());
  CHECK(runs[1].label == other.path().string());
}

} // namespace sofof::experiments::report
