// Octets as a message of cam.hpp.
#include "messages/etsi/cam.hpp"

#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  return sofof::fuzz::try_kind<sofof::messages::etsi::cam>(data, size);
}
