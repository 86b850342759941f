// What became of octets: they arrive, are lost, or are still under way.
#include "channel/octet_ledger.hpp"

#include <algorithm>
#include <cassert>

namespace sofof::channel {

void octet_ledger::send(std::string_view what, std::size_t octets,
                        time_point now, time_point arrives) {
  assert(arrives >= now);
  const std::lock_guard lock{mutex_};
  deliver(now);
  auto& line = line_of(what);
  line.sent.add(octets);
  under_way_.push(
      {arrives, static_cast<std::size_t>(&line - lines_.data()), octets});
}

void octet_ledger::lose(std::string_view what, std::size_t octets) {
  const std::lock_guard lock{mutex_};
  auto& line = line_of(what);
  line.sent.add(octets);
  line.lost.add(octets);
}

std::vector<octet_line> octet_ledger::read(time_point now) {
  const std::lock_guard lock{mutex_};
  deliver(now);
  auto lines = lines_;
  for (auto left = under_way_; !left.empty(); left.pop())
    lines[left.top().line].under_way.add(left.top().octets);
  return lines;
}

octet_line& octet_ledger::line_of(std::string_view what) {
  const auto found = std::ranges::find(lines_, what, &octet_line::what);
  return found != lines_.end() ? *found
                               : lines_.emplace_back(octet_line{
                                   std::string{what}, {}, {}, {}, {}});
}

void octet_ledger::deliver(time_point now) {
  for (; !under_way_.empty() && under_way_.top().at <= now; under_way_.pop()) {
    const auto& first = under_way_.top();
    lines_[first.line].delivered.add(first.octets);
  }
}

} // namespace sofof::channel
