// Octets as a message of cpm_ts103324.hpp.
#include "messages/etsi/cpm_ts103324.hpp"

#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  return sofof::fuzz::try_kind<sofof::messages::etsi::ts103324::cpm>(data,
                                                                     size);
}
