// What a report says first, and what it says of load.
#include "experiments/report/describe.hpp"
#include "tests/experiments/report_folder.hpp"
#include "tests/support/contains.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace sofof::experiments::report {

using namespace made_up;
using test::contains;

namespace {

const section* find(const std::vector<section>& all, std::string_view title) {
  const auto found = std::ranges::find(all, title, &section::title);
  return found == all.end() ? nullptr : &*found;
}

/// The played run with the load of a provider with workers and an uplink.
struct loaded_folder : played_folder {
  loaded_folder() {
    write("load.csv",
          "t_s,provider,what,jobs,asked_share,busy_share,mean_wait_ms,"
          "max_wait_ms\n"
          "0,mec,workers,20,0.25,0.25,1.0,3.0\n"
          "1,mec,workers,20,0.50,0.50,2.0,5.0\n"
          "0,mec,uplink,20,4.06,1.00,400.0,800.0\n"
          "1,mec,uplink,0,0.00,1.00,,\n");
    write("octets.csv",
          "t_s,provider,direction,what,messages,sent,delivered,lost,under_way"
          "\n0,mec,up,CAM,7,1000,900,100,0\n"
          "1,mec,up,CAM,3,360,360,0,0\n"
          "5,mec,up,CAM,1,125,125,0,0\n");
    spoil("summary.json", "\"load\": {}",
          "\"load\": {\"mec\": {\"uplink\": {\"busy_share\": 0.997, "
          "\"peak_share\": 4.057, \"wait_ms\": {\"mean\": 5420.2}}}}");
  }
};

} // namespace

TEST_CASE("a report of one run begins with the run in sentences") {
  const played_folder folder;
  const auto all = describe_run(folder.path());
  REQUIRE_FALSE(all.empty());
  CHECK(all.front().title == "In short");
  REQUIRE(all.front().blocks.size() == 1);
  const auto& said = std::get<paragraph>(all.front().blocks.front()).text;
  CHECK(said.starts_with(
      "Offloaded trajectory_planning 17.5 % of the time; 1 of 3 episodes"));
  CHECK(contains(said, " Safe: "));
}

TEST_CASE("each figure, and each column of a file, says what it means") {
  const loaded_folder folder;
  const auto sections = describe_run(folder.path());
  for (const auto& one : sections)
    for (const auto& block : one.blocks) {
      const auto* shown = std::get_if<table>(&block);
      if (shown == nullptr)
        continue;
      CAPTURE(shown->title);
      if (one.title == "Key figures") {
        REQUIRE(shown->row_meanings.size() == shown->rows.size());
        for (std::size_t i = 0; i < shown->rows.size(); ++i) {
          CAPTURE(shown->rows[i][0]);
          CHECK(shown->row_meanings[i] != "");
        }
      } else {
        REQUIRE(shown->column_meanings.size() == shown->columns.size());
        for (std::size_t i = 0; i < shown->columns.size(); ++i) {
          CAPTURE(shown->columns[i]);
          CHECK(shown->column_meanings[i] != "");
        }
      }
    }
}

TEST_CASE("load has a table, a figure for each kind of server, and octets in "
          "all and by time") {
  const loaded_folder folder;
  const auto all = describe_run(folder.path());
  const auto* load = find(all, "Load");
  REQUIRE(load);
  REQUIRE(load->blocks.size() == 7);
  const auto& servers = std::get<table>(load->blocks[0]);
  REQUIRE(servers.rows.size() == 2);
  CHECK(servers.rows[0]
        == std::vector<std::string>{"mec", "uplink", "99.7", "", "405.7", "",
                                    "5420.20", "", ""});
  const auto& workers = std::get<figure>(load->blocks[1]);
  CHECK(workers.title == "Asked of workers by time");
  REQUIRE(workers.curves.size() == 1);
  CHECK(workers.curves[0].y == std::vector<double>{25, 50});
  CHECK(workers.curves[0].provider == 0);
  const auto& waits = std::get<figure>(load->blocks[2]);
  CHECK(waits.title == "Waits for workers by time");
  REQUIRE(waits.curves.size() == 2);
  CHECK(waits.curves[0].name == "mec, mean");
  CHECK(waits.curves[0].y == std::vector<double>{1, 2});
  CHECK(waits.curves[1].name == "mec, longest");
  CHECK(waits.curves[1].y == std::vector<double>{3, 5});
  const auto& uplink = std::get<figure>(load->blocks[3]);
  CHECK(uplink.title == "Asked of the uplink by time");
  CHECK(uplink.curves.at(0).y.at(0) == doctest::Approx(406));
  CHECK(std::isnan(std::get<figure>(load->blocks[4]).curves.at(0).y.at(1)));
  const auto& octets = std::get<table>(load->blocks[5]);
  CHECK(octets.rows.at(0)
        == std::vector<std::string>{"mec", "up", "CAM", "11", "1485", "1385",
                                    "100", "0"});
  const auto& by_time = std::get<figure>(load->blocks[6]);
  CHECK(by_time.title == "On the air of mec by time");
  REQUIRE(by_time.curves.size() == 1);
  CHECK(by_time.curves[0].name == "CAM up");
  CHECK(by_time.curves[0].x == std::vector<double>{0, 1, 2, 4, 5});
  CHECK(by_time.curves[0].y == std::vector<double>{8, 2.88, 0, 0, 1});
}

TEST_CASE("of many providers pictures show those that were asked most, and "
          "tables show all") {
  const loaded_folder folder;
  std::string lines = "t_s,provider,what,jobs,asked_share,busy_share,"
                      "mean_wait_ms,max_wait_ms\n";
  std::string figures;
  for (int k = 10; k < 30; ++k) {
    const auto name = "mec_" + std::to_string(k);
    lines += "0," + name + ",workers,1,0.01,0.01,1.0,1.0\n";
    figures += ", \"" + name + "\": {\"workers\": {\"asked_share\": 0."
               + std::to_string(k) + "}}";
  }
  folder.write("load.csv", lines);
  folder.spoil("summary.json", "5420.2}}}", "5420.2}}}" + figures);
  const auto all = describe_run(folder.path());
  const auto* load = find(all, "Load");
  REQUIRE(load);
  CHECK(std::get<table>(load->blocks.at(0)).rows.size() == 20);
  CHECK(std::get<paragraph>(load->blocks.at(1)).text
        == "Pictures show the 12 providers of 20 that were asked most.");
  const auto& workers = std::get<figure>(load->blocks.at(2));
  REQUIRE(workers.curves.size() == 12);
  CHECK(workers.curves.front().name == "mec_18");
  CHECK(workers.curves.back().name == "mec_29");
}

TEST_CASE("beside a run with load one without any is named") {
  const loaded_folder loaded;
  const played_folder idle{"idle"};
  const auto all = compare_runs(loaded.path(), idle.path());
  const auto* load = find(all, "Load");
  REQUIRE(load);
  CHECK(std::get<paragraph>(load->blocks.at(1)).text.starts_with("`idle`: "));
}

TEST_CASE("a run that has measured no load has no section about it") {
  const played_folder folder;
  CHECK_FALSE(find(describe_run(folder.path()), "Load"));
}

} // namespace sofof::experiments::report
