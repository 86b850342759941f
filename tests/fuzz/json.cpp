// Text as the JSON of a message.
#include "tests/fuzz/fuzz.hpp"

using namespace sofof;
using namespace sofof::messages;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  const std::string text{data, data + size};
  const auto read = etsi::message_from_json(text);
  fuzz::require(read.value.has_value() == read.error.empty());
  if (!read.value)
    return 0;
  const auto octets = etsi::encode_message(*read.value);
  fuzz::require(octets.value.has_value());
  fuzz::require(etsi::decode_message(*octets.value).value.has_value());
  return 0;
}
