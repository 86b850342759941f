// Times at which a channel is interrupted.
#include "channel/outage_process.hpp"

#include <cassert>

namespace sofof::channel {

outage_process::outage_process(random_stream stream, delay_distribution quiet,
                               delay_distribution length)
    : stream_{stream}, quiet_{quiet}, length_{length}, end_{} {
  assert(quiet.mean_s() > 0);
  advance();
}

std::optional<interruption> outage_process::at(time_point now) {
  while (end_ <= now)
    advance();
  if (now < begin_)
    return std::nullopt;
  return interruption{drawn_ - 1, end_};
}

void outage_process::advance() {
  enum lane : std::uint32_t { quiet, length };
  begin_ = end_ + from_seconds(quiet_.draw_s(stream_, drawn_, quiet));
  end_ = begin_ + from_seconds(length_.draw_s(stream_, drawn_, length));
  ++drawn_;
}

} // namespace sofof::channel
