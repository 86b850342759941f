// The system's own close.
#include "network/descriptor.hpp"

#include <unistd.h>

namespace sofof {

descriptor::~descriptor() {
  if (fd_ != none)
    close(fd_);
}

} // namespace sofof
