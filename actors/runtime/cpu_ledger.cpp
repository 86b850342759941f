// A ledger of computing time: which actors took how much of it, for what.
#include "actors/runtime/cpu_ledger.hpp"

namespace sofof::actors {

void cpu_ledger::charge(std::uint64_t actor, const cpu_account& to) {
  const std::lock_guard lock{mutex_};
  auto& of = open(actor);
  if (of.account == to)
    return;
  const auto now = clock_();
  settle(of, now, settled_);
  of = {to, of.name, now};
}

void cpu_ledger::add_turn(std::uint64_t actor, std::string_view name,
                          duration cpu) {
  const std::lock_guard lock{mutex_};
  auto& of = open(actor);
  of.name = name;
  of.cpu += cpu;
  ++of.wakes;
}

void cpu_ledger::close(std::uint64_t actor) {
  const std::lock_guard lock{mutex_};
  const auto found = holders_.find(actor);
  if (found == holders_.end())
    return;
  settle(found->second, clock_(), settled_);
  holders_.erase(found);
}

void cpu_ledger::restart() {
  const std::lock_guard lock{mutex_};
  settled_.clear();
  const auto now = clock_();
  for (auto& [actor, of] : holders_)
    of = {of.account, of.name, now};
}

std::vector<cpu_line> cpu_ledger::lines() const {
  const std::lock_guard lock{mutex_};
  auto all = settled_;
  const auto now = clock_();
  for (const auto& [actor, of] : holders_)
    settle(of, now, all);
  std::vector<cpu_line> lines;
  lines.reserve(all.size());
  for (const auto& [key, sum] : all)
    lines.push_back({key.first, key.second, sum.cpu, sum.time, sum.wakes});
  return lines;
}

cpu_ledger::holder& cpu_ledger::open(std::uint64_t actor) {
  const auto [at, is_new] = holders_.try_emplace(actor);
  if (is_new)
    at->second.since = clock_();
  return at->second;
}

// Who has not had a turn yet has no name, and took nothing.
void cpu_ledger::settle(const holder& of, time_point until, all_sums& into) {
  if (of.name.empty())
    return;
  auto& sum = into[{of.account, of.name}];
  sum.cpu += of.cpu;
  sum.time += until - of.since;
  sum.wakes += of.wakes;
}

} // namespace sofof::actors
