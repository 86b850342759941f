// Drawing the line, not too often.
#include "recording/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::recording {

namespace {

constexpr double redraw_period_s = 0.2;
constexpr double plain_period_s = 10;
constexpr auto wipe_line = "\r\x1b[K";

std::string line(double virtual_s, double total_s, std::size_t offloaded_now,
                 double wall_s) {
  auto text = fmt::format("{:3.0f} %  {:.0f} of {:.0f} s",
                          100 * virtual_s / total_s, virtual_s, total_s);
  if (wall_s > 0 && virtual_s > 0) {
    const auto speed = virtual_s / wall_s;
    text += fmt::format("  {:.1f} x real time  {} offloaded  ETA {}", speed,
                        offloaded_now,
                        for_people(std::max(0.0, total_s - virtual_s) / speed));
  }
  return text;
}

} // namespace

void progress::update(double virtual_s, double total_s,
                      std::size_t offloaded_now, double wall_s) {
  assert(total_s > 0);
  show([&] { return line(virtual_s, total_s, offloaded_now, wall_s); }, wall_s);
}

bool progress::is_due(double wall_s) {
  if (how_ == output::quiet)
    return false;
  const auto terminal = how_ == output::terminal;
  const auto period_s = terminal ? redraw_period_s : plain_period_s;
  // A terminal shows something at once.
  if (wall_s - last_wall_s_ < period_s && (drawn_ || !terminal))
    return false;
  last_wall_s_ = wall_s;
  drawn_ = true;
  return true;
}

void progress::draw(const std::string& line) {
  if (how_ == output::terminal)
    out_ << wipe_line << line << std::flush;
  else
    out_ << line << '\n' << std::flush;
}

void progress::clear() {
  if (how_ == output::terminal && drawn_)
    out_ << wipe_line << std::flush;
  drawn_ = false;
}

std::string for_people(double seconds) {
  const auto s = std::lround(seconds);
  if (s < 60)
    return fmt::format("{} s", s);
  if (s < 3600)
    return fmt::format("{} min {} s", s / 60, s % 60);
  return fmt::format("{} h {} min", s / 3600, s / 60 % 60);
}

} // namespace sofof::recording
