// Listing orders and sides.
#include "planners/trajectory/maneuver_candidates.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace sofof::planners {
namespace {

/// Between those who cross and the own car, at the place that both use.
constexpr double gap_after_s = 0.8;
/// Whoever goes first shall not notice that the own car went before: not at
/// all when it decides to, less once it has begun.
constexpr double gap_to_begin_s = 1.5;
constexpr double gap_once_begun_s = 0.8;
constexpr double gap_at_last_s = 0.5;
/// Whoever can stay off a place by braking so little may have to, for a car
/// that cannot stop before it any more; less little once that has begun to go
/// before it: two that both brake hard are worse.
constexpr double little_braking_mps2 = 1.5, braking_for_begun_mps2 = 2.5;
/// Others see that a car goes on which would have to brake harder than this
/// (crossing_predictor), or that is on a place so long before they would be.
constexpr double surely_goes_on_mps2 = 3.0, is_seen_there_s = 1.0;
/// Who has waited for long asks others to let it go: those who can stay off by
/// braking even less may come to the place before the own car has left it, as
/// they come now.
constexpr double asked_braking_mps2 = 1.0, gap_asked_s = -3.0;
/// Who waits at a line or is slow, or hardly moves, may come so far beyond it:
/// a place begins before bodies touch.
constexpr double waits_within_m = 0.5, stands_within_m = 1.5;
/// Who stands farther on a place waits there for who is on it: each of both
/// would take the other's way out.
constexpr double stands_on_it_m = 6;
constexpr double slow_mps = 2.0, hardly_mps = 0.3;
/// Less is not worth to come beyond a line.
constexpr double worth_it_m = 0.1;
/// It takes so long until a car that decides to stop brakes.
constexpr double hesitation_s = 0.5;

void put_first(auto& orders, std::uint32_t choice) {
  const auto it =
      std::ranges::find(orders, choice, [](const auto& x) { return x.choice; });
  if (it != orders.end())
    std::rotate(orders.begin(), it, it + 1);
}

/// A place where somebody crosses who is minded.
struct minded_place {
  double line_m, clear_m; // way to before and behind it
  const crossing_user* user;
  std::size_t car;          // its bit
  bool follows_own = false; // the car would stand on one of the same before it
};

/// Those who are minded, in the order in which they come.
struct minded_cars {
  struct car {
    std::uint32_t body;
    double enter_s;
    double gap_s;     // to leave it when the own car goes before it, ...
    bool committed;   // ... and cannot wait for it any more, ...
    bool cannot_stop; // ... or not even by braking as hard as it can
    double on_to_m;   // where the place ends that the own front is on
  };
  std::array<minded_place, crossing_order::most_windows> places;
  std::size_t count = 0;
  std::array<car, crossing_order::most_cars> cars;
  std::size_t car_count = 0;
};

/// A crossing that the own front has not reached, of one who goes first there
/// and will not have left before the car can be there.
bool is_minded(const crossing_user& user, double line_m,
               const crossing_car& car) {
  return line_m >= 0 && user.goes_first
         && user.leave_s + gap_after_s > soonest_s(line_m, car);
}

bool may_be_asked(const crossing_user& user) {
  return user.brakes_mps2 < asked_braking_mps2;
}

/// The first cars to come; of more there is no telling anyway.
void find_cars(std::span<const crossing_user> users, const crossing_car& car,
               const auto& line_of, minded_cars& found) {
  std::array<minded_cars::car, 4 * crossing_order::most_cars> all;
  std::size_t count = 0;
  assert(found.car_count == 0);
  for (const auto& user : users) {
    if (!is_minded(user, line_of(user), car))
      continue;
    const auto known =
        std::find_if(all.begin(), all.begin() + count,
                     [&](const auto& x) { return x.body == user.body; });
    if (known != all.begin() + count)
      known->enter_s = std::min(known->enter_s, user.enter_s);
    else if (count < all.size())
      all[count++] = {user.body,
                      user.enter_s,
                      car.is_impatient && may_be_asked(user) ? gap_asked_s
                                                             : gap_to_begin_s,
                      false,
                      false,
                      -speed_constraints::never};
  }
  std::ranges::sort(all.begin(), all.begin() + count, {}, [](const auto& x) {
    return std::pair{x.enter_s, x.body};
  });
  found.car_count = std::min(count, found.cars.size());
  std::copy_n(all.begin(), found.car_count, found.cars.begin());
  assert(found.car_count <= crossing_order::most_cars);
}

/// @returns way to where it waits for what begins after a way: there, or a
/// little later where that is too near; negative where it is too late to.
double waiting_line_m(double line_m, bool is_taken, const crossing_car& car,
                      bool waits) {
  assert(car.speed_mps >= 0 && car.firm_decel_mps2 > 0);
  const auto slow = car.speed_mps < slow_mps;
  const auto within_m = car.speed_mps < hardly_mps
                            ? is_taken ? stands_on_it_m : stands_within_m
                        : waits || slow ? waits_within_m
                                        : 0.0;
  if (line_m < -within_m)
    return line_m;
  const auto softly_m = std::min(line_m + waits_within_m, stopping_m(car));
  return std::max(softly_m > line_m + worth_it_m ? softly_m : line_m, 0.0);
}

/// @returns the way to rest, braking as hard as cars can.
double hardest_stop_m(const crossing_car& car) {
  constexpr auto hardest_mps2 = 6.0;
  return car.speed_mps * car.speed_mps / (2 * hardest_mps2);
}

minded_cars find_minded(std::span<const crossing_user> users,
                        const crossing_car& car,
                        const std::function<double(double)>& way,
                        const crossing_choice& last) {
  minded_cars found;
  assert(way && car.front_m > 0);
  const auto line_of = [&](const crossing_user& user) {
    return waiting_line_m(way(user.from_m - car.front_m), user.enter_s <= 0,
                          car, last.waits);
  };
  find_cars(users, car, line_of, found);
  for (const auto& user : users) {
    const auto line_m = line_of(user);
    for (std::size_t i = 0; i < found.car_count; ++i) {
      auto& x = found.cars[i];
      if (x.body != user.body)
        continue;
      const auto before = last.goes_before(x.body);
      const auto way_m = way(user.from_m - car.front_m);
      // On one of its places the car does not stop before the next one.
      const auto cannot_stop =
          way_m < 0 ? car.speed_mps > slow_mps : hardest_stop_m(car) > way_m;
      x.cannot_stop = x.cannot_stop || (before && cannot_stop);
      if (way_m < 0 && before && cannot_stop)
        x.on_to_m = std::max(x.on_to_m, user.to_m);
      if (!is_minded(user, line_m, car) || found.count == found.places.size())
        continue;
      const auto no_car_between =
          user.from_m - car.front_m - car.rear_m < x.on_to_m;
      found.places[found.count++] = {line_m, way(user.to_m + car.rear_m), &user,
                                     i, no_car_between};
      x.committed = x.committed || (before && stopping_m(car) > way_m);
      if (before)
        x.gap_s = x.committed          ? gap_at_last_s
                  : may_be_asked(user) ? std::min(x.gap_s, gap_asked_s)
                                       : gap_once_begun_s;
    }
  }
  assert(found.car_count == 0 || found.count > 0);
  return found;
}

/// @returns whether it can be driven at all.
bool add_windows(const minded_cars& minded, const crossing_car& car,
                 crossing_order& order) {
  auto possible = true;
  assert(order.count == 0 && order.choice < crossing_order::waits);
  for (std::size_t i = 0; i < minded.count; ++i) {
    const auto& [line_m, clear_m, user, bit, follows_own] = minded.places[i];
    const auto before = (order.choice >> bit & 1U) != 0;
    if (before && (minded.cars[bit].committed || follows_own)
        && (user->brakes_mps2 < braking_for_begun_mps2
            || minded.cars[bit].cannot_stop))
      continue; // it lets the car pass, or has to
    auto& window = order.windows[order.count++];
    if (before) {
      window = {clear_m, -speed_constraints::never,
                user->enter_s - minded.cars[bit].gap_s};
      possible &= soonest_s(clear_m, car) <= window.latest_s;
    } else {
      window = {line_m, user->leave_s + gap_after_s, speed_constraints::never};
      possible &= std::isfinite(window.earliest_s);
    }
  }
  assert(order.count <= crossing_order::most_windows);
  return possible;
}

/// Who goes before one at a place goes before all who come there later, too.
/// @returns the bits with those of such cars.
std::uint32_t with_later(std::uint32_t bits, const minded_cars& minded) {
  assert(bits >> minded.car_count == 0);
  assert(minded.count <= minded.places.size());
  const auto is_before = [&](const minded_place& x) {
    return (bits >> x.car & 1U) != 0;
  };
  for (std::size_t i = 0; i < minded.count; ++i)
    for (std::size_t k = 0; k < minded.count; ++k) {
      const auto &a = minded.places[i], &b = minded.places[k];
      if (is_before(a) && !is_before(b) && a.user->enter_s <= b.user->enter_s
          && a.user->from_m < b.user->to_m && b.user->from_m < a.user->to_m)
        return with_later(bits | 1U << b.car, minded);
    }
  return bits;
}

/// @returns the bits of the cars that the last plan went before.
std::uint32_t bits_of(const crossing_choice& last, const minded_cars& minded) {
  if (last.waits)
    return crossing_order::waits;
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < minded.car_count; ++i)
    if (last.goes_before(minded.cars[i].body))
      bits |= 1U << i;
  return with_later(bits, minded);
}

} // namespace

