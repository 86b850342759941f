// Every record is written, then counted.
#include "recording/results.hpp"

#include <fmt/format.h>

#include <utility>

namespace sofof {

namespace {

constexpr int jump_places = 6;

} // namespace

results::results(std::filesystem::path folder, run_info run)
    : run_{std::move(run)}, metrics_{run_}, files_{std::in_place,
                                                   std::move(folder), run_} {}

results::results(run_info run) : run_{std::move(run)}, metrics_{run_} {}

void results::take(const event_record& x) {
  if (files_)
    files_->write(x);
  metrics_.take(x);
}

void results::take(const cycle_record& x) {
  if (files_)
    files_->write(x);
  metrics_.take(x);
}

void results::take(const episode_record& x) {
  if (files_)
    files_->write(x);
  metrics_.take(x);
}

void results::take(const air_record& x) {
  if (files_)
    files_->write(x);
  metrics_.take(x);
}

void results::take(const track_record& x) {
  if (files_)
    files_->write(x);
}

void results::take(const decision_record& x) {
  metrics_.take(x);
}

void results::take(const safety_record& x) {
  metrics_.take(x);
}

void results::take(const drive_record& x) {
  metrics_.take(x);
}

void results::take(const collision_record& x) {
  take(event_record{x.at, "collision", x.first, 0, "", 0,
                    fmt::format("with {}", x.second)});
  metrics_.take(x);
}

void results::take(const plan_switch_record& x) {
  const auto& id = x.running;
  std::string detail = x.remote ? "remote" : "local";
  const auto figure = [&detail](std::string_view name, double value) {
    detail += name;
    append(detail, rounded(value, jump_places));
  };
  figure(" d_m=", x.jump.d_m);
  figure(" kappa_1pm=", x.jump.curvature_1pm);
  figure(" v_mps=", x.jump.speed_mps);
  figure(" a_mps2=", x.jump.accel_mps2);
  take(event_record{x.at, "plan_switch", id.station, id.provider, id.kind,
                    id.counter, std::move(detail)});
  metrics_.take(x);
}

void results::take_timing(std::string name, double value) {
  of_clock_.timings.push_back({std::move(name), value});
}

void results::take(const cpu_table& x) {
  of_clock_.cpu_csv = to_csv(x);
}

void results::flush() {
  if (files_)
    files_->flush();
}

run_end results::finish(time_point end, double wall_s, bool interrupted) {
  const run_end outcome{to_seconds(end - run_.start), wall_s, interrupted};
  metrics_.finish(end);
  if (files_)
    files_->finish(metrics_, run_, outcome, of_clock_);
  return outcome;
}

} // namespace sofof
