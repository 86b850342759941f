// Prints random messages in hexadecimal, CAMs and CPMs of TR 103 562 in turn:
// random_messages COUNT
#include "messages/etsi/cam.hpp"
#include "messages/etsi/cpm_tr103562.hpp"
#include "messages/etsi/uper.hpp"
#include "tests/support/hex.hpp"
#include "tests/support/random_pdu.hpp"

#include <array>
#include <cstdint>
#include <cstdlib>
#include <iostream>

namespace {

template <class Message>
void print(std::uint64_t seed) {
  static std::array<std::byte, 1 << 16> room;
  sofof::test::random_pdu random{
      seed, {.presence = static_cast<double>(seed % 5) / 4, .longest = 4}};
  const auto octets =
      sofof::messages::etsi::encode(random.message<Message>(), std::span{room});
  std::cout << sofof::test::to_hex(
      {room.begin(), room.begin() + static_cast<std::ptrdiff_t>(octets)})
            << '\n';
}

} // namespace

int main(int argc, char** argv) {
  const auto count = argc == 2 ? std::strtoull(argv[1], nullptr, 10) : 0;
  for (std::uint64_t seed = 0; seed < count; ++seed)
    if (seed % 2 == 0)
      print<sofof::messages::etsi::cam>(seed);
    else
      print<sofof::messages::etsi::tr103562::cpm>(seed);
}
