// Templates of the paper's evaluation: figures and placeholders belong
// together.
#include "experiments/dehler2025/report_text.hpp"

#include "tests/support/contains.hpp"
#include "tests/support/files.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <stdexcept>
#include <vector>

namespace sofof::experiments::study {

using test::contains;

namespace {

const std::filesystem::path sources{SOFOF_SOURCE_DIR};

report_text two_parts() {
  return {"two", "# Two parts\n\n## first\nFrom {a_s} s\nto {b} of {a_s}.\n\n"
                 "## second\nNo figure.\n"};
}

} // namespace

TEST_CASE("a part is one line with its figures in their places") {
  const auto text = two_parts();
  CHECK(text.parts() == std::vector<std::string>{"first", "second"});
  CHECK(text.fill("first", {{"a_s", "1.5"}, {"b", "{a_s}"}})
        == "From 1.5 s to {a_s} of 1.5.");
  CHECK(text.fill("second") == "No figure.");
}

TEST_CASE("a placeholder without a figure is an error") {
  CHECK_THROWS_WITH_AS(two_parts().fill("first", {{"a_s", "1"}}),
                       "two: nothing stands for {b} in first",
                       std::logic_error);
}

TEST_CASE("a figure that no placeholder uses is an error") {
  CHECK_THROWS_WITH_AS(two_parts().fill("second", {{"a_s", "1"}}),
                       "two: second does not mention a_s", std::logic_error);
}

TEST_CASE("a part that there is not, or a text, is an error") {
  CHECK_THROWS_AS(two_parts().fill("third"), std::logic_error);
  CHECK_THROWS_AS(report_text::of("no_such_text"), std::logic_error);
}

TEST_CASE("a template with loose words, or empty or double parts, is refused") {
  for (const auto* broken :
       {"Words.\n## part\nMore.\n", "## part\n", "## part\n\n## next\nWords.\n",
        "## part\nOne.\n## part\nTwo.\n", ""}) {
    CAPTURE(broken);
    CHECK_THROWS_AS((report_text{"broken", broken}), std::logic_error);
  }
}

TEST_CASE("every part of the evaluation's texts is used by its section") {
  int texts = 0;
  for (const auto& file :
       std::filesystem::directory_iterator{sources / "config/paper/text"}) {
    ++texts;
    const auto name = file.path().stem().string();
    CAPTURE(name);
    CHECK(template_of(name) == test::read_file(file.path()));
    const auto user = name == "report" ? "reproduce" : name;
    auto code =
        test::read_file(sources / "experiments/dehler2025" / (user + ".cpp"));
    if (name == "verdicts") // whose parts are the claims
      code += test::read_file(sources / "experiments/dehler2025/claims.cpp");
    for (const auto& part : report_text::of(name).parts()) {
      CAPTURE(part);
      CHECK(contains(code, '"' + part + '"'));
    }
  }
  CHECK(texts == 9);
}

TEST_CASE("small numbers are words") {
  CHECK(counted(0, "run") == "no runs");
  CHECK(counted(1, "run") == "one run");
  CHECK(counted(10, "run") == "ten runs");
  CHECK(in_words(12) == "twelve");
  CHECK(counted(13, "seed") == "13 seeds");
}

TEST_CASE("numbers are listed, of many the first") {
  CHECK(in_a_list({}) == "none");
  CHECK(in_a_list(std::vector<std::int64_t>{3, 17}) == "3, 17");
  CHECK(in_a_list(std::vector<std::int64_t>(21, 7))
            .ends_with("7, … (21 in all)"));
}

} // namespace sofof::experiments::study
