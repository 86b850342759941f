// Which provider serves which vehicle: what is given, and what an answer is.
#include "policies/algorithms/assignment/problem.hpp"

#include "policies/algorithms/assignment/reduced_problem.hpp"

#include <cmath>
#include <ranges>
#include <stdexcept>
#include <string>

namespace sofof::policies::assignment {

namespace {

[[noreturn]] void refuse(const std::string& sentence) {
  throw std::invalid_argument{"assignment: " + sentence};
}

template <class Table>
void check_size(const Table& table, const problem& p, const std::string& what) {
  if (table.rows() == p.vehicles() && table.cols() == p.providers())
    return;
  refuse(what + " has " + std::to_string(table.rows()) + " x "
         + std::to_string(table.cols()) + " entries; make it vehicles x "
         + "providers, " + std::to_string(p.vehicles()) + " x "
         + std::to_string(p.providers()) + ".");
}

std::string pair_name(int vehicle, int provider) {
  return "of vehicle " + std::to_string(vehicle) + " at provider "
         + std::to_string(provider);
}

void check_resource(const problem& p, std::size_t number) {
  const auto& r = p.resources[number];
  const auto name = "resource " + std::to_string(number);
  check_size(r.demand, p, "the demand for " + name);
  if (r.capacity.size() != static_cast<std::size_t>(p.providers()))
    refuse(name + " has " + std::to_string(r.capacity.size())
           + " capacities; give one to each of " + std::to_string(p.providers())
           + " providers.");
  for (const auto capacity : r.capacity)
    if (!(capacity >= 0))
      refuse("a capacity of " + name + " is " + std::to_string(capacity)
             + "; give a number that is not negative.");
  for (int v = 0; v < p.vehicles(); ++v)
    for (int i = 0; i < p.providers(); ++i)
      if (p.eligible(v, i)
          && !(r.demand(v, i) >= 0 && std::isfinite(r.demand(v, i))))
        refuse("the demand for " + name + " " + pair_name(v, i) + " is "
               + std::to_string(r.demand(v, i))
               + "; give a finite number that is not negative.");
}

void check_present(const problem& p) {
  if (p.present.size() != static_cast<std::size_t>(p.vehicles()))
    refuse("present has " + std::to_string(p.present.size())
           + " choices; give one to each of " + std::to_string(p.vehicles())
           + " vehicles.");
  for (const auto& c : p.present)
    if (c && (*c < 0 || *c >= p.providers()))
      refuse("present names provider " + std::to_string(*c) + " of "
             + std::to_string(p.providers()) + "; give its index, or local.");
}

void check_leaning(const problem& p) {
  if (p.leans_on.empty())
    return;
  if (p.leans_on.size() != static_cast<std::size_t>(p.vehicles()))
    refuse("leans_on has " + std::to_string(p.leans_on.size())
           + " entries; give one to each of " + std::to_string(p.vehicles())
           + " vehicles, or none.");
  check_size(p.lost_alone, p, "lost_alone");
  for (int v = 0; v < p.vehicles(); ++v) {
    auto on = p.leans_on[v];
    for (int steps = 0; on; on = p.leans_on[*on], ++steps)
      if (*on < 0 || *on >= p.vehicles() || steps == p.vehicles())
        refuse("vehicle " + std::to_string(v)
               + " leans on nobody there is, or in a circle; give the index "
                 "of another one that does not lean on it.");
  }
  for (int v = 0; v < p.vehicles(); ++v)
    for (int i = 0; i < p.providers(); ++i)
      if (p.leans_on[v] && p.eligible(v, i) && !(p.lost_alone(v, i) >= 0))
        refuse("the loss alone " + pair_name(v, i) + " is "
               + std::to_string(p.lost_alone(v, i))
               + "; give a number that is not negative.");
}

} // namespace

void check(const problem& p) {
  check_size(p.eligible, p, "eligible");
  for (int v = 0; v < p.vehicles(); ++v)
    for (int i = 0; i < p.providers(); ++i)
      if (p.eligible(v, i) && !std::isfinite(p.gains(v, i)))
        refuse("the gain " + pair_name(v, i)
               + " is not finite; give a number, "
                 "or make the pair not eligible.");
  for (std::size_t k = 0; k < p.resources.size(); ++k)
    check_resource(p, k);
  check_present(p);
  check_leaning(p);
  if (!(p.switching_price >= 0 && std::isfinite(p.switching_price)))
    refuse("the switching price is " + std::to_string(p.switching_price)
           + "; give a finite number that is not negative.");
}

double worth(const problem& p, int vehicle, choice c) {
  const auto present = p.present[vehicle];
  const double gain = c ? p.gains(vehicle, *c) : 0;
  if (c == present)
    return gain;
  const int changes = (c ? 1 : 0) + (present ? 1 : 0);
  return gain - p.switching_price * changes;
}

double value(const problem& p, const std::vector<choice>& choices) {
  double sum = 0;
  for (int v = 0; v < p.vehicles(); ++v)
    sum += worth(p, v, choices[v]) - loss_alone(p, choices, v, choices[v]);
  return sum;
}

bool feasible(const problem& p, const std::vector<choice>& choices) {
  const auto shares = shares_of(p);
  free_capacity left{shares, p.providers()};
  for (int v = 0; v < p.vehicles(); ++v) {
    const auto c = choices[v];
    if (!c)
      continue;
    if (!p.eligible(v, *c) || !left.fits(v, *c))
      return false;
    left.occupy(v, *c);
  }
  return true;
}

double loss_alone(const problem& p, const std::vector<choice>& choices,
                  int vehicle, choice c) {
  if (p.leans_on.empty() || !c)
    return 0;
  const auto on = p.leans_on[vehicle];
  return on && choices[*on] != c ? p.lost_alone(vehicle, *c) : 0;
}

bool nobody_is_alone(const problem& p, const std::vector<choice>& choices) {
  for (int v = 0; v < p.vehicles(); ++v)
    if (loss_alone(p, choices, v, choices[v]) > 0)
      return false;
  return true;
}

std::vector<int> leaning_last(const problem& p, const std::vector<int>& order) {
  if (p.leans_on.empty())
    return order;
  std::vector<int> result;
  std::vector<bool> is_placed(order.size());
  for (const auto v : order) {
    std::vector<int> way;
    for (std::optional<int> next = v; next && !is_placed[*next];
         next = p.leans_on[*next])
      way.push_back(*next);
    for (const auto link : std::views::reverse(way)) {
      is_placed[link] = true;
      result.push_back(link);
    }
  }
  return result;
}

} // namespace sofof::policies::assignment
