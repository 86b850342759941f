// Times at which a channel is interrupted.
#include "channel/interruptions.hpp"

namespace sofof {

interruptions::interruptions(random_stream stream, delay_law quiet,
                             delay_law length)
    : stream_{stream}, quiet_{quiet}, length_{length}, end_{} {
  advance();
}

std::optional<interruption> interruptions::at(time_point now) {
  while (end_ <= now)
    advance();
  if (now < begin_)
    return std::nullopt;
  return interruption{drawn_ - 1, end_};
}

void interruptions::advance() {
  enum lane : std::uint32_t { quiet, length };
  begin_ = end_ + from_seconds(quiet_.draw_s(stream_, drawn_, quiet));
  end_ = begin_ + from_seconds(length_.draw_s(stream_, drawn_, length));
  ++drawn_;
}

} // namespace sofof
