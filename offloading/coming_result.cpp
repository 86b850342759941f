// The result of a cycle that perhaps is still being computed.
#include "offloading/coming_result.hpp"

#include <cassert>
#include <utility>

namespace sofof::offloading {

coming_output::coming_output(std::shared_ptr<service_function> of,
                             std::function<service_output()> left)
    : job_{std::make_shared<job>([of = std::move(of), left = std::move(left),
                                  made = made_] { *made = left(); })} {
  assert(job_);
}

service_output coming_output::take() {
  wait();
  return std::move(*made_);
}

std::optional<messages::service_result> coming_result::take() {
  if (output) {
    auto made = output->take();
    frame.what = std::move(made.what);
    frame.about = std::move(made.about);
  }
  if (frame.what.empty())
    return std::nullopt;
  return std::move(frame);
}

} // namespace sofof::offloading
