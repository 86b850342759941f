// A handler for each connection, and one queue for each receiver.
#include "network/amqp/broker.hpp"

#include "base/ids.hpp"
#include "network/amqp/client.hpp"
#include "network/amqp/is_built_in.hpp"
#include "network/amqp/proton_message.hpp"
#include "network/amqp/selector.hpp"
#include "network/block_signals.hpp"
#include "network/deadline.hpp"
#include "network/flow/sampled_log.hpp"
#include "network/flow/token_bucket.hpp"
#include "network/network_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <deque>
#include <future>
#include <map>
#include <proton/codec/map.hpp>
#include <proton/connection.hpp>
#include <proton/connection_options.hpp>
#include <proton/container.hpp>
#include <proton/delivery.hpp>
#include <proton/error_condition.hpp>
#include <proton/link.h>
#include <proton/listen_handler.hpp>
#include <proton/listener.hpp>
#include <proton/messaging_handler.hpp>
#include <proton/netaddr.h>
#include <proton/receiver.hpp>
#include <proton/receiver_options.hpp>
#include <proton/sender.hpp>
#include <proton/sender_options.hpp>
#include <proton/source_options.hpp>
#include <proton/symbol.hpp>
#include <proton/target_options.hpp>
#include <proton/transport.hpp>
#include <proton/work_queue.hpp>
#include <set>
#include <thread>
#include <utility>

namespace sofof::network::amqp {

namespace {

constexpr std::chrono::milliseconds idle_limit{5000};
constexpr std::chrono::milliseconds longest_ttl{5000}, usual_ttl{1000};
constexpr int publisher_credit = 500; // messages
constexpr std::size_t longest_address = 256;
/// Octets of a message besides its body, about.
constexpr std::size_t usual_head = 256;
/// Octets that wait for one receiver, and for all.
constexpr std::size_t most_waiting = std::size_t{4} << 20;
constexpr std::size_t most_waiting_in_all = std::size_t{64} << 20;

// What a provider hears of a peer (actors/remote/peer_rules.cpp), and what all
// vehicles of a provider may get from it.
constexpr double messages_per_station_s = 200, more_messages_s = 200;
constexpr double messages_of_provider_s = 20'000;
constexpr double burst_s = 2;

/// The object of Proton's C interface that one of C++ stands for.
template <class Object>
struct bare : Object {
  explicit bare(const Object& x) : Object{x} {}
  auto* get() const { return this->pn_object(); }
};

std::uint16_t remote_port(const proton::transport& t) {
  std::array<char, 16> host{}, port{};
  const auto* at = pn_transport_remote_addr(bare{t}.get());
  if (!at
      || pn_netaddr_host_port(at, host.data(), host.size(), port.data(),
                              port.size())
             != 0)
    return 0;
  return static_cast<std::uint16_t>(std::atoi(port.data()));
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

/// A message that waits for some receivers.
struct passed_on {
  proton::message what;
  std::size_t size = 0;
  deadline expires;
};

/// Who receives from an address.
struct subscriber {
  proton::sender to;
  selector wanted;
  std::deque<std::shared_ptr<const passed_on>> waiting{};
  std::size_t waiting_octets = 0;
  bool is_woken = false; // its connection will send
};

} // namespace

class broker::loop final : public proton::listen_handler {
public:
  explicit loop(broker_options options)
      : options_{std::move(options)}, container_{"sofof-broker"} {
    container_.auto_stop(false);
    auto opened = opened_.get_future();
    listener_ =
        container_.listen(fmt::format("//127.0.0.1:{}", options_.port), *this);
    thread_ = std::thread{[this] {
      leave_signals_to_others();
      container_.run();
    }};
    if (const auto why = opened.get(); !why.empty()) {
      container_.stop();
      thread_.join();
      throw network_error{fmt::format("the broker cannot listen on "
                                      "127.0.0.1:{}: {}",
                                      options_.port, why)};
    }
    port_ = static_cast<std::uint16_t>(listener_.port());
  }

  ~loop() override {
    container_.stop();
    thread_.join();
  }
  loop(const loop&) = delete;
  loop& operator=(const loop&) = delete;

  std::uint16_t port() const { return port_; }

  broker_counts counts() const {
    return {received_, sent_, expired_, overflowed_, refused_, connections_};
  }

private:
  class peer;

  void on_open(proton::listener&) override { opened_.set_value({}); }
  void on_error(proton::listener&, const std::string& why) override {
    opened_.set_value(why);
  }
  proton::connection_options on_accept(proton::listener&) override;

  void refuse(const std::string& who, std::string_view what) {
    auto& log =
        refusals_.try_emplace(std::string{what}, std::chrono::seconds{1})
            .first->second;
    const auto now = time_point{std::chrono::duration_cast<duration>(
        deadline_clock::now().time_since_epoch())};
    if (const auto line = log.add(fmt::format("{} {}", who, what), now);
        line && options_.on_refusal)
      options_.on_refusal(*line);
  }

