// A folder of one's own with our scenarios in it; gone with its test.
#pragma once

#include "tests/support/program.hpp"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::test {

inline constexpr auto scenario_file = "config/ulm_lehr.toml";

class workplace {
public:
  workplace() {
    static std::atomic<int> count = 0;
    base_ = std::filesystem::temp_directory_path()
            / ("sofof_processes_" + std::to_string(getpid()) + "_"
               + std::to_string(count++));
    std::filesystem::create_directories(here());
    std::filesystem::copy(source / "config", here() / "config",
                          std::filesystem::copy_options::recursive);
  }
  ~workplace() {
    std::error_code ignored;
    std::filesystem::remove_all(base_, ignored);
  }
  workplace(const workplace&) = delete;
  workplace& operator=(const workplace&) = delete;

  std::filesystem::path here() const { return base_ / "here"; }
  std::filesystem::path operator/(const std::filesystem::path& name) const {
    return here() / name;
  }

  ending run_sofof(const std::vector<std::string>& arguments,
                   const conditions& how = {}) const {
    return test::run_sofof(arguments, here(), how);
  }

  /// Drives our scenario; the test ends when that goes wrong.
  /// @returns the results folder.
  std::filesystem::path drive(const std::string& out,
                              std::vector<std::string> more) const {
    more.insert(more.begin(), {"run", scenario_file, "--out", out, "--quiet"});
    const auto end = run_sofof(more);
    CAPTURE(end.err);
    REQUIRE(end.code == 0);
    CHECK(end.out == "");
    CHECK(end.err == "");
    return here() / out;
  }

  void write(const std::filesystem::path& name, std::string_view text) const {
    std::ofstream{here() / name, std::ios::binary} << text;
  }

  /// @returns all that lies here, in order; files with their size.
  std::vector<std::string> inventory() const {
    std::vector<std::string> all;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator{here()})
      all.push_back(entry.path().string()
                    + (entry.is_regular_file()
                           ? " " + std::to_string(entry.file_size())
                           : "/"));
    std::ranges::sort(all);
    return all;
  }

private:
  inline static const std::filesystem::path source{SOFOF_SOURCE_DIR};
  std::filesystem::path base_;
};

/// @returns our scenario file with the first `from` replaced.
inline std::string scenario_with(std::string_view from, std::string_view to) {
  auto text =
      read_file(std::filesystem::path{SOFOF_SOURCE_DIR} / scenario_file);
  const auto at = text.find(from);
  if (at == text.npos)
    throw std::logic_error{"the scenario has no " + std::string{from}};
  return text.replace(at, from.size(), to);
}

} // namespace sofof::test
