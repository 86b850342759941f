// What became of a drive.
#pragma once

#include "experiments/judge/ks_model.hpp"
#include "experiments/judge/problem_scenario.hpp"
#include "world/traffic/scripted_body.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::experiments::judge {

/// The first of these that happens counts.
enum class outcome : std::uint8_t {
  reached,
  collided,
  off_road, ///< A corner of the model's box was off all lanelets.
  late,     ///< It was never in a goal when it should be.
  no_route, ///< No lanes lead there.
  refused,  ///< The file is wrong.
};

inline constexpr auto last_outcome = outcome::refused;

std::string_view name_of(outcome x);

struct verdict {
  outcome what = outcome::late;
  bool own_fault = false; ///< Of a collision.
  double at_s = 0;        ///< After the drive's begin.
  std::string why;        ///< In words.
  int step = 0;           ///< When it was reached, as the file counts.
};

/// Judges the drive of one problem.
class drive_judge {
public:
  /// @param what  Outlives this.
  explicit drive_judge(const problem_scenario& what);

  /// @returns what has become of it so far; nullopt: nothing yet.
  std::optional<verdict> look(std::span<const driven_moment> drive) const;

  /// @returns that it is late, and why.
  verdict give_up(std::span<const driven_moment> drive) const;

  /// @returns the drive in the model's states.
  std::vector<ks_state> states(std::span<const driven_moment> drive) const;

private:
  struct obstacle {
    std::string id;
    bool stands;
    world::scripted_body is;
  };
  struct outline {
    maps::scene_region rim;
    point low, high;
  };
  const obstacle* find_touched(const oriented_box& box, double t_s) const;
  verdict collided(std::span<const driven_moment> drive,
                   const obstacle& with) const;
  bool is_on_road(const oriented_box& box) const;
  bool is_near_road(point p) const;
  bool is_reached(const ks_state& x) const;

  const problem_scenario& what_;
  std::vector<obstacle> obstacles_;
  std::vector<outline> lanelets_;
};

} // namespace sofof::experiments::judge
