// One that cannot be started is missed by who needs it, not here.
#include "base/process/spare_programs.hpp"

#include "base/input_error.hpp"

#include <utility>

namespace sofof {

spare_programs::spare_programs(kept_setup setup, std::size_t count)
    : setup_{std::move(setup)}, count_{count} {
  fill();
}

std::unique_ptr<framed_program> spare_programs::take() {
  const std::lock_guard locked{lock_};
  forget_dead();
  std::unique_ptr<framed_program> first;
  if (!spares_.empty()) {
    first = std::move(spares_.front());
    spares_.erase(spares_.begin());
  }
  fill();
  return first;
}

void spare_programs::look() {
  const std::lock_guard locked{lock_};
  forget_dead();
}

void spare_programs::fill() {
  try {
    while (spares_.size() < count_)
      spares_.push_back(start_program(setup_));
  } catch (const input_error&) {
    return; // the function that needs one finds out, and says so
  }
}

void spare_programs::forget_dead() {
  for (auto& spare : spares_)
    spare->look();
  std::erase_if(spares_, [](const auto& x) { return !x->objection().empty(); });
}

} // namespace sofof
