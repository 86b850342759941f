// The first at once, the others together.
#include "network/tls/refusal_log.hpp"

#include <fmt/format.h>

namespace sofof {

namespace {

constexpr std::chrono::seconds pause{1};

} // namespace

void refusal_log::add(const std::string& sentence, deadline now) {
  if (!tell_)
    return;
  look_at(now);
  if (last_told_ && now < *last_told_ + pause) {
    last_ = sentence;
    ++left_out_;
    return;
  }
  last_told_ = now;
  tell_(sentence);
}

void refusal_log::look_at(deadline now) {
  if (left_out_ == 0 || now < *last_told_ + pause)
    return;
  last_told_ = now;
  tell_(left_out_ == 1
            ? last_
            : fmt::format("{} (and {} more before it)", last_, left_out_ - 1));
  left_out_ = 0;
}

std::optional<deadline> refusal_log::next() const {
  if (left_out_ == 0)
    return std::nullopt;
  return *last_told_ + pause;
}

} // namespace sofof
