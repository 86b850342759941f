// The ways past the others: which there are, and which come first.
#include "planners/trajectory/maneuver_candidates.hpp"

#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace sofof;
using namespace sofof::planners;
using doctest::Approx;

namespace {

constexpr crossing_car car{4, 1, 10, 14, 1.5};

double straight_on(double s_m) {
  return s_m;
}

/// A road user that crosses at one place; without a number, one of its own.
crossing_user user(double from_m, double to_m, double enter_s, double leave_s,
                   bool goes_first, std::uint32_t body = 0) {
  static std::uint32_t last = 1000;
  crossing_user x{from_m, to_m, enter_s, leave_s, goes_first};
  x.body = body > 0 ? body : ++last;
  return x;
}

std::vector<crossing_order> orders(std::vector<crossing_user> users,
                                   const crossing_choice& last = {},
                                   std::size_t most = 16,
                                   crossing_car c = car) {
  std::vector<crossing_order> out;
  list_orders(users, c, straight_on, last, most, out);
  return out;
}

std::vector<passing_order> sides(std::vector<lane_obstacle> bodies,
                                 std::uint32_t first = 0, std::size_t most = 16,
                                 double half_width_m = 1.75) {
  std::vector<passing_order> out;
  list_sides(bodies, half_width_m, first, most, out);
  return out;
}

bool lists(const auto& all, std::uint32_t choice) {
  return std::ranges::any_of(all,
                             [=](const auto& x) { return x.choice == choice; });
}

} // namespace

TEST_CASE("without anybody to mind there is one order, free of windows") {
  const auto check_free = [](const std::vector<crossing_order>& all) {
    REQUIRE(all.size() == 1);
    CHECK(all[0].count == 0);
    CHECK(all[0].choice == 0);
    CHECK(all[0].stop_m == speed_constraints::never);
  };
  check_free(orders({}));
  check_free(orders({}, {.waits = true, .before = {7}}));
  // Who gives way is not minded, nor who crosses where the car has been.
  check_free(orders({user(50, 55, 3, 5, false)}));
  check_free(orders({user(50, 55, 0, 4, false)})); // it waits there
  check_free(orders({user(2, 5, 0, 5, true)}));
}

TEST_CASE("one who goes first can be passed after, or before when there is "
          "time, or waited for") {
  const auto all = orders({user(40, 45, 9, 11, true)});
  REQUIRE(all.size() == 3);
  for (const auto& order : all) {
    if (order.choice == crossing_order::waits) {
      CHECK(order.stop_m == Approx(36)); // of the rear axle
      CHECK(order.count == 0);
      continue;
    }
    REQUIRE(order.count == 1);
    const auto& w = order.windows[0];
    if (order.choice == 0) { // after
      CHECK(w.at_m == Approx(36));
      CHECK(w.earliest_s > 11);
      CHECK(w.latest_s == speed_constraints::never);
    } else { // before
      CHECK(w.at_m == Approx(46));
      CHECK(w.latest_s < 9);
      CHECK(w.earliest_s == -speed_constraints::never);
    }
  }
}

TEST_CASE("nobody can be first where the time is too short") {
  CHECK(!lists(orders({user(40, 45, 3, 5, true)}), 1));
  CHECK(lists(orders({user(40, 45, 8, 10, true)}), 1));
  // From standstill it takes longer.
  const crossing_car stands{4, 1, 0, 14, 1.5};
  CHECK(!lists(orders({user(40, 45, 8, 10, true)}, {}, 16, stands), 1));
}

TEST_CASE("somebody who stands on the crossing can only be waited for") {
  const auto all = orders({user(40, 45, 0, speed_constraints::never, true)});
  REQUIRE(all.size() == 1);
  CHECK(all[0].choice == crossing_order::waits);
  CHECK(all[0].stop_m == Approx(36));
}

