// Connecting and shaking hands, one step at a time; then a tunnel_loop takes
// over.
#include "network/tls/tls_connector.hpp"

#include "network/block_signals.hpp"
#include "network/network_error.hpp"
#include "network/tls/tls.hpp"
#include "network/tls/tunnel_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <deque>
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

/// A pause when the system has no more files.
constexpr std::chrono::milliseconds breather{100};

std::optional<tls_context> context_for(const credentials* own,
                                       tls_service service) {
  if (!own)
    return std::nullopt;
  if (own->identity().is_provider() && service == tls_service::provider)
    throw network_error{fmt::format(
        "the certificate names {}, but vehicles need one of their stations: "
        "`sofof keys issue --station` makes it",
        describe(own->identity()))};
  return make_tls_context(*own, service);
}

std::string explain_connect_error(int error) {
  switch (error) {
    case ECONNREFUSED:
      return "nobody listens there";
    case EHOSTUNREACH:
    case ENETUNREACH:
      return "there is no route to it";
    case ETIMEDOUT:
      return "it does not answer";
    default:
      return std::generic_category().message(error);
  }
}

} // namespace

class tls_connector::loop {
public:
  loop(const credentials* own, connector_options options)
      : options_{std::move(options)}, listener_{listen_at({"127.0.0.1", 0})},
        port_{port_of(listener_)}, remote_{options_.remote},
        context_{context_for(own, options_.service)}, tunnels_{options_.idle} {
    if (own)
      tunnels_.revoke(own->revoked());
    thread_ = std::thread{[this] { run(); }};
  }

  ~loop() {
    stops_ = true;
    wake_->call();
    thread_.join();
  }

  void hang_up() {
    hangs_up_ = true;
    wake_->call();
  }

  void lead_to(network_address remote) {
    {
      const std::lock_guard lock{mutex_};
      next_remote_ = std::move(remote);
    }
    wake_->call();
  }

  void renew(const credentials& own) {
    auto context = context_for(&own, options_.service);
    {
      const std::lock_guard lock{mutex_};
      next_context_ = std::move(context);
    }
    wake_->call();
    tunnels_.revoke(own.revoked());
  }

  std::uint16_t port() const { return port_; }

  std::string last_error() const {
    const std::lock_guard lock{mutex_};
    return last_error_;
  }

private:
  /// A connection that is not carried yet.
  struct call {
    descriptor near;
    deadline until;
    /// Those that may answer; the first has its turn. None: they are looked up.
    std::optional<std::deque<socket_address>> addresses;
    deadline connected_by;
    descriptor far;
    std::optional<tls_handshake> handshake; ///< Once connected.
    short waits_for = POLLOUT;
  };
  using call_list = std::list<call>;

  void run() {
    leave_signals_to_others();
    while (!stops_) {
      const auto events = wait();
      now_ = deadline_clock::now();
      wake_->answer();
      take_news();
      // In the same order as they were waited for.
      auto at = calls_.begin();
      for (std::size_t i = first_call; i < events.size(); ++i) {
        const auto current = at++;
        if (events[i].revents != 0)
          advance(current);
        else if (now_ >= current->until)
          time_out(current);
      }
      if (hangs_up_.exchange(false)) {
        calls_.clear();
        tunnels_.drop();
      }
      if (events[1].revents != 0)
        accept_one();
      look_up();
    }
  }

  /// @returns what happened: to `wake_`, the listener, and the calls.
  std::vector<pollfd> wait() {
    auto next = deadline::max();
    const auto pauses = now_ < accepts_again_;
    if (pauses)
      next = accepts_again_;
    std::vector<pollfd> events{
        {wake_->fd(), POLLIN, 0},
        {listener_.get(), static_cast<short>(pauses ? 0 : POLLIN), 0}};
    for (const auto& call : calls_) {
      events.push_back({call.far.get(), call.waits_for, 0});
      next = std::min(next, call.until);
    }
    const auto timeout = next == deadline::max()
                             ? -1
                             : milliseconds_until(next, deadline_clock::now());
    if (poll(events.data(), events.size(), timeout) < 0)
      for (auto& event : events)
        event.revents = 0;
    return events;
  }

  void take_news() {
    const std::lock_guard lock{mutex_};
    if (next_context_)
      context_ = std::exchange(next_context_, std::nullopt);
    if (next_remote_ && *next_remote_ != remote_) {
      remote_ = *std::exchange(next_remote_, std::nullopt);
      lookup_.reset(); // whoever waits for it gets the new one's
    }
  }

  void accept_one() {
    auto accepted = accept_from(listener_);
    if (!accepted.socket) {
      if (accepted.error != EAGAIN && accepted.error != ECONNABORTED
          && accepted.error != EINTR)
        accepts_again_ = now_ + breather;
      return;
    }
    if (calls_.size() + carried_ >= options_.most_connections) {
      set_last_error(fmt::format("there are {} connections already",
                                 options_.most_connections));
      return;
    }
    calls_.push_back({std::move(accepted.socket),
                      now_ + options_.lookup_timeout,
                      {},
                      {},
                      {},
                      {},
                      POLLOUT});
  }

  /// Asks for the addresses, once for all who wait for them.
  void look_up() {
    if (!lookup_ && std::ranges::any_of(calls_, &is_nowhere))
      ask();
    auto found = lookup_ ? lookup_->answer() : std::nullopt;
    if (!found)
      return;
    lookup_.reset();
    for (auto at = calls_.begin(); at != calls_.end();)
      if (const auto current = at++; is_nowhere(*current)) {
        current->addresses.emplace(found->begin(), found->end());
        current->connected_by = now_ + options_.connect_timeout;
        if (found->empty())
          give_up(current, "nobody knows this host");
        else
          connect_first(current, 0);
      }
  }

