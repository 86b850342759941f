// A run as files: what is ordered, and what comes back.
#include "scenario/sweep/order_files.hpp"

#include "scenario/run.hpp"

#include <fmt/format.h>

#include <iterator>
#include <stdexcept>

namespace sofof {

std::vector<file_piece> order_of(const scenario& s) {
  const std::string texts[] = {configuration_of(s), s.map_text, s.trace_text};
  std::size_t octets = 0;
  for (const auto& text : texts)
    octets += text.size();
  if (octets > largest_order)
    throw std::runtime_error{fmt::format(
        "configuration, map and trace have {} MiB, more than the {} MiB that "
        "workers take; use -j without --workers",
        octets >> 20, largest_order >> 20)};
  std::vector<file_piece> order;
  for (std::size_t i = 0; i < std::size(texts); ++i)
    for (std::size_t at = 0; at < texts[i].size(); at += longest_piece)
      order.push_back({std::string{files_of_an_order[i]},
                       texts[i].substr(at, longest_piece)});
  return order;
}

} // namespace sofof
