// Tunnels are served in turns, as epoll says that there is something to do.
#include "network/tls/tunnel_loop.hpp"

#include "network/block_signals.hpp"
#include "network/network_error.hpp"

#include <algorithm>
#include <array>
#include <sys/epoll.h>
#include <utility>

namespace sofof::network {

namespace {

/// The event of `wake_`; tunnels count from 1.
constexpr std::uint64_t woken = 0;

bool watch_fd(const descriptor& epoll, int how, int fd, std::uint64_t number,
              std::uint32_t events) {
  epoll_event event{};
  event.events = events;
  event.data.u64 = number;
  return epoll_ctl(epoll.get(), how, fd, &event) == 0;
}

} // namespace

tunnel_loop::tunnel_loop(std::chrono::milliseconds idle)
    : idle_{idle}, epoll_{epoll_create1(EPOLL_CLOEXEC)} {
  if (!epoll_ || !watch_fd(epoll_, EPOLL_CTL_ADD, wake_.fd(), woken, EPOLLIN))
    throw network_error{"no more files can be opened: raise `ulimit -n`"};
  thread_ = std::thread{[this] { run(); }};
}

tunnel_loop::~tunnel_loop() {
  stops_ = true;
  wake_.call();
  thread_.join();
  drop_all();
  for (auto& tunnel : new_ones_)
    tunnel.end(tunnel_end::cause::stopped);
}

void tunnel_loop::carry(tls_tunnel tunnel) {
  {
    const std::lock_guard lock{mutex_};
    new_ones_.push_back(std::move(tunnel));
  }
  wake_.call();
}

void tunnel_loop::drop() {
  drops_ = true;
  wake_.call();
}

void tunnel_loop::revoke(revocation_list revoked) {
  {
    const std::lock_guard lock{mutex_};
    new_list_ = std::move(revoked);
  }
  wake_.call();
}

void tunnel_loop::run() {
  leave_signals_to_others();
  using std::chrono::milliseconds;
  // Tunnels are found idle at most a tenth late.
  const auto look_around =
      std::clamp(idle_ / 10, milliseconds{1}, milliseconds{200});
  auto next_look = deadline_clock::now();
  while (!stops_) {
    wait_for_events(ready_.empty()
                        ? milliseconds_until(next_look, deadline_clock::now())
                        : 0);
    const auto now = deadline_clock::now();
    take_new_ones(now);
    if (drops_.exchange(false))
      drop_all();
    serve_ready_ones(now);
    if (now >= next_look) {
      close_idle_ones(now);
      close_distrusted_ones();
      next_look = now + look_around;
    }
  }
}

void tunnel_loop::take_new_ones(deadline now) {
  std::vector<tls_tunnel> arrived;
  std::optional<revocation_list> list;
  {
    const std::lock_guard lock{mutex_};
    arrived.swap(new_ones_);
    list.swap(new_list_);
  }
  if (list) {
    revoked_ = std::move(*list);
    close_distrusted_ones();
  }
  for (auto& tunnel : arrived) {
    // Its handshake may have been older than the list.
    if (auto why = tunnel.distrust(revoked_); !why.empty()) {
      tunnel.end_distrusted(std::move(why));
      continue;
    }
    ready_.push_back(++last_number_);
    entries_.emplace(last_number_, entry{std::move(tunnel), now});
  }
}

void tunnel_loop::drop_all() {
  for (auto& [number, entry] : entries_)
    entry.tunnel.end(tunnel_end::cause::stopped);
  entries_.clear();
  ready_.clear();
}

void tunnel_loop::wait_for_events(int timeout_ms) {
  std::array<epoll_event, 64> events{};
  const auto count =
      epoll_wait(epoll_.get(), events.data(), events.size(), timeout_ms);
  for (int i = 0; i < count; ++i) {
    const auto number = events[static_cast<std::size_t>(i)].data.u64;
    if (number == woken)
      wake_.answer();
    else
      make_ready(number);
  }
}

void tunnel_loop::make_ready(entry_number number) {
  // A child that was just forked may still hold the sockets of one that ended.
  const auto found = entries_.find(number);
  if (found == entries_.end() || std::exchange(found->second.is_ready, true))
    return;
  ready_.push_back(number);
}

void tunnel_loop::serve_ready_ones(deadline now) {
  for (const auto number : std::exchange(ready_, {})) {
    const auto found = entries_.find(number);
    if (found == entries_.end())
      continue; // it was distrusted meanwhile
    auto& entry = found->second;
    auto& tunnel = entry.tunnel;
    const auto turn = tunnel.move();
    if (turn.ended) {
      tunnel.end(tunnel.who_closed());
      entries_.erase(found);
      continue;
    }
    entry.is_ready = turn.more;
    if (turn.moved)
      entry.last_moved = now;
    if (turn.more) {
      ready_.push_back(number);
    } else {
      watch(tunnel.far_fd(), number, entry.far_events, tunnel.far_events());
      watch(tunnel.near_fd(), number, entry.near_events, tunnel.near_events());
    }
  }
}

void tunnel_loop::watch(int fd, entry_number number, std::uint32_t& watched,
                        std::uint32_t wanted) {
  if (watched == wanted)
    return;
  // What waits for nothing is not watched: epoll tells of errors unasked, again
  // and again.
  const auto how = watched == 0  ? EPOLL_CTL_ADD
                   : wanted == 0 ? EPOLL_CTL_DEL
                                 : EPOLL_CTL_MOD;
  watch_fd(epoll_, how, fd, number, wanted);
  watched = wanted;
}

void tunnel_loop::close_distrusted_ones() {
  for (auto at = entries_.begin(); at != entries_.end();) {
    auto& tunnel = at->second.tunnel;
    auto why = tunnel.distrust(revoked_);
    if (why.empty()) {
      ++at;
      continue;
    }
    tunnel.end_distrusted(std::move(why));
    at = entries_.erase(at);
  }
}

void tunnel_loop::close_idle_ones(deadline now) {
  for (auto at = entries_.begin(); at != entries_.end();) {
    auto& entry = at->second;
    if (entry.is_ready || now - entry.last_moved < idle_) {
      ++at;
      continue;
    }
    entry.tunnel.end(tunnel_end::cause::idle);
    at = entries_.erase(at);
  }
}

} // namespace sofof::network
