// How much a peer may send, by all its connections together.
#include "actors/remote/frame_allowance.hpp"

#include <algorithm>
#include <chrono>

namespace sofof::actors {

namespace {

constexpr double frames_per_station_s = 400;
constexpr double octets_per_station_s = 512 * 1024;
constexpr std::chrono::seconds backlog{2};

network::token_bucket limit_of(double per_second) {
  return {per_second, per_second * to_seconds(backlog)};
}

} // namespace

frame_bounds bounds_for(std::size_t stations) {
  const auto shares = 1 + static_cast<double>(stations);
  return {shares * frames_per_station_s, shares * octets_per_station_s};
}

frame_allowance::frame_allowance(frame_bounds bounds)
    : frames_{limit_of(bounds.frames_s)}, octets_{limit_of(bounds.octets_s)} {}

std::string_view frame_allowance::objection(std::size_t octets,
                                            time_point now) {
  last_ = std::max(last_, now);
  if (!frames_.try_spend(now))
    return "it sends too many messages";
  if (!octets_.try_spend(now, static_cast<double>(octets)))
    return "it sends too many octets";
  return {};
}

bool frame_allowance::is_whole(time_point now) const {
  return last_ == time_point::min() || now - last_ >= backlog;
}

std::shared_ptr<frame_allowance> frame_allowances::of(const std::string& peer,
                                                      frame_bounds bounds,
                                                      time_point now) {
  std::erase_if(by_peer_, [now](const auto& known) {
    return known.second.use_count() == 1 && known.second->is_whole(now);
  });
  auto& allowance = by_peer_[peer];
  if (!allowance)
    allowance = std::make_shared<frame_allowance>(bounds);
  return allowance;
}

} // namespace sofof::actors
