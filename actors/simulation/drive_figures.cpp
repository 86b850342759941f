// Counting plans, and noticing where they come from.
#include "actors/simulation/drive_figures.hpp"

#include "base/protocol.hpp"

#include <utility>

namespace sofof::actors {

namespace {

bool is_remote(const messages::session_id& x) {
  return x.is_remote();
}

} // namespace

std::optional<messages::plan_switch_record>
drive_figures::on_plan(const world::trajectory& in_use,
                       const world::trajectory& next,
                       const planners::plan_report& report,
                       const messages::session_id& running, time_point now) {
  stops_ = false;
  emergency_ = report.emergency;
  ++plans_.count;
  plans_.kept += report.origin == planners::plan_origin::kept;
  plans_.stops += report.origin == planners::plan_origin::stop;
  plans_.imperfect += !planners::ocp::publishable(report.path)
                      || !planners::ocp::publishable(report.velocity);
  if (emergency_)
    ++plans_.emergency;
  else
    plans_.extremes.add(report.extremes ? *report.extremes
                                        : world::extremes_of(next));

  const auto before = std::exchange(source_, running);
  if (!before || *before == running)
    return std::nullopt;
  return messages::plan_switch_record{
      now, is_remote(running) ? running : *before, is_remote(running),
      world::jump_between(in_use, next, now)};
}

void drive_figures::stop_safely() {
  if (std::exchange(stops_, true))
    return;
  source_.reset();
  emergency_ = true;
  ++plans_.safe_stops;
}

void drive_figures::on_step(const world::vehicle_state& x) {
  ride_.add(x, emergency_);
  stood_.add(x.speed_mps, to_seconds(protocol::control_period));
}

messages::drive_record drive_figures::flush() {
  return {station_, std::exchange(plans_, {}), ride_.flush()};
}

} // namespace sofof::actors
