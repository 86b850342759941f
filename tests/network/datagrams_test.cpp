// Datagrams to one address, and those that others send.
#include "network/udp/datagrams.hpp"

#include "network/network_error.hpp"
#include "tests/network/loopback.hpp"

#include <doctest/doctest.h>

#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace sofof::test::datagram_lines {

using network::datagrams;
using network::network_address;

namespace {

const network_address any_port{"127.0.0.1", 0};

/// Keeps what it hears.
struct listener {
  std::mutex mutex;
  std::vector<bytes> heard;
  datagrams line;

  explicit listener(network_address to,
                    std::optional<network_address> from = any_port)
      : line{to, from, 100, [this](std::span<const std::byte> x) {
               const std::lock_guard lock{mutex};
               heard.emplace_back(x.begin(), x.end());
             }} {}

  bool has_heard(std::string_view what) {
    return wait_until([&] {
      const std::lock_guard lock{mutex};
      return std::ranges::find(heard, to_bytes(what)) != heard.end();
    });
  }
  void send(std::string_view what) {
    line.send(std::as_bytes(std::span{what}));
  }
};

} // namespace

TEST_CASE("a datagram comes where it was sent to, and answers come back") {
  listener there{{"127.0.0.1", 9}};
  listener here{there.line.address()};
  here.send("hello");
  CHECK(there.has_heard("hello"));
  listener back{here.line.address()};
  back.send("well");
  CHECK(here.has_heard("well"));
}

TEST_CASE("what is too long is not heard, and nobody there is no error") {
  listener there{{"127.0.0.1", 9}};
  listener here{there.line.address()};
  here.send(std::string(101, 'x'));
  here.send("");
  here.send(std::string(100, 'y'));
  CHECK(there.has_heard(std::string(100, 'y')));
  CHECK(there.heard.size() == 1);
  for (int i = 0; i < 10; ++i)
    there.send("to nobody");
  here.send("still there");
  CHECK(there.has_heard("still there"));
}

TEST_CASE("an address that is taken, or of another family, is refused") {
  const listener there{{"127.0.0.1", 9}};
  const auto again = [&] { listener{{"127.0.0.1", 9}, there.line.address()}; };
  CHECK_THROWS_WITH_AS(again(), doctest::Contains("no datagrams can come at"),
                       network::network_error);
  const auto nowhere = [] { listener{any_port}; };
  CHECK_THROWS_WITH_AS(nowhere(), doctest::Contains("0 is no port"),
                       network::network_error);
  const auto group = [] {
    listener{{"127.0.0.1", 9}, network_address{"239.1.2.3", 0}};
  };
  CHECK_THROWS_WITH_AS(group(), doctest::Contains("it is a group"),
                       network::network_error);
  const auto mixed = [] { listener{{"::1", 9}, any_port}; };
  CHECK_THROWS_WITH_AS(mixed(), doctest::Contains("of another family"),
                       network::network_error);
}

} // namespace sofof::test::datagram_lines
