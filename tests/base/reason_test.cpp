// A reason in words, with its number or without.
#include "base/reason.hpp"

#include "base/text/words.hpp"

#include <doctest/doctest.h>

using namespace sofof;

TEST_CASE("a reason tells the number that decided, and its limit") {
  CHECK(reason{"no room", 0.9, 0.8}.told()
        == "no room value=0.900 limit=0.800");
  CHECK(reason{"nobody offers it"}.told() == "nobody offers it");
  CHECK(reason{}.told().empty());
  CHECK(reason{}.empty());
}

TEST_CASE("reasons are counted by their words, whatever the numbers") {
  for (const reason& x : {reason{"no room", 0.9, 0.8}, reason{"no room"}})
    CHECK(reason::words_of(x.told()) == "no room");
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
