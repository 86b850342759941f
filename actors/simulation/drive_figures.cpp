// Counting plans, and noticing where they come from.
#include "actors/simulation/drive_figures.hpp"

#include <utility>

namespace sofof {

namespace {

bool is_remote(const session_id& x) {
  return x.is_remote();
}

} // namespace

std::optional<plan_switch_record>
drive_figures::on_plan(const trajectory& in_use, const trajectory& next,
                       const plan_report& report, const session_id& running,
                       time_point now) {
  stops_ = false;
  emergency_ = report.emergency;
  ++plans_.count;
  plans_.on_board += !is_remote(running);
  plans_.kept += report.origin == plan_origin::kept;
  plans_.stops += report.origin == plan_origin::stop;
  plans_.imperfect +=
      !ocp::publishable(report.path) || !ocp::publishable(report.velocity);
  if (emergency_)
    ++plans_.emergency;
  else
    plans_.extremes.add(report.extremes ? *report.extremes : extremes_of(next));

  const auto before = std::exchange(source_, running);
  if (!before || *before == running)
    return std::nullopt;
  return plan_switch_record{now, is_remote(running) ? running : *before,
                            is_remote(running),
                            jump_between(in_use, next, now)};
}

void drive_figures::stop_safely() {
  if (std::exchange(stops_, true))
    return;
  source_.reset();
  emergency_ = true;
  ++plans_.safe_stops;
}

drive_record drive_figures::flush() {
  return {station_, std::exchange(plans_, {}), ride_.flush()};
}

} // namespace sofof
