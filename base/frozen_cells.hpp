// A grid of cells to which nothing is added any more.
#pragma once

#include "base/cell_grid.hpp"

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sofof {

/// Things of a cell_grid, each cell's side by side: one look at memory for the
/// cell, one for what is in it. A thing in several cells is there several
/// times.
template <class T>
class frozen_cells {
public:
  frozen_cells() = default;

  /// @param grid   Small enough for 2^32 things.
  /// @param thing  @returns the thing of an item of the grid.
  template <class Thing>
  frozen_cells(const cell_grid& grid, Thing thing) : cell_m_{grid.cell_m()} {
    std::size_t count = 0;
    grid.for_each_cell([&count](const auto&) { ++count; });
    table_.resize(std::bit_ceil(2 * count + 1));
    grid.for_each_keyed_cell([&](std::uint64_t key, const auto& items) {
      auto& place = table_[find(key)];
      assert(place.begin == place.end);
      place.key = key;
      place.begin = static_cast<std::uint32_t>(things_.size());
      for (const auto it : items)
        things_.push_back(thing(it));
      place.end = static_cast<std::uint32_t>(things_.size());
    });
    things_.shrink_to_fit();
  }

  /// @returns what is in the cell of `p`, in the order of filing.
  std::span<const T> at(point p) const {
    if (table_.empty())
      return {};
    const auto& place = table_[find(cell_grid::key_of(p, cell_m_))];
    return std::span{things_}.subspan(place.begin, place.end - place.begin);
  }

private:
  struct place {
    std::uint64_t key = 0;
    std::uint32_t begin = 0, end = 0; // equal: nothing is here
  };

  /// @returns where the cell is, or would be. Half of the places are free.
  std::size_t find(std::uint64_t key) const {
    constexpr std::uint64_t odd = 0x9e3779b97f4a7c15; // 2^64 / golden ratio
    auto i = (key * odd >> 32) & (table_.size() - 1);
    while (table_[i].begin != table_[i].end && table_[i].key != key)
      i = (i + 1) & (table_.size() - 1);
    return i;
  }

  double cell_m_ = 1;
  std::vector<place> table_; // a power of two of them
  std::vector<T> things_;
};

} // namespace sofof
