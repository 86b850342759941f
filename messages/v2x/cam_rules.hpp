// When a vehicle sends a CAM, and when the CAM tells more than usual.
#pragma once

#include "messages/v2x/generation_rules.hpp"

#include <optional>

namespace sofof::messages {

/// Decides when to send CAMs. A vehicle asks every 100 ms or more often
/// (T_CheckCamGen) and sends at once what it is told to.
///
/// * Condition 1: T_GenCam_Dcc after the last CAM, when the motion is news.
///   From then on T_GenCam is the time that had passed.
/// * Condition 2: T_GenCam after the last CAM, whatever the motion. After
///   three such CAMs in a row (N_GenCam) T_GenCam is a second again.
/// * The low-frequency container is in the first CAM, and then in each that
///   comes 500 ms or more after the last with it.
///
/// Source: EN 302 637-2 V1.4.1, section 6.1.3.
class cam_trigger {
public:
  struct decision {
    bool send = false;
    bool low_frequency = false; ///< With that container.
  };

  /// @param dcc  T_GenCam_Dcc: how fast the channel's load lets CAMs follow
  ///             each other, 100 ms to 1 s.
  explicit cam_trigger(generation_rule rule = generation_rule::triggered,
                       duration dcc = generation::shortest);

  /// Decides for `now`; what it says is taken for done.
  /// @param now  Not earlier than the time before; else nothing is sent.
  decision check(time_point now, const told_motion& motion);

private:
  bool is_due(duration elapsed, const told_motion& motion);

  struct sent {
    time_point at;
    told_motion motion;
  };
  generation_rule rule_;
  duration dcc_;
  duration period_ = generation::longest; // T_GenCam
  int without_news_ = 0;                  // CAMs in a row
  std::optional<sent> last_;
  time_point last_low_frequency_; // when there is a last one
};

} // namespace sofof::messages
