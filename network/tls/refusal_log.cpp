// The first at once, the others together.
#include "network/tls/refusal_log.hpp"

#include <fmt/format.h>

namespace sofof::network {

namespace {

constexpr std::chrono::seconds pause{1};

} // namespace

void refusal_log::add(const std::string& sentence, deadline now) {
  if (!publish_)
    return;
  publish_rest(now);
  if (last_published_ && now < *last_published_ + pause) {
    last_ = sentence;
    ++left_out_;
    return;
  }
  last_published_ = now;
  publish_(sentence);
}

void refusal_log::publish_rest(deadline now) {
  if (left_out_ == 0 || now < *last_published_ + pause)
    return;
  last_published_ = now;
  publish_(left_out_ == 1 ? last_
                          : fmt::format("{} (and {} more before it)", last_,
                                        left_out_ - 1));
  left_out_ = 0;
}

std::optional<deadline> refusal_log::next() const {
  if (left_out_ == 0)
    return std::nullopt;
  return *last_published_ + pause;
}

} // namespace sofof::network
