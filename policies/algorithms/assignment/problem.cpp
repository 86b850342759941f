// Which provider serves which vehicle: what is given, and what an answer is.
#include "policies/algorithms/assignment/problem.hpp"

#include "policies/algorithms/assignment/reduced_problem.hpp"

#include <cmath>
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
    sum += worth(p, v, choices[v]);
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

} // namespace sofof::policies::assignment
