// Whatever is done to a scenario, it is judged or refused.
#include "base/random.hpp"
#include "tests/judge/made_scene.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

namespace sofof::judging {

using namespace experiments::judge;

namespace {

/// Some bytes changed, taken out or doubled; mostly digits.
std::string spoilt(std::string text, const random_stream& draws,
                   std::uint64_t i) {
  const auto changes = 1 + draws.bits(i, 0) % 4;
  for (std::uint32_t k = 1; k <= changes; ++k) {
    const auto at = draws.bits(i, 4 * k) % text.size();
    const auto other = draws.bits(i, 4 * k + 1);
    const auto length = std::min<std::size_t>(1 + other % 60, text.size() - at);
    switch (draws.bits(i, 4 * k + 2) % 6) {
      case 0:
        text[at] = static_cast<char>(other);
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(other % text.size(), length));
        break;
      default: {
        const auto digit =
            std::min(text.find_first_of("0123456789", at), text.size() - 1);
        constexpr std::string_view some = "0123456789-.e";
        if (other % 2 == 0)
          text[digit] = some[other / 2 % 10];
        else
          text.insert(digit, 1, some[other / 2 % some.size()]);
      }
    }
  }
  return text;
}

} // namespace

TEST_CASE("a spoilt scenario is judged or refused, and no file is half there") {
  constexpr std::uint64_t files = 1000;
  made_scene brief{.last = 10, .goal_x_m = 38};
  brief.add_driver(60, 0, 8);
  brief.obstacles.resize(brief.obstacles.find("<time><exact>12<"));
  brief.obstacles.resize(brief.obstacles.rfind("<state>"));
  brief.obstacles += "</trajectory></dynamicObstacle>\n";
  const auto text = brief.text();
  const random_stream draws{1, "judge"};
  std::array<int, static_cast<std::size_t>(last_outcome) + 1> count{};
  for (std::uint64_t i = 0; i < files; ++i) {
    const judged_scene made{spoilt(text, draws, i)};
    REQUIRE(!made.rows.empty());
    for (const auto& row : made.rows) {
      ++count[static_cast<std::size_t>(row.found.what)];
      if (row.found.what == outcome::refused)
        CHECK(!row.found.why.empty());
      if (!row.solution.empty())
        CHECK(made.text_of(row.solution).ends_with("</CommonRoadSolution>\n"));
    }
    for (const auto& name : made.names())
      CHECK_FALSE(name.ends_with(".tmp"));
  }
  CHECK(count[static_cast<std::size_t>(outcome::reached)] > 100);
  CHECK(count[static_cast<std::size_t>(outcome::refused)] > 100);
}

} // namespace sofof::judging
