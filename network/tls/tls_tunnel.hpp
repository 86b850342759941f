// Carries bytes between two connections, both ways, as they come.
#pragma once

#include "network/keys/revocation_list.hpp"
#include "network/tls/byte_stream.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace sofof::network {

/// How a tunnel ended.
struct tunnel_end {
  enum class cause {
    near_closed, ///< Our own process did.
    far_closed,  ///< The other host did, or the connection to it broke.
    idle,        ///< Nothing crossed for too long.
    distrusted,  ///< The other host's certificate is good no more.
    stopped,     ///< By the end of its loop.
  };
  cause why = cause::stopped;
  /// Why the connection broke, or what is wrong with the certificate; empty for
  /// all else.
  std::string failure;
  std::uint64_t bytes_inward = 0; ///< From the other host.
};

/// A connection to another host, and one within this host. While one side does
/// not take what the other sent, nothing more is read there: a tunnel holds 32
/// kB at most.
class tls_tunnel {
public:
  using end_handler = std::function<void(const tunnel_end&)>;

  /// @param on_end  Called once, before the connections close; must not throw.
  tls_tunnel(byte_stream far, byte_stream near, end_handler on_end);
  tls_tunnel(tls_tunnel&&) noexcept = default;

  struct turn {
    bool moved = false; ///< Something crossed.
    bool more = false;  ///< There is more to do at once.
    bool ended = false; ///< One side closed, and all that it sent has crossed.
  };

  /// Moves what can be moved now, but only some 100 kB: others wait, too.
  turn move();

  /// Tells how it ended.
  void end(tunnel_end::cause why);
  /// The same for a peer that is distrusted, for this reason.
  void end_distrusted(std::string why);

  /// @returns what is wrong now with the certificate of the other host, as
  /// words about it, "its certificate"; empty: nothing.
  std::string distrust(const revocation_list& revoked) const;

  /// Which side ended it, once it has.
  tunnel_end::cause who_closed() const { return closed_by_; }

  /// What to wait for before the next turn: events of epoll, or 0.
  std::uint32_t far_events() const { return far_events_; }
  std::uint32_t near_events() const { return near_events_; }
  int far_fd() const { return far_.fd(); }
  int near_fd() const { return near_.fd(); }

private:
  static constexpr std::size_t buffer_size = 16 * 1024; // a record of TLS

  struct flow {
    std::unique_ptr<std::array<std::byte, buffer_size>> bytes =
        std::make_unique<std::array<std::byte, buffer_size>>();
    std::size_t begin = 0;
    std::size_t end = 0;
    std::uint64_t moved = 0;
    bool source_closed = false;
    byte_stream::state read_waits = byte_stream::state::moved;
    byte_stream::state write_waits = byte_stream::state::moved;

    bool is_empty() const { return begin == end; }
  };

  /// @returns whether it moved anything.
  bool shift(byte_stream& from, byte_stream& to, flow& f);
  bool has_ended(const flow& f, tunnel_end::cause source,
                 tunnel_end::cause sink);
  void update_events();

  byte_stream far_;
  byte_stream near_;
  flow inward_;
  flow outward_;
  end_handler on_end_;
  tunnel_end::cause closed_by_ = tunnel_end::cause::stopped;
  std::uint32_t far_events_ = 0;
  std::uint32_t near_events_ = 0;
};

} // namespace sofof::network
