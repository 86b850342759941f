// Broken messages: whatever a stranger sends, it is a message or refused.
#include "base/random.hpp"
#include "messages/etsi/message.hpp"
#include "tests/support/any_message.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <string>
#include <vector>

namespace sofof::messages::etsi {
namespace {

/// SOFOF_MUTATIONS makes it more.
std::uint64_t number_of_mutations() {
  constexpr std::uint64_t usual = 100'000;
  const auto* wanted = std::getenv("SOFOF_MUTATIONS");
  return wanted ? std::stoull(wanted) : usual;
}

/// Flips, replaces, cuts off or appends; not in the first two octets, which
/// tell what it is.
void break_somewhere(std::vector<std::byte>& octets, std::uint64_t random) {
  constexpr std::size_t head = 2;
  if (octets.size() <= head)
    return;
  const auto what = random % 4;
  const auto how = random >> 2 & 0xff;
  const auto at = head + (random >> 10) % (octets.size() - head);
  if (what == 0)
    octets[at] ^= static_cast<std::byte>(1u << how % 8);
  else if (what == 1)
    octets[at] = static_cast<std::byte>(how);
  else if (what == 2)
    octets.resize(at);
  else
    octets.push_back(static_cast<std::byte>(how));
}

} // namespace

TEST_CASE("a broken message is refused with a reason, or is another message") {
  const random_stream random{1, "mutations"};
  constexpr std::uint64_t each = 32;
  const auto count = number_of_mutations();
  std::uint64_t refused = 0;
  std::vector<std::byte> whole;
  for (std::uint64_t i = 0; i < count; ++i) {
    CAPTURE(i);
    if (i % each == 0)
      whole = encode_message(test::any_message(i / each)).value.value();
    auto broken = whole;
    for (std::uint32_t n = 0; n <= random.bits(i) % 3; ++n)
      break_somewhere(broken, random.bits(i, n + 1));
    const auto [m, error] = decode_message(broken);
    REQUIRE(m.has_value() == error.empty());
    if (!m) {
      ++refused;
      continue;
    }
    // It says the same when it is sent on. What is there may be written in
    // another way: additions that we skipped are gone.
    const auto again = encode_message(*m);
    CAPTURE(again.error);
    REQUIRE(again.value);
    const auto twice = decode_message(*again.value);
    CAPTURE(twice.error);
    REQUIRE(twice.value);
    REQUIRE(encode_message(*twice.value).value == again.value);
  }
  // Both happen, or we have tested nothing.
  CHECK(refused > count / 4);
  CHECK(refused < count);
}

} // namespace sofof::messages::etsi
