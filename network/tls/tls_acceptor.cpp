// Handshakes, one step at a time; then a tunnel_loop takes over.
#include "network/tls/tls_acceptor.hpp"

#include "network/block_signals.hpp"
#include "network/network_error.hpp"
#include "network/tls/connection_quota.hpp"
#include "network/tls/fair_share.hpp"
#include "network/tls/refusal_log.hpp"
#include "network/tls/tls.hpp"
#include "network/tls/tunnel_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <list>
#include <mutex>
#include <optional>
#include <poll.h>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace sofof::network {

namespace {

/// New connections per turn; then it is the turn of handshakes.
constexpr int most_new_ones = 16;

/// A pause when the system has no more files.
constexpr std::chrono::milliseconds pause_without_files{100};

const credentials& provider_only(const credentials& own) {
  if (!own.identity().is_provider())
    throw network_error{fmt::format(
        "the certificate names {}, but a provider needs one of a provider: "
        "`sofof keys issue --provider` makes it",
        describe(own.identity()))};
  return own;
}

} // namespace

class tls_acceptor::loop {
public:
  loop(const credentials& own, acceptor_options options)
      : options_{std::move(options)}, listener_{listen_at(options_.listen)},
        port_{port_of(listener_)}, quota_{options_.most_connections,
                                          options_.most_per_peer},
        context_{make_tls_context(provider_only(own), options_.service)},
        log_{options_.on_refusal}, tunnels_{options_.idle} {
    tunnels_.revoke(own.revoked());
    thread_ = std::thread{[this] { run(); }};
  }

  ~loop() {
    stops_ = true;
    wake_.call();
    thread_.join();
    for (const auto& peer : pending_)
      leave_quota(peer);
  }

  void renew(const credentials& own) {
    auto context = make_tls_context(provider_only(own), options_.service);
    {
      const std::lock_guard lock{mutex_};
      next_context_ = std::move(context);
    }
    wake_.call();
    tunnels_.revoke(own.revoked());
  }

  std::uint16_t port() const { return port_; }
  acceptor_counts counts() const {
    return {accepted_, refused_, quota_.open()};
  }

private:
  /// A connection that is not carried yet.
  struct pending_peer {
    std::string name; ///< Its address, later its identity, too.
    network_prefix network;
    deadline until;
    descriptor outer;
    tls_handshake handshake;
    short waits_for = POLLIN;
    std::string admitted; ///< Its identity, once the quota has let it in.
    descriptor inner; ///< The connection to the inner port, once it has begun.
    std::uint16_t inner_from = 0; ///< Its own port, if that is registered.
  };
  using peer_list = std::list<pending_peer>;

  void run() {
    leave_signals_to_others();
    while (!stops_) {
      const auto events = wait();
      now_ = deadline_clock::now();
      wake_.answer();
      take_messages();
      // In the same order as they were waited for.
      auto at = pending_.begin();
      for (std::size_t i = first_peer; i < events.size(); ++i) {
        const auto current = at++;
        if (events[i].revents != 0)
          advance(current);
        else if (now_ >= current->until)
          time_out(current);
      }
      if (events[1].revents != 0)
        accept_new_ones();
      log_.publish_rest(now_);
    }
  }

  /// @returns what happened: to `wake_`, the listener, and the pending peers.
  std::vector<pollfd> wait() {
    auto next = deadline::max();
    if (const auto told = log_.next())
      next = *told;
    const auto pauses = now_ < accepts_again_;
    if (pauses)
      next = std::min(next, accepts_again_);
    std::vector<pollfd> events{
        {wake_.fd(), POLLIN, 0},
        {listener_.get(), static_cast<short>(pauses ? 0 : POLLIN), 0}};
    for (const auto& peer : pending_) {
      const auto& socket = peer.inner ? peer.inner : peer.outer;
      events.push_back({socket.get(), peer.waits_for, 0});
      next = std::min(next, peer.until);
    }
    const auto timeout = next == deadline::max()
                             ? -1
                             : milliseconds_until(next, deadline_clock::now());
    if (poll(events.data(), events.size(), timeout) < 0)
      for (auto& event : events)
        event.revents = 0;
    return events;
  }

  /// What other threads have left here.
  void take_messages() {
    std::vector<std::string> distrusted;
    {
      const std::lock_guard lock{mutex_};
      distrusted.swap(distrusted_);
      if (next_context_)
        context_ = *std::exchange(next_context_, std::nullopt);
    }
    // Each of these: they were let in, and strangers must not hide them.
    if (options_.on_refusal)
      for (const auto& sentence : distrusted)
        options_.on_refusal(sentence);
  }

  void accept_new_ones() {
    for (int i = 0; i < most_new_ones; ++i) {
      auto [socket, peer, error] = accept_from(listener_);
      if (!socket) {
        if (error != EAGAIN && error != ECONNABORTED && error != EINTR)
          accepts_again_ = now_ + pause_without_files;
        return;
      }
      const auto name = print_address(peer);
      if (quota_.is_full()) {
        log_refusal(name, fmt::format("all {} connections are taken",
                                      options_.most_connections));
        continue;
      }
      if (pending_.size() >= options_.most_handshakes)
        make_room();
      give_up_after(socket, options_.idle);
      const auto fd = socket.get();
      try {
        pending_.push_back({name,
                            prefix_of(peer),
                            now_ + options_.handshake_timeout,
                            std::move(socket),
                            {context_, fd, tls_side::answerer},
                            POLLIN,
                            {},
                            {},
                            {}});
      } catch (const network_error& e) {
        log_refusal(name, e.what());
      }
    }
  }