TEST_CASE(
    "one decision is made for a road user, at all places where it crosses") {
  const auto all =
      orders({user(40, 45, 9, 11, true, 1), user(46, 50, 10, 12, true, 1),
              user(52, 55, 9, 12, true, 2)});
  CHECK(all.size() == 5); // each of two before or after, and to wait
  for (const auto& order : all)
    CHECK(order.count == (order.choice == crossing_order::waits ? 0 : 3));
  const auto first =
      std::ranges::find(all, 1U, [](const auto& x) { return x.choice; });
  REQUIRE(first != all.end());
  CHECK(choice_of(*first).goes_before(1));
  CHECK_FALSE(choice_of(*first).goes_before(2));
  CHECK(first->windows[0].latest_s == Approx(9 - 1.5));
  CHECK(first->windows[1].latest_s == Approx(10 - 1.5));
  CHECK(first->windows[2].earliest_s == Approx(12 + 0.8));
}

TEST_CASE("after all and before all are tried, among however few") {
  const std::vector<crossing_user> three{user(40, 45, 9, 11, true, 1),
                                         user(40, 45, 10, 12, true, 2),
                                         user(40, 45, 11, 13, true, 3)};
  for (const std::size_t most : {1, 2, 3}) {
    const auto few = orders(three, {.before = {2}}, most);
    REQUIRE(few.size() == 4);
    CHECK(choice_of(few[0]).goes_before(2));
    CHECK_FALSE(choice_of(few[0]).goes_before(1));
    CHECK(few[1].choice == 0);
    CHECK(few[2].choice == 7);
    CHECK(few[3].choice == crossing_order::waits);
  }
}

TEST_CASE("who has begun to go before another leaves it less time, and least "
          "where it cannot stop any more") {
  const crossing_car slow{4, 1, 4, 14, 1.5};
  const auto latest_s = [](double from_m, const crossing_choice& last,
                           const crossing_car& c) {
    for (const auto& order :
         orders({user(from_m, from_m + 5, 20, 22, true, 1)}, last, 16, c))
      if (order.choice == 1)
        return order.windows[0].latest_s;
    return 0.0;
  };
  CHECK(latest_s(60, {}, slow) == Approx(18.5));
  CHECK(latest_s(60, {.before = {1}}, slow) == Approx(19.2));
  // At 4 m/s it stops within 5.2 m.
  CHECK(latest_s(9, {.before = {1}}, slow) == Approx(19.5));
  CHECK(latest_s(9, {}, slow) == Approx(18.5));
}

TEST_CASE(
    "who can stay off by braking firmly lets a car pass that has begun to "
    "go before it and cannot stop any more") {
  const crossing_car fast{4, 1, 10, 14, 1.5};
  auto other = user(14, 19, 0.5, 3, true, 1);
  const auto goes = [&](const crossing_choice& last) {
    return lists(orders({other}, last, 16, fast), 1);
  };
  CHECK_FALSE(goes({.before = {1}}));
  other.brakes_mps2 = 2.4;
  CHECK(goes({.before = {1}}));
  CHECK_FALSE(goes({}));
  other.brakes_mps2 = 2.6;
  CHECK_FALSE(goes({.before = {1}}));
  // At 10 m/s it does not stop within 8 m at all.
  other = user(12, 17, 0.5, 3, true, 1);
  CHECK(goes({.before = {1}}));
  CHECK_FALSE(goes({}));
}

TEST_CASE("a car on one place of another that it goes before does not wait on "
          "it for that one's next place") {
  const crossing_car fast{4, 1, 6, 6, 1.5};
  // Its front is 1 m into the first, and comes too late to the second.
  const std::vector both{user(3, 12, 4, 5, true, 1),
                         user(16, 22, 3.5, 5, true, 1)};
  CHECK(lists(orders(both, {.before = {1}}, 16, fast), 1));
  CHECK_FALSE(lists(orders(both, {}, 16, fast), 1));
  const crossing_car slow{4, 1, 1.9, 6, 1.5}; // it can stay where it is
  CHECK_FALSE(lists(orders(both, {.before = {1}}, 16, slow), 1));
  // Between these it can wait.
  const std::vector apart{both[0], user(40, 46, 3.5, 5, true, 1)};
  CHECK_FALSE(lists(orders(apart, {.before = {1}}, 16, fast), 1));
}

