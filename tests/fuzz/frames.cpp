// Octets as what comes by a connection: a header, its payload, and so on.
#include "actors/remote/frame_allowance.hpp"
#include "actors/remote/frame_check.hpp"
#include "tests/fuzz/fuzz.hpp"

#include <algorithm>

using namespace sofof;
using namespace sofof::actors;

namespace {

/// As large as the real ones, of a few types.
const message_forms forms{{{{9, 245}, 4096}, {{249}, 64}, {{208}, 2048}},
                          {{{9, 10}, 64}, {{247, 252}, 8192}},
                          {{{9, 10, 12, 48}, 512}, {{248, 253}, 128}},
                          27,
                          12,
                          {40, 55}};

constexpr std::size_t header_size = 17;

/// Operation, flags, size, id and a step of time; actors are not judged.
struct input_frame {
  frame_header header;
  std::span<const std::byte> payload;
  duration passed{};
};

std::uint64_t number(std::span<const std::byte> octets) {
  std::uint64_t value = 0;
  for (const auto octet : octets)
    value = value << 8 | std::to_integer<std::uint64_t>(octet);
  return value;
}

/// Takes the next frame; of an announced payload what is there.
input_frame next(std::span<const std::byte>& in) {
  input_frame f;
  f.header.operation = std::to_integer<std::uint8_t>(in[0]);
  f.header.flags = std::to_integer<std::uint8_t>(in[1]);
  f.header.payload_size = static_cast<std::uint32_t>(number(in.subspan(2, 4)));
  f.header.operation_data = number(in.subspan(6, 8));
  f.passed = std::chrono::milliseconds{number(in.subspan(14, 3))};
  in = in.subspan(header_size);
  const auto size =
      std::min<std::size_t>(f.header.payload_size % 8192, in.size());
  f.payload = in.first(size);
  in = in.subspan(size);
  return f;
}

constexpr std::uint8_t direct_message = 2;

bool is_handshake(const frame_header& header) {
  return header.operation < direct_message;
}

/// Whether a payload without stages begins with the types of some form, or is
/// an error.
bool has_form(std::span<const std::byte> payload) {
  if (payload.size() < 2 || number(payload.first(1)) != 0)
    return false;
  const auto count = number(payload.subspan(1, 1));
  std::vector<std::uint16_t> types;
  for (std::size_t i = 0; i < count && payload.size() >= 4 + 2 * i; ++i)
    types.push_back(
        static_cast<std::uint16_t>(number(payload.subspan(2 + 2 * i, 2))));
  const auto is_known = [&](const std::vector<message_form>& list) {
    return std::ranges::any_of(list, [&](const message_form& form) {
      return form.types == types && payload.size() <= form.longest;
    });
  };
  return is_known(forms.told) || is_known(forms.asked)
         || is_known(forms.answered)
         || types == std::vector<std::uint16_t>{forms.error_type};
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  if (size == 0)
    return 0;
  auto in = fuzz::octets_of(data, size).subspan(1);
  const auto is_accepted = data[0] % 2 == 0;
  frame_check check{is_accepted, forms};
  frame_allowance allowance{{100, 10'000}};
  time_point now{};
  double octets = 0;
  while (in.size() >= header_size) {
    const auto before = check.node();
    const auto f = next(in);
    now += f.passed;
    if (!check.objection(f.header).empty()
        || !allowance.objection(f.payload.size(), now).empty()
        || !check.objection(f.header, f.payload).empty())
      return 0; // the connection is closed
    // One handshake, and before anything else.
    fuzz::require(before.empty() == is_handshake(f.header));
    fuzz::require(check.node().size() == 25);
    fuzz::require(f.header.flags == 0);
    if (f.header.operation == direct_message)
      fuzz::require(has_form(f.payload));
    octets += static_cast<double>(f.payload.size());
    fuzz::require(octets <= 10'000 * (2 + to_seconds(now - time_point{})));
  }
  return 0;
}
