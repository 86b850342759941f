// `sofof report` as a user meets it: where the file goes, and what is refused.
#include "tests/processes/workplace.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/report_document.hpp"

using namespace sofof::test;

namespace {

/// Checks that words are refused with one sentence and nothing is touched.
void check_refused(const workplace& at, const std::vector<std::string>& words,
                   std::string_view says) {
  CAPTURE(words);
  const auto before = at.inventory();
  const auto end = at.run_sofof(words);
  CAPTURE(end.err);
  CHECK(end.code == 2);
  CHECK(end.out == "");
  CHECK(end.err.starts_with("sofof: "));
  CHECK(contains(end.err, says));
  CHECK(end.err.find('\n') == end.err.size() - 1);
  CHECK(at.inventory() == before);
}

} // namespace

TEST_CASE("a report goes into the first folder, or where it is wanted") {
  const workplace at;
  at.drive("one", {"--duration", "2s"});
  at.drive("two", {"--duration", "2s"});
  CHECK(at.run_sofof({"report", "one"}).out == "report in one/report.html\n");
  CHECK(contains(read_file(at / "one/report.html"), "<title>one</title>"));

  CHECK(at.run_sofof({"report", "one/", "two", "-o", "both.html"}).out
        == "report in both.html\n");
  CHECK(contains(read_file(at / "both.html"), "<title>one · two</title>"));

  at.write("both.html", "an older one");
  CHECK(at.run_sofof({"report", "two", "--out", "both.html"}).code == 0);
  CHECK(contains(read_file(at / "both.html"), "<title>two</title>"));
}

TEST_CASE("a report that cannot be is refused, and nothing is touched") {
  const workplace at;
  at.drive("one", {"--duration", "2s"});
  check_refused(at, {"report", "nowhere"}, "no results folder");
  check_refused(at, {"report", "one", "config"}, "no results folder");
  check_refused(at, {"report", "one", "-o", "nowhere/report.html"},
                "choose another file with -o");
  check_refused(at, {"report", "one", "-o", "config"},
                "choose another file with -o");
  check_refused(at, {"report", "one", "-o", "one/../one/cycles.csv"},
                "one of the run's results");
  at.write("one/tracks.csv", "t_s,station\n1,");
  check_refused(at, {"report", "one"}, "tracks.csv:1: ");
}

TEST_CASE("the report of a run that was killed says so") {
  const workplace at;
  std::filesystem::remove(at.drive("one", {"--duration", "2s"})
                          / "summary.json");
  CHECK(at.run_sofof({"report", "one"}).code == 0);
  const auto page = read_file(at / "one/report.html");
  CHECK(contains(sofof::experiments::report::document_in(page).dump(),
                 "This run was killed"));
}

TEST_CASE("a full disk leaves the older report as it was") {
  const workplace at;
  at.drive("one", {"--duration", "2s"});
  at.write("one/report.html", "an older one");
  const auto end = at.run_sofof({"report", "one"}, {.largest_file = 64 * 1024});
  CHECK(end.code == 2);
  CHECK(contains(end.err, "choose another file with -o"));
  CHECK(read_file(at / "one/report.html") == "an older one");
  CHECK_FALSE(std::filesystem::exists(at / "one/report.html.tmp"));
}
