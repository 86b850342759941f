// Finds blocks in the sections of a report.
#pragma once

#include "experiments/report/document.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>

namespace sofof::experiments::report {

/// @returns the first block of a kind.
template <class Block>
const Block& first_of(std::span<const section> sections,
                      std::string_view title) {
  for (const auto& one : sections)
    if (one.title == title)
      for (const auto& block : one.blocks)
        if (const auto* found = std::get_if<Block>(&block))
          return *found;
  FAIL("there is no such block in ", title);
  throw std::logic_error{"unreachable"};
}

inline const std::string& cell(const table& in, std::string_view row,
                               std::size_t column) {
  const auto found = std::ranges::find(in.rows, row, [](const auto& cells) {
    return std::string_view{cells[0]};
  });
  REQUIRE(found != in.rows.end());
  return found->at(column);
}

} // namespace sofof::experiments::report
