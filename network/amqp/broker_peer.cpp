// Octets in, octets out, and who may say what.
#include "network/amqp/broker_peer.hpp"

#include "base/ids.hpp"
#include "network/amqp/client.hpp"
#include "network/amqp/proton_message.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <poll.h>
#include <proton/codec/map.hpp>
#include <proton/connection_options.hpp>
#include <proton/delivery.hpp>
#include <proton/error_condition.hpp>
#include <proton/receiver.hpp>
#include <proton/receiver_options.hpp>
#include <proton/sender_options.hpp>
#include <proton/session.hpp>
#include <proton/source.hpp>
#include <proton/source_options.hpp>
#include <proton/symbol.hpp>
#include <proton/target.hpp>
#include <proton/target_options.hpp>
#include <proton/timestamp.hpp>
#include <sys/socket.h>
#include <utility>

namespace sofof::network::amqp {

namespace {

constexpr std::chrono::milliseconds idle_limit{5000};
constexpr int publisher_credit = 500; // messages
constexpr std::size_t longest_address = 256;
constexpr std::uint32_t longest_frame = 64 << 10;
constexpr std::uint16_t most_sessions = 4;
/// Octets of messages that have not come whole; more ends the connection.
constexpr std::size_t most_incoming = std::size_t{256} << 10;
constexpr std::size_t most_receivers = 4; // of a connection

// What a provider hears of a peer (actors/remote/peer_rules.cpp), and what all
// vehicles of a provider may get from it.
constexpr double messages_per_station_s = 200, more_messages_s = 200;
constexpr double messages_of_provider_s = 20'000;
constexpr double octets_of_message = 1024; // in the mean
constexpr double burst_s = 2;

double rate_of(const std::optional<peer_identity>& who, std::size_t stations) {
  if (who && who->is_provider())
    return messages_of_provider_s;
  const auto n = who ? who->stations.size() : stations;
  return more_messages_s + messages_per_station_s * static_cast<double>(n);
}

network::token_bucket two_seconds_of(double rate) {
  return {rate, burst_s * rate};
}

proton::error_condition condition(const std::string& why) {
  return {"amqp:not-allowed", why};
}

/// @throws network_error, proton::error.
selector selector_of(const proton::source& from) {
  const auto& filters = from.filters();
  if (!filters.exists("selector"))
    return {};
  const auto described = filters.get("selector");
  proton::codec::decoder in(described);
  proton::codec::start begin;
  proton::symbol what;
  std::string text;
  in >> begin >> what >> text;
  return selector{text};
}

/// @returns the station in the header of an ITS message (TS 102 894-2).
std::optional<station_id::rep> station_in(const proton::binary& its) {
  if (its.size() < 6)
    return std::nullopt;
  return static_cast<station_id::rep>(its[2]) << 24U
         | static_cast<station_id::rep>(its[3]) << 16U
         | static_cast<station_id::rep>(its[4]) << 8U | its[5];
}

time_point time_of(deadline t) {
  return time_point{std::chrono::duration_cast<duration>(t.time_since_epoch())};
}

} // namespace

broker_peer::broker_peer(
    descriptor socket, std::optional<peer_identity> who, std::size_t stations,
    std::size_t most_links, exchange& all,
    std::function<void(const std::string&, std::string_view)> on_refusal)
    : socket_{std::move(socket)}, all_{all}, on_refusal_{std::move(on_refusal)},
      who_{std::move(who)}, name_{who_ ? describe(*who_) : "a stranger"},
      messages_{two_seconds_of(rate_of(who_, stations))},
      octets_{two_seconds_of(octets_of_message * rate_of(who_, stations))},
      most_links_{most_links} {
  proton::connection_options how;
  how.handler(*this)
      .container_id("sofof-broker")
      .idle_timeout(proton::duration{idle_limit.count()})
      .max_frame_size(longest_frame)
      .max_sessions(most_sessions)
      .sasl_enabled(true)
      .sasl_allow_insecure_mechs(true)
      .sasl_allowed_mechs("ANONYMOUS EXTERNAL");
  driver_.accept(how);
}

broker_peer::~broker_peer() {
  for (const auto& one : receives_)
    all_.remove(one);
}

// -- octets -----------------------------------------------------------------

short broker_peer::events() {
  short all = 0;
  if (driver_.read_buffer().size > 0)
    all |= POLLIN;
  if (driver_.write_buffer().size > 0)
    all |= POLLOUT;
  return all;
}

void broker_peer::read(short found) {
  const auto room = driver_.read_buffer();
  if (room.size == 0) {
    if ((found & (POLLHUP | POLLERR)) != 0)
      is_finished_ = true;
    return;
  }
  const auto size = recv(socket_.get(), room.data, room.size, MSG_DONTWAIT);
  if (size > 0)
    driver_.read_done(static_cast<std::size_t>(size));
  else if (size == 0 || (errno != EAGAIN && errno != EINTR))
    driver_.disconnected(condition("the connection is gone"));
  dispatch();
  std::size_t incoming = 0;
  for (const auto& session : driver_.connection().sessions())
    incoming += session.incoming_bytes();
  if (incoming > most_incoming)
    give_up("sends a message that is too long");
}

void broker_peer::write(deadline now) {
  const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(
      now.time_since_epoch());
  driver_.tick(proton::timestamp{ms.count()});
  for (const auto& one : receives_)
    all_.send_waiting(*one);
  dispatch();
  for (auto next = driver_.write_buffer(); next.size > 0 && !is_finished_;
       next = driver_.write_buffer()) {
    const auto size =
        send(socket_.get(), next.data, next.size, MSG_DONTWAIT | MSG_NOSIGNAL);
    if (size < 0 && (errno == EAGAIN || errno == EINTR))
      return;
    if (size < 0)
      driver_.disconnected(condition("the connection is gone"));
    else
      driver_.write_done(static_cast<std::size_t>(size));
    dispatch();
  }
}

// What an event's handler throws, or Proton for what it cannot decode, is the
// connection's error.
void broker_peer::dispatch() {
  if (is_finished_)
    return;
  const auto goes_on = driver_.dispatch();
  is_finished_ = !goes_on || !driver_.transport().error().empty();
}

void broker_peer::give_up(const std::string& why) {
  refuse(why);
  driver_.disconnected(condition(why));
  dispatch();
  is_finished_ = true;
}

// -- links ------------------------------------------------------------------

void broker_peer::on_connection_open(proton::connection& c) {
  c.open(proton::connection_options{}.properties(
      {{"product", std::string{proving_broker}}}));
}

bool broker_peer::admits_link(const std::string& address) {
  return ++links_ <= 2 * most_links_ && !address.empty()
         && address.size() <= longest_address;
}

void broker_peer::on_receiver_open(proton::receiver& r) {
  const auto address = r.target().address();
  if (!admits_link(address)) {
    r.connection().close(condition("too many links, or no address"));
    return;
  }
  r.open(proton::receiver_options{}
             .target(proton::target_options{}.address(address))
             .credit_window(publisher_credit));
}

void broker_peer::on_sender_open(proton::sender& s) {
  const auto address = s.source().address();
  if (!admits_link(address) || receives_.size() >= most_receivers) {
    s.connection().close(condition("too many links, or no address"));
    return;
  }
  auto one = std::make_shared<subscriber>();
  try {
    one->wanted = selector_of(s.source());
  } catch (const std::exception& e) {
    s.close(condition(e.what()));
    return;
  }
  one->to = s;
  s.open(proton::sender_options{}
             .source(proton::source_options{}.address(address))
             .delivery_mode(proton::delivery_mode::AT_MOST_ONCE));
  receives_.push_back(one);
  all_.add(address, std::move(one));
}

void broker_peer::end(const proton::sender& s) {
  --links_;
  const auto at =
      std::ranges::find(receives_, s, [](const auto& x) { return x->to; });
  if (at == receives_.end())
    return;
  all_.remove(*at);
  receives_.erase(at);
}

// -- messages ---------------------------------------------------------------

void broker_peer::on_message(proton::delivery& d, proton::message& m) {
  ++all_.counts.received;
  const auto body = m.body().type() == proton::BINARY
                        ? proton::get<proton::binary>(m.body()).size()
                        : 0;
  const auto now = time_of(deadline_clock::now());
  if (!messages_.try_spend(now)
      || !octets_.try_spend(now, static_cast<double>(body))) {
    refuse("says too much");
    return;
  }
  try {
    const auto all = properties_of(m);
    if (const auto why = objection_to(m, all, body); why.empty())
      all_.pass_on(d.receiver().target().address(), std::move(m), all, body);
    else
      refuse(why);
  } catch (const std::exception&) {
    refuse("sends what cannot be read");
  }
}

std::string_view broker_peer::objection_to(const proton::message& m,
                                           const properties& all,
                                           std::size_t body) const {
  if (m.body().type() != proton::BINARY)
    return "sends what is no binary";
  if (body > longest_frame)
    return "sends a message that is too long";
  for (const auto* name : {"mid", "station_id", "destination_station_id"})
    if (m.properties().exists(name) && !all.contains(name))
      return "sends a number of a type that none of these has";
  const auto* station = find<std::uint32_t>(all, "station_id");
  if (all.contains("mid")) {
    const auto in = station_in(proton::get<proton::binary>(m.body()));
    if (!find<std::uint16_t>(all, "mid") || !in || !station || *in != *station)
      return "sends the ITS message of a station that it does not name";
  }
  if (!who_)
    return {};
  if (m.user() != name_)
    return "sends in another's name";
  if (!station)
    return "does not say for which station it sends";
  const auto own = who_->is_provider()
                       ? is_provider_station(station_id{*station})
                       : who_->has(station_id{*station});
  return own ? "" : "sends for another station";
}

void broker_peer::refuse(std::string_view why) {
  ++all_.counts.refused;
  on_refusal_(name_, why);
}

} // namespace sofof::network::amqp
