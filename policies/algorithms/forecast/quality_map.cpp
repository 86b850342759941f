// How often results were late where: a map of square cells.
#include "policies/algorithms/forecast/quality_map.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::policies {

namespace {

/// What is farther away lies in the last cell.
constexpr double farthest_cell = 1e9;

std::int64_t cell_index(double x_m, double cell_m) {
  const auto cell = std::floor(x_m / cell_m);
  return static_cast<std::int64_t>(
      std::isnan(cell) ? -farthest_cell
                       : std::clamp(cell, -farthest_cell, farthest_cell));
}

[[maybe_unused]] bool is_sound(const cell_quality& x) {
  return x.visits >= 0 && x.late >= 0 && x.late <= x.visits && x.latency_s >= 0;
}

} // namespace

quality_map::quality_map(const quality_map_options& options)
    : options_{options} {
  assert(options.cell_m > 0 && options.prior_visits > 0 && options.memory > 0);
  assert(options.prior_late >= 0 && options.prior_late <= 1);
}

map_cell quality_map::cell_of(point at) const {
  return {cell_index(at.x_m, options_.cell_m),
          cell_index(at.y_m, options_.cell_m)};
}

void quality_map::add(std::string_view service, provider_id provider,
                      map_cell cell, const cell_quality& known) {
  assert(is_sound(known));
  const auto share =
      known.visits > options_.memory ? options_.memory / known.visits : 1;
  const auto visits = known.visits * share;
  const std::lock_guard locked{mutex_};
  auto& x = cells_[{std::string{service}, provider}][cell];
  if (const auto all = x.visits + visits; all > options_.memory) {
    const auto kept = (options_.memory - visits) / x.visits;
    x.visits *= kept;
    x.late *= kept;
  }
  if (known.latency_s > 0) {
    const auto before = x.latency_s > 0 ? x.visits : 0;
    const auto weight = visits > 0 ? visits / (before + visits) : 0;
    x.latency_s += weight * (known.latency_s - x.latency_s);
  }
  x.visits += visits;
  x.late = std::min(x.late + known.late * share, x.visits);
  assert(is_sound(x));
}

cell_quality quality_map::at(std::string_view service, provider_id provider,
                             map_cell cell) const {
  const std::lock_guard locked{mutex_};
  const auto of = cells_.find({std::string{service}, provider});
  if (of == cells_.end())
    return {};
  const auto there = of->second.find(cell);
  return there == of->second.end() ? cell_quality{} : there->second;
}

double quality_map::late(std::string_view service, provider_id provider,
                         map_cell cell) const {
  const auto known = at(service, provider, cell);
  const auto& o = options_;
  const auto p = (known.late + o.prior_visits * o.prior_late)
                 / (known.visits + o.prior_visits);
  assert(p >= 0 && p <= 1);
  return p;
}

std::vector<quality_map::entry> quality_map::entries() const {
  const std::lock_guard locked{mutex_};
  const auto middle_m = [this](std::int64_t cell) {
    return (static_cast<double>(cell) + 0.5) * options_.cell_m;
  };
  std::vector<entry> all;
  for (const auto& [of, cells] : cells_)
    for (const auto& [cell, known] : cells)
      all.push_back({of.first,
                     of.second,
                     {middle_m(cell.column), middle_m(cell.row)},
                     known});
  return all;
}

void quality_map::add(const quality_map& other) {
  assert(&other != this);
  for (const auto& x : other.entries())
    add(x.service, x.provider, cell_of(x.at), x.known);
}

} // namespace sofof::policies
