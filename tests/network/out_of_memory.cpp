// An acceptor and a connector when OpenSSL gets no memory.
#include "tests/network/two_hosts.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <cstdlib>
#include <openssl/crypto.h>

using namespace sofof;
using namespace sofof::network;
using namespace sofof::test;

namespace {

std::atomic<bool> is_short = false;

void* allocate(std::size_t size, const char*, int) {
  return is_short ? nullptr : std::malloc(size);
}
void* allocate_again(void* old, std::size_t size, const char*, int) {
  return is_short ? nullptr : std::realloc(old, size);
}
void release(void* old, const char*, int) {
  std::free(old);
}

// OpenSSL takes them as long as it has allocated nothing.
const bool is_ours =
    CRYPTO_set_mem_functions(allocate, allocate_again, release) == 1;

} // namespace

TEST_CASE("who comes while there is no memory for TLS is refused, and not who "
          "comes later") {
  REQUIRE(is_ours);
  const key_folder keys;
  server inner{echo};
  sentences heard;
  const tls_acceptor acceptor{keys.credentials_for(mec),
                              acceptor_to(inner.port(), &heard)};
  const auto own = keys.credentials_for(car);
  const tls_connector connector{&own, connector_to(acceptor.port())};
  std::uint16_t port = 0;
  SUBCASE("by the acceptor") {
    port = acceptor.port();
  }
  SUBCASE("by the connector") {
    port = connector.port();
  }
  is_short = true;
  const auto late = plug_into(port);
  CHECK(late.is_closed());
  is_short = false;
  if (port == acceptor.port())
    CHECK(heard.heard("was refused: beginning TLS failed in OpenSSL"));
  else
    CHECK(contains(connector.last_error(), "beginning TLS failed in OpenSSL"));
  CHECK(echoes(plug_into(connector.port()), "after"));
}
