// ITS messages as datagrams.
#include "messages/v2x/btp_datagram.hpp"

#include "messages/etsi/message.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/hex.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace sofof;
using namespace sofof::messages;
using test::from_hex;
using test::octets;

namespace {

octets joined(octets a, const octets& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

} // namespace

TEST_CASE("each kind has its port, and the message behind it") {
  const auto of = [](const char* header) {
    return btp_datagram(from_hex(header));
  };
  CHECK(of("020200000065abcd")
        == from_hex("07d10000"
                    "020200000065abcd"));
  CHECK(of("010e00000065abcd")
        == from_hex("07d90000"
                    "010e00000065abcd"));
  CHECK(of("020e00000065abcd")
        == from_hex("07d90000"
                    "020e00000065abcd"));
  CHECK(of("021400000065abcd")
        == from_hex("07e40000"
                    "021400000065abcd"));
  CHECK(of("020100000065abcd").empty()); // a DENM
  CHECK(of("0202000000").empty());
  CHECK(btp_datagram(octets(longest_datagram)).empty());
}

TEST_CASE("a datagram is read if its port is that of its message") {
  const auto cam = from_hex("020200000065abcd");
  CHECK(message_in(btp_datagram(cam)) == cam);
  CHECK(message_in(joined(from_hex("07d11234"), cam))
        == cam); // details count not
  CHECK_FALSE(message_in(joined(from_hex("07d90000"), cam)));
  CHECK_FALSE(message_in(from_hex("07d2000002010000006500")));
  CHECK_FALSE(message_in({}));
  CHECK_FALSE(message_in(from_hex("07d10000")));
}

TEST_CASE("mutated datagrams are read within their bounds or refused") {
  test::dice dice{11};
  const auto start = btp_datagram(
      from_hex("02020000006a2228005a5048cfce273e12dffffffc23b7743e00418fc2167e"
               "032092bf33ffe6000200"));
  REQUIRE_FALSE(start.empty());
  int read = 0;
  for (int i = 0; i < 100'000; ++i) {
    auto x = start;
    const auto pick = [&](std::size_t below) {
      return static_cast<std::size_t>(
          dice.between(0, static_cast<double>(below)));
    };
    for (auto changes = pick(4); changes > 0; --changes)
      x[pick(x.size())] = static_cast<std::byte>(pick(256));
    if (pick(3) == 0)
      x.resize(pick(x.size() + 1));
    const octets exact = x;
    if (const auto message = message_in(exact)) {
      ++read;
      (void)etsi::decode_message(*message);
    }
  }
  CHECK(read > 10'000);
}