TEST_CASE(
    "a car that would have to brake hard goes on before those who can stay "
    "off by braking little at all places, and before nobody else") {
  const crossing_car fast{4, 1, 10, 14, 1.5};
  const auto never_comes = [](double) { return speed_constraints::never; };
  // At 10 m/s it stops within 16.7 m by 3 m/s².
  const auto goes_on = [&](double line_m, double brakes_mps2,
                           double brakes_later_mps2, double more_s = 0.0) {
    auto here = user(line_m + 4, line_m + 9, 2 + more_s, 5, true, 1);
    auto later = user(line_m + 14, line_m + 19, 3 + more_s, 6, true, 1);
    here.brakes_mps2 = brakes_mps2;
    later.brakes_mps2 = brakes_later_mps2;
    return going_on({}, std::vector{here, later}, fast, straight_on,
                    never_comes)
        .goes_before(1);
  };
  CHECK(goes_on(16, 1.4, 1.0));
  CHECK_FALSE(goes_on(17, 1.4, 1.0)); // others think that it will stop
  CHECK(goes_on(17, 1.4, 1.0, 1.5));  // and see it on the place before that
  CHECK_FALSE(goes_on(16, 1.6, 1.0));
  CHECK_FALSE(goes_on(16, 1.4, 1.6));
}

TEST_CASE("who has waited for long goes before those whom it costs little "
          "braking, and only those") {
  crossing_car waiting{4, 1, 0, 14, 1.5};
  auto other = user(6, 11, 4, 6, true, 1); // clear of it in 4.6 s
  const auto goes = [&](const crossing_choice& last = {}) {
    return lists(orders({other}, last, 16, waiting), 1);
  };
  other.brakes_mps2 = 0.9;
  CHECK_FALSE(goes());
  waiting.is_impatient = true;
  CHECK(goes());
  other.brakes_mps2 = 1.1;
  CHECK_FALSE(goes());
  // Having begun it goes on, as long as that is all it asks.
  waiting = {4, 1, 1, 14, 1.5};
  CHECK_FALSE(goes({.before = {1}}));
  other.brakes_mps2 = 0.9;
  CHECK(goes({.before = {1}}));
}

TEST_CASE("waiting is always possible, among however few; what was decided "
          "last comes first") {
  test::dice dice{1};
  for (auto i = 0; i < 2000; ++i) {
    std::vector<crossing_user> users;
    const auto n = static_cast<std::uint32_t>(dice.between(1, 7));
    for (std::uint32_t k = 0; k < n; ++k) {
      const auto from = dice.between(5, 80), enter = dice.between(-2, 15);
      const auto stands = dice.between(0, 1) < 0.1;
      users.push_back(user(from, from + 4, std::max(0.0, enter),
                           stands ? speed_constraints::never
                                  : std::max(0.0, enter) + dice.between(0.5, 5),
                           dice.between(0, 1) < 0.8,
                           1 + static_cast<std::uint32_t>(dice.between(0, n))));
    }
    std::ranges::sort(users, {}, &crossing_user::from_m);
    const auto full = orders(users, {}, 100);
    const auto minded = full.size() > 1 || full[0].count > 0
                        || full[0].choice == crossing_order::waits;
    for (const auto& before : full)
      for (const std::size_t most : {1, 2, 4, 16, 17}) {
        CAPTURE(i);
        CAPTURE(most);
        const auto last = choice_of(before);
        const auto few = orders(users, last, most);
        REQUIRE(!few.empty());
        // To wait comes on top of them.
        CHECK(few.size() <= std::max(most, std::size_t{3}) + (minded ? 1 : 0));
        CHECK(few.front().choice == before.choice);
        if (minded)
          CHECK(lists(few, crossing_order::waits));
        for (const auto& order : few)
          CHECK(std::ranges::count(few, order.choice, &crossing_order::choice)
                == 1);
      }
    for (const auto& order : full)
      for (std::size_t k = 0; k < order.count; ++k) {
        const auto& w = order.windows[k];
        CHECK(w.earliest_s < speed_constraints::never);
        CHECK(w.latest_s > 0);
        CHECK(w.earliest_s < w.latest_s);
      }
  }
}

