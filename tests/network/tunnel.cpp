// Two hosts with an acceptor and a connector: what comes through, and what does
// not.
#include "network/network_error.hpp"
#include "tests/network/two_hosts.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <future>
#include <optional>
#include <thread>
#include <vector>

using namespace sofof;
using namespace sofof::network;
using namespace sofof::test;

namespace {

bytes random_bytes(std::size_t size) {
  test::dice dice{7};
  bytes all(size);
  for (auto& b : all)
    b = static_cast<std::byte>(dice.between(0, 256));
  return all;
}

} // namespace

TEST_CASE("bytes come through both ways unchanged") {
  const key_folder keys;
  server inner{echo};
  const tls_acceptor acceptor{keys.credentials_for(mec),
                              acceptor_to(inner.port())};
  const auto own = keys.credentials_for(car);
  const tls_connector connector{&own, connector_to(acceptor.port())};
  const auto line = plug_into(connector.port());
  CHECK(echoes(line, "a"));
  const auto sent = random_bytes(10'000'000);
  bytes received;
  std::thread reader{[&] { received = line.receive(sent.size()); }};
  CHECK(line.send(sent));
  reader.join();
  CHECK(received == sent);
  CHECK(connector.last_error() == "");
  CHECK(acceptor.counts().accepted == 1);
  CHECK(acceptor.counts().open == 1);
  CHECK(acceptor.counts().refused == 0);
}

TEST_CASE("without credentials bytes come through as they are") {
  server inner{echo};
  const tls_connector connector{nullptr, connector_to(inner.port())};
  const auto line = plug_into(connector.port());
  CHECK(echoes(line, "plain"));
}

TEST_CASE("a connector leads elsewhere once it is told to, and open lines "
          "stay") {
  server first{echo};
  server second{[](const plug& to) { to.send("second"); }};
  tls_connector connector{nullptr, connector_to(first.port())};
  const auto line = plug_into(connector.port());
  CHECK(echoes(line, "first"));
  connector.lead_to({"127.0.0.1", second.port()});
  CHECK(plug_into(connector.port()).receive(6) == to_bytes("second"));
  CHECK(echoes(line, "still first"));
  connector.lead_to({"127.0.0.1", first.port()});
  CHECK(echoes(plug_into(connector.port()), "first again"));
}

TEST_CASE("a connector that nobody has told its host connects to nobody") {
  server inner{[](const plug& to) { to.send("here"); }};
  tls_connector connector{nullptr, {}};
  CHECK(plug_into(connector.port()).is_closed());
  connector.lead_to({"127.0.0.1", inner.port()});
  CHECK(plug_into(connector.port()).receive(4) == to_bytes("here"));
}

TEST_CASE("many lines carry at once") {
  const key_folder keys;
  server inner{echo};
  const tls_acceptor acceptor{keys.credentials_for(mec),
                              acceptor_to(inner.port())};
  const auto own = keys.credentials_for(car);
  const tls_connector connector{&own, connector_to(acceptor.port())};
  std::vector<plug> lines;
  for (int k = 0; k < 16; ++k)
    lines.push_back(plug_into(connector.port()));
  for (std::size_t k = 0; k < lines.size(); ++k)
    CHECK(echoes(lines[k], "line " + std::to_string(k)));
  CHECK(acceptor.counts().open == 16);
  CHECK(plug_into(connector.port()).is_closed());
  CHECK(contains(connector.last_error(), "there are 16 connections already"));
}

TEST_CASE("what was sent before the end arrives before the end") {
  const key_folder keys;
  const auto sent = random_bytes(1'000'000);
  server inner{[&](const plug& line) { line.send(sent); }};
  const tls_acceptor acceptor{keys.credentials_for(mec),
                              acceptor_to(inner.port())};
  const auto own = keys.credentials_for(car);
  const tls_connector connector{&own, connector_to(acceptor.port())};
  const auto line = plug_into(connector.port());
  CHECK(line.receive(sent.size() + 1) == sent);
  CHECK(contains(connector.last_error(), "it closed the connection"));
  CHECK(wait_until([&] { return acceptor.counts().open == 0; }));
}

