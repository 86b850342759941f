// The plane cut into square cells, to find what is near without looking at
// everything.
#pragma once

#include "base/geometry.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

namespace sofof {

/// Things by the cells that they touch.
class cell_grid {
public:
  using item = std::uint32_t;

  /// @param cell_m  Edge of a cell, m, > 0.
  explicit cell_grid(double cell_m = 10) : cell_m_{cell_m} {
    assert(cell_m > 0);
  }

  /// Files `it` under every cell that the segment's bounding box, grown by
  /// `margin_m`, touches. One item may be filed many times.
  void add(point a, point b, double margin_m, item it) {
    for_cells(a, b, margin_m, [&](std::uint64_t key) {
      auto& cell = cells_[key];
      if (cell.empty() || cell.back() != it)
        cell.push_back(it);
    });
  }

  /// Forgets all items, but keeps their memory for the next ones.
  void clear() {
    for (auto& [key, items] : cells_)
      items.clear();
  }

  /// Calls `visit(item)` for everything in the cells within `radius_m` of `p`,
  /// cell by cell from west to east and south to north, in each in the order
  /// of filing; an item may come twice.
  template <class Visitor>
  void for_each_near(point p, double radius_m, Visitor visit) const {
    for_cells(p, p, radius_m, [&](std::uint64_t key) {
      if (const auto cell = cells_.find(key); cell != cells_.end())
        for (const auto it : cell->second)
          visit(it);
    });
  }

  /// Looks in the cells within `radius_m` of `p`, first in that of `p`; an item
  /// may be asked twice.
  /// @returns something for which `holds(item)` is true; nullopt if it is true
  /// for nothing there.
  template <class Predicate>
  std::optional<item> any_near(point p, double radius_m,
                               Predicate holds) const {
    std::optional<item> found;
    const auto look = [&](std::uint64_t key) {
      if (const auto cell = cells_.find(key); !found && cell != cells_.end())
        if (const auto it = std::ranges::find_if(cell->second, holds);
            it != cell->second.end())
          found = *it;
    };
    for_cells(p, p, 0, look);
    if (!found)
      for_cells(p, p, radius_m, look);
    return found;
  }

  /// Calls `visit(items)` for every cell, in no particular order.
  template <class Visitor>
  void for_each_cell(Visitor visit) const {
    for (const auto& [key, items] : cells_)
      visit(items);
  }

  /// Calls `visit(key, items)` likewise.
  template <class Visitor>
  void for_each_keyed_cell(Visitor visit) const {
    for (const auto& [key, items] : cells_)
      visit(key, items);
  }

  double cell_m() const { return cell_m_; }

  /// @returns the key of the cell of `p` in a grid of this edge.
  static std::uint64_t key_of(point p, double cell_m) {
    return key_of(index(p.x_m, cell_m), index(p.y_m, cell_m));
  }

private:
  static std::uint64_t key_of(std::int64_t x, std::int64_t y) {
    return static_cast<std::uint64_t>(x) << 32
           ^ (static_cast<std::uint64_t>(y) & 0xffffffff);
  }

  // What is too far away for a key, or is no number, lies in one cell far off.
  static std::int64_t index(double x_m, double cell_m) {
    constexpr std::int64_t farthest = 1 << 30;
    const auto cell = x_m / cell_m;
    if (!(std::abs(cell) < farthest))
      return -farthest;
    const auto whole = static_cast<std::int64_t>(cell); // towards 0
    return whole - (cell < static_cast<double>(whole) ? 1 : 0);
  }

  template <class Function>
  void for_cells(point a, point b, double margin_m, Function f) const {
    const auto at = [this](double x_m) { return index(x_m, cell_m_); };
    const auto right = at(std::max(a.x_m, b.x_m) + margin_m);
    const auto top = at(std::max(a.y_m, b.y_m) + margin_m);
    for (auto x = at(std::min(a.x_m, b.x_m) - margin_m); x <= right; ++x)
      for (auto y = at(std::min(a.y_m, b.y_m) - margin_m); y <= top; ++y)
        f(key_of(x, y));
  }

  double cell_m_;
  std::unordered_map<std::uint64_t, std::vector<item>> cells_;
};

} // namespace sofof
