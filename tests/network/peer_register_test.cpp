// Who is behind the connections that an acceptor makes within its machine.
#include "network/tls/peer_register.hpp"

#include "tests/network/two_hosts.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <memory>
#include <netinet/in.h>
#include <optional>

using namespace sofof;
using namespace sofof::network;
using namespace sofof::test;

namespace {

/// @returns the port at the other end of a connection.
std::uint16_t far_port(int fd) {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  REQUIRE(getpeername(fd, reinterpret_cast<sockaddr*>(&address), &size) == 0);
  return ntohs(address.sin_port);
}

} // namespace

TEST_CASE("a carried connection is known by its port before it says anything, "
          "and as long as it lasts") {
  const key_folder keys;
  const auto peers = std::make_shared<peer_register>();
  std::atomic<bool> was_known = false;
  std::atomic<std::uint16_t> port = 0;
  server inner{[&](const plug& line) {
    const auto from = far_port(line.fd());
    was_known = peers->find(from) == car;
    port = from;
    echo(line);
  }};
  auto options = acceptor_to(inner.port());
  options.peers = peers;
  const tls_acceptor acceptor{keys.credentials_for(mec), options};
  const auto own = keys.credentials_for(car);
  const tls_connector connector{&own, connector_to(acceptor.port())};
  {
    const auto line = plug_into(connector.port());
    CHECK(echoes(line, "a"));
    CHECK(was_known);
    CHECK(peers->find(port) == car);
  }
  CHECK(wait_until([&] { return !peers->find(port); }));
  CHECK(wait_until([&] { return acceptor.counts().open == 0; }));
}

TEST_CASE("a connection of another process of the machine is nobody's") {
  const auto peers = std::make_shared<peer_register>();
  std::atomic<bool> was_known = false, came = false;
  server inner{[&](const plug& line) {
    was_known = peers->find(far_port(line.fd())).has_value();
    came = true;
  }};
  const auto line = plug_into(inner.port());
  CHECK(wait_until([&] { return came.load(); }));
  CHECK(!was_known);
}

TEST_CASE("a peer whose provider cannot be reached leaves nothing behind") {
  const key_folder keys;
  const auto peers = std::make_shared<peer_register>();
  std::uint16_t closed = 0;
  {
    server gone{echo};
    closed = gone.port();
  }
  auto options = acceptor_to(closed);
  options.peers = peers;
  const tls_acceptor acceptor{keys.credentials_for(mec), options};
  const auto own = keys.credentials_for(car);
  const tls_connector connector{&own, connector_to(acceptor.port())};
  const auto line = plug_into(connector.port());
  CHECK(line.is_closed());
  int known = 0;
  for (int port = 1; port < 65'536; ++port)
    known += peers->find(static_cast<std::uint16_t>(port)).has_value();
  CHECK(known == 0);
}