TEST_CASE("when our side closes, the far side hears of it") {
  const key_folder keys;
  std::atomic<int> over = 0;
  server inner{[&](const plug& line) {
    echo(line);
    ++over;
  }};
  const tls_acceptor acceptor{keys.credentials_for(mec),
                              acceptor_to(inner.port())};
  const auto own = keys.credentials_for(car);
  const tls_connector connector{&own, connector_to(acceptor.port())};
  CHECK(echoes(plug_into(connector.port()), "short"));
  CHECK(wait_until([&] { return over == 1; }));
  CHECK(wait_until([&] { return acceptor.counts().open == 0; }));
  CHECK(connector.last_error() == "");
}

TEST_CASE("a line through which nothing crosses is closed") {
  const key_folder keys;
  server inner{echo};
  SUBCASE("by the acceptor") {
    auto options = acceptor_to(inner.port());
    options.idle = 200ms;
    const tls_acceptor acceptor{keys.credentials_for(mec), options};
    const auto own = keys.credentials_for(car);
    const tls_connector connector{&own, connector_to(acceptor.port())};
    const auto line = plug_into(connector.port());
    CHECK(echoes(line, "and then silence"));
    CHECK(line.is_closed());
  }
  SUBCASE("by the connector") {
    const tls_acceptor acceptor{keys.credentials_for(mec),
                                acceptor_to(inner.port())};
    const auto own = keys.credentials_for(car);
    auto options = connector_to(acceptor.port());
    options.idle = 200ms;
    const tls_connector connector{&own, options};
    const auto line = plug_into(connector.port());
    CHECK(echoes(line, "and then silence"));
    CHECK(line.is_closed());
    CHECK(contains(connector.last_error(), "nothing crossed for 200 ms"));
  }
}

TEST_CASE("a line with something crossing now and then stays") {
  const key_folder keys;
  server inner{echo};
  auto options = acceptor_to(inner.port());
  options.idle = 3s; // a loaded machine may well stand still for half a second
  const tls_acceptor acceptor{keys.credentials_for(mec), options};
  const auto own = keys.credentials_for(car);
  const tls_connector connector{&own, connector_to(acceptor.port())};
  const auto line = plug_into(connector.port());
  for (int k = 0; k < 34; ++k) {
    CHECK(echoes(line, "still here"));
    std::this_thread::sleep_for(100ms);
  }
}

