// Connections of other processes by raw frames: who is heard, and what ends a
// connection.
#include "actors/remote/version_check.hpp"
#include "scenario/runtime.hpp"
#include "tests/network/loopback.hpp"

#include <caf/io/middleman.hpp>
#include <caf/typed_event_based_actor.hpp>
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace sofof::test::connections {

using namespace actors;
using namespace messages;
using namespace network;
using namespace scenario;

namespace {

constexpr std::size_t header_size = 32, node_size = 25;
constexpr std::uint8_t client_handshake = 1, direct_message = 2,
                       monitor_message = 4, heartbeat = 6;
constexpr std::uint64_t told = 0x1000'0000'0000'0000;

bytes number(std::uint64_t value, std::size_t size) {
  bytes out(size);
  for (auto at = out.rbegin(); at != out.rend(); ++at, value >>= 8)
    *at = static_cast<std::byte>(value & 0xff);
  return out;
}

bytes operator+(bytes a, const bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

bytes frame(std::uint8_t operation, const bytes& payload = {},
            std::uint64_t data = 0, std::uint64_t from = 0,
            std::uint64_t to = 0) {
  return number(std::uint64_t{operation} << 24, 4) + number(payload.size(), 4)
         + number(data, 8) + number(from, 8) + number(to, 8) + payload;
}

bytes a_node(int filled_with = 7) {
  bytes node(node_size, static_cast<std::byte>(filled_with));
  node.front() = std::byte{1};
  return node;
}

acceptor_actor::behavior_type played_acceptor() {
  return {[](std::uint32_t, std::uint64_t) -> version_answer {
    return {std::uint32_t{1}, std::uint64_t{2}, std::string{"nonce"},
            caf::strong_actor_ptr{}};
  }};
}

std::unique_ptr<network_runtime> make_runtime() {
  caf::io::middleman::init_global_meta_objects();
  return make_network_runtime();
}

/// A process with an acceptor, and what it has said of those it disconnected.
struct listening_process {
  std::unique_ptr<network_runtime> time = make_runtime();
  std::mutex mutex;
  std::vector<std::string> refusals;
  std::uint16_t port = 0;

  explicit listening_process(
      std::function<std::optional<peer_identity>(std::uint16_t)> identify =
          {}) {
    filter_setup setup;
    setup.identify = std::move(identify);
    setup.stations = 1;
    setup.on_refusal = [this](const std::string& why) {
      const std::lock_guard lock{mutex};
      refusals.push_back(why);
    };
    time->filter(std::move(setup));
    port = time->publish(time->system().spawn(played_acceptor), 0);
  }

  bool has_said(std::string_view what) {
    return wait_until([&] {
      const std::lock_guard lock{mutex};
      return std::ranges::any_of(refusals, [&](const std::string& why) {
        return why.find(what) != why.npos;
      });
    });
  }
};

/// A connection to it, greeted by it.
struct raw_peer {
  plug line;
  bytes its_node;
  std::uint64_t acceptor = 0;

  explicit raw_peer(const listening_process& to) : line{plug_into(to.port)} {
    const auto header = line.receive(header_size);
    REQUIRE(header.size() == header_size);
    std::size_t size = 0;
    for (std::size_t i = 4; i < 8; ++i)
      size = size << 8 | std::to_integer<std::size_t>(header[i]);
    const auto payload = line.receive(size);
    its_node.assign(payload.begin(), payload.begin() + node_size);
    // The application id, a list of one text; then the acceptor.
    const auto at = node_size + 2 + std::to_integer<std::size_t>(payload[26]);
    for (std::size_t i = at; i < at + 8; ++i)
      acceptor = acceptor << 8 | std::to_integer<std::uint64_t>(payload[i]);
  }

  void introduce(const bytes& node) const {
    line.send(frame(client_handshake, node));
  }
  /// @returns whether the acceptor answers it.
  bool is_heard() const {
    const auto question = number(0, 1) + number(2, 1) + number(9, 2)
                          + number(10, 2) + number(6, 4) + number(1, 8);
    line.send(frame(direct_message, question, told | 1, 5, acceptor));
    for (;;) {
      const auto header = line.receive(header_size);
      if (header.size() < header_size)
        return false;
      std::size_t size = 0;
      for (std::size_t i = 4; i < 8; ++i)
        size = size << 8 | std::to_integer<std::size_t>(header[i]);
      line.receive(size);
      if (header[0] == std::byte{direct_message})
        return true;
    }
  }
};

} // namespace

TEST_CASE("a peer that introduces a node of its own is answered") {
  const listening_process process;
  const raw_peer peer{process};
  peer.introduce(a_node());
  CHECK(peer.is_heard());
}

TEST_CASE("a peer that says that it is this process is disconnected, and so is "
          "one that is another peer, or two") {
  listening_process process;
  const raw_peer honest{process}, other{process}, twice{process};
  honest.introduce(a_node());
  REQUIRE(honest.is_heard());
  SUBCASE("this process") {
    other.introduce(other.its_node);
    CHECK(other.line.is_closed());
  }
  SUBCASE("another peer") {
    other.introduce(a_node());
    CHECK(other.line.is_closed());
  }
  SUBCASE("two") {
    twice.introduce(a_node(8));
    twice.introduce(a_node(9));
    CHECK(twice.line.is_closed());
    CHECK(process.has_said("it introduces its node twice"));
  }
  SUBCASE("nobody") {
    other.line.send(frame(heartbeat));
    CHECK(other.line.is_closed());
    CHECK(process.has_said("its first frame is not its handshake"));
    CHECK(process.refusals.front().find("more") == std::string::npos);
  }
  CHECK(honest.is_heard());
}

TEST_CASE("a peer speaks for itself alone, and to this process alone") {
  const listening_process process;
  const raw_peer honest{process}, other{process};
  honest.introduce(a_node());
  REQUIRE(honest.is_heard());
  other.introduce(a_node(8));
  SUBCASE("for another") {
    other.line.send(frame(monitor_message, a_node() + other.its_node, 0, 0,
                          other.acceptor));
  }
  SUBCASE("to another") {
    other.line.send(frame(monitor_message, a_node(8) + a_node(), 0, 0, 1));
  }
  CHECK(other.line.is_closed());
  CHECK(honest.is_heard());
}

TEST_CASE("a message in a message ends the connection, and nothing else") {
  listening_process process;
  const raw_peer honest{process}, other{process};
  honest.introduce(a_node());
  other.introduce(a_node(8));
  bytes nested = number(0, 1);
  for (int depth = 0; depth < 10'000; ++depth)
    nested = std::move(nested) + number(1, 1) + number(39, 2);
  other.line.send(frame(direct_message, nested, told, 5, other.acceptor));
  CHECK(other.line.is_closed());
  CHECK(process.has_said("its message is none that it may send"));
  CHECK(honest.is_heard());
}

TEST_CASE("a connection from a port that is nobody's is closed before it is "
          "greeted") {
  std::atomic<bool> is_known = false;
  const listening_process process{[&](std::uint16_t) {
    return is_known ? std::optional{peer_identity{{101}, {}}} : std::nullopt;
  }};
  {
    const auto line = plug_into(process.port);
    CHECK(line.receive(1).empty());
  }
  is_known = true;
  const raw_peer peer{process};
  peer.introduce(a_node());
  CHECK(peer.is_heard());
  const auto node = caf::make_node_id(
      0x07070707,
      caf::node_id::default_data::host_id_type{7, 7, 7, 7, 7, 7, 7, 7, 7, 7,
                                               7, 7, 7, 7, 7, 7, 7, 7, 7, 7});
  CHECK(process.time->identity_of(node) == peer_identity{{101}, {}});
}

} // namespace sofof::test::connections
