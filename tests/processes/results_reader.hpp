// Reads a results folder as a notebook would.
#pragma once

#include "tests/support/program.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace sofof::test {

/// One line of a CSV file, by the names of the columns.
using row = std::map<std::string, std::string>;

inline double number(const row& r, const std::string& column) {
  return std::stod(r.at(column));
}

inline std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::istringstream in{read_file(file)};
  std::vector<std::string> all;
  for (std::string line; std::getline(in, line);)
    all.push_back(line);
  return all;
}

/// Our scenario's names need no quotes, so neither does a field.
inline std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> all;
  std::istringstream in{line + ','};
  for (std::string field; std::getline(in, field, ',');)
    all.push_back(field);
  return all;
}

/// Every line must have as many fields as the first one.
inline std::vector<row> rows_of(const std::filesystem::path& file) {
  const auto lines = lines_of(file);
  REQUIRE(!lines.empty());
  const auto names = fields_of(lines.front());
  std::vector<row> rows;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const auto fields = fields_of(lines[i]);
    CAPTURE(lines[i]);
    REQUIRE(fields.size() == names.size());
    row r;
    for (std::size_t k = 0; k < names.size(); ++k)
      r.emplace(names[k], fields[k]);
    rows.push_back(std::move(r));
  }
  return rows;
}

/// What one side closed for one kind of service.
inline std::vector<row> episodes_of(const std::filesystem::path& folder,
                                    const std::string& side,
                                    const std::string& service) {
  auto rows = rows_of(folder / "episodes.csv");
  std::erase_if(rows, [&](const row& r) {
    return r.at("side") != side || r.at("service") != service;
  });
  return rows;
}

inline nlohmann::json summary_of(const std::filesystem::path& folder) {
  return nlohmann::json::parse(read_file(folder / "summary.json"));
}

inline bool ends_with_a_whole_line(const std::filesystem::path& file) {
  return read_file(file).ends_with('\n');
}

} // namespace sofof::test
