// Octets as a message of mcm.hpp.
#include "messages/etsi/mcm.hpp"

#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  return sofof::fuzz::try_kind<sofof::messages::etsi::mcm>(data, size);
}
