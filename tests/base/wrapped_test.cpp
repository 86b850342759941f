// Tests of text in lines that end between words.
#include "base/text/wrapped.hpp"

#include <doctest/doctest.h>

using sofof::wrapped;

TEST_CASE("lines end between words and begin below each other") {
  CHECK(wrapped("  name  one two three four", 14, 8)
        == "  name  one\n        two\n        three\n        four");
  CHECK(wrapped("one two three", 80) == "one two three");
  CHECK(wrapped("one two three", 7) == "one two\nthree");
  CHECK(wrapped("one\n\n  two three\n", 7, 2) == "one\n\n  two\n  three\n");
  CHECK(wrapped("", 10) == "");
}

TEST_CASE("a word that is too long stands alone") {
  CHECK(wrapped("a tremendous word", 5) == "a\ntremendous\nword");
}

TEST_CASE("letters count, not their bytes") {
  CHECK(wrapped("äöü äöü", 7) == "äöü äöü");
  CHECK(wrapped("äöü äöü", 6) == "äöü\näöü");
}