double soonest_s(double way_m, const crossing_car& car) {
  const auto v = car.speed_mps, a = car.max_accel_mps2;
  const auto top = std::max(v, car.top_mps);
  assert(v >= 0 && a > 0);
  const auto until_top = (top * top - v * v) / (2 * a);
  if (way_m < until_top)
    return (std::sqrt(v * v + 2 * a * std::max(way_m, 0.0)) - v) / a;
  return (top - v) / a + (way_m - until_top) / top;
}

double stopping_m(const crossing_car& car) {
  const auto v = car.speed_mps;
  assert(v >= 0 && car.firm_decel_mps2 > 0);
  const auto begun = std::clamp(-car.accel_mps2 / car.firm_decel_mps2, 0., 1.);
  return v * ((1 - begun) * hesitation_s + v / (2 * car.firm_decel_mps2));
}

crossing_choice choice_of(const crossing_order& order) {
  crossing_choice choice{order.choice == crossing_order::waits, {}};
  for (std::size_t i = 0; i < order.cars.size(); ++i)
    if (!choice.waits && (order.choice >> i & 1U) != 0)
      choice.before[i] = order.cars[i];
  return choice;
}

crossing_choice going_on(crossing_choice last,
                         std::span<const crossing_user> users,
                         const crossing_car& car,
                         const std::function<double(double)>& way,
                         const std::function<double(double)>& when_s) {
  assert(way && when_s);
  const auto line_of = [&](const crossing_user& x) {
    return way(x.from_m - car.front_m);
  };
  auto first_m = speed_constraints::never; // of places before which it may stop
  for (const auto& x : users)
    if (x.goes_first && line_of(x) >= 0)
      first_m = std::min(first_m, line_of(x));
  if (last.waits || first_m > stopping_m(car))
    return last;
  const auto surely_goes_on =
      car.speed_mps * car.speed_mps > 2 * surely_goes_on_mps2 * first_m;
  const auto seen_there_s = soonest_s(first_m, car) + is_seen_there_s;
  for (const auto& user : users) {
    const auto free = std::ranges::find(last.before, 0U);
    if (free == last.before.end() || !user.goes_first || line_of(user) < 0
        || last.goes_before(user.body))
      continue;
    const auto all_of_it = [&](const auto& holds) {
      return std::ranges::all_of(users, [&](const crossing_user& x) {
        return x.body != user.body || holds(x);
      });
    };
    const auto is_past = [&](const crossing_user& x) {
      return when_s(way(x.to_m + car.rear_m)) < x.enter_s;
    };
    const auto can_stay_off = [&](const crossing_user& x) {
      return x.brakes_mps2 < little_braking_mps2
             && (surely_goes_on || seen_there_s < x.enter_s);
    };
    if ((line_of(user) <= stopping_m(car) && all_of_it(is_past))
        || all_of_it(can_stay_off))
      *free = user.body;
  }
  assert(!last.waits || last.before[0] == 0);
  return last;
}

