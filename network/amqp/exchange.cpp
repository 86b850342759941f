// One queue for each receiver.
#include "network/amqp/exchange.hpp"

#include <algorithm>
#include <chrono>
#include <proton/duration.hpp>
#include <proton/session.hpp>
#include <utility>

namespace sofof::network::amqp {

namespace {

constexpr std::chrono::milliseconds longest_ttl{5000}, usual_ttl{1000};
/// Octets of a message besides its body, about.
constexpr std::size_t usual_head = 256;
/// Octets that wait for one receiver; for all, but for a little for each; and
/// in a connection that does not take them.
constexpr std::size_t most_waiting = std::size_t{2} << 20;
constexpr std::size_t most_waiting_in_all = std::size_t{64} << 20;
constexpr std::size_t always_possible = std::size_t{64} << 10;
constexpr std::size_t most_outgoing = std::size_t{256} << 10;

} // namespace

void exchange::remove(const std::shared_ptr<subscriber>& one) {
  std::erase_if(subscribers_, [&](const auto& x) { return x.second == one; });
  waiting_octets_ -= one->waiting_octets;
  one->waiting_octets = 0;
  one->waiting.clear();
}

void exchange::pass_on(const std::string& address, proton::message&& m,
                       const properties& all, std::size_t body) {
  std::vector<std::shared_ptr<subscriber>> wanting;
  const auto [first, last] = subscribers_.equal_range(address);
  for (auto at = first; at != last; ++at)
    if (at->second->wanted.matches(all))
      wanting.push_back(at->second);
  if (wanting.empty())
    return;
  const std::chrono::milliseconds told{m.ttl().milliseconds()};
  const auto ttl = told.count() > 0 ? std::min(told, longest_ttl) : usual_ttl;
  const auto one = std::make_shared<const passed_on>(
      passed_on{std::move(m), body + usual_head, deadline_clock::now() + ttl});
  for (const auto& to : wanting) {
    enqueue(*to, one);
    send_waiting(*to);
  }
}

void exchange::enqueue(subscriber& to,
                       const std::shared_ptr<const passed_on>& one) {
  const auto is_too_much = [&] {
    const auto octets = to.waiting_octets + one->size;
    return to.waiting.size() >= longest_queue_ || octets > most_waiting
           || (octets > always_possible
               && waiting_octets_ + one->size > most_waiting_in_all);
  };
  while (!to.waiting.empty() && is_too_much())
    drop_oldest(to);
  to.waiting.push_back(one);
  to.waiting_octets += one->size;
  waiting_octets_ += one->size;
}

void exchange::drop_oldest(subscriber& of) {
  const auto size = of.waiting.front()->size;
  of.waiting_octets -= size;
  waiting_octets_ -= size;
  of.waiting.pop_front();
  ++counts.overflowed;
}

void exchange::send_waiting(subscriber& to) {
  const auto now = deadline_clock::now();
  while (!to.waiting.empty()) {
    const auto& one = *to.waiting.front();
    const auto is_old = one.expires < now;
    if (!is_old
        && (to.to.credit() <= 0
            || to.to.session().outgoing_bytes() > most_outgoing))
      return; // it goes when there is room
    if (is_old)
      ++counts.expired;
    else
      to.to.send(one.what);
    counts.sent += is_old ? 0 : 1;
    to.waiting_octets -= one.size;
    waiting_octets_ -= one.size;
    to.waiting.pop_front();
  }
}

} // namespace sofof::network::amqp
