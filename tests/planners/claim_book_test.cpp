// Windows of a crossing: when they bind, and that no two that overlap do.
#include "planners/crossing/claim_book.hpp"

#include "tests/planners/crossing_air.hpp"

#include <doctest/doctest.h>

#include <array>
#include <vector>

using namespace sofof;
using namespace sofof::planners;
using namespace std::chrono_literals;

namespace {

constexpr station_id me = 101, other = 102, third = 103;
const std::vector<station_id> both{me, other};

std::vector<area_window> on_area(std::uint32_t area, duration from,
                                 duration to) {
  return {{area, time_point{from}, time_point{to}}};
}

const auto mine = on_area(1, 5s, 6s);

area_claims told(station_id who, duration generated,
                 std::vector<area_window> windows = {}) {
  return {who, time_point{generated}, std::move(windows)};
}

/// A book that has asked at 1 s.
claim_book that_asked() {
  claim_book book{me};
  REQUIRE(book.ask(time_point{1s}, mine, both));
  return book;
}

} // namespace

TEST_CASE("a window binds once everybody has spoken after it was asked for") {
  auto book = that_asked();
  CHECK(book.binding().empty());
  // Clocks may differ by 5 ms each.
  book.hear(time_point{1020ms}, told(other, 1010ms), true);
  CHECK(book.binding().empty());
  book.hear(time_point{1100ms}, told(other, 1011ms), true);
  CHECK(std::ranges::equal(book.binding(), mine));
  CHECK(book.asked().empty());
}

TEST_CASE("alone, a vehicle's window binds at once") {
  claim_book book{me};
  CHECK(book.ask(time_point{1s}, mine, std::array{me}));
  CHECK(std::ranges::equal(book.binding(), mine));
}

TEST_CASE("whoever was heard within two seconds has to be heard again, if its "
          "way meets the own one") {
  const auto binds = [](duration heard, bool meets) {
    claim_book book{me};
    book.hear(time_point{heard}, told(third, heard), meets);
    REQUIRE(book.ask(time_point{3s}, mine, both));
    book.hear(time_point{3100ms}, told(other, 3050ms), true);
    return !book.binding().empty();
  };
  CHECK_FALSE(binds(1500ms, true));
  CHECK(binds(1500ms, false));
  CHECK(binds(1s, true));
}

TEST_CASE("what others claim cannot be asked for, but beside it") {
  claim_book book{me};
  book.hear(time_point{900ms}, told(other, 890ms, on_area(1, 4s, 5500ms)),
            true);
  CHECK_FALSE(book.ask(time_point{1s}, mine, both));
  CHECK(book.asked().empty());
  // 10 ms for clocks.
  CHECK_FALSE(book.ask(time_point{1s}, on_area(1, 5510ms - 1ns, 6s), both));
  CHECK(book.ask(time_point{1s}, on_area(1, 5510ms, 6s), both));
  CHECK(book.ask(time_point{1s}, on_area(2, 5s, 6s), both));
}

TEST_CASE("of two that ask for the same at once, neither's window binds") {
  auto book = that_asked();
  book.hear(time_point{1100ms}, told(other, 1050ms, on_area(1, 5500ms, 7s)),
            true);
  CHECK(book.binding().empty());
  CHECK(book.asked().empty());
}

TEST_CASE("what binds stays, whatever others claim afterwards") {
  auto book = that_asked();
  book.hear(time_point{1100ms}, told(other, 1050ms), true);
  book.hear(time_point{1200ms}, told(other, 1150ms, mine), true);
  CHECK(std::ranges::equal(book.binding(), mine));
  CHECK(book.is_closed(mine.front()));
}

TEST_CASE("a window that moves is told with the old one, which binds until the "
          "new one does") {
  auto book = that_asked();
  book.hear(time_point{1100ms}, told(other, 1050ms), true);
  const auto later = on_area(1, 8s, 9s);
  REQUIRE(book.ask(time_point{2s}, later, both));
  CHECK(std::ranges::equal(book.binding(), mine));
  CHECK(book.tell(time_point{2s}).windows.size() == 2);
  book.hear(time_point{2100ms}, told(other, 2050ms), true);
  CHECK(std::ranges::equal(book.binding(), later));
  CHECK(book.tell(time_point{2100ms}).windows == later);
}

