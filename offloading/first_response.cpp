// Several providers plan the same cycles: the first response wins.
#include "offloading/first_response.hpp"

namespace sofof::offloading {

bool first_response::use(time_point began) {
  if (answered(began)) {
    ++dropped_;
    return false;
  }
  newest_ = began;
  return true;
}

} // namespace sofof::offloading
