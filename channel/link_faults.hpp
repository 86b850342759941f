// Faults for tests: messages that get lost, come twice, or out of order.
#pragma once

#include "base/random.hpp"
#include "base/time.hpp"

#include <cstdint>
#include <optional>

namespace sofof::channel {

/// What goes wrong on a link, per message.
struct link_fault_options {
  double loss = 0;                ///< Probability in [0, 1].
  double duplicate = 0;           ///< Probability in [0, 1].
  double reorder = 0;             ///< Probability in [0, 1] of an extra delay.
  duration longest_extra_delay{}; ///< Of late messages and of copies.
};

/// Decides the fate of messages by their number.
class link_faults {
public:
  /// What happens to one message.
  struct fate {
    bool lost = false;      ///< Neither it nor a copy arrives.
    duration extra_delay{}; ///< On top of the link's; later messages
                            ///< do not wait for it.
    std::optional<duration> copy_after; ///< A second one so much later.
  };

  link_faults(random_stream stream, const link_fault_options& options);

  fate of(std::uint64_t number) const {
    return is_faultless_ ? fate{} : draw(number);
  }

private:
  fate draw(std::uint64_t number) const;

  random_stream stream_;
  link_fault_options options_;
  bool is_faultless_;
};

} // namespace sofof::channel
