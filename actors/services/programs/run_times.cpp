// A line, a time.
#include "actors/services/programs/run_times.hpp"

#include "base/files/regular_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <stdexcept>
#include <string_view>

namespace sofof::actors {

namespace {

constexpr std::size_t most_octets_of_times = 1 << 24;
constexpr double longest_run_time_ms = 60'000;

} // namespace

std::shared_ptr<const std::vector<duration>>
read_run_times(const std::filesystem::path& file) {
  const auto content = read_regular_file(file, most_octets_of_times);
  if (!content.refusal.empty())
    throw std::invalid_argument{fmt::format("the file {} cannot be read: {}",
                                            file.string(), content.refusal)};
  std::vector<duration> all;
  std::string_view left = content.text;
  for (int number = 1; !left.empty(); ++number) {
    const auto line = left.substr(0, left.find('\n'));
    left.remove_prefix(std::min(line.size() + 1, left.size()));
    if (line.empty() || line.front() == '#')
      continue;
    double time_ms = 0;
    const auto [end, error] =
        std::from_chars(line.data(), line.data() + line.size(), time_ms);
    if (error != std::errc{} || end != line.data() + line.size()
        || !(time_ms > 0 && time_ms <= longest_run_time_ms))
      throw std::invalid_argument{
          fmt::format("{}:{}: \"{}\" is no time in ms, above 0 and at most {}",
                      file.string(), number, line, longest_run_time_ms)};
    all.push_back(from_seconds(1e-3 * time_ms));
  }
  if (all.empty())
    throw std::invalid_argument{
        fmt::format("the file {} has no times", file.string())};
  return std::make_shared<const std::vector<duration>>(std::move(all));
}

} // namespace sofof::actors