  /// Refuses a handshake of a network that has the most of them.
  void make_room() {
    std::vector<peer_list::iterator> unfinished;
    std::vector<network_prefix> networks;
    for (auto at = pending_.begin(); at != pending_.end(); ++at)
      if (!at->inner) {
        unfinished.push_back(at);
        networks.push_back(at->network);
      }
    if (unfinished.empty())
      return;
    const auto draw = options_.draws.uniform(drawn_++);
    const auto victim = unfinished[choose_victim(networks, draw)];
    refuse(victim, fmt::format("{} handshakes of its network are unfinished",
                               std::ranges::count(networks, victim->network)));
  }

  void advance(peer_list::iterator at) {
    if (at->inner) {
      finish(at);
      return;
    }
    using step = tls_handshake::step;
    switch (at->handshake.advance()) {
      case step::waits_to_read:
        at->waits_for = POLLIN;
        return;
      case step::waits_to_write:
        at->waits_for = POLLOUT;
        return;
      case step::failed:
        refuse(at, at->handshake.failure());
        return;
      case step::done:
        let_in(at);
    }
  }

  /// Who it is is known: now to the inner port.
  void let_in(peer_list::iterator at) {
    auto who = describe(at->handshake.who());
    at->name += ", " + who + ",";
    if (const auto refusal = quota_.admit(who); !refusal.empty()) {
      refuse(at, refusal);
      return;
    }
    at->admitted = std::move(who);
    auto [inner, error] = start_connecting(
        loopback_port(options_.inner_port), [&](std::uint16_t port) {
          at->inner_from = port;
          if (options_.peers)
            options_.peers->add(port, at->handshake.who());
        });
    at->inner = std::move(inner);
    at->waits_for = POLLOUT;
    if (!at->inner)
      refuse_for_inner(at, error);
  }

  void finish(peer_list::iterator at) {
    if (const auto error = connection_error(at->inner); error != 0) {
      refuse_for_inner(at, error);
      return;
    }
    ++accepted_;
    tunnels_.carry({byte_stream{std::move(at->outer), at->handshake.release()},
                    byte_stream{std::move(at->inner)},
                    [this, who = at->admitted, name = at->name,
                     port = at->inner_from](const tunnel_end& end) {
                      forget_port(port);
                      quota_.release(who);
                      if (end.why == tunnel_end::cause::distrusted)
                        leave_message(name
                                      + " was disconnected: " + end.failure);
                    }});
    pending_.erase(at);
  }

  /// For the thread, by others.
  void leave_message(std::string sentence) {
    {
      const std::lock_guard lock{mutex_};
      distrusted_.push_back(std::move(sentence));
    }
    wake_.call();
  }

  void time_out(peer_list::iterator at) {
    if (at->inner)
      refuse_for_inner(at, ETIMEDOUT);
    else
      refuse(at, "it did not finish the TLS handshake in time");
  }

  void refuse_for_inner(peer_list::iterator at, int error) {
    refuse(at, "the provider itself cannot be reached: "
                   + std::generic_category().message(error));
  }

  void refuse(peer_list::iterator at, const std::string& why) {
    log_refusal(at->name, why);
    leave_quota(*at);
    pending_.erase(at);
  }

  void log_refusal(const std::string& name, const std::string& why) {
    ++refused_;
    log_.add(name + " was refused: " + why, now_);
  }

  void leave_quota(const pending_peer& peer) {
    forget_port(peer.inner_from);
    if (!peer.admitted.empty())
      quota_.release(peer.admitted);
  }

  void forget_port(std::uint16_t port) {
    if (options_.peers && port != 0)
      options_.peers->remove(port);
  }

  static constexpr std::size_t first_peer = 2;

  const acceptor_options options_;
  const descriptor listener_;
  const std::uint16_t port_;
  connection_quota quota_;
  std::atomic<std::uint64_t> accepted_ = 0;
  std::atomic<std::uint64_t> refused_ = 0;
  std::atomic<bool> stops_ = false;
  wake_up wake_;
  std::mutex mutex_;
  std::optional<tls_context> next_context_; // guarded by mutex_, as is
  std::vector<std::string> distrusted_;     // who was, and why

  // Of the thread:
  tls_context context_;
  refusal_log log_;
  peer_list pending_;
  std::uint64_t drawn_ = 0; // of the victims
  deadline now_ = deadline_clock::now();
  deadline accepts_again_ = now_;

  tunnel_loop tunnels_; // ends before what its tunnels refer to
  std::thread thread_;
};

tls_acceptor::tls_acceptor(const credentials& own, acceptor_options options)
    : loop_{std::make_unique<loop>(own, std::move(options))} {}

tls_acceptor::~tls_acceptor() = default;

void tls_acceptor::renew(const credentials& own) {
  loop_->renew(own);
}

std::uint16_t tls_acceptor::port() const {
  return loop_->port();
}

acceptor_counts tls_acceptor::counts() const {
  return loop_->counts();
}

} // namespace sofof::network
