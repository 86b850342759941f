// Numbers as text.
#include "live/frame.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace sofof::live {

namespace {

/// Results that came so long ago tell nothing of now.
constexpr duration latency_counts = std::chrono::seconds{1};

constexpr int on_board = -1, not_known = -2, by_somebody = -3;

/// @returns the place of who plans, counting from 0, or one of the above.
int place_number(const seen_car& x) {
  if (x.plans == planned::on_board)
    return on_board;
  if (x.plans == planned::not_known)
    return not_known;
  return x.place ? static_cast<int>(*x.place) : by_somebody;
}

bool is_finite(const seen_car& x) {
  return std::isfinite(x.position.x_m) && std::isfinite(x.position.y_m)
         && std::isfinite(x.heading_rad) && std::isfinite(x.speed_mps);
}

void write_cars(std::back_insert_iterator<std::string> to, const moment& of,
                const std::map<station_id, seen_car>& cars) {
  auto is_first = true;
  for (const auto& [station, x] : cars) {
    if (!is_finite(x)) // nobody's CAM says so, but nobody can rely on that
      continue;
    fmt::format_to(to, "{}[{},{:.3f},{:.2f},{:.2f},{:.4f},{:.2f},{},",
                   is_first ? "" : ",", station.value(),
                   to_seconds(x.at - of.start), x.position.x_m, x.position.y_m,
                   x.heading_rad, x.speed_mps, place_number(x));
    is_first = false;
    if (x.latency && x.plans == planned::by_provider
        && of.now - x.result_at < latency_counts)
      fmt::format_to(to, "{:.1f}]", 1e3 * to_seconds(*x.latency));
    else
      fmt::format_to(to, "null]");
  }
}

} // namespace

std::string frame_text(const moment& of,
                       const std::map<station_id, seen_car>& cars,
                       std::span<const scenario::operations::load> loads,
                       std::span<const std::string> names,
                       const seen_counts& counts) {
  std::string text;
  const auto to = std::back_inserter(text);
  fmt::format_to(to, R"({{"run":"{}","n":{},"t":{:.3f},"ending":{},"cars":[)",
                 of.run, of.number, to_seconds(of.now - of.start),
                 of.is_ending);
  write_cars(to, of, cars);
  fmt::format_to(to, R"(],"loads":[)");
  for (std::size_t i = 0; i < loads.size(); ++i)
    fmt::format_to(to, "{}[{},{},{:.3f}]", i == 0 ? "" : ",",
                   std::ranges::find(names, loads[i].provider) - names.begin(),
                   loads[i].workers, loads[i].busy);
  fmt::format_to(to,
                 R"(],"counts":{{"violations":{},"fallbacks":{},"episodes":{},)"
                 R"("driven_s":{:.1f},"without_plan_s":{:.2f}}})",
                 counts.violations, counts.fallbacks, counts.episodes,
                 counts.driven_s, counts.without_plan_s);
  return text;
}

std::string event_text(const std::string& frame, time_point start,
                       std::span<const told_event> events, std::uint64_t last) {
  auto all = nlohmann::json::array();
  for (const auto& x : events) {
    all.push_back({x.number, to_seconds(x.at - start), x.what,
                   x.station.value(), x.place ? static_cast<int>(*x.place) : -1,
                   x.service, x.detail, x.group});
    last = x.number;
  }
  return fmt::format(
      "id: {}\ndata: {},\"events\":{}}}\n\n", last, frame,
      all.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

} // namespace sofof::live
