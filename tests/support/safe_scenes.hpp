// Whole scenes of two or three vehicles that start safe, driven in virtual
// time, and held against Responsibility-Sensitive Safety at every instant.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace sofof::test {

enum class scene_kind : std::uint8_t {
  follow,   ///< Behind one that drives as it likes.
  row,      ///< Two behind one that does.
  oncoming, ///< Likewise, and one comes the other way.
  granted,  ///< One comes from the side; the road grants the crossing.
};
inline constexpr int scene_kinds = 4;
std::string_view name_of(scene_kind kind);

/// How the vehicles that are looked at offload.
struct scene_policy {
  std::string_view lodm = "rss"; ///< Behind `location`; or that, or "never".
  bool is_slow = false;  ///< Channel and limits allow for more than 1 s.
  bool is_plain = false; ///< At home nobody responds properly.
  bool is_chain = false; ///< Tracking and the environment model, too.
};

/// What scenes showed, of all vehicles that are looked at. The distance is less
/// than RSS's while the longest safe response time is below the time of the
/// split in use.
struct scene_findings {
  int scenes = 0; ///< Those that start safe under the home split's time.
  int passed_over = 0;
  int collisions = 0;
  int changes = 0; ///< Of a service, from home to a provider, or back.
  double driven_s = 0, remote_s = 0;
  double less_s = 0; ///< For how long it was less.
  int less = 0;      ///< How often it became so, ...
  int entered = 0;   ///< ... because a service went to a provider,
  int others = 0;    ///< or else by another's doing.
  int late = 0; ///< How often the car was not safe again, and did not brake
                ///< by b_min, when the time of the split had passed in which
                ///< it became less: with a service at a provider,
  int home_late = 0;   ///< and with all at home;
  double latest_s = 0; ///< how late it was at most, with a service away.
  std::string first;   ///< Of what was entered or late.

  void add(const scene_findings& other);
};

/// Draws a scene and drives it.
/// @param seed  The same draws the same vehicles for every policy.
scene_findings drive_scene(std::uint64_t seed, const scene_policy& how);

/// @returns the scenario that it drives, as a file says it.
std::string scene_text(std::uint64_t seed, const scene_policy& how);

scene_kind kind_of(std::uint64_t seed);

} // namespace sofof::test