  void pass_on(const std::string& address, proton::message&& m,
               const properties& all, std::size_t size);
  void enqueue(const std::shared_ptr<subscriber>& to,
               const std::shared_ptr<const passed_on>& one);
  void send_waiting(subscriber& to);
  void drop_oldest(subscriber& of);
  void leave(peer& who);

  broker_options options_;
  std::promise<std::string> opened_;
  proton::listener listener_;
  std::uint16_t port_ = 0;
  // Of the container's thread:
  std::map<std::string, network::sampled_log> refusals_;
  std::map<peer*, std::unique_ptr<peer>> peers_;
  std::multimap<std::string, std::shared_ptr<subscriber>> subscribers_;
  std::size_t waiting_octets_ = 0;
  // Anybody's:
  std::atomic<std::uint64_t> received_ = 0, sent_ = 0, expired_ = 0,
                             overflowed_ = 0, refused_ = 0;
  std::atomic<std::size_t> connections_ = 0;
  proton::container container_;
  std::thread thread_;
};

/// One connection.
class broker::loop::peer final : public proton::messaging_handler {
public:
  explicit peer(loop& all) : all_{all}, name_{"a stranger"} {}

  std::vector<std::shared_ptr<subscriber>> receives;

private:
  void on_transport_open(proton::transport& t) override {
    const auto& o = all_.options_;
    if (all_.peers_.size() > o.most_connections) {
      t.connection().close(condition("there are too many connections"));
      is_closed_ = true;
    }
    auto stations = o.stations;
    if (o.identify) {
      who_ = o.identify(remote_port(t));
      if (!who_) {
        t.connection().close(condition("nobody knows who connects"));
        is_closed_ = true;
        return;
      }
      name_ = describe(*who_);
      stations = who_->stations.size();
    }
    const auto rate =
        who_ && who_->is_provider()
            ? messages_of_provider_s
            : more_messages_s
                  + messages_per_station_s * static_cast<double>(stations);
    allowance_ = {rate, burst_s * rate};
  }

  void on_connection_open(proton::connection& c) override {
    c.open(proton::connection_options{}.properties(
        {{"product", std::string{proving_broker}}}));
  }

  static proton::error_condition condition(const std::string& why) {
    return {"amqp:not-allowed", why};
  }

  void on_receiver_open(proton::receiver& r) override {
    const auto& address = r.target().address();
    if (const auto why = objection_to_link(address); !why.empty()) {
      r.close(condition(why));
      return;
    }
    pn_link_set_max_message_size(bare{r}.get(), all_.options_.longest_message);
    r.open(proton::receiver_options{}
               .target(proton::target_options{}.address(address))
               .credit_window(publisher_credit));
  }

  void on_sender_open(proton::sender& s) override {
    const auto& address = s.source().address();
    auto why = objection_to_link(address);
    auto one = std::make_shared<subscriber>();
    try {
      one->wanted = selector_of(s.source());
    } catch (const std::exception& e) {
      why = e.what();
    }
    if (!why.empty()) {
      s.close(condition(why));
      return;
    }
    one->to = s;
    s.open(proton::sender_options{}
               .source(proton::source_options{}.address(address))
               .delivery_mode(proton::delivery_mode::AT_MOST_ONCE));
    receives.push_back(one);
    all_.subscribers_.emplace(address, std::move(one));
  }

  std::string objection_to_link(const std::string& address) {
    if (is_closed_)
      return "the connection is closed";
    if (++links_ > 2 * all_.options_.most_links)
      return fmt::format("a connection has at most {} links",
                         2 * all_.options_.most_links);
    if (address.empty() || address.size() > longest_address)
      return fmt::format("an address has 1 to {} characters", longest_address);
    return {};
  }

  void on_sender_close(proton::sender& s) override { end(s); }
  void on_sender_detach(proton::sender& s) override { end(s); }

  void end(const proton::sender& s) {
    const auto at =
        std::ranges::find(receives, s, [](const auto& x) { return x->to; });
    if (at == receives.end())
      return;
    forget(*at);
    receives.erase(at);
    --links_;
  }

  void forget(const std::shared_ptr<subscriber>& one) {
    std::erase_if(all_.subscribers_,
                  [&](const auto& x) { return x.second == one; });
    all_.waiting_octets_ -= one->waiting_octets;
    one->waiting_octets = 0;
    one->waiting.clear();
  }

  void on_sendable(proton::sender& s) override {
    for (const auto& one : receives)
      if (one->to == s)
        all_.send_waiting(*one);
  }

