// What became of octets: they arrive, are lost, or are still under way.
#include "channel/octet_ledger.hpp"

#include <algorithm>
#include <cassert>

namespace sofof::channel {

octet_count& octet_count::operator+=(const octet_count& x) {
  messages += x.messages;
  octets += x.octets;
  return *this;
}

octet_fates& octet_fates::operator+=(const octet_fates& x) {
  sent += x.sent;
  delivered += x.delivered;
  lost += x.lost;
  under_way += x.under_way;
  return *this;
}

octet_fates octet_line::together() const {
  octet_fates sum;
  for (const auto& x : rows.sums())
    sum += x;
  return sum;
}

void disturbed_count::add(disturbance by) {
  lost += by == disturbance::loss;
  outage += by == disturbance::outage;
  stall += by == disturbance::stall;
  slow += by == disturbance::slow;
}

disturbed_count& disturbed_count::operator+=(const disturbed_count& x) {
  lost += x.lost;
  outage += x.outage;
  stall += x.stall;
  slow += x.slow;
  copied += x.copied;
  overtaken += x.overtaken;
  return *this;
}

disturbance disturbed_count::most() const {
  const auto largest = std::max({lost, outage, stall, slow});
  if (largest == 0)
    return disturbance::none;
  return largest == outage  ? disturbance::outage
         : largest == stall ? disturbance::stall
         : largest == lost  ? disturbance::loss
                            : disturbance::slow;
}

void octet_ledger::send(const sending& x, time_point arrives) {
  assert(arrives >= x.at);
  const std::lock_guard lock{mutex_};
  deliver(x.at);
  auto& line = line_of(x.what);
  count(x, line);
  under_way_.push({arrives, static_cast<std::size_t>(&line - lines_.data()),
                   x.at - start_, x.octets});
}

void octet_ledger::lose(const sending& x) {
  const std::lock_guard lock{mutex_};
  count(x, line_of(x.what)).lost.add(x.octets);
}

std::vector<octet_line> octet_ledger::read(time_point now) {
  const std::lock_guard lock{mutex_};
  deliver(now);
  auto lines = lines_;
  auto row = length_of_rows(now - start_);
  for (const auto& line : lines)
    row = std::max(row, line.rows.length());
  for (auto& line : lines)
    line.rows.join_to(row);
  for (auto left = under_way_; !left.empty(); left.pop()) {
    const auto& x = left.top();
    lines[x.line].rows.at(x.sent).under_way.add(x.octets);
  }
  return lines;
}

std::vector<disturbed_line> octet_ledger::take_disturbed(time_point before) {
  const std::lock_guard lock{mutex_};
  std::vector<disturbed_line> lines;
  auto next = disturbed_.begin();
  for (; next != disturbed_.end() && start_ + next->first.first < before;
       ++next) {
    const auto& [at, of] = next->first;
    lines.push_back({at, of.first, of.second, next->second});
  }
  disturbed_.erase(disturbed_.begin(), next);
  return lines;
}

octet_line& octet_ledger::line_of(std::string_view what) {
  const auto found = std::ranges::find(lines_, what, &octet_line::what);
  return found != lines_.end()
             ? *found
             : lines_.emplace_back(octet_line{std::string{what}, {}});
}

octet_fates& octet_ledger::count(const sending& x, octet_line& line) {
  assert(x.at >= start_);
  if (x.is_disturbed()) {
    auto& of = disturbed_[{x.at - start_, {x.station, std::string{x.what}}}];
    of.add(x.by);
    of.copied += x.is_copy;
    of.overtaken += x.is_overtaken;
  }
  auto& fates = line.rows.at(x.at - start_);
  fates.sent.add(x.octets);
  return fates;
}

void octet_ledger::deliver(time_point now) {
  for (; !under_way_.empty() && under_way_.top().at <= now; under_way_.pop()) {
    const auto& x = under_way_.top();
    lines_[x.line].rows.at(x.sent).delivered.add(x.octets);
  }
}

} // namespace sofof::channel
