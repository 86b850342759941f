// Reading and writing of one side of a tunnel.
#include "network/tls/byte_stream.hpp"

#include "network/tls/tls.hpp"
#include "tests/network/key_folder.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <openssl/err.h>
#include <sys/socket.h>
#include <utility>

using namespace sofof;
using namespace sofof::network;
using namespace sofof::test;

namespace {

/// A vehicle and a provider that have shaken hands.
std::pair<byte_stream, byte_stream> connected() {
  const key_folder keys;
  const auto vehicle = make_tls_context(keys.credentials_for(car));
  const auto provider = make_tls_context(keys.credentials_for(mec));
  std::array<int, 2> ends{};
  REQUIRE(socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, ends.data())
          == 0);
  descriptor near{ends[0]};
  descriptor far{ends[1]};
  tls_handshake opener{vehicle, near.get(), tls_side::opener};
  tls_handshake answerer{provider, far.get(), tls_side::answerer};
  for (int flight = 0; flight < 3; ++flight) {
    opener.advance();
    answerer.advance();
  }
  REQUIRE(opener.advance() == tls_handshake::step::done);
  REQUIRE(answerer.advance() == tls_handshake::step::done);
  return {byte_stream{std::move(near), opener.release()},
          byte_stream{std::move(far), answerer.release()}};
}

void leave_an_error_behind() {
  ERR_raise(ERR_LIB_SSL, ERR_R_INTERNAL_ERROR);
}

} // namespace

TEST_CASE("what OpenSSL complained of elsewhere breaks no connection") {
  using state = byte_stream::state;
  auto [vehicle, provider] = connected();
  std::array<std::byte, 4096> some{};
  leave_an_error_behind();
  CHECK(vehicle.read(some).what == state::waits_to_read);
  auto sent = state::moved;
  while (sent == state::moved) { // until there is no room
    leave_an_error_behind();
    sent = vehicle.write(some).what;
  }
  CHECK(sent == state::waits_to_write);
  leave_an_error_behind();
  CHECK(provider.read(some).what == state::moved);
  forget_openssl_errors();
}
