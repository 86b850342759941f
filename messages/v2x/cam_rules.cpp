// When a vehicle sends a CAM, and when the CAM tells more than usual.
#include "messages/v2x/cam_rules.hpp"

#include <algorithm>

namespace sofof::messages {
namespace {

using namespace std::chrono_literals;

/// N_GenCam. Source: EN 302 637-2, section 6.1.3.
constexpr int most_without_news = 3;

/// Between two CAMs with the container. Source: the same.
constexpr duration low_frequency_period = 500ms;

} // namespace

cam_trigger::cam_trigger(generation_rule rule, duration dcc)
    : rule_{rule}, dcc_{std::clamp(dcc, generation::shortest,
                                   generation::longest)} {}

cam_trigger::decision cam_trigger::check(time_point now,
                                         const told_motion& motion) {
  if (last_ && !is_due(now - last_->at, motion))
    return {};
  const auto low_frequency =
      !last_ || now - last_low_frequency_ >= low_frequency_period;
  if (low_frequency)
    last_low_frequency_ = now;
  last_ = {now, motion};
  return {true, low_frequency};
}

bool cam_trigger::is_due(duration elapsed, const told_motion& motion) {
  if (rule_ == generation_rule::fixed_10hz)
    return elapsed >= generation::shortest;
  if (elapsed < dcc_)
    return false;
  if (is_news(last_->motion, motion)) {
    period_ = std::min(elapsed, generation::longest);
    without_news_ = 0;
    return true;
  }
  if (elapsed < period_)
    return false;
  if (++without_news_ >= most_without_news)
    period_ = generation::longest;
  return true;
}

} // namespace sofof::messages