TEST_CASE("who waits does so before the first crossing") {
  const auto all = orders({user(70, 75, 9, 14, true), user(40, 45, 2, 5, true),
                           user(40, 46, 6, 9, true)});
  const auto wait =
      std::ranges::find(all, crossing_order::waits, &crossing_order::choice);
  REQUIRE(wait != all.end());
  CHECK(wait->stop_m == Approx(36));
}

TEST_CASE("who sees late that it has to wait comes a little beyond the line "
          "rather than brake hard") {
  const auto waits_at_m = [](double speed_mps, double line_m, double accel) {
    crossing_car c{4, 1, speed_mps, 14, 1.5};
    c.accel_mps2 = accel;
    for (const auto& x :
         orders({user(line_m + 4, line_m + 9, 3, 5, true)}, {}, 16, c))
      if (x.choice == crossing_order::waits)
        return x.stop_m;
    return -1.0;
  };
  CHECK(waits_at_m(2.5, 4, 0) == Approx(4));     // far enough
  CHECK(waits_at_m(2.5, 2.2, 0) == Approx(2.5)); // 0.5 s, then 2.5 m/s²
  CHECK(waits_at_m(2.5, 1.5, 0) == Approx(2));
  CHECK(waits_at_m(2.5, 1.5, -2.5) == Approx(1.5)); // it brakes already
  CHECK(waits_at_m(1, -0.3, -1) == Approx(0.2));
  CHECK(waits_at_m(1, -0.6, -1) < 0); // it has come onto the crossing
}

TEST_CASE(
    "who stands with its front on a place waits there for who is on it, and "
    "goes on before who comes") {
  const crossing_car stands{4, 1, 0, 14, 1.5};
  const auto waits = [&](double line_m, double enter_s) {
    const auto all =
        orders({user(line_m + 4, line_m + 10, enter_s, enter_s + 5, true, 1)},
               {}, 16, stands);
    return all.size() > 1; // else it minds nobody
  };
  CHECK(waits(-2, 0));
  CHECK(waits(-5, 0));
  CHECK_FALSE(waits(-2, 1));
  CHECK(waits(-1, 1)); // it hardly reaches in
}

TEST_CASE("an empty lane has one way through") {
  const auto all = sides({});
  REQUIRE(all.size() == 1);
  CHECK(all[0].choice == 0);
  CHECK(all[0].bodies.empty());
}

TEST_CASE("a body is passed where it leaves room") {
  const auto left = sides({{50, 55, -1.9, -0.9, 0}});
  REQUIRE(left.size() == 1);
  REQUIRE(left[0].bodies.size() == 1);
  CHECK(left[0].bodies[0].side == side_of_road::left);
  const auto right = sides({{50, 55, 0.9, 1.9, 0}});
  REQUIRE(right.size() == 1);
  CHECK(right[0].bodies[0].side == side_of_road::right);
  CHECK(right[0].choice == 1);
  CHECK(sides({{50, 55, -0.2, 0.2, 0}}).empty());
  // A wide lane leaves room on both sides.
  CHECK(sides({{50, 55, -0.2, 0.2, 0}}, 0, 16, 3.5).size() == 2);
}

TEST_CASE("sides are combined, the ones before first, no more than wanted") {
  const std::vector<lane_obstacle> bodies{
      {50, 55, -0.2, 0.2, 0}, {80, 85, -1, 0.5, 0}, {99, 101, 0, 1, 0}};
  const auto all = sides(bodies, 0, 16, 4);
  CHECK(all.size() == 8);
  for (std::uint32_t choice = 0; choice < 8; ++choice) {
    CHECK(lists(all, choice));
    const auto few = sides(bodies, choice, 2, 4);
    REQUIRE(few.size() == 2);
    CHECK(few[0].choice == choice);
    CHECK(few[1].choice != choice);
    for (const auto& order : few)
      for (std::size_t i = 0; i < bodies.size(); ++i)
        CHECK((order.bodies[i].side == side_of_road::right)
              == ((order.choice >> i & 1U) != 0));
  }
}
