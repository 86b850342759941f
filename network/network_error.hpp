// What is thrown when a process cannot take part in the network at all.
#pragma once

#include <stdexcept>

namespace sofof::network {

/// One sentence for the user: what is wrong, where, and what would be right.
class network_error : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

} // namespace sofof::network
