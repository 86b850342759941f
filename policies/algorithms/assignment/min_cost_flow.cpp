// The best assignment in polynomial time, where vehicles want equal amounts.
#include "policies/algorithms/assignment/min_cost_flow.hpp"

#include "policies/algorithms/assignment/reduced_problem.hpp"

#include <algorithm>
#include <limits>

namespace sofof::policies::assignment {

namespace {

constexpr auto unreachable = std::numeric_limits<double>::infinity();

/// @returns how many vehicles a provider can serve, if all want the same of it.
std::optional<int> seats_at(const reduced_problem& s, int provider) {
  std::optional<int> first;
  free_capacity left{s.shares, s.providers()};
  int seats = 0;
  for (int v = 0; v < s.vehicles(); ++v) {
    if (s.advantage(v, provider) == 0)
      continue;
    first = first.value_or(v);
    for (const auto& shares : s.shares)
      if (shares(v, provider) != shares(*first, provider))
        return std::nullopt;
    if (!left.fits(v, provider))
      continue;
    left.occupy(v, provider);
    ++seats;
  }
  return seats;
}

/// Seats vehicles at providers; the place after the last provider is home, with
/// a seat for everybody.
class seating {
public:
  seating(const reduced_problem& s, std::vector<int> seats);

  /// Seats one more; the places of others may change.
  void seat(int vehicle);

  std::vector<choice> choices() const;

private:
  /// A way to make room at a place: by whom, and coming from where.
  struct step {
    double length = unreachable;
    int vehicle = 0;
    std::optional<int> from;
    bool settled = false;
  };

  double cost(int vehicle, int place) const;
  double reduced_cost(int vehicle, int place) const {
    return cost(vehicle, place) - potentials_[place];
  }
  bool has_seat(int place) const {
    return static_cast<int>(seated_[place].size()) < seats_[place];
  }
  std::vector<step> first_steps(int vehicle) const;
  void settle(std::vector<step>& steps, int place) const;
  void displace(const std::vector<step>& steps, int free_place);

  const reduced_problem& problem_;
  std::vector<int> seats_;
  std::vector<std::vector<int>> seated_;
  /// ≤ 0, and 0 where a seat is free: nobody wins by a change at reduced costs.
  std::vector<double> potentials_;
};

seating::seating(const reduced_problem& s, std::vector<int> seats)
    : problem_{s}, seats_{std::move(seats)} {
  seats_.push_back(s.vehicles());
  seated_.resize(seats_.size());
  potentials_.resize(seats_.size());
}

double seating::cost(int vehicle, int place) const {
  if (place == problem_.providers())
    return 0;
  const auto advantage = problem_.advantage(vehicle, place);
  return advantage > 0 ? -advantage : unreachable;
}

std::vector<seating::step> seating::first_steps(int vehicle) const {
  std::vector<step> result(seats_.size());
  for (int place = 0; place <= problem_.providers(); ++place) {
    result[place].length = reduced_cost(vehicle, place);
    result[place].vehicle = vehicle;
  }
  return result;
}

void seating::settle(std::vector<step>& steps, int place) const {
  steps[place].settled = true;
  for (const auto vehicle : seated_[place])
    for (int to = 0; to <= problem_.providers(); ++to) {
      const auto length = steps[place].length + reduced_cost(vehicle, to)
                          - reduced_cost(vehicle, place);
      if (!steps[to].settled && length < steps[to].length)
        steps[to] = {length, vehicle, place, false};
    }
}

void seating::displace(const std::vector<step>& steps, int free_place) {
  auto place = free_place;
  while (true) {
    const auto& s = steps[place];
    seated_[place].push_back(s.vehicle);
    if (!s.from)
      return;
    place = *s.from;
    auto& leaving = seated_[place];
    leaving.erase(std::find(leaving.begin(), leaving.end(), s.vehicle));
  }
}

void seating::seat(int vehicle) {
  auto steps = first_steps(vehicle);
  while (true) {
    const auto nearest = std::min_element(
        steps.begin(), steps.end(), [](const step& a, const step& b) {
          return !a.settled && (b.settled || a.length < b.length);
        });
    const auto place = static_cast<int>(nearest - steps.begin());
    if (!has_seat(place)) {
      settle(steps, place);
      continue;
    }
    for (std::size_t other = 0; other < steps.size(); ++other)
      if (steps[other].settled)
        potentials_[other] += steps[other].length - nearest->length;
    return displace(steps, place);
  }
}

std::vector<choice> seating::choices() const {
  std::vector<choice> result(problem_.vehicles(), local);
  for (int place = 0; place < problem_.providers(); ++place)
    for (const auto vehicle : seated_[place])
      result[vehicle] = place;
  return result;
}

} // namespace

std::optional<solution> min_cost_flow(const problem& p) {
  const auto s = stakes_of(p);
  std::vector<int> seats;
  for (int i = 0; i < s.providers(); ++i) {
    const auto at_this = seats_at(s, i);
    if (!at_this)
      return std::nullopt;
    seats.push_back(*at_this);
  }
  seating plan{s, std::move(seats)};
  for (int v = 0; v < s.vehicles(); ++v)
    plan.seat(v);
  const auto choices = plan.choices();
  if (!nobody_is_alone(p, choices))
    return std::nullopt;
  return solution{choices, value(p, choices)};
}

} // namespace sofof::policies::assignment
