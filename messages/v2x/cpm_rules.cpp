// When to send a CPM, and which of the perceived objects go into it.
#include "messages/v2x/cpm_rules.hpp"

#include <algorithm>
#include <tuple>

namespace sofof::messages {
namespace {

/// T_AddSensorInformation. Source: TS 103 324, section 6.1.2.
constexpr duration sensor_period = std::chrono::milliseconds{1000};
static_assert(sensor_period <= generation::longest); // so a CPM comes in time

told_motion motion_of(const world::perceived_object& x) {
  return {x.centre, x.heading_rad, x.speed_mps};
}

} // namespace

cpm_trigger::cpm_trigger(generation_rule rule, duration period)
    : rule_{rule}, period_{rule == generation_rule::fixed_10hz
                               ? generation::shortest
                               : std::clamp(period, generation::shortest,
                                            generation::longest)} {
  told_.reserve(most_objects);
  before_.reserve(most_objects);
  chosen_.reserve(most_objects);
}

cpm_trigger::decision
cpm_trigger::check(time_point now, std::span<const known_object> perceived) {
  if (!is_first_ && now - last_ < period_)
    return {};
  choose(now, perceived);
  const auto sensors = is_first_ || now - last_sensors_ >= sensor_period;
  const auto send =
      sensors || !chosen_.empty() || rule_ == generation_rule::fixed_10hz;
  remember(now, perceived);
  if (!send)
    return {};
  is_first_ = false;
  last_ = now;
  if (sensors)
    last_sensors_ = now;
  return {true, sensors, chosen_};
}

const cpm_trigger::told_object* cpm_trigger::find(std::uint32_t id) const {
  const auto found = std::ranges::lower_bound(told_, id, {}, &told_object::id);
  return found != told_.end() && found->id == id ? &*found : nullptr;
}

bool cpm_trigger::is_due(time_point now, const known_object& x) const {
  const auto* told = find(x.id);
  return rule_ == generation_rule::fixed_10hz || !told
         || now - told->at >= generation::longest
         || is_news(told->motion, motion_of(x.what));
}

void cpm_trigger::choose(time_point now,
                         std::span<const known_object> perceived) {
  chosen_.clear();
  for (std::uint32_t i = 0; i < perceived.size(); ++i)
    if (is_due(now, perceived[i]))
      chosen_.push_back(i);
  if (chosen_.size() <= most_objects)
    return;
  std::ranges::sort(chosen_, {}, [&](std::uint32_t i) {
    const auto id = perceived[i].id;
    const auto* told = find(id);
    return std::tuple{told ? told->at : time_point::min(), id, i};
  });
  chosen_.resize(most_objects);
  std::ranges::sort(chosen_);
}

/// Writes down what has been told of those who are still perceived.
void cpm_trigger::remember(time_point now,
                           std::span<const known_object> perceived) {
  std::swap(told_, before_);
  told_.clear();
  auto chosen = chosen_.begin();
  for (std::uint32_t i = 0; i < perceived.size(); ++i) {
    const auto& x = perceived[i];
    if (chosen != chosen_.end() && *chosen == i) {
      told_.push_back({x.id, now, motion_of(x.what)});
      ++chosen;
      continue;
    }
    const auto old =
        std::ranges::lower_bound(before_, x.id, {}, &told_object::id);
    if (old != before_.end() && old->id == x.id)
      told_.push_back(*old);
  }
  std::ranges::sort(told_, {}, &told_object::id);
}

} // namespace sofof::messages
