// How a process of a scenario uses an AMQP broker.
#pragma once

#include "actors/broker/wire.hpp"
#include "network/amqp/client.hpp"
#include "network/flow/freshness.hpp"
#include "network/keys/key_ring.hpp"
#include "network/network_address.hpp"
#include "network/tls/tls_connector.hpp"
#include "recording/exposition.hpp"
#include "scenario/runtime.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace sofof::scenario {

/// A broker and what is used of it.
struct broker_url {
  network::network_address at;
  bool secured = false;         ///< By TLS.
  std::string user, password;   ///< For SASL PLAIN; often empty.
  std::string address = "etsi"; ///< Of all messages.
};

/// Reads "amqp://127.0.0.1", "amqps://user:password@edge.example:5671/etsi" or
/// the like; usual ports are 5672 and 5671.
/// @returns nothing for anything else.
std::optional<broker_url> parse_broker(std::string_view url);

/// @returns the same without user and password, for people.
std::string print_broker(const broker_url& url);

struct broker_options {
  broker_url url;
  bool trusted = false; ///< It need not prove who sends.
  /// Adds the properties of C-ROADS, as this publisher's; empty: none.
  std::string publisher{};
};

/// The name that a broker's certificate has to have, as if it were a provider.
inline constexpr std::string_view broker_name = "broker";

/// A connection to a broker, by TLS if it is secured.
class broker_connection {
public:
  /// @param keys      Null where it is not secured; outlives this.
  /// @param time      Outlives this.
  /// @param selector  Of what comes.
  /// @param on_news   Called on any thread with sentences about the
  ///                  connection.
  /// @throws input_error when the URL and the keys do not fit.
  broker_connection(broker_options what,
                    std::shared_ptr<network::key_ring> keys, runtime& time,
                    std::string selector,
                    std::function<void(const std::string&)> on_news);

  /// Connects, from now on.
  /// @param on_envelope  Called for each, on a thread of the connection's.
  /// @param on_lost    Likewise when the connection is lost.
  /// @throws network_error.
  void open(std::function<void(const actors::wire::envelope&)> on_envelope,
            std::function<void()> on_lost);

  /// Any thread; nothing is sent before it is open and connected.
  void send(const actors::wire::envelope& x);

  /// Adds how many messages crossed and did not; on any thread.
  void write_figures(recording::exposition& to) const;

  /// @returns as whom the process sends; empty where nobody proves anything.
  std::string user() const;

  /// @returns why there is no connection; nothing: there is one. Waits for a
  /// second at most for the first attempt to connect.
  std::optional<std::string> why_not() const;

  /// Closes everything; nothing is called any more.
  void close();

private:
  void on_message(const network::amqp::message& m);
  std::chrono::milliseconds time_of_day(time_point now) const;

  broker_options what_;
  std::shared_ptr<network::key_ring> keys_;
  std::function<time_point()> now_;
  messages::etsi::its_clock clock_;
  std::string selector_;
  std::function<void(const std::string&)> on_news_;
  std::function<void(const actors::wire::envelope&)> on_envelope_;
  network::freshness fresh_;
  std::atomic<std::uint64_t> too_old_ = 0;
  mutable std::mutex mutex_;
  std::string why_not_ = "it does not answer"; // guarded by mutex_, as is
  bool was_tried_ = false;
  mutable std::condition_variable tried_;
  std::unique_ptr<network::tls_connector> tunnel_;
  std::atomic<std::shared_ptr<network::amqp::client>> client_;
};

} // namespace sofof::scenario
