// A reason in words, with its number or without.
#include "base/reason.hpp"

#include "base/text/words.hpp"

#include <doctest/doctest.h>

using namespace sofof;

TEST_CASE("a reason tells the number that decided, and its limit") {
  CHECK(reason{"no room", 0.9, 0.8}.text() == "no room value=0.9 limit=0.8");
  CHECK(reason{"too short", 3.2, 5, "m"}.text()
        == "too short value_m=3.2 limit_m=5");
  // A value beyond its limit does not read as if it were the limit.
  CHECK(reason{"no room", 0.80002, 0.8}.text()
        == "no room value=0.80002 limit=0.8");
  CHECK(reason{"nobody offers it"}.text() == "nobody offers it");
  CHECK(reason{}.text().empty());
  CHECK(reason{}.empty());
}

TEST_CASE("reasons are counted by their words, whatever the numbers") {
  for (const reason& x : {reason{"no room", 0.9, 0.8}, reason{"no room"},
                          reason{"no room", 1, 2, "s"}})
    CHECK(reason::words_of(x.text()) == "no room");
  CHECK(reason{"no room", 0.9, 0.8} == "no room");
  CHECK_FALSE(reason{"no room"} == "no answer");
}

TEST_CASE("a text has the words between its spaces, and no part of one") {
  std::string text;
  for (const auto* word : {"planning", "climate"})
    add_word(text, word);
  CHECK(text == "planning climate");
  CHECK(has_word(text, "planning"));
  CHECK(has_word(text, "climate"));
  CHECK_FALSE(has_word(text, "plan"));
  CHECK_FALSE(has_word("", "planning"));
}