TEST_CASE("messages may come in any order; the newest counts") {
  auto book = that_asked();
  book.hear(time_point{1300ms}, told(other, 1250ms, mine), true);
  book.hear(time_point{1310ms}, told(other, 1150ms), true);
  CHECK(book.is_closed(mine.front()));
  book.hear(time_point{1400ms}, told(other, 1350ms), true);
  CHECK_FALSE(book.is_closed(mine.front()));
}

TEST_CASE("what does not bind within a second is given up") {
  auto book = that_asked();
  book.pass_time(time_point{2s});
  CHECK(std::ranges::equal(book.asked(), mine));
  book.pass_time(time_point{2s + 1ns});
  CHECK(book.asked().empty());
}

TEST_CASE("the windows of who has fallen silent stay closed until they are "
          "over") {
  claim_book book{me};
  book.hear(time_point{1s}, told(other, 1s, mine), true);
  book.pass_time(time_point{6010ms});
  CHECK(book.is_closed(mine.front()));
  book.pass_time(time_point{6010ms + 1ns});
  CHECK_FALSE(book.is_closed(mine.front()));
}

TEST_CASE("an area that is left is nobody's, and what is given up neither") {
  claim_book book{me};
  auto two = mine;
  two.push_back({2, time_point{6s}, time_point{7s}});
  REQUIRE(book.ask(time_point{1s}, two, std::array{me}));
  book.leave(1);
  CHECK(book.tell(time_point{6s}).windows == on_area(2, 6s, 7s));
  book.give_up();
  CHECK(book.tell(time_point{6s}).windows.empty());
}

TEST_CASE("a message of the future, or an echo, closes nothing") {
  claim_book book{me};
  book.hear(time_point{1s}, told(other, 1011ms, mine), true);
  book.hear(time_point{1s}, told(me, 1s, mine), true);
  CHECK_FALSE(book.is_closed(mine.front()));
}

TEST_CASE("no two windows that overlap bind, whatever is proposed, lost, late "
          "or out of order") {
  for (const auto& air : {test::air_quality{},
                          {0.1},
                          {0.3},
                          {0.1, 0.5},
                          {0.3, 0.5},
                          {0.1, 0, 400, 20}})
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      CAPTURE(air.loss);
      CAPTURE(air.burst_s);
      CAPTURE(seed);
      test::crossing_air crossing{6, air, seed};
      auto& dice = crossing.random();
      auto bound = 0;
      for (int step = 0; step < 400; ++step) {
        crossing.go_on();
        const auto who = static_cast<std::size_t>(dice.between(0, 6));
        const auto at = crossing.now() + from_seconds(dice.between(0, 3));
        const auto area = static_cast<std::uint32_t>(dice.between(0, 2));
        if (dice.between(0, 1) < 0.2)
          crossing.book(who).ask(crossing.clock(who),
                                 std::array{area_window{area, at, at + 1s}},
                                 crossing.all());
        if (dice.between(0, 1) < 0.01)
          crossing.book(who).give_up();
        bound += !crossing.book(who).binding().empty();
        REQUIRE_FALSE(crossing.has_overlap());
      }
      CHECK(bound > 0);
    }
}

TEST_CASE("with a tenth of the messages lost, windows apart bind within half a "
          "second") {
  auto in_time = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    test::crossing_air crossing{18, {.loss = 0.1}, seed};
    for (int step = 0; step < 50; ++step) {
      crossing.go_on();
      for (std::uint32_t i = 0; i < crossing.size(); ++i)
        if (step % 5 == 0 && crossing.book(i).binding().empty()
            && !crossing.is_lost())
          crossing.book(i).ask(crossing.clock(i), on_area(i, 3s, 4s),
                               crossing.all());
    }
    for (std::size_t i = 0; i < crossing.size(); ++i, ++all)
      in_time += !crossing.book(i).binding().empty();
  }
  CHECK(in_time >= 0.98 * all);
}
