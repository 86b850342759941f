// One connection of a broker.
#pragma once

#include "base/files/descriptor.hpp"
#include "network/amqp/exchange.hpp"
#include "network/flow/token_bucket.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <proton/connection.hpp>
#include <proton/io/connection_driver.hpp>
#include <proton/messaging_handler.hpp>
#include <proton/transport.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::network::amqp {

/// Carries octets between a socket and Proton's engine, and hands on what the
/// peer sends, as far as it may. What goes wrong ends this connection alone.
class broker_peer final : public proton::messaging_handler {
public:
  /// @param who        Whom TLS has established; nothing: nobody proves
  ///                   anything.
  /// @param stations   For whom the peer speaks then.
  /// @param on_refusal Told who was not heard, and why.
  broker_peer(descriptor socket, std::optional<peer_identity> who,
              std::size_t stations, std::size_t most_links, exchange& all,
              std::function<void(const std::string& who, std::string_view why)>
                  on_refusal);
  ~broker_peer() override;

  int fd() const { return socket_.get(); }
  /// @returns what the loop waits for at the socket, as for poll().
  short events();
  bool is_finished() const { return is_finished_; }

  /// The socket has something to read, or is closed.
  /// @param found  As poll() has it.
  void read(short found);
  /// Sends what it can, and sees to heartbeats.
  void write(deadline now);

private:
  void on_connection_open(proton::connection& c) override;
  void on_receiver_open(proton::receiver& r) override;
  void on_sender_open(proton::sender& s) override;
  void on_receiver_close(proton::receiver&) override { --links_; }
  void on_receiver_detach(proton::receiver&) override { --links_; }
  void on_sender_close(proton::sender& s) override { end(s); }
  void on_sender_detach(proton::sender& s) override { end(s); }
  void on_message(proton::delivery& d, proton::message& m) override;
  // What a peer does wrong ends its link or connection, and nothing else.
  void on_transport_error(proton::transport&) override {}
  void on_connection_error(proton::connection&) override {}
  void on_error(const proton::error_condition&) override {}

  bool admits_link(const std::string& address);
  void end(const proton::sender& s);
  std::string_view objection_to(const proton::message& m, const properties& all,
                                std::size_t body) const;
  void refuse(std::string_view why);
  void dispatch();
  void give_up(const std::string& why);

  descriptor socket_;
  exchange& all_;
  std::function<void(const std::string&, std::string_view)> on_refusal_;
  std::optional<peer_identity> who_;
  std::string name_;
  network::token_bucket messages_, octets_;
  std::size_t most_links_;
  std::size_t links_ = 0;
  std::vector<std::shared_ptr<subscriber>> receives_;
  bool is_finished_ = false;
  proton::io::connection_driver driver_;
};

} // namespace sofof::network::amqp
