// Whatever is done to a results folder, it is shown or it is refused.
#include "base/random.hpp"
#include "experiments/report/describe.hpp"
#include "experiments/report/html.hpp"
#include "tests/experiments/report_folder.hpp"

#include <doctest/doctest.h>

#include <array>

namespace sofof::experiments::report {

using namespace made_up;

namespace {

/// Any other exception than `input_error` ends the test.
struct report_tally {
  int shown = 0;
  int refused = 0;

  void count(const played_folder& folder) {
    try {
      html(describe(std::array{folder.path()}, "0.1.0"));
      ++shown;
    } catch (const input_error&) {
      ++refused;
    }
  }
};

std::string spoilt(std::string text, std::uint64_t i,
                   const random_stream& draws) {
  const auto at = draws.bits(i, 0) % text.size();
  const auto other = draws.bits(i, 1);
  // Mostly characters of the file itself, which are worse than noise.
  const auto byte = other % 4 == 0 ? static_cast<char>(other >> 8)
                                   : text[(other >> 8) % text.size()];
  switch (draws.bits(i, 2) % 3) {
    case 0:
      text[at] = byte;
      break;
    case 1:
      text.insert(at, 1, byte);
      break;
    default:
      text.erase(at, 1 + other % 16);
  }
  return text;
}

} // namespace

TEST_CASE("a results folder with wrong bytes is shown or refused") {
  const random_stream draws{1, "mutations"};
  const played_folder folder;
  // Few lines, so that each is met.
  const auto cycles = folder.read("cycles.csv");
  folder.write("cycles.csv", cycles.substr(0, cycles.find('\n', 400) + 1));
  report_tally all;
  for (const auto file :
       {"config.toml", "summary.json", "episodes.csv", "cycles.csv",
        "tracks.csv", "vehicles.csv", "events.jsonl"}) {
    CAPTURE(file);
    const auto right = folder.read(file);
    for (std::uint64_t i = 0; i < 100; ++i) {
      CAPTURE(i);
      folder.write(file, spoilt(right, i, draws));
      all.count(folder);
    }
    folder.write(file, right);
  }
  CHECK(all.shown > 0);
  CHECK(all.refused > 0);
}

TEST_CASE("objects in objects without end do no harm") {
  const played_folder folder;
  std::string deep;
  for (int i = 0; i < 100'000; ++i)
    deep += "{\"a\":";
  deep += "1" + std::string(100'000, '}');
  folder.write("summary.json", deep);
  CHECK_NOTHROW(html(describe(std::array{folder.path()}, "0.1.0")));
  folder.write("events.jsonl", deep + "\n");
  CHECK_THROWS_AS(html(describe(std::array{folder.path()}, "0.1.0")),
                  input_error);
}

} // namespace sofof::experiments::report
