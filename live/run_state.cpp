// Puts down the newest of each.
#include "live/run_state.hpp"

#include "experiments/report/event_group.hpp"
#include "messages/protocol/event_type.hpp"

#include <algorithm>
#include <iterator>
#include <utility>
#include <variant>

namespace sofof::live {

namespace {

using messages::event_type;

constexpr std::size_t longest_detail = 240;

/// What is said again and again, that a provider refuses, is told so often.
constexpr duration told_again_after = std::chrono::seconds{10};

bool says_the_same(const told_event& a, const told_event& b) {
  return a.what == b.what && a.station == b.station && a.place == b.place
         && a.service == b.service && a.detail == b.detail;
}

/// @returns the place of a provider in the file, counting from 0.
std::optional<std::uint64_t> place_from(provider_id provider) {
  const auto counted_from_1 = place_of(provider).value();
  if (counted_from_1 == 0)
    return std::nullopt;
  return counted_from_1 - 1;
}

/// @returns the group that an event is shown in; empty: it is not.
std::string_view shown_in(event_type what) {
  switch (what) {
    case event_type::switched:
      return "switch";
    case event_type::peer_connected:
    case event_type::peer_disconnected:
    case event_type::peer_refused:
      return "other";
    default:
      return experiments::report::group_of(what);
  }
}

} // namespace

void run_state::on_record(const messages::record& x) {
  std::visit([this](const auto& of_a_kind) { add(of_a_kind); }, x);
}

void run_state::on_heard(const messages::cam& x, time_point now) {
  const std::lock_guard lock{mutex_};
  auto* car = car_of(x.station);
  if (!car || (car->is_ours && now - car->told < silence))
    return;
  car->is_ours = false;
  car->at = x.at;
  car->told = now;
  car->position = x.position;
  car->heading_rad = x.heading_rad;
  car->speed_mps = x.speed_mps;
  const auto found = planned_by_.find(x.station);
  const auto is_served = found != planned_by_.end();
  car->plans = is_served ? planned::by_provider : planned::not_known;
  car->place = is_served ? found->second : std::nullopt;
}

std::map<station_id, seen_car> run_state::cars(time_point now) {
  const std::lock_guard lock{mutex_};
  std::erase_if(cars_,
                [&](const auto& x) { return now - x.second.told > silence; });
  return cars_;
}

std::vector<told_event> run_state::events_after(std::uint64_t number,
                                                std::size_t most) const {
  const std::lock_guard lock{mutex_};
  if (number > told_) // of another run
    number = 0;
  const auto newer = static_cast<std::size_t>(told_ - number);
  const auto count = std::min({newer, most, events_.size()});
  return {std::prev(events_.end(), static_cast<std::ptrdiff_t>(count)),
          events_.end()};
}

seen_counts run_state::counts() const {
  const std::lock_guard lock{mutex_};
  return counts_;
}

void run_state::add(const messages::event_record& x) {
  const auto is_planning = x.service.view() == planner_;
  const std::lock_guard lock{mutex_};
  if (x.what == event_type::switched && is_planning) {
    if (x.remote)
      planned_by_[x.station] = place_from(x.provider);
    else
      planned_by_.erase(x.station);
  } else if (x.what == event_type::violation) {
    ++counts_.violations;
  } else if (x.what == event_type::arrived) {
    cars_.erase(x.station);
    planned_by_.erase(x.station);
  }
  const auto group = shown_in(x.what);
  if (group.empty() || (x.what == event_type::switched && !is_planning))
    return;
  auto detail =
      x.what == event_type::switched ? x.remote ? "remote" : "local" : x.detail;
  if (!x.check.empty() && detail.find(x.check) == detail.npos)
    detail = x.check + (detail.empty() ? "" : " ") + detail;
  tell({0, x.at, messages::name_of(x.what), x.station, place_from(x.provider),
        std::string{x.service.view()}, std::move(detail), group});
}

void run_state::add(const messages::verdict_record& x) {
  if (!provider_) // whose vehicles tell of it, too
    return;
  const std::lock_guard lock{mutex_};
  if (x.accepted && x.session.service.view() == planner_)
    planned_by_[x.session.station] = provider_;
  tell({0, x.at, x.accepted ? "accepted" : "refused", x.session.station,
        provider_, std::string{x.session.service.view()}, x.why, "other"});
}

void run_state::add(const messages::cycle_record& x) {
  if (x.session.service.view() != planner_)
    return;
  const std::lock_guard lock{mutex_};
  if (const auto car = cars_.find(x.session.station); car != cars_.end()) {
    car->second.latency = x.received - x.created;
    car->second.result_at = x.received;
  }
}

void run_state::add(const messages::episode_record& x) {
  const auto is_of_provider = x.of == messages::side::provider;
  if (is_of_provider != provider_.has_value())
    return;
  const std::lock_guard lock{mutex_};
  ++counts_.episodes;
  counts_.fallbacks += x.fallback;
  if (!is_of_provider)
    return;
  if (x.session.service.view() == planner_)
    planned_by_.erase(x.session.station);
  auto detail = std::string{messages::name_of(x.reason)};
  if (!x.because.empty())
    detail += ": " + x.because;
  tell({0, x.ended, "ended", x.session.station, provider_,
        std::string{x.session.service.view()}, std::move(detail), "other"});
}

void run_state::add(const messages::track_record& x) {
  const auto& own = x.ego.own;
  const std::lock_guard lock{mutex_};
  auto* car = car_of(own.station);
  if (!car)
    return;
  car->is_ours = true;
  car->at = car->told = x.at;
  car->position = own.position;
  car->heading_rad = own.heading_rad;
  car->speed_mps = own.speed_mps;
  car->plans = x.remote ? planned::by_provider : planned::on_board;
  car->place.reset();
  if (const auto found = planned_by_.find(own.station);
      x.remote && found != planned_by_.end())
    car->place = found->second;
}

void run_state::add(const messages::safety_record& x) {
  const std::lock_guard lock{mutex_};
  counts_.driven_s += to_seconds(x.driven);
  counts_.without_plan_s += to_seconds(x.without_fresh_plan);
}

seen_car* run_state::car_of(station_id station) {
  if (const auto found = cars_.find(station); found != cars_.end())
    return &found->second;
  return cars_.size() < most_cars ? &cars_[station] : nullptr;
}

void run_state::tell(told_event x) {
  if (x.detail.size() > longest_detail)
    x.detail.resize(longest_detail);
  if (x.group == "other")
    for (auto old = events_.rbegin();
         old != events_.rend() && x.at - old->at < told_again_after; ++old)
      if (says_the_same(*old, x))
        return;
  x.number = ++told_;
  events_.push_back(std::move(x));
  if (events_.size() > most_events)
    events_.pop_front();
}

} // namespace sofof::live
