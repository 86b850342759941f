// A connection to an AMQP 1.0 broker, made again whenever it is lost.
#pragma once

#include "network/amqp/message.hpp"
#include "network/network_address.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace sofof::network::amqp {

/// What the broker's product property says where it lets clients send only in
/// their own names.
inline constexpr std::string_view proving_broker = "sofof broker";

/// Where to connect, and what for.
struct client_options {
  /// @returns the address to connect to, asked before each attempt.
  std::function<network_address()> where;
  std::string host; ///< Of the broker, as it knows itself; may be empty.
  std::string name; ///< Ours; no two clients have the same.
  std::string address = "etsi"; ///< Of all that is sent and received.
  std::string selector;         ///< Of what is received; empty: everything.
  std::string user, password;   ///< For SASL PLAIN; empty: ANONYMOUS.
  bool external = false;        ///< SASL EXTERNAL is possible, too.
  /// Only a broker that proves who sends is good (`proving_broker`).
  bool proving = true;
  int credit_window = 5; ///< Messages that the broker may have sent ahead.
  std::size_t longest_queue = 1024; ///< Messages that wait to be sent.
  /// All are called on the client's thread and must not block. Lost or never
  /// made, for this reason; once for each attempt.
  std::function<void(const std::string& why)> on_down;
  std::function<void()> on_up;
  std::function<void(message)> on_message;
};

/// What has become of messages, since the start.
struct client_counts {
  std::uint64_t sent = 0;
  std::uint64_t received = 0;
  std::uint64_t dropped = 0;    ///< Not sent, for want of credit or connection.
  std::uint64_t unreadable = 0; ///< Received and not understood.
};

/// Sends to one address of a broker and receives from it, each message at most
/// once, on a thread of its own. Attempts to connect follow each other after up
/// to 2 s; what was to be sent before a connection was lost is forgotten.
class client {
public:
  explicit client(client_options options);
  /// Connects, from now on.
  void start();
  /// Ends connection and thread; afterwards nothing is sent, and no function is
  /// called nor kept any more. Not on its own thread.
  void stop();
  ~client();
  client(const client&) = delete;
  client& operator=(const client&) = delete;

  /// Sends a message, or drops it: where there is no connection, where too many
  /// wait, and where the broker gives no credit for 100 ms. Any thread.
  void send(message m);

  bool is_up() const;
  client_counts counts() const;

private:
  class state;
  std::shared_ptr<state> state_;
};

} // namespace sofof::network::amqp
