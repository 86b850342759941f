// What is in a folder, and what is said of one that is refused.
#pragma once

#include "base/input_error.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace sofof::made_up {

inline std::vector<std::string> names_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator{folder})
    names.push_back(entry.path().filename());
  std::ranges::sort(names);
  return names;
}

inline std::string content_of(const std::filesystem::path& file) {
  std::ifstream in{file, std::ios::binary};
  REQUIRE(in.good());
  return {std::istreambuf_iterator<char>{in}, {}};
}

/// What an input_error says; empty if there is none.
template <class Action>
std::string complaint(Action action) {
  try {
    action();
  } catch (const input_error& error) {
    return error.what();
  }
  return {};
}

} // namespace sofof::made_up
