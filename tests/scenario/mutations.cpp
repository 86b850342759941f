// Whatever is done to a scenario file, it loads or it is refused.
#include "base/options/toml_file.hpp"
#include "base/random.hpp"
#include "tests/scenario/example.hpp"

#include <doctest/doctest.h>

using namespace sofof;

namespace {

/// @returns a scenario that comes with the project, on the small map.
std::string original() {
  const auto text = read_text(SOFOF_SOURCE_DIR "/config/ulm_lehr.toml");
  REQUIRE(text);
  return example::with("maps/ulm_lehr.toml", "ring.toml", *text);
}

/// Any other exception than `input_error` ends the test.
struct load_tally {
  int loaded = 0;
  int refused = 0;

  void count(std::string_view text) {
    try {
      example::load(text);
      ++loaded;
    } catch (const input_error&) {
      ++refused;
    }
  }
};

} // namespace

TEST_CASE("a scenario file that ends anywhere loads or is refused") {
  const auto text = original();
  load_tally all;
  for (std::size_t n = 0; n <= text.size(); ++n)
    all.count(std::string_view{text}.substr(0, n));
  CHECK(all.loaded > 0);
  CHECK(all.refused > 0);
}

TEST_CASE("a scenario file with wrong bytes loads or is refused") {
  const random_stream draws{1, "mutations"};
  const auto text = original();
  load_tally all;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    auto spoilt = text;
    const auto changes = 1 + draws.bits(i, 0) % 3;
    for (std::uint32_t k = 1; k <= changes; ++k) {
      const auto at = draws.bits(i, 3 * k) % spoilt.size();
      const auto other = draws.bits(i, 3 * k + 1);
      // Mostly characters of the file itself, which are worse than noise.
      const auto byte = other % 4 == 0 ? static_cast<char>(other >> 8)
                                       : text[(other >> 8) % text.size()];
      switch (draws.bits(i, 3 * k + 2) % 3) {
        case 0:
          spoilt[at] = byte;
          break;
        case 1:
          spoilt.insert(at, 1, byte);
          break;
        default:
          spoilt.erase(at, 1 + other % 16);
      }
    }
    all.count(spoilt);
  }
  CHECK(all.loaded > 0);
  CHECK(all.refused > 0);
}