bool list_orders(std::span<const crossing_user> users, const crossing_car& car,
                 const std::function<double(double)>& way,
                 const crossing_choice& last, std::size_t most,
                 std::vector<crossing_order>& out) {
  assert(most >= 1 && car.max_accel_mps2 > 0);
  assert(car.speed_mps >= 0 && way);
  const auto minded = find_minded(users, car, way, last);
  const auto before_all = (1U << minded.car_count) - 1;
  const auto first = bits_of(last, minded);
  crossing_order blank;
  for (std::size_t i = 0; i < minded.car_count; ++i)
    blank.cars[i] = minded.cars[i].body;
  out.clear();
  for (std::uint32_t choice = 0; choice <= before_all; ++choice) {
    auto order = blank;
    order.choice = choice;
    if (with_later(choice, minded) == choice && add_windows(minded, car, order))
      out.push_back(order);
  }
  put_first(out, before_all);
  put_first(out, 0);
  put_first(out, first);
  constexpr std::size_t always = 3; // the last one, after all, before all
  if (out.size() > std::max(most, always))
    out.resize(std::max(most, always));
  if (minded.car_count == 0) {
    assert(out.size() == 1 && out.front().count == 0);
    return true;
  }
  auto order = blank;
  order.choice = crossing_order::waits;
  for (std::size_t i = 0; i < minded.count; ++i)
    order.stop_m = std::min(order.stop_m, minded.places[i].line_m);
  assert(order.stop_m >= 0); // before the first crossing, and not behind
  out.push_back(order);
  put_first(out, first);
  return out.front().choice == first;
}

