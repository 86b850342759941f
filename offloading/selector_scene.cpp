// How late results may be by what the vehicle sees.
#include "base/reason.hpp"
#include "offloading/qos_monitor.hpp"
#include "offloading/source_selector.hpp"

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

namespace sofof::offloading {

void source_selector::look_at_scene(time_point now) {
  const auto found = own().look_at_scene(newest_);
  if (!found)
    return;
  assert(found->longest >= duration{0});
  if (options().latency_by_scene)
    limit_by_scene(found->longest - greatest_age(*found, now), now);
  assert(!found->because.empty());
  port_.report_safe_response(found->longest);
  messages::scene_record seen{.at = now,
                              .station = setup_.station,
                              .service = setup_.service.name,
                              .safe = found->longest,
                              .because = std::string{found->because}};
  if (!newest_.in_use.empty())
    seen.response = now - used_input_at_;
  port_.record(std::move(seen));
}

/// @returns the greatest age among the inputs whose results may still be used:
/// those of older inputs come later than the scene allows.
duration source_selector::greatest_age(const safe_response& found,
                                       time_point now) {
  assert(found.age >= duration{0});
  ages_.emplace_back(now, found.age);
  while (now - ages_.front().first > found.longest && ages_.size() > 1)
    ages_.pop_front();
  auto greatest = found.age;
  for (const auto& [at, age] : ages_)
    greatest = std::max(greatest, age);
  assert(greatest >= found.age);
  return greatest;
}

// Those that wait for their first result wait on: the scene may allow it then.
// What it leaves may be negative: the scene is older than it allows.
void source_selector::limit_by_scene(duration safe, time_point now) {
  const auto limits = limits_in_scene(on(setup_.computer, options()), safe);
  if (limits && limits != limits_)
    port_.watch_limits(*limits);
  limits_ = limits;
  if (limits)
    return;
  std::vector<messages::session_id> used;
  for (const auto& x : sources_)
    if (x.in_use)
      used.push_back(x.session);
  for (const auto& session : used) {
    on_end({session, messages::end_reason::released, messages::side::requester},
           now);
    port_.report(
        {session,
         messages::qos_breach::scene,
         now,
         true,
         in_words("safe_response", std::max(safe, duration{0}), duration{0}),
         {}});
  }
  assert(!is_remote());
}

} // namespace sofof::offloading
