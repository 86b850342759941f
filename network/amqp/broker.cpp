// One thread polls the sockets of all connections.
#include "network/amqp/broker.hpp"

#include "network/amqp/broker_peer.hpp"
#include "network/amqp/exchange.hpp"
#include "network/amqp/is_built_in.hpp"
#include "network/block_signals.hpp"
#include "network/flow/sampled_log.hpp"
#include "network/socket.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <arpa/inet.h>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <map>
#include <memory>
#include <netinet/in.h>
#include <poll.h>
#include <thread>
#include <utility>
#include <vector>

namespace sofof::network::amqp {

namespace {

/// New connections per turn; then it is the turn of those that there are.
constexpr int most_new_ones = 16;
/// Heartbeats are seen to so often, at least.
constexpr int longest_turn_ms = 500;
/// When the system has no more files.
constexpr int pause_without_files_ms = 100;

std::uint16_t port_of_peer(const socket_address& peer) {
  sockaddr_in at{};
  if (peer.storage.ss_family != AF_INET)
    return 0;
  std::copy_n(reinterpret_cast<const char*>(&peer.storage), sizeof at,
              reinterpret_cast<char*>(&at));
  return ntohs(at.sin_port);
}

} // namespace

class broker::loop {
public:
  explicit loop(broker_options options)
      : options_{std::move(options)}, exchange_{options_.longest_queue},
        listener_{listen_at({"127.0.0.1", options_.port})},
        port_{port_of(listener_)}, thread_{[this] { run(); }} {}

  ~loop() {
    ends_ = true;
    wake_.call();
    thread_.join();
  }
  loop(const loop&) = delete;
  loop& operator=(const loop&) = delete;

  std::uint16_t port() const { return port_; }

  broker_counts counts() const {
    const auto& all = exchange_.counts;
    return {all.received,   all.sent,    all.expired,
            all.overflowed, all.refused, connections_};
  }

private:
  void run() {
    leave_signals_to_others();
    while (!ends_) {
      wait();
      for (std::size_t i = 0; i < peers_.size(); ++i)
        if (polled_[2 + i].revents != 0)
          peers_[i]->read(polled_[2 + i].revents);
      // What came from one may be for all.
      const auto now = deadline_clock::now();
      for (const auto& peer : peers_)
        peer->write(now);
      std::erase_if(peers_, [](const auto& x) { return x->is_finished(); });
      accept_some();
      connections_ = peers_.size();
    }
    peers_.clear();
  }

  void wait() {
    polled_.clear();
    polled_.push_back({wake_.fd(), POLLIN, 0});
    const auto accepts = deadline_clock::now() >= accepts_again_;
    polled_.push_back(
        {listener_.get(), static_cast<short>(accepts ? POLLIN : 0), 0});
    for (const auto& peer : peers_)
      polled_.push_back({peer->fd(), peer->events(), 0});
    poll(polled_.data(), polled_.size(),
         accepts ? longest_turn_ms : pause_without_files_ms);
  }

  void accept_some() {
    for (int i = 0; i < most_new_ones; ++i) {
      auto found = accept_from(listener_);
      if (found.error != 0) {
        if (found.error != EAGAIN)
          accepts_again_ = deadline_clock::now()
                           + std::chrono::milliseconds{pause_without_files_ms};
        return;
      }
      std::optional<peer_identity> who;
      if (options_.identify)
        who = options_.identify(port_of_peer(found.peer));
      if (options_.identify && !who)
        refuse("a stranger", "connects, and nobody knows who it is");
      else if (peers_.size() >= options_.most_connections)
        refuse(who ? describe(*who) : "a stranger",
               "finds all connections taken");
      else
        peers_.push_back(std::make_unique<broker_peer>(
            std::move(found.socket), std::move(who), options_.stations,
            options_.most_links, exchange_,
            [this](const auto& name, auto why) { refuse(name, why); }));
    }
  }

  void refuse(const std::string& who, std::string_view what) {
    auto& log =
        refusals_.try_emplace(std::string{what}, std::chrono::seconds{1})
            .first->second;
    const time_point now{std::chrono::duration_cast<duration>(
        deadline_clock::now().time_since_epoch())};
    if (const auto line = log.add(fmt::format("{} {}", who, what), now);
        line && options_.on_refusal)
      options_.on_refusal(*line);
  }

  broker_options options_;
  exchange exchange_;
  descriptor listener_;
  std::uint16_t port_;
  wake_up wake_;
  // Of the thread:
  std::map<std::string, network::sampled_log> refusals_;
  std::vector<std::unique_ptr<broker_peer>> peers_;
  std::vector<pollfd> polled_; // wake, listener, peers
  deadline accepts_again_;
  // Anybody's:
  std::atomic<std::size_t> connections_ = 0;
  std::atomic<bool> ends_ = false;
  std::thread thread_;
};

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
