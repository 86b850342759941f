// Scenarios that are made small, and still show what they showed.
#include "base/input_error.hpp"
#include "experiments/torture/draw.hpp"
#include "experiments/torture/shrink.hpp"
#include "scenario/load.hpp"
#include "tests/support/contains.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <optional>
#include <string>

using namespace sofof;
using namespace sofof::experiments::torture;

namespace {

std::optional<scenario::scenario_definition> loaded(const std::string& text) {
  try {
    return scenario::parse_scenario(text, "torture.toml");
  } catch (const input_error&) {
    return std::nullopt;
  }
}

/// As if a promise broke when a provider comes back while messages get lost.
bool shows(const std::string& text) {
  const auto s = loaded(text);
  return s && s->length > std::chrono::seconds{7} && s->network.profile.loss > 0
         && std::ranges::any_of(s->providers, [](const auto& p) {
              return p.returns_at.has_value();
            });
}

std::string failing() {
  for (std::uint64_t seed = 1;; ++seed)
    if (auto text = draw(seed); shows(text))
      return text;
}

} // namespace

TEST_CASE("a scenario is made small, and shows what it showed") {
  const auto text = failing();
  const auto small = shrink(text, shows, 1000);
  CAPTURE(small.text);
  CHECK(shows(small.text));
  CHECK(std::ranges::count(small.text, '\n') <= 20);
  const auto s = loaded(small.text);
  REQUIRE(s);
  CHECK(s->length < std::chrono::seconds{9});
  CHECK(s->providers.size() == 1);
  CHECK(s->services.size() == 1);
  CHECK(s->network.profile.name == "paper_sim"); // the default
  // Nothing else can be taken out.
  CHECK(shrink(small.text, shows, 1000).text == small.text);
}

TEST_CASE("a chain of services is taken out as a whole where it shows "
          "nothing, and stays where it does") {
  const std::string text = R"(duration = "9s"
[street_grid]
columns = 3
rows = 3
[[fleet]]
routes = ["block *"]
[[provider]]
services = ["environment_model", "trajectory_planning"]
returns_at = "4s"
fails_at = "3s"
[[service]]
name = "tracking"
[[service]]
name = "environment_model"
[[service]]
name = "trajectory_planning"
[network]
loss = 0.1
)";
  // The town stays small, or each try would take long.
  const auto shows_here = [](const std::string& changed) {
    return test::contains(changed, "columns = 3")
           && test::contains(changed, "rows = 3") && shows(changed);
  };
  REQUIRE(shows_here(text));
  const auto small = loaded(shrink(text, shows_here, 1000).text);
  REQUIRE(small);
  CHECK(small->services.size() == 1);
  const auto by_tracks = [&](const std::string& changed) {
    return shows_here(changed)
           && scenario::find_service(*loaded(changed), "tracking");
  };
  const auto chain = loaded(shrink(text, by_tracks, 1000).text);
  REQUIRE(chain);
  CHECK(chain->services.size() == 3);
}

TEST_CASE("no more scenarios are tried than may be") {
  std::size_t tries = 0;
  const auto count = [&tries](const std::string& text) {
    ++tries;
    return shows(text);
  };
  const auto small = shrink(failing(), count, 10);
  CHECK(tries == 10);
  CHECK(small.tries == 10);
  CHECK(shows(small.text));
}
