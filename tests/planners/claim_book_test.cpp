// The claim of a drive through a crossing: when it binds, and that no two that
// overlap do.
#include "planners/crossing/claim_book.hpp"

#include "tests/planners/crossing_air.hpp"

#include <doctest/doctest.h>

#include <array>
#include <vector>

using namespace sofof;
using namespace sofof::planners;
using namespace std::chrono_literals;
using test::stay_on;

namespace {

constexpr station_id me = 101, other = 102, third = 103;
const std::vector<station_id> both{me, other};
using state = claim_book::state;

const auto mine = stay_on(1, time_point{5s}, time_point{6s});

crossing_claim told(station_id who, duration generated,
                    std::optional<claimed_drive> drive = {}) {
  return {who, time_point{generated}, std::move(drive)};
}

claimed_drive on_place(int place, duration from, duration to) {
  return stay_on(place, time_point{from}, time_point{to});
}

/// A book with a claim made at 1 s.
claim_book with_claim() {
  claim_book book{me};
  REQUIRE(book.claim(time_point{1s}, mine, both));
  return book;
}

} // namespace

TEST_CASE("a claim binds once everybody has spoken after it was made") {
  auto book = with_claim();
  CHECK(book.is() == state::claimed);
  // Clocks may differ by 5 ms each.
  book.on_report(time_point{1020ms}, told(other, 1010ms), true);
  CHECK(book.is() == state::claimed);
  book.on_report(time_point{1100ms}, told(other, 1011ms), true);
  CHECK(book.is() == state::bound);
}

TEST_CASE("alone, a vehicle's claim binds at once") {
  claim_book book{me};
  CHECK(book.claim(time_point{1s}, mine, std::array{me}));
  CHECK(book.is() == state::bound);
}

TEST_CASE("whoever was heard within two seconds has to be heard again, if it "
          "may come to where the vehicle goes") {
  const auto binds = [](duration heard, bool matters) {
    claim_book book{me};
    book.on_report(time_point{heard}, told(third, heard), matters);
    REQUIRE(book.claim(time_point{3s}, mine, both));
    book.on_report(time_point{3100ms}, told(other, 3050ms), true);
    return book.is() == state::bound;
  };
  CHECK_FALSE(binds(1500ms, true));
  CHECK(binds(1500ms, false));
  CHECK(binds(1s, true));
}

TEST_CASE("what others claim cannot be claimed, nor half a second beside it") {
  claim_book book{me};
  book.on_report(time_point{900ms}, told(other, 890ms, on_place(1, 4s, 5500ms)),
                 true);
  CHECK_FALSE(book.claim(time_point{1s}, mine, both));
  CHECK(book.is() == state::free);
  // 10 ms for clocks.
  CHECK_FALSE(book.claim(time_point{1s}, on_place(1, 6s, 7s), both));
  CHECK(book.claim(time_point{1s}, on_place(1, 6100ms, 7s), both));
  CHECK(book.claim(time_point{1s}, on_place(2, 5s, 6s), both));
}

TEST_CASE("of two that claim the same at once, neither's claim binds") {
  auto book = with_claim();
  book.on_report(time_point{1100ms},
                 told(other, 1050ms, on_place(1, 5500ms, 7s)), true);
  CHECK(book.is() == state::free);
}

TEST_CASE("what binds stays, whatever others claim afterwards") {
  auto book = with_claim();
  book.on_report(time_point{1100ms}, told(other, 1050ms), true);
  book.on_report(time_point{1200ms}, told(other, 1150ms, mine), true);
  CHECK(book.is() == state::bound);
  CHECK(book.is_closed(mine));
}

TEST_CASE("another claim takes the place of the one before, and binds anew") {
  auto book = with_claim();
  book.on_report(time_point{1100ms}, told(other, 1050ms), true);
  const auto later = on_place(1, 8s, 9s);
  REQUIRE(book.claim(time_point{2s}, later, both));
  CHECK(book.is() == state::claimed);
  CHECK(book.tell(time_point{2s}).drive->from == later.from);
  book.on_report(time_point{2100ms}, told(other, 2050ms), true);
  CHECK(book.is() == state::bound);
}

TEST_CASE("messages may come in any order; the newest counts") {
  auto book = with_claim();
  book.on_report(time_point{1300ms}, told(other, 1250ms, mine), true);
  book.on_report(time_point{1310ms}, told(other, 1150ms), true);
  CHECK(book.is_closed(mine));
  book.on_report(time_point{1400ms}, told(other, 1350ms), true);
  CHECK_FALSE(book.is_closed(mine));
}

TEST_CASE("what does not bind within a second is given up, and what does when "
          "it is over") {
  auto book = with_claim();
  book.pass_time(time_point{2s});
  CHECK(book.is() == state::claimed);
  book.pass_time(time_point{2s + 1ns});
  CHECK(book.is() == state::free);
  auto bound = with_claim();
  bound.on_report(time_point{1100ms}, told(other, 1050ms), true);
  bound.pass_time(mine.to());
  CHECK(bound.is() == state::bound);
  bound.pass_time(mine.to() + 1ns);
  CHECK(bound.is() == state::free);
}

TEST_CASE("what was claimed by who has fallen silent stays so until it is "
          "over") {
  claim_book book{me};
  book.on_report(time_point{1s}, told(other, 1s, mine), true);
  book.pass_time(time_point{6010ms});
  CHECK(book.is_closed(mine));
  book.pass_time(time_point{6010ms + 1ns});
  CHECK_FALSE(book.is_closed(mine));
}

TEST_CASE("a message of the future, or an echo, closes nothing") {
  claim_book book{me};
  book.on_report(time_point{1s}, told(other, 1011ms, mine), true);
  book.on_report(time_point{1s}, told(me, 1s, mine), true);
  CHECK_FALSE(book.is_closed(mine));
}

TEST_CASE("no two claims that overlap bind, whatever is proposed, lost, late "
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
        const auto place = static_cast<int>(dice.between(0, 2));
        if (dice.between(0, 1) < 0.2)
          crossing.book(who).claim(crossing.clock(who),
                                   stay_on(place, at, at + 1s), crossing.all());
        if (dice.between(0, 1) < 0.01)
          crossing.book(who).give_up();
        bound += crossing.book(who).is() == state::bound;
        REQUIRE_FALSE(crossing.has_overlap());
      }
      CHECK(bound > 0);
    }
}

TEST_CASE("with a tenth of the messages lost, claims apart bind within half a "
          "second") {
  auto in_time = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    test::crossing_air crossing{18, {.loss = 0.1}, seed};
    for (int step = 0; step < 50; ++step) {
      crossing.go_on();
      for (std::uint32_t i = 0; i < crossing.size(); ++i)
        if (step % 5 == 0 && !crossing.is_lost())
          crossing.book(i).claim(crossing.clock(i),
                                 on_place(static_cast<int>(i), 3s, 4s),
                                 crossing.all());
    }
    for (std::size_t i = 0; i < crossing.size(); ++i, ++all)
      in_time += crossing.book(i).is() == state::bound;
  }
  CHECK(in_time >= 0.98 * all);
}
