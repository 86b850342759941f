// One socket, which never blocks, and a thread that waits for it.
#include "network/udp/datagrams.hpp"

#include "network/block_signals.hpp"
#include "network/deadline.hpp"
#include "network/flow/token_bucket.hpp"
#include "network/network_error.hpp"
#include "network/socket.hpp"

#include <fmt/format.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <netinet/in.h>
#include <poll.h>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace sofof::network {

namespace {

const sockaddr* as_sockaddr(const socket_address& x) {
  return reinterpret_cast<const sockaddr*>(&x.storage);
}

socket_address resolved(const network_address& address) {
  const auto all = resolve(address);
  if (all.empty())
    throw network_error{
        fmt::format("{} has no address; is the name right?", address.host)};
  return all.front();
}

bool is_multicast(const socket_address& x) {
  if (x.storage.ss_family == AF_INET6)
    return IN6_IS_ADDR_MULTICAST(
        &reinterpret_cast<const sockaddr_in6*>(&x.storage)->sin6_addr);
  return IN_MULTICAST(
      ntohl(reinterpret_cast<const sockaddr_in*>(&x.storage)->sin_addr.s_addr));
}

descriptor socket_for(const network_address& to, const socket_address& there,
                      const std::optional<network_address>& from) {
  if (to.port == 0)
    throw network_error{
        fmt::format("no datagrams can go to {}: 0 is no port of "
                    "a program that waits for them",
                    print_address(to))};
  const auto refuse = [&](const network_address& where, std::string_view why) {
    throw network_error{fmt::format(
        "no datagrams can come at {}: {}; choose another port or address",
        print_address(where), why)};
  };
  descriptor own{::socket(there.storage.ss_family,
                          SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)};
  if (!own)
    refuse(to, std::generic_category().message(errno));
  if (!from)
    return own;
  const auto here = resolved(*from);
  if (is_multicast(here))
    refuse(*from, "it is a group, and groups are not joined");
  if (here.storage.ss_family != there.storage.ss_family)
    refuse(*from, fmt::format("{} is of another family; give both as IPv4 or "
                              "both as IPv6",
                              print_address(to)));
  if (bind(own.get(), as_sockaddr(here), here.size) != 0)
    refuse(*from, std::generic_category().message(errno));
  return own;
}

} // namespace

class datagrams::state {
public:
  state(const network_address& to, const std::optional<network_address>& from,
        std::size_t longest,
        std::function<void(std::span<const std::byte>)> hear)
      : there_{resolved(to)}, from_{from}, socket_{socket_for(to, there_,
                                                              from)},
        buffer_(longest + 1), hear_{std::move(hear)}, thread_{[this] {
          leave_signals_to_others();
          run();
        }} {}
  ~state() {
    ends_.call();
    thread_.join();
  }
  state(const state&) = delete;
  state& operator=(const state&) = delete;

  void send(std::span<const std::byte> datagram) {
    // What there is no room for now is late anyway.
    sendto(socket_.get(), datagram.data(), datagram.size(), MSG_NOSIGNAL,
           as_sockaddr(there_), there_.size);
  }

  network_address address() const {
    return {from_ ? from_->host : "0.0.0.0", port_of(socket_)};
  }

private:
  void run() {
    for (;;) {
      std::array<pollfd, 2> all{
          {{socket_.get(), POLLIN, 0}, {ends_.fd(), POLLIN, 0}}};
      if (poll(all.data(), all.size(), -1) < 0 && errno != EINTR)
        return;
      if (all[1].revents != 0)
        return;
      if (all[0].revents != 0)
        take_one();
    }
  }

  void take_one() {
    const auto size = recv(socket_.get(), buffer_.data(), buffer_.size(), 0);
    // An error is that nobody was there for what was sent before.
    if (size <= 0 || static_cast<std::size_t>(size) == buffer_.size())
      return;
    const time_point now{deadline_clock::now().time_since_epoch()};
    if (allowed_.try_spend(now))
      hear_({buffer_.data(), static_cast<std::size_t>(size)});
  }

  const socket_address there_;
  const std::optional<network_address> from_;
  const descriptor socket_;
  wake_up ends_;
  // Of the thread:
  std::vector<std::byte> buffer_;
  token_bucket allowed_{most_per_second, most_per_second};
  const std::function<void(std::span<const std::byte>)> hear_;
  std::thread thread_;
};

datagrams::datagrams(const network_address& to,
                     const std::optional<network_address>& from,
                     std::size_t longest,
                     std::function<void(std::span<const std::byte>)> hear)
    : state_{std::make_unique<state>(to, from, longest, std::move(hear))} {}
datagrams::~datagrams() = default;

void datagrams::send(std::span<const std::byte> datagram) {
  state_->send(datagram);
}

network_address datagrams::address() const {
  return state_->address();
}

} // namespace sofof::network
