// Octets as a message of cpm_tr103562.hpp.
#include "messages/etsi/cpm_tr103562.hpp"

#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  return sofof::fuzz::try_kind<sofof::messages::etsi::tr103562::cpm>(data,
                                                                     size);
}
