// When a run was safe: the one definition, for runs, sweeps and the bench.
#pragma once

namespace sofof {

/// What a safe run has nothing of.
struct safety_line {
  double without_fresh_plan_s = 0;
  double off_road_s = 0;
  double collisions = 0;

  bool holds() const {
    return without_fresh_plan_s == 0 && off_road_s == 0 && collisions == 0;
  }
};

/// @param figure  Gives a number of summary.json by its dotted name; it throws
///                where there is none.
template <class Figure>
safety_line safety_line_of(Figure figure) {
  return {figure("safety.without_fresh_plan_s"), figure("safety.off_road_s"),
          figure("safety.collisions")};
}

} // namespace sofof