bool leaves_room(const lane_obstacle& body, side_of_road side,
                 double half_width_m) {
  const auto room = side == side_of_road::right
                        ? body.low_m + half_width_m
                        : half_width_m + body.left_m - body.high_m;
  return room >= corridor::room_beside_m - body.lacks_m;
}

void list_sides(std::span<const lane_obstacle> bodies, double half_width_m,
                std::uint32_t first, std::size_t most,
                std::vector<passing_order>& out) {
  assert(most >= 1 && !(half_width_m < 0));
  const auto n = std::min(bodies.size(), most_bodies);
  const auto side_in = [](std::uint32_t choice, std::size_t i) {
    return (choice >> i & 1U) != 0 ? side_of_road::right : side_of_road::left;
  };
  std::size_t used = 0;
  for (std::uint32_t choice = 0; choice < (1U << n); ++choice) {
    auto possible = true;
    for (std::size_t i = 0; i < n; ++i)
      possible &= leaves_room(bodies[i], side_in(choice, i), half_width_m);
    if (!possible)
      continue;
    if (used == out.size())
      out.emplace_back();
    assert(used < out.size());
    auto& order = out[used++];
    order.choice = choice;
    order.bodies.clear();
    for (std::size_t i = 0; i < n; ++i)
      order.bodies.push_back({bodies[i], side_in(choice, i)});
  }
  out.resize(used);
  assert(n > 0 || used == 1); // nothing can be passed in one way
  put_first(out, first);
  if (out.size() > most)
    out.resize(std::max<std::size_t>(most, 1));
}

} // namespace sofof::planners
