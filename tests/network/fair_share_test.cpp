// Who makes room at a crowded port.
#include "network/tls/fair_share.hpp"

#include "base/random.hpp"

#include <doctest/doctest.h>

#include <arpa/inet.h>
#include <array>
#include <cstring>
#include <deque>
#include <functional>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::network;

namespace {

socket_address address(const char* text) {
  socket_address at;
  sockaddr_in v4{};
  sockaddr_in6 v6{};
  v4.sin_family = AF_INET;
  v6.sin6_family = AF_INET6;
  if (inet_pton(AF_INET, text, &v4.sin_addr) == 1) {
    std::memcpy(&at.storage, &v4, sizeof v4);
    at.size = sizeof v4;
  } else {
    REQUIRE(inet_pton(AF_INET6, text, &v6.sin6_addr) == 1);
    std::memcpy(&at.storage, &v6, sizeof v6);
    at.size = sizeof v6;
  }
  return at;
}

network_prefix prefix_of(const char* text) {
  return prefix_of(address(text));
}

/// Connections that never finish come at an even pace, and every 97th beside
/// them is an honest one, which takes 3 one-way delays of 20 ms.
/// @returns the share of the honest ones that finish.
double share_let_in(double per_s,
                    const std::function<network_prefix(int)>& attacker) {
  constexpr std::size_t places = 256;
  constexpr double timeout_s = 2, handshake_s = 0.06;
  constexpr int connections = 60'000, every = 97;
  const auto honest = prefix_of("198.51.100.7");
  struct handshake {
    network_prefix from;
    double begun_s;
    bool is_honest;
  };
  std::vector<handshake> open;
  const random_stream draws{7, "handshakes"};
  int came = 0, finished = 0;
  for (int n = 0; n < connections; ++n) {
    const auto now_s = n / per_s;
    std::erase_if(open, [&](const handshake& h) {
      const auto is_done = h.is_honest && now_s - h.begun_s >= handshake_s;
      finished += is_done;
      return is_done || now_s - h.begun_s >= timeout_s;
    });
    if (open.size() >= places) {
      std::vector<network_prefix> from;
      for (const auto& h : open)
        from.push_back(h.from);
      const auto draw = draws.uniform(static_cast<std::uint64_t>(n));
      open.erase(open.begin()
                 + static_cast<std::ptrdiff_t>(choose_victim(from, draw)));
    }
    const auto is_honest = n % every == 0;
    came += is_honest;
    open.push_back({is_honest ? honest : attacker(n), now_s, is_honest});
  }
  return static_cast<double>(finished) / came;
}

} // namespace

TEST_CASE("an IPv4 network is a /24, and an IPv6 network a /64") {
  CHECK(prefix_of("192.0.2.1") == prefix_of("192.0.2.254"));
  CHECK(prefix_of("192.0.2.1") != prefix_of("192.0.3.1"));
  CHECK(prefix_of("192.0.2.1") == prefix_of("::ffff:192.0.2.9"));
  CHECK(prefix_of("::ffff:192.0.2.9") != prefix_of("::ffff:192.0.3.9"));
  CHECK(prefix_of("2001:db8:1:2::1") == prefix_of("2001:db8:1:2:ffff::"));
  CHECK(prefix_of("2001:db8:1:2::1") != prefix_of("2001:db8:1:3::1"));
  CHECK(prefix_of("::1") != prefix_of("0.0.0.1"));
}

TEST_CASE("a handshake makes room in the network that has the most") {
  const std::vector<network_prefix> open{{1}, {2}, {3}, {2}, {4}};
  for (const auto draw : {0., 0.25, 0.499})
    CHECK(choose_victim(open, draw) == 1);
  for (const auto draw : {0.5, 0.75, 0.999999})
    CHECK(choose_victim(open, draw) == 3);
}

TEST_CASE("of equals each makes room equally often") {
  constexpr std::size_t networks = 64;
  constexpr std::uint64_t draws = 64'000;
  std::vector<network_prefix> open;
  for (std::size_t k = 0; k < networks; ++k)
    open.push_back({k});
  std::array<int, networks> chosen{};
  const random_stream stream{1, "handshakes"};
  for (std::uint64_t n = 0; n < draws; ++n)
    ++chosen.at(choose_victim(open, stream.uniform(n)));
  for (const auto count : chosen) {
    CHECK(count > 850); // 1000, and almost five standard deviations
    CHECK(count < 1150);
  }
}

TEST_CASE("a newcomer with 40 ms of round trip gets in beside a crowd") {
  const std::array<std::uint64_t, 2> sizes{6400, 25};
  for (const auto per_s : {100., 300., 1000.}) {
    CAPTURE(per_s);
    CHECK(share_let_in(per_s, [](int) { return network_prefix{1}; }) > 0.99);
    CHECK(share_let_in(per_s,
                       [&](int n) {
                         return network_prefix{static_cast<std::uint64_t>(n)
                                               % sizes[1]};
                       })
          > 0.99);
  }
  // Each attacker in a network of its own: chance decides, for each attempt.
  const auto alone = [&](int n) {
    return network_prefix{static_cast<std::uint64_t>(n) % sizes[0]};
  };
  CHECK(share_let_in(300, alone) > 0.9);
  CHECK(share_let_in(1000, alone) > 0.7);
  // In the attacker's own network as well.
  const auto same = [](int) { return prefix_of("198.51.100.8"); };
  CHECK(share_let_in(300, same) > 0.9);
}
