// Who receives what a broker is sent, and what waits for them.
#pragma once

#include "network/amqp/broker.hpp"
#include "network/amqp/message.hpp"
#include "network/amqp/selector.hpp"
#include "network/deadline.hpp"

#include <atomic>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <proton/message.hpp>
#include <proton/sender.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::network::amqp {

/// A message that waits for some receivers.
struct passed_on {
  proton::message what;
  std::size_t size = 0; ///< Octets, about.
  deadline expires;
};

/// A receiver: one link of a connection.
struct subscriber {
  proton::sender to;
  selector wanted;
  std::deque<std::shared_ptr<const passed_on>> waiting{};
  std::size_t waiting_octets = 0;
};

/// Queues of all receivers, and what was counted. Of the broker's thread, but
/// for the counts.
class exchange {
public:
  explicit exchange(std::size_t longest_queue)
      : longest_queue_{longest_queue} {}

  void add(const std::string& address, std::shared_ptr<subscriber> one) {
    subscribers_.emplace(address, std::move(one));
  }
  void remove(const std::shared_ptr<subscriber>& one);

  /// Puts a message into the queues of those that want it.
  /// @param all  Its properties.
  void pass_on(const std::string& address, proton::message&& m,
               const properties& all, std::size_t body);

  /// Sends what waits for a receiver, as far as it has credit and its
  /// connection takes it.
  void send_waiting(subscriber& to);

  struct {
    std::atomic<std::uint64_t> received = 0, sent = 0, expired = 0,
                               overflowed = 0, refused = 0;
  } counts;

private:
  void enqueue(subscriber& to, const std::shared_ptr<const passed_on>& one);
  void drop_oldest(subscriber& of);

  std::size_t longest_queue_;
  std::multimap<std::string, std::shared_ptr<subscriber>> subscribers_;
  std::size_t waiting_octets_ = 0; // in all queues
};

} // namespace sofof::network::amqp
