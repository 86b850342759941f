// HOST:PORT.
#include "network/network_address.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace sofof::network;

TEST_CASE("an address is a host, a colon and a port") {
  CHECK(parse_address("edge.example:3333")
        == network_address{"edge.example", 3333});
  CHECK(parse_address("10.0.0.1:0") == network_address{"10.0.0.1", 0});
  CHECK(parse_address("[fd00::1]:65535") == network_address{"fd00::1", 65535});
  for (const auto* text : {"edge.example:3333", "10.0.0.1:0", "[fd00::1]:1"})
    CHECK(print_address(parse_address(text).value()) == text);
}

TEST_CASE("what is no address is refused") {
  for (const auto* text :
       {"", ":", "host", "host:", ":1", "host:65536", "host:-1", "host:1 ",
        "host:x", "fd00::1", "fd00::1:80", "[]:1", "[fd00::1]", "[fd00::1]1",
        "a b:1", "http://a:1"}) {
    CAPTURE(text);
    CHECK_FALSE(parse_address(text));
  }
}
