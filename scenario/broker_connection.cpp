// An AMQP client, before which may be a tunnel.
#include "scenario/broker_connection.hpp"

#include "actors/broker/c_roads.hpp"
#include "actors/runtime/time.hpp"
#include "base/input_error.hpp"
#include "network/amqp/is_built_in.hpp"
#include "network/keys/nonce.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace sofof::scenario {

namespace {

constexpr std::uint16_t usual_port = 5672, usual_secured_port = 5671;

constexpr std::chrono::seconds first_patience{1};

/// Also of messages that tell none.
constexpr std::chrono::milliseconds longest_ttl{5000};

/// Senders whose clocks are known.
constexpr std::size_t most_senders = 4096;

std::string hex_of_nonce() {
  std::string all;
  for (const auto c : network::draw_nonce().substr(0, 8))
    all += fmt::format("{:02x}", static_cast<unsigned char>(c));
  return all;
}

} // namespace

std::optional<broker_url> parse_broker(std::string_view url) {
  broker_url all;
  constexpr std::string_view plain = "amqp://", secured = "amqps://";
  all.secured = url.starts_with(secured);
  if (!all.secured && !url.starts_with(plain))
    return std::nullopt;
  url.remove_prefix(all.secured ? secured.size() : plain.size());
  if (const auto slash = url.find('/'); slash != url.npos) {
    // RabbitMQ's have a slash of their own: amqp://host//topic/etsi.
    all.address = url.substr(slash + 1);
    url = url.substr(0, slash);
    if (all.address.empty())
      all.address = "etsi";
  }
  if (const auto at = url.rfind('@'); at != url.npos) {
    const auto colon = url.substr(0, at).find(':');
    if (colon == url.npos)
      return std::nullopt;
    all.user = url.substr(0, colon);
    all.password = url.substr(colon + 1, at - colon - 1);
    url.remove_prefix(at + 1);
  }
  auto address = network::parse_address(url);
  if (!address)
    address = network::parse_address(fmt::format(
        "{}:{}", url, all.secured ? usual_secured_port : usual_port));
  if (!address)
    return std::nullopt;
  all.at = *address;
  return all;
}

std::string print_broker(const broker_url& url) {
  return fmt::format("{}://{}/{}", url.secured ? "amqps" : "amqp",
                     network::print_address(url.at), url.address);
}

broker_connection::broker_connection(
    broker_options what, std::shared_ptr<network::key_ring> keys, runtime& time,
    std::string selector, std::function<void(const std::string&)> on_news)
    : what_{std::move(what)}, keys_{std::move(keys)}, now_{[&sys =
                                                                time.system()] {
        return actors::now(sys);
      }},
      clock_{time.clock()}, selector_{std::move(selector)},
      on_news_{std::move(on_news)}, fresh_{most_senders} {
  network::amqp::require_built_in();
  const auto& url = what_.url;
  if (url.secured && !keys_)
    throw input_error(fmt::format("--broker {} is secured; name the folder of "
                                  "the own certificate with --keys",
                                  print_broker(url)));
  if (!url.secured && keys_)
    throw input_error(fmt::format("--broker {} is not secured, so --keys has "
                                  "no effect; use amqps://",
                                  print_broker(url)));
  if (!what_.publisher.empty() && !actors::wire::is_publisher(what_.publisher))
    throw input_error(fmt::format("--c-roads '{}' is no publisher: two letters "
                                  "of a country and digits, like DE12345",
                                  what_.publisher));
  if (!url.secured && !url.user.empty())
    throw input_error("--broker: a password is sent over amqps:// only");
  if (!keys_)
    return;
  const auto own = keys_->now();
  tunnel_ = std::make_unique<network::tls_connector>(
      &own, network::connector_options{
                .remote = url.at,
                .provider = what_.trusted ? "" : std::string{broker_name},
                .service = network::tls_service::broker,
                // Heartbeats are 2.5 s apart.
                .idle = std::chrono::milliseconds{6000}});
  keys_->add_user([this](const network::credentials& fresh) {
    if (tunnel_)
      tunnel_->renew(fresh);
  });
}

