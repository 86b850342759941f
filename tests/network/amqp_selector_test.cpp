// Which messages a selector selects.
#include "network/amqp/selector.hpp"
#include "network/network_error.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <string>

using namespace sofof;
using network::amqp::selector;

namespace {

const network::amqp::properties of_cpm{
    {"mid", std::uint16_t{2049}},
    {"station_id", std::uint32_t{102}},
    {"latitude", 48.4},
    {"messageType", std::string{"CPM"}},
    {"quadTree", std::string{",120221112001033211,"}},
    {"relayed", false},
    {"raw", std::vector<std::byte>{std::byte{1}}}};

bool selects(std::string_view text) {
  return selector{text}.matches(of_cpm);
}

std::string complaint_about(const std::string& text) {
  try {
    selector{text};
    return "";
  } catch (const network::network_error& e) {
    return e.what();
  }
}

} // namespace

TEST_CASE("a selector compares properties with numbers and texts") {
  CHECK(selector{}.matches(of_cpm));
  CHECK(selects("mid = 2049"));
  CHECK_FALSE(selects("mid = 2050"));
  CHECK(selects("mid <> 2050 AND mid >= 2049 AND mid <= 2049"));
  CHECK(selects("mid > 2048 and mid < 2050 and latitude = 48.4"));
  CHECK(selects("messageType = 'CPM'"));
  CHECK(selects("NOT relayed AND relayed = FALSE"));
  CHECK(selects("mid BETWEEN 2048 AND 2050"));
  CHECK(selects("mid NOT BETWEEN 2050 AND 2052"));
  CHECK(selects("messageType IN ('CAM', 'CPM') AND mid NOT IN (1, 2)"));
}

TEST_CASE("the selector of the institute's receivers leaves out one's own") {
  CHECK(selects("NOT(station_id = 101) AND mid = 2049"));
  CHECK_FALSE(selects("NOT(station_id = 102) AND mid = 2049"));
}

TEST_CASE("an area is selected by the beginning of its tiles' keys") {
  CHECK(selects("quadTree LIKE '%,1202211%'"));
  CHECK_FALSE(selects("quadTree LIKE '%,1302211%'"));
  CHECK(selects("messageType = 'CAM' OR (messageType = 'CPM' AND (quadTree "
                "like '%,0123%' or quadTree like '%,12022%'))"));
  CHECK(selects("messageType LIKE 'C_M'"));
  CHECK_FALSE(selects("messageType LIKE 'C!_M' ESCAPE '!'"));
  CHECK(selects("messageType NOT LIKE 'D%'"));
}

TEST_CASE("what is missing or of another type is neither so nor not so") {
  CHECK(selects("destination_station_id IS NULL"));
  CHECK(selects("mid IS NOT NULL"));
  for (const auto* text :
       {"destination_station_id = 101", "NOT(destination_station_id = 101)",
        "messageType = 5", "NOT(messageType = 5)", "raw = 1", "NOT raw",
        "messageType < 'D'", "destination_station_id LIKE '%'"}) {
    CAPTURE(text);
    CHECK_FALSE(selects(text));
  }
  CHECK(selects("destination_station_id = 101 OR mid = 2049"));
  CHECK_FALSE(selects("destination_station_id = 101 AND mid = 2049"));
}

TEST_CASE("what is no selector is refused, with the place") {
  CHECK(complaint_about("mid =")
        == "the selector needs a name, a number or a text in single quotes at "
           "character 6");
  for (const auto* text :
       {"mid 2049", "(mid = 1", "mid = 'a", "mid IN 1", "mid = 1)", "NOT",
        "mid BETWEEN 1 OR 2", "mid = -inf", "mid = -nan", "1 IS NULL",
        "mid LIKE 5", "mid = 1 AND", "?"}) {
    CAPTURE(text);
    CHECK(complaint_about(text).starts_with("the selector needs "));
  }
  CHECK(complaint_about(std::string(100'000, '('))
        == "the selector is longer than 4096 characters");
  CHECK(complaint_about(std::string(4000, '('))
        == "the selector is deeper than 64 levels");
  std::string nots;
  for (int i = 0; i < 1000; ++i)
    nots += "NOT ";
  CHECK(complaint_about(nots + "mid")
        == "the selector is deeper than 64 levels");
}

TEST_CASE("what would take long is not looked for") {
  std::string all = "mid = 1";
  for (int i = 0; i < 400; ++i)
    all += " OR a=1";
  CHECK(complaint_about(all) == "the selector has more than 256 operands");
  auto long_text = of_cpm;
  long_text["quadTree"] = std::string(60'000, 'a');
  const selector pattern{"quadTree LIKE '%" + std::string(4000, 'a') + "b'"};
  CHECK_FALSE(pattern.matches(long_text));
  CHECK_FALSE(selector{"quadTree NOT LIKE 'b'"}.matches(long_text));
  CHECK(selector{"  "}.matches(long_text));
}

TEST_CASE("a selector of anything is read or refused") {
  const std::string_view words[] = {
      "mid", "station_id", "NOT",  "AND", "OR",   "(",  ")",    "=",
      "<",   "'C%'",       "LIKE", "IN",  "NULL", "IS", "2049", ",",
      "'",   "BETWEEN",    "TRUE", "-",   "1e9",  "<>", " ",    "\xff"};
  test::dice dice{1};
  const auto below = [&dice](std::size_t n) {
    return static_cast<std::size_t>(dice.between(0, static_cast<double>(n)));
  };
  for (int i = 0; i < 20'000; ++i) {
    std::string text;
    for (auto n = below(12); n > 0; --n) {
      text += words[below(std::size(words))];
      text += below(3) > 0 ? " " : "";
    }
    CAPTURE(text);
    try {
      selector{text}.matches(of_cpm);
    } catch (const network::network_error&) {
    }
  }
}
