// The system's own close.
#include "base/files/descriptor.hpp"

#include <unistd.h>

namespace sofof {

descriptor::~descriptor() {
  if (fd_ != none)
    close(fd_);
}

} // namespace sofof
