// docs/claims.md: all rows, files that are there, and each computed claim.
#include "experiments/dehler2025/claims.hpp"
#include "tests/support/files.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace sofof::experiments::study {

namespace {

const std::filesystem::path root{SOFOF_SOURCE_DIR};

constexpr std::size_t rows_of_the_paper = 72;

struct page_row {
  std::string number;
  std::string claim;
  std::string where;
  std::string how;
  std::string verdict;
};

std::vector<page_row> rows_of(const std::string& page) {
  static const std::regex row{R"(\| (\d+) \| (.+) \| (.+) \| (.+) \| (.+) \|)"};
  std::vector<page_row> all;
  std::istringstream lines{page};
  for (std::string line; std::getline(lines, line);) {
    std::smatch found;
    if (std::regex_match(line, found, row))
      all.push_back({found[1], found[2], found[3], found[4], found[5]});
  }
  return all;
}

/// @returns what stands in backquotes.
std::vector<std::string> quoted_in(const std::string& text) {
  static const std::regex quoted{"`([^`]+)`"};
  std::vector<std::string> all;
  for (std::sregex_iterator at{text.begin(), text.end(), quoted}, end;
       at != end; ++at)
    all.push_back((*at)[1]);
  return all;
}

std::vector<page_row> the_page() {
  return rows_of(test::read_file(root / "docs/claims.md"));
}

} // namespace

TEST_CASE("the page of claims has each row of the paper once, in order") {
  const auto rows = the_page();
  REQUIRE(rows.size() == rows_of_the_paper);
  for (std::size_t i = 0; i < rows.size(); ++i)
    CHECK(rows[i].number == std::to_string(i + 1));
}

TEST_CASE("every file that the page of claims names is there") {
  for (const auto& row : the_page()) {
    CAPTURE(row.number);
    CHECK_FALSE(quoted_in(row.where).empty());
    for (const auto& text : {row.where, row.how})
      for (const auto& file : quoted_in(text)) {
        CAPTURE(file);
        CHECK(std::filesystem::is_regular_file(root / file));
      }
  }
}

TEST_CASE("each computed claim is in one row, which has no verdict by hand") {
  std::multiset<std::string> computed;
  for (const auto& row : the_page()) {
    CAPTURE(row.number);
    const auto names = quoted_in(row.verdict);
    if (row.verdict.starts_with("computed: "))
      CHECK_FALSE(names.empty());
    else
      CHECK(std::set<std::string>{"reproduced", "in part", "otherwise",
                                  "missing", "not ours"}
                .contains(row.verdict));
    computed.insert(names.begin(), names.end());
  }
  std::multiset<std::string> judged;
  for (const auto& claim : judge({}))
    judged.insert(claim.name);
  CHECK(computed == judged);
}

TEST_CASE("what is reproduced or in part is shown by a test, a file, or says "
          "what is missing") {
  for (const auto& row : the_page())
    if (row.verdict == "reproduced") {
      CAPTURE(row.number);
      CHECK((row.how.find("`tests/") != row.how.npos || row.how == "the file"));
    }
}

} // namespace sofof::experiments::study
