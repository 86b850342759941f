// Whatever is done to a file, it is imported or refused.
#include "base/input_error.hpp"
#include "base/random.hpp"
#include "tests/maps/files.hpp"

#include "maps/commonroad_scene.hpp"
#include <stdexcept>

namespace sofof::maps_tests::mutations {

namespace {

constexpr auto files = 1000;

/// A few bytes replaced, parts left out or doubled: mostly what still is XML.
std::string spoilt(const std::string& text, const random_stream& draws,
                   std::uint64_t i) {
  auto made = text;
  const auto changes = 1 + draws.bits(i, 0) % 3;
  for (std::uint32_t k = 1; k <= changes && !made.empty(); ++k) {
    auto at = draws.bits(i, 4 * k) % made.size();
    const auto other = draws.bits(i, 4 * k + 1);
    const auto length = std::min<std::size_t>(1 + other % 40, made.size() - at);
    switch (draws.bits(i, 4 * k + 2) % 8) {
      case 0:
        made[at] = made[other % made.size()];
        break;
      case 1:
        made[at] = static_cast<char>(other);
        break;
      case 2:
        made.erase(at, length);
        break;
      case 3:
        made.insert(at, made.substr(other % made.size(), length));
        break;
      default: // another digit, or one more, a sign, an exponent
        at = std::min(made.find_first_of("0123456789", at), made.size() - 1);
        if (other % 2 == 0)
          made[at] = "0123456789"[other / 2 % 10];
        else
          made.insert(at, 1, "0123456789-.e"[other / 2 % 13]);
    }
  }
  return made;
}

/// Any other exception than `input_error` ends the test.
void spoil(std::string_view file) {
  const random_stream draws{1, file};
  const auto text = text_of(file);
  auto loaded = 0, refused = 0;
  for (std::uint64_t i = 0; i < files; ++i) {
    try {
      const auto map = imported(spoilt(text, draws, i), file);
      CHECK(!map.lanes.empty());
      streets_of(map); // right: it can be driven
      ++loaded;
    } catch (const input_error&) {
      ++refused;
    }
  }
  MESSAGE(file << ": " << loaded << " imported, " << refused << " refused");
  CHECK(loaded > files / 20);
  CHECK(refused > files / 20);
}

} // namespace

TEST_CASE("a spoilt network of SUMO is imported or refused") {
  spoil("t_junction.net.xml");
}

TEST_CASE("a spoilt map of Lanelet2 is imported or refused") {
  spoil("fork.osm");
  spoil("fork_local.osm");
}

TEST_CASE("a spoilt scenario of CommonRoad is imported or refused") {
  spoil("fork.xml");
}

TEST_CASE("the scene of a spoilt scenario of CommonRoad is read or refused") {
  const random_stream draws{1, "scene"};
  const auto text = text_of("scene.xml");
  auto read = 0, refused = 0;
  for (std::uint64_t i = 0; i < files; ++i)
    try {
      const auto made = spoilt(text, draws, i);
      const auto scene =
          maps::read_commonroad_scene(maps::xml_file{made, "scene.xml"});
      for (const auto& body : scene.bodies)
        CHECK(!body.states.empty());
      for (const auto& problem : scene.problems)
        CHECK(problem.end() >= problem.begin);
      ++read;
    } catch (const input_error&) {
      ++refused;
    }
  CHECK(read > files / 20);
  CHECK(refused > files / 20);
}

TEST_CASE("spoilt routes of SUMO are read or refused") {
  const random_stream draws{1, "routes"};
  const auto net = text_of("t_junction.net.xml");
  const auto text = text_of("t_junction.rou.xml");
  auto read = 0, refused = 0;
  for (std::uint64_t i = 0; i < files; ++i)
    try {
      maps::import({net, "t.net.xml"}, "t",
                   {spoilt(text, draws, i), "t.rou.xml"});
      ++read;
    } catch (const input_error&) {
      ++refused;
    }
  CHECK(read > 0);
  CHECK(refused > 0);
}

TEST_CASE("a file that ends anywhere is imported or refused") {
  for (const auto* file : {"t_junction.net.xml", "fork.osm", "fork.xml"}) {
    const auto text = text_of(file);
    for (std::size_t n = 0; n < text.rfind('<'); n += 7)
      CHECK_THROWS_AS(imported(text.substr(0, n), file), input_error);
  }
}

} // namespace sofof::maps_tests::mutations
