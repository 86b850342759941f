// The page of the protocol's rules, held against the rules.
#include "experiments/conformance/rules.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

using namespace sofof::experiments::conformance;

TEST_CASE("docs/trace.md has the rules that traces are held against, in their "
          "order and words") {
  std::ifstream page{std::filesystem::path{SOFOF_SOURCE_DIR} / "docs/trace.md"};
  std::vector<std::string> printed, known;
  for (std::string line; std::getline(page, line);)
    if (line.size() > 3 && line.starts_with("| ")
        && std::string_view{"VSPMC"}.find(line[2]) != std::string_view::npos
        && std::isdigit(static_cast<unsigned char>(line[3])))
      printed.push_back(line);
  for (const auto& x : all_rules)
    known.push_back(fmt::format("| {} | {}. |", x.id, x.sentence));
  CHECK(printed == known);
}
