// Octets as a frame of a capture; the first one says how it begins.
#include "messages/v2x/captured_frame.hpp"

#include "tests/fuzz/fuzz.hpp"

#include <variant>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  using namespace sofof::messages;
  if (size == 0)
    return 0;
  constexpr int layers = 5;
  const auto frame = sofof::fuzz::octets_of(data, size).subspan(1);
  const auto found =
      find_message(static_cast<link_layer>(data[0] % layers), frame);
  if (const auto* x = std::get_if<btp_packet>(&found)) {
    sofof::fuzz::require(x->message.size() <= frame.size());
    (void)etsi::decode_message(x->message);
  }
  return 0;
}