  void ask() {
    try {
      lookup_.emplace(options_.resolver, remote_, wake_);
    } catch (const std::system_error& e) {
      set_last_error(e.what());
      std::erase_if(calls_, &is_nowhere);
    }
  }

  static bool is_nowhere(const call& x) { return !x.addresses; }

  /// Gives the first address its turn that can have one.
  /// @param error  Why the one before it did not do.
  void connect_first(call_list::iterator at, int error) {
    auto& all = *at->addresses;
    for (; !all.empty(); all.pop_front()) {
      auto started = start_connecting(all.front());
      at->far = std::move(started.socket);
      at->until = std::min(now_ + options_.turn, at->connected_by);
      if (at->far)
        return;
      error = started.error;
    }
    give_up(at, explain_connect_error(error));
  }

  void end_turn(call_list::iterator at) {
    if (now_ >= at->connected_by) {
      give_up(at, explain_connect_error(ETIMEDOUT));
      return;
    }
    at->addresses->push_back(at->addresses->front());
    at->addresses->pop_front();
    connect_first(at, ETIMEDOUT);
  }

  void time_out(call_list::iterator at) {
    if (is_nowhere(*at))
      give_up(at, "its name was not found in time; give an address, or look "
                  "after the name server");
    else if (at->handshake)
      give_up(at, "it did not finish the TLS handshake in time; is it a plain "
                  "port?");
    else
      end_turn(at);
  }

  void advance(call_list::iterator at) {
    if (at->handshake) {
      shake_hands(at);
      return;
    }
    if (const auto error = connection_error(at->far); error != 0) {
      at->addresses->pop_front();
      connect_first(at, error);
      return;
    }
    give_up_after(at->far, options_.idle);
    if (!context_) {
      put_through(at, {});
      return;
    }
    at->until = now_ + options_.handshake_timeout;
    try {
      at->handshake.emplace(*context_, at->far.get(), tls_side::opener);
    } catch (const network_error& e) {
      give_up(at, e.what());
      return;
    }
    shake_hands(at);
  }

  void shake_hands(call_list::iterator at) {
    using step = tls_handshake::step;
    switch (at->handshake->advance()) {
      case step::waits_to_read:
        at->waits_for = POLLIN;
        return;
      case step::waits_to_write:
        at->waits_for = POLLOUT;
        return;
      case step::failed:
        give_up(at, at->handshake->failure());
        return;
      case step::done:
        if (is_expected(at->handshake->who()))
          put_through(at, at->handshake->release());
        else
          give_up(at, fmt::format("its certificate is for {}, not for provider "
                                  "{}",
                                  describe(at->handshake->who()),
                                  options_.provider));
    }
  }

  bool is_expected(const peer_identity& who) const {
    return options_.provider.empty() || who.provider == options_.provider;
  }

  void put_through(call_list::iterator at, ssl_ptr tls) {
    set_last_error({});
    ++carried_;
    tunnels_.carry({byte_stream{std::move(at->far), std::move(tls)},
                    byte_stream{std::move(at->near)},
                    [this](const tunnel_end& end) {
                      explain(end);
                      --carried_;
                    }});
    calls_.erase(at);
  }

  void explain(const tunnel_end& end) {
    using cause = tunnel_end::cause;
    if (end.why == cause::distrusted)
      set_last_error(end.failure);
    if (end.why == cause::idle)
      set_last_error(
          fmt::format("nothing crossed for {} ms", options_.idle.count()));
    if (end.why != cause::far_closed)
      return;
    if (!end.failure.empty())
      set_last_error(end.failure);
    else
      set_last_error(end.bytes_inward == 0
                         ? "it closed the connection before it said anything"
                         : "it closed the connection");
  }

  void give_up(call_list::iterator at, const std::string& why) {
    set_last_error(why);
    calls_.erase(at);
  }

  void set_last_error(std::string sentence) {
    const std::lock_guard lock{mutex_};
    last_error_ = std::move(sentence);
  }

  static constexpr std::size_t first_call = 2;

  const connector_options options_;
  const descriptor listener_;
  const std::uint16_t port_;
  std::atomic<std::size_t> carried_ = 0;
  std::atomic<bool> stops_ = false;
  std::atomic<bool> hangs_up_ = false;
  const std::shared_ptr<wake_up> wake_ = std::make_shared<wake_up>();
  mutable std::mutex mutex_;
  std::string last_error_;                  // guarded by mutex_, as is
  std::optional<tls_context> next_context_; // and
  std::optional<network_address> next_remote_;

  // Of the thread:
  network_address remote_;
  std::optional<tls_context> context_; // none: plain
  call_list calls_;
  std::optional<name_lookup> lookup_;
  deadline now_ = deadline_clock::now();
  deadline accepts_again_ = now_;

  tunnel_loop tunnels_; // ends before what its tunnels refer to
  std::thread thread_;
};

tls_connector::tls_connector(const credentials* own, connector_options options)
    : loop_{std::make_unique<loop>(own, std::move(options))} {}

tls_connector::~tls_connector() = default;

void tls_connector::lead_to(network_address remote) {
  loop_->lead_to(std::move(remote));
}

void tls_connector::renew(const credentials& own) {
  loop_->renew(own);
}

void tls_connector::hang_up() {
  loop_->hang_up();
}

std::uint16_t tls_connector::port() const {
  return loop_->port();
}

std::string tls_connector::last_error() const {
  return loop_->last_error();
}

} // namespace sofof::network
