// Rows of one session out of those of all.
#include "experiments/explain/episode_files.hpp"

#include "base/text/csv_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

namespace sofof::experiments::explain {

namespace {

namespace fs = std::filesystem;
using columns = std::string_view[];

csv_reader::ending ending_of(const fs::path& folder) {
  return fs::exists(folder / "summary.json") ? csv_reader::ending::whole
                                             : csv_reader::ending::killed;
}

report::session_key name_of(const csv_reader& row) {
  return {.provider = row.text(0),
          .service = row.text(1),
          .provider_id = row.whole(2),
          .station = row.whole(3),
          .counter = row.whole(4)};
}

} // namespace

std::vector<closed_episode> read_episodes(const fs::path& folder) {
  static constexpr columns names{"provider",   "service",      "provider_id",
                                 "station",    "counter",      "side",
                                 "accepted_s", "first_data_s", "ended_s",
                                 "reason",     "fallback",     "because"};
  enum { side = 5, accepted, first_data, ended, reason, fallback, because };
  csv_reader row{folder / "episodes.csv", names, ending_of(folder)};
  std::vector<closed_episode> all;
  while (row.next())
    all.push_back({.of = name_of(row),
                   .by_requester = row.text(side) == "requester",
                   .accepted_s = row.number(accepted),
                   .first_data_s = row.number_if_any(first_data),
                   .ended_s = row.number(ended),
                   .reason = row.text(reason),
                   .fallback = row.flag(fallback),
                   .because = row.text(because)});
  return all;
}

std::optional<std::vector<received_result>>
read_results(const fs::path& folder, const report::session_key& session) {
  static constexpr columns names{
      "provider",     "service",  "provider_id",    "station",
      "counter",      "cycle",    "received_s",     "latency_ms",
      "input_age_ms", "used",     "uplink_wait_ms", "uplink_ms",
      "rest_ms",      "queue_ms", "computing_ms",   "downlink_wait_ms",
      "downlink_ms"};
  enum { cycle = 5, received, latency, input_age, used, parts };
  const auto file = folder / "cycles.csv";
  if (!fs::exists(file))
    return std::nullopt;
  csv_reader row{file, names, ending_of(folder)};
  std::vector<received_result> all;
  const auto part = [&row](std::size_t k) { return row.number(parts + k); };
  while (row.next()) {
    if (row.whole(3) != session.station || name_of(row) != session)
      continue;
    all.push_back({.cycle = row.whole(cycle),
                   .received_s = row.number(received),
                   .latency_ms = row.number(latency),
                   .input_age_ms = row.number(input_age),
                   .used = row.flag(used),
                   .ms = {part(0), part(1), part(2), part(3), part(4), part(5),
                          part(6)}});
  }
  return all;
}

bool has_gaps(const fs::path& folder, const report::session_key& session) {
  static constexpr columns names{"provider", "service", "provider_id",
                                 "station",  "counter", "cycle"};
  const auto file = folder / "cycles.csv";
  if (!fs::exists(file))
    return false;
  std::map<std::uint64_t, std::uint64_t> last; // cycle by counter
  csv_reader row{file, names, ending_of(folder)};
  while (row.next()) {
    auto of = name_of(row);
    const auto counter = std::exchange(of.counter, session.counter);
    if (of != session)
      continue;
    const auto cycle = row.whole(5);
    const auto [before, is_first] = last.try_emplace(counter, cycle);
    if (!is_first && cycle > before->second + 1)
      return true;
    before->second = cycle;
  }
  return false;
}

std::optional<double> lost_share(const fs::path& folder,
                                 const std::string& provider,
                                 const std::string& service) {
  static constexpr columns names{"provider", "direction", "what", "sent",
                                 "lost"};
  const auto file = folder / "octets.csv";
  if (!fs::exists(file))
    return std::nullopt;
  csv_reader row{file, names, ending_of(folder)};
  while (row.next())
    if (row.text(0) == provider && row.text(1) == "down"
        && row.text(2) == service && row.number(3) > 0)
      return row.number(4) / row.number(3);
  return std::nullopt;
}

asked_shares read_load(const fs::path& folder, const std::string& provider,
                       double at_s) {
  static constexpr columns names{"t_s", "provider", "what", "asked_share"};
  asked_shares all;
  const auto file = folder / "load.csv";
  if (!fs::exists(file))
    return all;
  csv_reader row{file, names, ending_of(folder)};
  const auto second = std::floor(at_s);
  while (row.next())
    if (row.number(0) >= second - 1 && row.number(0) <= second
        && row.text(1) == provider)
      all[row.text(2)] = std::max(all[row.text(2)], row.number(3));
  return all;
}

} // namespace sofof::experiments::explain
