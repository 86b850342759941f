// Adding up distributions.csv.
#include "experiments/dehler2025/histogram.hpp"

#include "base/text/csv_reader.hpp"

#include <utility>

namespace sofof::experiments::study {

void histogram::add(const histogram& other) {
  for (const auto& [up_to_ms, count] : other.bins_)
    add(up_to_ms, count);
}

std::uint64_t histogram::count() const {
  std::uint64_t all = 0;
  for (const auto& [up_to_ms, count] : bins_)
    all += count;
  return all;
}

report::curve histogram::cumulative(std::string name) const {
  report::curve shares;
  shares.name = std::move(name);
  shares.drawn = report::curve::style::steps;
  const auto all = static_cast<double>(count());
  std::uint64_t so_far = 0;
  for (const auto& [up_to_ms, count] : bins_) {
    so_far += count;
    shares.x.push_back(up_to_ms);
    shares.y.push_back(static_cast<double>(so_far) / all);
  }
  return shares;
}

double histogram::share_above(double ms) const {
  std::uint64_t above = 0, all = 0;
  for (const auto& [up_to_ms, count] : bins_) {
    all += count;
    if (up_to_ms > ms)
      above += count;
  }
  return all == 0 ? 0 : static_cast<double>(above) / static_cast<double>(all);
}

histogram read_histogram(const std::filesystem::path& folder,
                         std::string_view service, std::string_view figure) {
  constexpr std::string_view columns[] = {"service", "figure", "up_to_ms",
                                          "count"};
  csv_reader rows{folder / "distributions.csv", columns};
  histogram all;
  while (rows.next())
    if (rows.text(0) == service && rows.text(1) == figure)
      all.add(rows.number(2), rows.whole(3));
  return all;
}

} // namespace sofof::experiments::study
