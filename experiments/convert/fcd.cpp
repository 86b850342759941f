// Floating car data: sumo.dlr.de/docs/Simulation/Output/FCDOutput.html.
#include "experiments/convert/formats.hpp"
#include "world/vehicle/vehicle.hpp"

#include <fmt/format.h>

#include <cmath>
#include <deque>
#include <map>
#include <numbers>
#include <string>

namespace sofof::experiments::convert {

namespace {

/// Rows of a car that is there are not farther apart, in periods of rows.
constexpr double longest_gap = 2.5;

/// The latest rows of a car: those around the next step, and later ones.
using recent_rows = std::deque<track_row>;

double between(double a, double b, double share) {
  return a + share * (b - a);
}

/// In SUMO's frame: of the middle of the front bumper, degrees clockwise from
/// north.
std::string line_of(const track_row& a, const track_row& b, double t_s) {
  const auto share = b.t_s > a.t_s ? (t_s - a.t_s) / (b.t_s - a.t_s) : 0.0;
  const auto turn_rad =
      std::remainder(b.heading_rad - a.heading_rad, 2 * std::numbers::pi);
  const auto heading_rad = a.heading_rad + share * turn_rad;
  const auto front_m = world::vehicle_params{}.front_m;
  const auto x_m =
      between(a.at.x_m, b.at.x_m, share) + front_m * std::cos(heading_rad);
  const auto y_m =
      between(a.at.y_m, b.at.y_m, share) + front_m * std::sin(heading_rad);
  auto angle_deg = std::fmod(90 - heading_rad * 180 / std::numbers::pi, 360);
  angle_deg += angle_deg < 0 ? 360 : 0;
  return fmt::format(
      "    <vehicle id=\"{}\" x=\"{:.3f}\" y=\"{:.3f}\" angle=\"{:.2f}\" "
      "type=\"{}\" speed=\"{:.3f}\" pos=\"{:.2f}\" acceleration=\"{:.3f}\"/>\n",
      a.station, x_m, y_m, angle_deg, a.remote ? "offloaded" : "on_board",
      between(a.speed_mps, b.speed_mps, share), between(a.s_m, b.s_m, share),
      a.accel_mps2);
}

/// @returns all cars at one time; forgets rows that no later time needs.
/// @param gap_s  Rows of a car that is there are not farther apart.
std::string step_at(double t_s, double gap_s,
                    std::map<std::uint64_t, recent_rows>& cars) {
  std::string text = fmt::format("  <timestep time=\"{:.2f}\">\n", t_s);
  for (auto car = cars.begin(); car != cars.end();) {
    auto& rows = car->second;
    while (rows.size() > 1 && rows[1].t_s <= t_s)
      rows.pop_front();
    const auto& a = rows.front();
    if (rows.size() == 1 && a.t_s < t_s - gap_s) {
      car = cars.erase(car); // it has gone
      continue;
    }
    const auto& b = rows.size() > 1 ? rows[1] : a;
    if (a.t_s <= t_s && b.t_s - a.t_s <= gap_s
        && (rows.size() > 1 || a.t_s == t_s))
      text += line_of(a, b, t_s);
    ++car;
  }
  return text + "  </timestep>\n";
}

} // namespace

void write_fcd(const recorded_drive& drive, const sink& put) {
  put("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fcd-export>\n");
  const auto step_s = to_seconds(drive.what.record.tracks_period);
  const auto gap_s = longest_gap * step_s;
  std::map<std::uint64_t, recent_rows> cars;
  track_file rows{drive.folder};
  std::int64_t step = 0;
  // A time is told when no row of before can come any more that is needed: a
  // gap later, or at the end.
  const auto tell_until = [&](double t_s) {
    for (; static_cast<double>(step) * step_s <= t_s; ++step)
      put(step_at(static_cast<double>(step) * step_s, gap_s, cars));
  };
  double last_s = 0;
  while (const auto row = rows.next()) {
    last_s = row->t_s;
    cars[row->station].push_back(*row);
    tell_until(last_s - gap_s);
  }
  tell_until(last_s);
  put("</fcd-export>\n");
}

} // namespace sofof::experiments::convert