TEST_CASE("while nobody reads, nobody can send without end") {
  const key_folder keys;
  std::atomic<bool> over = false;
  server inner{[&](const plug&) { wait_until([&] { return over.load(); }); }};
  const tls_acceptor acceptor{keys.credentials_for(mec),
                              acceptor_to(inner.port())};
  const auto own = keys.credentials_for(car);
  const tls_connector connector{&own, connector_to(acceptor.port())};
  const auto line = plug_into(connector.port());
  const timeval wait{0, 300'000};
  setsockopt(line.fd(), SOL_SOCKET, SO_SNDTIMEO, &wait, sizeof wait);
  const bytes block(64 * 1024);
  std::size_t sent = 0;
  constexpr std::size_t too_much = 200'000'000;
  while (sent < too_much && line.send(block))
    sent += block.size();
  // What the system's own buffers of three connections hold, and 64 kB.
  CHECK(sent < 60'000'000);
  over = true;
}

TEST_CASE("an end with a line open leaves nothing behind") {
  const key_folder keys;
  server inner{echo};
  std::optional<tls_acceptor> acceptor;
  acceptor.emplace(keys.credentials_for(mec), acceptor_to(inner.port()));
  const auto own = keys.credentials_for(car);
  std::optional<tls_connector> connector;
  connector.emplace(&own, connector_to(acceptor->port()));
  const auto line = plug_into(connector->port());
  CHECK(echoes(line, "open"));
  SUBCASE("the acceptor first") {
    acceptor.reset();
    CHECK(line.is_closed());
    CHECK(contains(connector->last_error(), "it closed the connection"));
  }
  SUBCASE("the connector first") {
    connector.reset();
    CHECK(line.is_closed());
    CHECK(wait_until([&] { return acceptor->counts().open == 0; }));
  }
}

TEST_CASE("a connector that hangs up closes its lines, and takes new ones") {
  const key_folder keys;
  server inner{echo};
  const tls_acceptor acceptor{keys.credentials_for(mec),
                              acceptor_to(inner.port())};
  const auto own = keys.credentials_for(car);
  tls_connector connector{&own, connector_to(acceptor.port())};
  const auto one = plug_into(connector.port());
  const auto two = plug_into(connector.port());
  CHECK(echoes(one, "one"));
  CHECK(echoes(two, "two"));
  connector.hang_up();
  CHECK(one.is_closed());
  CHECK(two.is_closed());
  CHECK(wait_until([&] { return acceptor.counts().open == 0; }));
  CHECK(connector.last_error() == "");
  CHECK(echoes(plug_into(connector.port()), "three"));
}

TEST_CASE("a resolver that never answers holds up neither lines nor the end") {
  std::promise<void> answer;
  auto options = connector_to(1);
  options.remote.host = "edge.example";
  options.resolver = [until = answer.get_future().share()](const auto&) {
    until.wait();
    return std::vector<socket_address>{};
  };
  SUBCASE("lines are given up in time") {
    options.lookup_timeout = 50ms;
    const tls_connector connector{nullptr, options};
    for (int k = 0; k < 3; ++k)
      CHECK(plug_into(connector.port()).is_closed());
    CHECK(contains(connector.last_error(), "its name was not "
                                           "found in time"));
  }
  SUBCASE("they are given up at once when the connector hangs up") {
    tls_connector connector{nullptr, options};
    const auto line = plug_into(connector.port());
    std::this_thread::sleep_for(20ms);
    connector.hang_up();
    CHECK(line.is_closed());
  }
  SUBCASE("the connector ends") {
    std::optional<tls_connector> connector;
    connector.emplace(nullptr, options);
    const auto line = plug_into(connector->port());
    std::this_thread::sleep_for(20ms);
    connector.reset();
    CHECK(line.is_closed());
  }
  answer.set_value();
}

TEST_CASE("who does not answer is called again before the system would") {
  // Of a port that nobody accepts from, with no room for more, the system
  // drops what would be a new connection.
  const auto full = [] {
    auto listener = listen_at({"127.0.0.1", 0});
    listen(listener.get(), 0);
    return listener;
  }();
  const auto in_the_way = plug_into(port_of(full));
  auto options = connector_to(port_of(full));
  options.turn = 50ms;
  const auto began = std::chrono::steady_clock::now();
  const tls_connector connector{nullptr, options};
  const auto line = plug_into(connector.port());
  std::this_thread::sleep_for(200ms);
  REQUIRE(accept_from(full).socket);
  pollfd event{full.get(), POLLIN, 0};
  REQUIRE(poll(&event, 1, static_cast<int>(patience.count())) == 1);
  CHECK(std::chrono::steady_clock::now() - began < 900ms); // it waits for 1 s
  const plug far{accept_from(full).socket};
  CHECK(far.send("hello"));
  CHECK(line.receive(5) == to_bytes("hello"));
}

TEST_CASE("an address that is silent does not keep us from the next") {
  const auto silent = listen_at({"127.0.0.1", 0});
  listen(silent.get(), 0);
  const auto in_the_way = plug_into(port_of(silent));
  server inner{echo};
  auto options = connector_to(1);
  options.turn = 50ms;
  options.resolver = [&](const auto&) {
    return std::vector{loopback_port(port_of(silent)),
                       loopback_port(inner.port())};
  };
  const tls_connector connector{nullptr, options};
  CHECK(echoes(plug_into(connector.port()), "found"));
}

TEST_CASE("who never answers is called for so long, and no longer") {
  const auto silent = listen_at({"127.0.0.1", 0});
  listen(silent.get(), 0);
  const auto in_the_way = plug_into(port_of(silent));
  auto options = connector_to(port_of(silent));
  options.turn = 20ms;
  options.connect_timeout = 100ms;
  const tls_connector connector{nullptr, options};
  CHECK(plug_into(connector.port()).is_closed());
  CHECK(connector.last_error() == "it does not answer");
}

TEST_CASE("a name is looked up once for all that wait for it") {
  server inner{echo};
  std::promise<void> answer;
  std::atomic<int> asked = 0;
  auto options = connector_to(inner.port());
  options.resolver = [&asked, until = answer.get_future().share()](
                         const network_address& host) {
    ++asked;
    until.wait();
    return resolve(host);
  };
  const tls_connector connector{nullptr, options};
  std::vector<plug> lines;
  for (int k = 0; k < 5; ++k)
    lines.push_back(plug_into(connector.port()));
  std::this_thread::sleep_for(20ms);
  answer.set_value();
  for (const auto& line : lines)
    CHECK(echoes(line, "found"));
  CHECK(asked <= 2); // one may have come after the answer
}

TEST_CASE("acceptors are for providers, and connectors for vehicles") {
  const key_folder keys;
  const auto vehicle = keys.credentials_for(car);
  const auto provider = keys.credentials_for(mec);
  CHECK_THROWS_WITH_AS((tls_acceptor{vehicle, acceptor_to(1)}),
                       "the certificate names stations 101-102, but a provider "
                       "needs one of a provider: `sofof keys issue --provider` "
                       "makes it",
                       network_error);
  CHECK_THROWS_WITH_AS((tls_connector{&provider, connector_to(1)}),
                       "the certificate names provider mec, but vehicles need "
                       "one of their stations: `sofof keys issue --station` "
                       "makes it",
                       network_error);
}

TEST_CASE("a port that is taken has its sentence") {
  const key_folder keys;
  const auto taken = listen_at({"127.0.0.1", 0});
  auto options = acceptor_to(1);
  options.listen.port = port_of(taken);
  CHECK_THROWS_WITH_AS(
      (tls_acceptor{keys.credentials_for(mec), options}),
      ("cannot listen on 127.0.0.1:" + std::to_string(port_of(taken))
       + ": Address already in use; choose another port or address")
          .c_str(),
      network_error);
}

TEST_CASE("a connector says why there is no connection") {
  const key_folder keys;
  const key_folder others;
  server inner{echo};
  const auto own = keys.credentials_for(car);
  const auto error_of = [&](const connector_options& options) {
    const tls_connector connector{&own, options};
    const auto line = plug_into(connector.port());
    line.send("hello");
    CHECK(line.is_closed());
    return connector.last_error();
  };
  SUBCASE("nobody listens") {
    std::uint16_t port = 0;
    { port = port_of(listen_at({"127.0.0.1", 0})); }
    CHECK(error_of(connector_to(port)) == "nobody listens there");
  }
  SUBCASE("nobody knows the host") {
    auto options = connector_to(1);
    options.remote.host = "300.1.2.3";
    CHECK(error_of(options) == "nobody knows this host");
  }
  SUBCASE("a plain port that answers") {
    CHECK(contains(error_of(connector_to(inner.port())), "TLS"));
  }
  SUBCASE("a plain port that is silent") {
    server silent{[](const plug& line) { (void)line.is_closed(); }};
    auto options = connector_to(silent.port());
    options.handshake_timeout = 50ms;
    CHECK(contains(error_of(options), "did not finish the TLS handshake in "
                                      "time; is it a plain port?"));
  }
  SUBCASE("a plain port that closes") {
    server rude{[](const plug&) {}};
    CHECK(contains(error_of(connector_to(rude.port())), "it hung up"));
  }
  SUBCASE("a provider of another CA") {
    const tls_acceptor acceptor{others.credentials_for(mec),
                                acceptor_to(inner.port())};
    CHECK(contains(error_of(connector_to(acceptor.port())),
                   "its certificate is not signed by this CA"));
  }
  SUBCASE("the provider itself is not there") {
    const tls_acceptor acceptor{keys.credentials_for(mec), acceptor_to(1)};
    CHECK(contains(error_of(connector_to(acceptor.port())),
                   "it closed the connection before it said anything"));
  }
}

TEST_CASE("the number of lines per peer has a limit") {
  const key_folder keys;
  server inner{echo};
  sentences heard;
  auto options = acceptor_to(inner.port(), &heard);
  options.most_per_peer = 2;
  options.most_connections = 3;
  const tls_acceptor acceptor{keys.credentials_for(mec), options};
  const auto own = keys.credentials_for(car);
  const auto other = keys.credentials_for({{7}, {}});
  const tls_connector connector{&own, connector_to(acceptor.port())};
  const tls_connector other_connector{&other, connector_to(acceptor.port())};
  std::optional<plug> first = plug_into(connector.port());
  CHECK(echoes(*first, "one"));
  const auto second = plug_into(connector.port());
  CHECK(echoes(second, "two"));
  CHECK(plug_into(connector.port()).is_closed());
  CHECK(heard.heard("stations 101-102, was refused: it has 2 connections "
                    "already"));
  const auto third = plug_into(other_connector.port());
  CHECK(echoes(third, "three"));
  CHECK(plug_into(other_connector.port()).is_closed());
  CHECK(heard.heard("was refused: all 3 connections are taken"));
  first.reset();
  CHECK(wait_until([&] { return acceptor.counts().open == 2; }));
  CHECK(echoes(plug_into(connector.port()), "again"));
}
