// What each side wants of all that is on a broker.
#include "actors/broker/wire.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sofof::actors::wire {

std::string selector_of_vehicles(const std::vector<station_id>& stations) {
  auto all = stations;
  std::ranges::sort(all);
  std::string text = "(mid = 2052 AND destination_station_id IS NULL)";
  for (std::size_t i = 0; i < all.size();) {
    auto end = i + 1;
    while (end < all.size() && all[end].value() == all[end - 1].value() + 1)
      ++end;
    text += fmt::format(" OR destination_station_id BETWEEN {} AND {}", all[i],
                        all[end - 1]);
    i = end;
  }
  // Else all, of which its own are picked.
  return text.size() <= 2048 ? text : std::string{};
}

std::string selector_of_provider(station_id own) {
  return fmt::format("(destination_station_id IS NULL OR "
                     "destination_station_id = {0}) AND (station_id IS NULL OR "
                     "station_id <> {0})",
                     own);
}

} // namespace sofof::actors::wire
