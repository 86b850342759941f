// Octets as whatever they say they are, and on to JSON and back.
#include "tests/fuzz/fuzz.hpp"

using namespace sofof;
using namespace sofof::messages;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  const auto decoded = etsi::decode_message(fuzz::octets_of(data, size));
  fuzz::require(decoded.value.has_value() == decoded.error.empty());
  if (!decoded.value)
    return 0;
  const auto first = etsi::encode_message(*decoded.value);
  fuzz::require(first.value.has_value());
  std::string json;
  etsi::append_json(json, *decoded.value);
  const auto read = etsi::message_from_json(json);
  fuzz::require(read.value.has_value());
  fuzz::require(etsi::encode_message(*read.value).value == first.value);
  return 0;
}