  void on_message(proton::delivery& d, proton::message& m) override {
    ++all_.received_;
    const auto now = time_point{std::chrono::duration_cast<duration>(
        deadline_clock::now().time_since_epoch())};
    if (!allowance_.try_spend(now)) {
      refuse("says too much");
      return;
    }
    try {
      const auto all = properties_of(m);
      const auto body = body_of(m);
      if (const auto why = objection_to(m, all, body); why.empty())
        all_.pass_on(d.receiver().target().address(), std::move(m), all,
                     body.size() + usual_head);
      else
        refuse(why);
    } catch (const proton::error&) {
      refuse("sends what cannot be read");
    }
  }

  static proton::binary body_of(const proton::message& m) {
    return m.body().type() == proton::BINARY
               ? proton::get<proton::binary>(m.body())
               : proton::binary{};
  }

  std::string_view objection_to(const proton::message& m, const properties& all,
                                const proton::binary& body) const {
    const auto* station = find<std::uint32_t>(all, "station_id");
    if (all.contains("mid")) {
      const auto in = station_in(body);
      if (!in || !station || *in != *station)
        return "sends the ITS message of a station that it does not name";
    } else if (m.body().type() != proton::BINARY) {
      return "sends what is no binary";
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

  void refuse(std::string_view why) {
    ++all_.refused_;
    all_.refuse(name_, why);
  }

  void on_transport_close(proton::transport&) override {
    for (const auto& one : receives)
      forget(one);
    receives.clear();
    all_.leave(*this);
  }

  // What a peer does wrong ends its link or connection, and nothing else.
  void on_transport_error(proton::transport&) override {}
  void on_connection_error(proton::connection&) override {}
  void on_error(const proton::error_condition&) override {}

  loop& all_;
  std::string name_;
  std::optional<peer_identity> who_;
  network::token_bucket allowance_{0, 0};
  std::size_t links_ = 0;
  bool is_closed_ = false;
};

proton::connection_options broker::loop::on_accept(proton::listener&) {
  auto made = std::make_unique<peer>(*this);
  auto& one = *made;
  peers_.emplace(&one, std::move(made));
  connections_ = peers_.size();
  proton::connection_options how;
  how.handler(one)
      .idle_timeout(proton::duration{idle_limit.count()})
      .sasl_allow_insecure_mechs(true)
      .sasl_allowed_mechs("ANONYMOUS EXTERNAL");
  return how;
}

void broker::loop::leave(peer& who) {
  // Not within one of its own functions.
  container_.schedule(proton::duration{0}, [this, &who] {
    peers_.erase(&who);
    connections_ = peers_.size();
  });
}

void broker::loop::pass_on(const std::string& address, proton::message&& m,
                           const properties& all, std::size_t size) {
  std::shared_ptr<const passed_on> one;
  const auto [first, last] = subscribers_.equal_range(address);
  for (auto at = first; at != last; ++at) {
    if (!at->second->wanted.matches(all))
      continue;
    if (!one) {
      const std::chrono::milliseconds told{m.ttl().milliseconds()};
      const auto ttl =
          told.count() > 0 ? std::min(told, longest_ttl) : usual_ttl;
      one = std::make_shared<const passed_on>(
          passed_on{std::move(m), size, deadline_clock::now() + ttl});
    }
    enqueue(at->second, one);
  }
}

void broker::loop::enqueue(const std::shared_ptr<subscriber>& to,
                           const std::shared_ptr<const passed_on>& one) {
  while (!to->waiting.empty()
         && (to->waiting.size() >= options_.longest_queue
             || to->waiting_octets + one->size > most_waiting
             || waiting_octets_ + one->size > most_waiting_in_all))
    drop_oldest(*to);
  to->waiting.push_back(one);
  to->waiting_octets += one->size;
  waiting_octets_ += one->size;
  if (std::exchange(to->is_woken, true))
    return;
  to->to.work_queue().add([this, to] {
    to->is_woken = false;
    send_waiting(*to);
  });
}

void broker::loop::drop_oldest(subscriber& of) {
  const auto size = of.waiting.front()->size;
  of.waiting_octets -= size;
  waiting_octets_ -= size;
  of.waiting.pop_front();
  ++overflowed_;
}

void broker::loop::send_waiting(subscriber& to) {
  const auto now = deadline_clock::now();
  while (!to.waiting.empty()) {
    const auto& one = *to.waiting.front();
    const auto is_old = one.expires < now;
    if (!is_old && to.to.credit() <= 0)
      return; // on_sendable comes
    if (is_old)
      ++expired_;
    else
      to.to.send(one.what);
    sent_ += is_old ? 0 : 1;
    to.waiting_octets -= one.size;
    waiting_octets_ -= one.size;
    to.waiting.pop_front();
  }
}

bool is_built_in() {
  return true;
}

broker::broker(broker_options options)
    : loop_{std::make_unique<loop>(std::move(options))} {}

broker::~broker() = default;

std::uint16_t broker::port() const {
  return loop_->port();
}

broker_counts broker::counts() const {
  return loop_->counts();
}

} // namespace sofof::network::amqp
