// Things that are known by the name of their file: policies, filters,
// governors, services, planners. CMake makes a table of each folder of them
// (cmake/sofof_table.cmake).
#pragma once

#include <string_view>
#include <vector>

namespace sofof {

/// What a file NAME.cpp of such a folder defines.
template <class T>
struct named {
  std::string_view name;
  T (*make)();
};

/// @returns what makes the one of this name; null for an unknown name.
template <class Table>
auto find_named(const Table& table, std::string_view name) {
  for (const auto& entry : table)
    if (entry.name == name)
      return &entry.make;
  return static_cast<decltype(&table[0].make)>(nullptr);
}

/// @returns all names, in the order of the table, which CMake sorts.
template <class Table>
std::vector<std::string_view> names_of(const Table& table) {
  std::vector<std::string_view> all;
  for (const auto& entry : table)
    all.push_back(entry.name);
  return all;
}

} // namespace sofof
