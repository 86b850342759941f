// A broker behind TLS, with its figures.
#include "scenario/broker_service.hpp"

#include "base/fingerprint.hpp"
#include "network/amqp/broker.hpp"
#include "network/amqp/is_built_in.hpp"
#include "network/http/server.hpp"
#include "network/keys/nonce.hpp"
#include "network/tls/tls_acceptor.hpp"
#include "recording/exposition.hpp"
#include "scenario/broker_connection.hpp"
#include "scenario/host_parts.hpp"
#include "scenario/secure_listener.hpp"

#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <ostream>
#include <thread>
#include <utility>

namespace sofof::scenario {

namespace {

using recording::exposition;

constexpr std::chrono::milliseconds between_news{100};

void write_figures(const network::amqp::broker_counts& x, exposition& to) {
  const auto counter = [&to](std::string_view name, std::string_view help,
                             std::uint64_t value) {
    to.family(name, exposition::kind::counter, help);
    to.sample({}, value);
  };
  counter("sofof_broker_messages_received", "Messages that came.", x.received);
  counter("sofof_broker_messages_sent", "Messages sent, one for each receiver.",
          x.sent);
  counter("sofof_broker_messages_expired",
          "Messages that were older than their ttl before they could be sent.",
          x.expired);
  counter("sofof_broker_messages_overflowed",
          "Messages dropped because too many waited for a receiver.",
          x.overflowed);
  counter("sofof_broker_messages_refused",
          "Messages that were not passed on: too many, or in another's name.",
          x.refused);
  to.family("sofof_broker_connections", exposition::kind::gauge,
            "Connections now.");
  to.sample({}, static_cast<std::uint64_t>(x.connections));
}

network::http::response answer(const network::amqp::broker& of,
                               const network::http::request& to) {
  constexpr unsigned not_found = 404;
  if (to.path == "/healthz")
    return {.body = "ready\n"};
  if (to.path != "/metrics")
    return {.status = not_found, .body = "sofof broker\n/metrics\n/healthz\n"};
  const auto format = recording::format_for(to.accept);
  exposition page{format};
  write_figures(of.counts(), page);
  return {.type = std::string{recording::type_of(format)},
          .body = page.finish()};
}

network::acceptor_options secured(network::acceptor_options how) {
  how.service = network::tls_service::broker;
  how.draws = {fingerprint(network::draw_nonce()), "handshakes"};
  how.idle = std::chrono::milliseconds{6000}; // heartbeats are 2.5 s apart
  return how;
}

} // namespace

void run_broker(const broker_service_options& what,
                const std::atomic<bool>& interrupted, std::ostream& console) {
  network::amqp::require_built_in();
  const auto keys = load_keys(
      what.listen, what.keys, "--listen", [&](const network::credentials& own) {
        check_identity(own, what.keys, std::string{broker_name});
      });
  news_board board;
  const auto on_refusal = [&board](const std::string& why) {
    board.log("refused: " + why);
  };
  const auto peers = std::make_shared<network::peer_register>();
  network::amqp::broker_options how;
  how.port = keys ? 0 : what.listen.port;
  how.on_refusal = on_refusal;
  if (keys)
    how.identify = [peers](std::uint16_t port) { return peers->find(port); };
  const network::amqp::broker broker{std::move(how)};
  std::optional<network::tls_acceptor> tls;
  if (keys) {
    tls.emplace(keys->now(), secured({.listen = what.listen,
                                      .inner_port = broker.port(),
                                      .peers = peers,
                                      .on_refusal = on_refusal}));
    keys->add_user([&](const network::credentials& own) { tls->renew(own); });
  }
  std::optional<network::http::server> figures;
  if (what.metrics) {
    figures.emplace(*what.metrics, [&broker](const network::http::request& to) {
      return answer(broker, to);
    });
    console << fmt::format("figures at http://{}/metrics",
                           network::print_address(figures->address()))
            << std::endl;
  }
  console << fmt::format(
      "the broker listens on {}{}",
      network::print_address(
          {what.listen.host, tls ? tls->port() : broker.port()}),
      keys ? "" : ", for this machine alone")
          << std::endl;
  while (!interrupted) {
    std::this_thread::sleep_for(between_news);
    if (keys && what.keys_have_changed
        && what.keys_have_changed->exchange(false))
      board.log(keys->read_again());
    for (const auto& line : board.take())
      console << line << std::endl;
  }
}

} // namespace sofof::scenario
