// Clients and a broker, on this machine alone.
#include "network/amqp/broker.hpp"
#include "network/amqp/client.hpp"
#include "network/amqp/is_built_in.hpp"
#include "network/network_error.hpp"
#include "tests/network/loopback.hpp"

#include <doctest/doctest.h>

#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

namespace sofof::test::at_a_broker {

namespace amqp = network::amqp;
using namespace std::string_view_literals;

/// Whether there is something to test; says so if not.
bool has_amqp() {
  if (!amqp::is_built_in())
    MESSAGE("skipped: this program was built without Qpid Proton");
  return amqp::is_built_in();
}

/// A client and what it has received.
class listening_client {
public:
  listening_client(
      std::uint16_t port, const std::string& selector = {},
      const std::function<void(amqp::client_options&)>& change = [](auto&) {}) {
    static int number = 0;
    amqp::client_options how;
    how.where = [port] { return network::network_address{"127.0.0.1", port}; };
    how.name = "test-" + std::to_string(++number);
    how.selector = selector;
    how.on_message = [this](amqp::message m) {
      std::this_thread::sleep_for(reads_for.load());
      const std::lock_guard lock{mutex_};
      messages_.push_back(std::move(m));
    };
    how.on_down = [this](const std::string& why) {
      const std::lock_guard lock{mutex_};
      why_down_ = why;
    };
    change(how);
    client_ = std::make_unique<amqp::client>(std::move(how));
    client_->start();
  }
  ~listening_client() { client_->stop(); }

  amqp::client& client() { return *client_; }
  bool is_up() const { return client_->is_up(); }
  std::vector<amqp::message> messages() const {
    const std::lock_guard lock{mutex_};
    return messages_;
  }
  std::size_t count() const { return messages().size(); }
  std::string why_down() const {
    const std::lock_guard lock{mutex_};
    return why_down_;
  }

