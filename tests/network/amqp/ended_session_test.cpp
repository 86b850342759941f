// A broker that ends what was opened at it, but not the connection.
#include "network/amqp/client.hpp"
#include "tests/network/loopback.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <functional>
#include <proton/connection.hpp>
#include <proton/container.hpp>
#include <proton/error_condition.hpp>
#include <proton/listen_handler.hpp>
#include <proton/listener.hpp>
#include <proton/messaging_handler.hpp>
#include <proton/receiver.hpp>
#include <proton/sender.hpp>
#include <proton/session.hpp>
#include <string>
#include <thread>
#include <utility>

namespace sofof::test::ended_sessions {

using namespace network::amqp;

/// Lets everybody in, and ends something of them as soon as both links are
/// open.
class ending_broker final : public proton::messaging_handler {
public:
  using ending = std::function<void(proton::sender&)>;

  explicit ending_broker(ending how)
      : how_{std::move(how)}, container_{*this}, thread_{[this] {
          container_.run();
        }} {
    REQUIRE(wait_until([this] { return port_ != 0; }));
  }

  ~ending_broker() override {
    container_.stop();
    thread_.join();
  }

  std::uint16_t port() const { return port_; }
  int connections() const { return connections_; }

private:
  struct opened final : proton::listen_handler {
    explicit opened(std::atomic<std::uint16_t>& where) : port{where} {}
    void on_open(proton::listener& l) override {
      port = static_cast<std::uint16_t>(l.port());
    }
    std::atomic<std::uint16_t>& port;
  };

  void on_container_start(proton::container& c) override {
    c.listen("127.0.0.1:0", opened_);
  }
  void on_connection_open(proton::connection& c) override {
    ++connections_;
    c.open();
  }
  void on_receiver_open(proton::receiver& r) override { r.open(); }
  void on_sender_open(proton::sender& s) override {
    s.open();
    how_(s);
  }
  void on_error(const proton::error_condition&) override {}

  ending how_;
  std::atomic<std::uint16_t> port_{0};
  std::atomic<int> connections_{0};
  opened opened_{port_};
  proton::container container_;
  std::thread thread_;
};

/// @returns why the client went down, once it has come back.
std::string why_down_at(const ending_broker& broker) {
  std::mutex lock;
  std::string why;
  client_options how;
  how.where = [&] {
    return network::network_address{"127.0.0.1", broker.port()};
  };
  how.name = "test";
  how.proving = false;
  how.on_message = [](const message&) {};
  how.on_down = [&](std::string said) {
    const std::lock_guard locked{lock};
    why = std::move(said);
  };
  client one{std::move(how)};
  one.start();
  CHECK(wait_until([&] { return broker.connections() > 1; }));
  one.stop();
  const std::lock_guard locked{lock};
  return why;
}

TEST_CASE("a client whose session the broker ends connects again, and says "
          "why") {
  const ending_broker broker{[](proton::sender& s) {
    s.session().close(
        proton::error_condition{"amqp:precondition-failed", "another user"});
  }};
  const auto why = why_down_at(broker);
  CAPTURE(why);
  CHECK(why.find("another user") != std::string::npos);
}

TEST_CASE("a client whose link the broker ends without a word connects "
          "again") {
  const ending_broker broker{[](proton::sender& s) { s.close(); }};
  CHECK_FALSE(why_down_at(broker).empty());
}

} // namespace sofof::test::ended_sessions
