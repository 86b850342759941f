// Drives a scenario of one car.
#include "experiments/judge/drive.hpp"

#include "messages/protocol/record.hpp"
#include "scenario/build.hpp"
#include "scenario/runtime.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

namespace sofof::experiments::judge {

namespace {

using namespace std::chrono_literals;

/// Keeps the tracks of one car.
class track_sink final : public messages::record_sink {
public:
  explicit track_sink(const world::vehicle_state& start) : all_{{0, start}} {}

  void on_record(const messages::record& x) override {
    const auto* track = std::get_if<messages::track_record>(&x);
    if (!track)
      return;
    const auto& own = track->ego.own;
    const world::vehicle_params car;
    all_.push_back(
        {to_seconds(track->at),
         {own.position, own.heading_rad, own.speed_mps, own.accel_mps2,
          std::atan(car.wheelbase_m * own.curvature_1pm)}});
  }

  const std::vector<driven_moment>& all() const { return all_; }

private:
  std::vector<driven_moment> all_;
};

} // namespace

std::vector<driven_moment>
drive(const scenario::scenario_definition& s, const world::vehicle_state& start,
      const std::function<bool(std::span<const driven_moment>)>& is_over) {
  const auto tracks = std::make_shared<track_sink>(start);
  const auto lost = std::make_shared<std::string>();
  const auto time = scenario::make_virtual_runtime();
  const auto actors =
      scenario::build(time->system(), s, tracks, time->clock(), true,
                      [lost](const std::string& why) { *lost = why; });
  const auto end = time->now() + s.length;
  while (time->now() < end && lost->empty()) {
    time->run_until(std::min(time->now() + 1s, end));
    if (is_over(tracks->all()))
      break;
  }
  scenario::dismiss(actors, *time);
  if (!lost->empty())
    throw std::runtime_error{*lost};
  return tracks->all();
}

} // namespace sofof::experiments::judge
