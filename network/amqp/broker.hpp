// A small AMQP 1.0 broker: what is sent to an address goes to all who receive
// from it.
#pragma once

#include "network/keys/identity.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace sofof::network::amqp {

/// Whom a broker lets in, and for how much.
struct broker_options {
  std::uint16_t port = 0; ///< On 127.0.0.1; 0: any.
  /// @returns who is behind a connection from this port of 127.0.0.1; nothing:
  /// it is closed. Empty: everybody is let in, and nobody proves anything.
  std::function<std::optional<peer_identity>(std::uint16_t port)> identify;
  std::size_t most_connections = 512;
  std::size_t most_links = 8;             ///< Of one connection, each way.
  std::size_t longest_message = 64 << 10; ///< Octets.
  std::size_t longest_queue = 1024; ///< Messages that wait for one receiver.
  /// For whom peers speak that are not known, stations.
  std::size_t stations = 256;
  /// Told who was refused or not heard, and why, in a sentence without its full
  /// stop, of each kind at most once a second; on the broker's thread; must not
  /// block or throw.
  std::function<void(const std::string&)> on_refusal;
};

/// What has become of messages and connections, since the start.
struct broker_counts {
  std::uint64_t received = 0;   ///< Messages.
  std::uint64_t sent = 0;       ///< One for each receiver.
  std::uint64_t expired = 0;    ///< Older than their ttl before they were sent.
  std::uint64_t overflowed = 0; ///< The oldest of a queue that was full.
  std::uint64_t refused = 0;    ///< Messages that were not passed on.
  std::size_t connections = 0;  ///< Now.
};

/// Passes each message on at once, at most once, to the receivers whose
/// selector it matches, the sender's own among them. For a receiver without
/// credit it waits as long as its ttl, and no longer queue than the options
/// say. A peer sends in its own name and for its own stations only: user-id is
/// what `describe` says of it, `station_id` is of its stations or, from a
/// provider, a provider's, and an ITS message in the body (`mid`) is that
/// station's own. It sends at most as much as a provider would hear of it.
class broker {
public:
  /// @throws network_error when it cannot listen.
  explicit broker(broker_options options);
  /// Closes everything.
  ~broker();
  broker(const broker&) = delete;
  broker& operator=(const broker&) = delete;

  std::uint16_t port() const;
  broker_counts counts() const; ///< Any thread may ask.

private:
  class loop;
  std::unique_ptr<loop> loop_;
};

} // namespace sofof::network::amqp