  std::atomic<std::chrono::milliseconds> reads_for{0ms}; ///< Each message.

private:
  mutable std::mutex mutex_;
  std::vector<amqp::message> messages_;
  std::string why_down_;
  std::unique_ptr<amqp::client> client_;
};

/// @returns an ITS message of a station, as far as a broker looks at it.
amqp::message cpm_of(std::uint32_t station) {
  amqp::message m;
  m.subject = "cpm";
  m.created = std::chrono::duration_cast<std::chrono::milliseconds>(
      std::chrono::system_clock::now().time_since_epoch());
  m.ttl = 1000ms;
  m.all = {{"mid", std::uint16_t{2049}}, {"station_id", station}};
  m.body.assign(40, std::byte{0});
  for (std::size_t i = 0; i < 4; ++i)
    m.body[2 + i] = static_cast<std::byte>(station >> (24 - 8 * i) & 0xff);
  return m;
}

/// Messages that are not passed on have all been looked at when a later one has
/// come back.
void send_last(listening_client& from, const std::string& user = {}) {
  auto last = cpm_of(101);
  last.user = user;
  last.subject = "last";
  from.client().send(last);
  REQUIRE(wait_until([&] {
    const auto all = from.messages();
    return !all.empty() && all.back().subject == "last";
  }));
}

TEST_CASE("a message reaches all whose selector it matches, and as it was") {
  if (!has_amqp())
    return;
  const amqp::broker broker{{}};
  listening_client sender{broker.port(), "mid = 1"};
  listening_client all{broker.port()};
  listening_client others{broker.port(),
                          "NOT(station_id = 101) AND mid = 2049"};
  REQUIRE(wait_until(
      [&] { return sender.is_up() && all.is_up() && others.is_up(); }));
  auto first = cpm_of(101), second = cpm_of(102);
  second.all.emplace("raw", std::vector<std::byte>(300, std::byte{5}));
  second.all.emplace("latitude", 48.4);
  sender.client().send(first);
  sender.client().send(second);
  REQUIRE(wait_until([&] { return all.count() == 2 && others.count() == 1; }));
  CHECK((all.messages() == std::vector{first, second}));
  CHECK((others.messages() == std::vector{second}));
  CHECK(sender.count() == 0);
  CHECK(broker.counts().received == 2);
  CHECK(broker.counts().sent == 3);
}

TEST_CASE("a peer sends in its own name, for its own stations, and whole "
          "messages") {
  if (!has_amqp())
    return;
  std::mutex mutex;
  std::string refusals;
  amqp::broker_options how;
  how.identify = [](std::uint16_t) {
    return network::peer_identity{{101}, {}};
  };
  how.on_refusal = [&](const std::string& why) {
    const std::lock_guard lock{mutex};
    refusals += why + '\n';
  };
  const amqp::broker broker{std::move(how)};
  listening_client client{broker.port()};
  REQUIRE(wait_until([&] { return client.is_up(); }));
  const auto good = [](auto m) {
    m.user = "station 101";
    return m;
  };
  auto other_name = cpm_of(101);
  other_name.user = "station 102";
  auto other_body = good(cpm_of(102));
  other_body.all["station_id"] = std::uint32_t{101};
  auto no_station = good(cpm_of(101));
  no_station.all.clear();
  auto cut_off = good(cpm_of(101));
  cut_off.body.resize(5);
  for (const auto& bad : {other_name, other_body, no_station, cut_off,
                          good(cpm_of(102)), cpm_of(101)})
    client.client().send(bad);
  send_last(client, "station 101");
  CHECK(client.count() == 1);
  CHECK(broker.counts().refused == 6);
  const std::lock_guard lock{mutex};
  for (const auto* why :
       {"sends in another's name", "sends for another station",
        "does not say for which station it sends",
        "sends the ITS message of a station that it does not name"}) {
    CAPTURE(why);
    CHECK(refusals.find(std::string{"station 101 "} + why)
          != std::string::npos);
  }
}

TEST_CASE("a stranger is not let in where peers are known") {
  if (!has_amqp())
    return;
  std::mutex mutex;
  std::string refusals;
  amqp::broker_options how;
  how.identify = [](std::uint16_t) {
    return std::optional<network::peer_identity>{};
  };
  how.on_refusal = [&](const std::string& why) {
    const std::lock_guard lock{mutex};
    refusals += why + '\n';
  };
  const amqp::broker broker{std::move(how)};
  listening_client client{broker.port()};
  REQUIRE(wait_until([&] { return !client.why_down().empty(); }));
  CHECK_FALSE(client.is_up());
  const std::lock_guard lock{mutex};
  CHECK(refusals.find("nobody knows who it is") != std::string::npos);
}

TEST_CASE("a peer that says too much is heard for two seconds' worth") {
  if (!has_amqp())
    return;
  amqp::broker_options how;
  how.stations = 1; // 400 messages a second
  const amqp::broker broker{std::move(how)};
  listening_client flood{broker.port(), "mid = 1",
                         [](auto& o) { o.longest_queue = 5000; }};
  REQUIRE(wait_until([&] { return flood.is_up(); }));
  for (int i = 0; i < 3000; ++i)
    flood.client().send(cpm_of(101));
  REQUIRE(wait_until([&] { return broker.counts().received >= 1500; }));
  CHECK(broker.counts().refused >= 100);
}

TEST_CASE("who reads slowly delays nobody, and gets nothing that is too old") {
  if (!has_amqp())
    return;
  const amqp::broker broker{{}};
  listening_client sender{broker.port(), "mid = 1"};
  listening_client fast{broker.port()}, slow{broker.port()};
  slow.reads_for = 40ms;
  REQUIRE(wait_until(
      [&] { return sender.is_up() && fast.is_up() && slow.is_up(); }));
  for (int i = 0; i < 200; ++i) {
    auto m = cpm_of(101);
    m.ttl = 100ms;
    sender.client().send(m);
    std::this_thread::sleep_for(1ms);
  }
  REQUIRE(wait_until([&] { return fast.count() == 200; }));
  REQUIRE(wait_until([&] { return broker.counts().expired > 0; }));
  CHECK(slow.count() < 100);
}

TEST_CASE("a client finds its broker again, and forgets what it had to say") {
  if (!has_amqp())
    return;
  auto broker = std::make_unique<amqp::broker>(amqp::broker_options{});
  const auto port = broker->port();
  listening_client client{port};
  REQUIRE(wait_until([&] { return client.is_up(); }));
  broker.reset();
  REQUIRE(wait_until([&] { return !client.is_up(); }));
  client.client().send(cpm_of(101));
  CHECK(client.client().counts().dropped == 1);
  amqp::broker_options again;
  again.port = port;
  const amqp::broker other{std::move(again)};
  REQUIRE(wait_until([&] { return client.is_up(); }));
  send_last(client);
  CHECK(client.count() == 1);
}

TEST_CASE("octets that are no AMQP harm nobody") {
  if (!has_amqp())
    return;
  const amqp::broker broker{{}};
  listening_client client{broker.port()};
  REQUIRE(wait_until([&] { return client.is_up(); }));
  for (int i = 0; i < 200; ++i) {
    const auto stranger = plug_into(broker.port());
    std::string octets = i % 2 ? std::string{"AMQP\0\1\0\0", 8} : "GET / HTTP";
    for (int k = 0; k < 64; ++k)
      octets += static_cast<char>(i * 31 + k * 17);
    static_cast<void>(stranger.send(octets));
  }
  send_last(client);
}

/// Opens connection, session and a link to "etsi", and sends one transfer, as
/// AMQP 1.0 has them, whose payload is these octets.
bytes transfer_of(std::string_view payload) {
  using namespace std::string_literals;
  const auto frame = [](const std::string& body) {
    std::string all(8, '\0');
    all += body;
    const auto size = all.size();
    for (std::size_t i = 0; i < 4; ++i)
      all[i] = static_cast<char>(size >> (24 - 8 * i) & 0xff);
    all[4] = 2; // where the body begins, in words
    return all;
  };
  const auto performative = [](char code, const std::string& fields,
                               char count) {
    std::string all = "\0\x53"s;
    all += code;
    all += '\xc0';
    all += static_cast<char>(fields.size() + 1);
    all += count;
    return all + fields;
  };
  std::string all = "AMQP\0\1\0\0"s;
  all += frame(performative('\x10', "\xa1\4liar"s, 1));               // open
  all += frame(performative('\x11', "\x40\x43\x52\x7f\x52\x7f"s, 4)); // begin
  // attach: name, handle, role, modes, source, target
  all += frame(performative('\x12',
                            "\xa1\1a\x43\x42\x50\1\x40\x00\x53\x28\x45"s
                                + "\x00\x53\x29\xc0\7\1\xa1\4etsi"s,
                            7));
  // transfer: handle, id, tag, format, settled, more
  all += frame(performative('\x14', "\x43\x43\xa0\1t\x43\x41\x42"s, 6)
               + std::string{payload});
  return to_bytes(all);
}

TEST_CASE("a message that cannot be decoded ends its connection alone") {
  if (!has_amqp())
    return;
  const amqp::broker broker{{}};
  listening_client client{broker.port()};
  REQUIRE(wait_until([&] { return client.is_up(); }));
  for (const std::string_view payload :
       {""sv, "\xff\xff"sv, "\x00\x53\x75\xb0"sv, "\x00\x53\x74\xc1\x02\x05"sv,
        "nonsense"sv}) {
    const auto liar = plug_into(broker.port());
    REQUIRE(liar.send(transfer_of(payload)));
    send_last(client);
  }
  CHECK(client.is_up());
}

TEST_CASE("a broker that sends nonsense ends no client") {
  if (!has_amqp())
    return;
  for (const std::string_view octets :
       {"AMQP\0\1\0\0nonsense"sv, "HTTP/1.1 400 Bad Request"sv, ""sv}) {
    server liar{
        [octets](const plug& one) { static_cast<void>(one.send(octets)); }};
    listening_client client{liar.port()};
    REQUIRE(wait_until([&] { return !client.why_down().empty(); }));
    CHECK_FALSE(client.is_up());
  }
}

TEST_CASE("numbers have the types of the profile, or nobody gets them") {
  if (!has_amqp())
    return;
  const amqp::broker broker{{}};
  listening_client client{broker.port()};
  REQUIRE(wait_until([&] { return client.is_up(); }));
  auto m = cpm_of(101);
  m.all["mid"] = std::int64_t{2049};
  client.client().send(m);
  m = cpm_of(101);
  m.all["mid"] = std::string{"2049"};
  client.client().send(m);
  send_last(client);
  CHECK(client.count() == 1);
  CHECK(broker.counts().refused == 2);
}

TEST_CASE("a broker does not share its port") {
  if (!has_amqp())
    return;
  const amqp::broker broker{{}};
  amqp::broker_options same;
  same.port = broker.port();
  CHECK_THROWS_AS(amqp::broker{std::move(same)}, network::network_error);
}

} // namespace sofof::test::at_a_broker