void broker_connection::open(
    std::function<void(const actors::wire::envelope&)> on_envelope,
    std::function<void()> on_lost) {
  on_envelope_ = std::move(on_envelope);
  network::amqp::client_options how;
  how.where = [this] {
    return tunnel_ ? network::network_address{"127.0.0.1", tunnel_->port()}
                   : what_.url.at;
  };
  how.host = what_.url.at.host;
  how.name = "sofof-" + hex_of_nonce();
  how.address = what_.url.address;
  how.selector = selector_;
  how.user = what_.url.user;
  how.password = what_.url.password;
  how.external = what_.url.secured;
  how.proving = !what_.trusted;
  how.on_message = [this](const auto& m) { on_message(m); };
  how.on_up = [this] {
    {
      const std::lock_guard lock{mutex_};
      why_not_.clear();
      was_tried_ = true;
    }
    tried_.notify_all();
    on_news_(
        fmt::format("connected to the broker {}", print_broker(what_.url)));
  };
  how.on_down = [this, on_lost = std::move(on_lost)](std::string why) {
    if (tunnel_)
      if (auto of_tunnel = tunnel_->last_error(); !of_tunnel.empty())
        why = std::move(of_tunnel);
    auto sentence = fmt::format("no connection to the broker {}: {}; trying "
                                "again",
                                print_broker(what_.url), why);
    const auto is_news = [&] {
      const std::lock_guard lock{mutex_};
      const auto is_first = !std::exchange(was_tried_, true);
      return std::exchange(why_not_, why) != why || is_first;
    }();
    tried_.notify_all();
    if (is_news)
      on_news_(sentence);
    on_lost();
  };
  client_.store(std::make_shared<network::amqp::client>(std::move(how)));
  client_.load()->start();
}

void broker_connection::on_message(const network::amqp::message& m) {
  const auto envelope = actors::wire::from_amqp(m);
  if (!envelope)
    return;
  const auto now = now_();
  const auto sender = static_cast<std::uint64_t>(envelope->from.value());
  const auto ttl =
      m.ttl.count() > 0 ? std::min(m.ttl, longest_ttl) : longest_ttl;
  const auto is_dated = messages::is_time_of_day(m.created.count());
  if (is_dated
      && fresh_.is_fresh(sender, time_of_day(now) - m.created, ttl, now))
    on_envelope_(*envelope);
  else
    ++too_old_;
}

std::chrono::milliseconds broker_connection::time_of_day(time_point now) const {
  return std::chrono::floor<std::chrono::milliseconds>(clock_.unix_time(now));
}

void broker_connection::send(const actors::wire::envelope& x) {
  const auto client = client_.load();
  if (!client)
    return;
  auto m = actors::wire::to_amqp(x, time_of_day(now_()));
  if (!what_.publisher.empty())
    actors::wire::add_c_roads_properties(m, what_.publisher);
  client->send(std::move(m));
}

void broker_connection::write_figures(recording::exposition& to) const {
  const auto counter = [&to](std::string_view name, std::string_view help,
                             std::uint64_t value) {
    to.family(name, recording::exposition::kind::counter, help);
    to.sample({}, value);
  };
  const auto client = client_.load();
  const auto counts =
      client ? client->counts() : network::amqp::client_counts{};
  counter("sofof_broker_client_sent", "Messages sent to the broker.",
          counts.sent);
  counter("sofof_broker_client_dropped",
          "Messages not sent, for want of credit or connection.",
          counts.dropped);
  counter("sofof_broker_client_received", "Messages that the broker sent.",
          counts.received);
  counter("sofof_broker_client_old",
          "Messages received that were older than their ttl.", too_old_);
}

std::string broker_connection::user() const {
  if (!what_.url.user.empty())
    return what_.url.user;
  return keys_ ? network::describe(keys_->now().identity()) : std::string{};
}

std::optional<std::string> broker_connection::why_not() const {
  std::unique_lock lock{mutex_};
  tried_.wait_for(lock, first_patience, [this] { return was_tried_; });
  return why_not_.empty() ? std::nullopt : std::optional{why_not_};
}

void broker_connection::close() {
  if (const auto client = client_.load())
    client->stop();
  on_envelope_ = {};
  if (tunnel_)
    tunnel_->hang_up();
}

} // namespace sofof::scenario
