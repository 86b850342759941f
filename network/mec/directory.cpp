// Where a registry says that providers are.
#include "network/mec/directory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace sofof::network::mec011 {

namespace {

using namespace std::chrono_literals;

/// A registry that answers is asked so often, ...
constexpr duration asks_again = 5s;
/// ... and by who has lost a provider.
constexpr duration asks_in_a_hurry = 500ms;
constexpr std::uint64_t urgent_steps = 6; // this often

/// A provider has so many addresses at most, of all its entries.
constexpr std::size_t most_known = 8;

bool is_this_machine(std::string_view host) {
  return host == "localhost" || host == "::1" || host.starts_with("127.");
}

exponential_backoff pauses_of_silence() {
  exponential_backoff pauses{asks_in_a_hurry, asks_again};
  (void)pauses.next_wait(0); // there is one after the first attempt, too
  return pauses;
}

} // namespace

directory::directory(registry at, directory_rules rules, random_stream draws,
                     std::function<void(const registry_news&)> publish)
    : at_{std::move(at)}, rules_{std::move(rules)}, draws_{draws},
      publish_{std::move(publish)}, pauses_{pauses_of_silence()} {}

pause_between directory::step() {
  const auto draw = draws_.uniform(steps_); // which nobody else changes
  pause_between next{};
  std::optional<registry_news> news;
  std::optional<address_book> fresh;
  try {
    std::string left_out;
    fresh = read(at_.providers(), left_out);
    pauses_ = pauses_of_silence();
    constexpr double spread = 0.2; // vehicles do not ask all at once
    next = {from_seconds(to_seconds(asks_again) * (1 - spread * draw)),
            asks_in_a_hurry};
    news = {left_out.empty(), describe(*fresh)};
    if (!left_out.empty())
      news->sentence += "; left out: " + left_out;
  } catch (const network_error& problem) {
    const auto pause = pauses_.next_wait(draw);
    next = {pause, pause};
    news = {false,
            fmt::format("the registry {} tells nothing: {}; what it told "
                        "before counts",
                        print_root(at_.root()), problem.what())};
  }
  {
    const std::lock_guard lock{mutex_};
    ++steps_;
    if (fresh) {
      for (auto& [provider, x] : attempts_)
        if (places_in(book_, provider) != places_in(*fresh, provider))
          x.missed_from = steps_;
      book_ = std::move(*fresh);
    }
  }
  answered_.notify_all();
  publish(*news);
  return next;
}

void directory::await_first(std::chrono::milliseconds patience) {
  std::unique_lock lock{mutex_};
  answered_.wait_for(lock, patience, [this] { return steps_ > 0; });
}

next_attempt directory::next(const std::string& provider) {
  const std::lock_guard lock{mutex_};
  auto& x = attempts_[provider];
  if (steps_ > x.missed_at + 1) // there was a connection meanwhile
    x.missed_from = steps_;
  x.missed_at = steps_;
  next_attempt next{std::nullopt, steps_ - x.missed_from < urgent_steps};
  if (const auto all = places_in(book_, provider); !all.empty()) {
    next.at = all[x.turn++ % all.size()];
    x.last = *next.at;
  }
  return next;
}

std::string directory::place_of(const std::string& provider) const {
  const std::lock_guard lock{mutex_};
  const auto tried = attempts_.find(provider);
  return tried == attempts_.end() || tried->second.turn == 0
             ? "an address of " + print_root(at_.root())
             : print_address(tried->second.last);
}

directory::addresses directory::places_in(const address_book& book,
                                          const std::string& provider) {
  const auto known = book.find(provider);
  return known == book.end() ? addresses{} : known->second;
}

/// @param left_out  Gets why an entry or an address is, if one is.
directory::address_book directory::read(const service_list& from,
                                        std::string& left_out) const {
  left_out = from.why_not_all;
  const auto leave_out = [&](const service_info& entry, std::string why) {
    if (left_out.empty())
      left_out = fmt::format("provider {}: {}", entry.provider, why);
  };
  address_book book;
  for (const auto& entry : from.services) {
    if (!entry.is_active || !rules_.providers.contains(entry.provider))
      continue;
    if (auto why = why_not(entry); !why.empty()) {
      leave_out(entry, std::move(why));
      continue;
    }
    for (const auto& at : entry.addresses) {
      if (auto why = why_not(at); !why.empty()) {
        leave_out(entry, std::move(why));
        continue;
      }
      auto& known = book[entry.provider];
      if (known.size() == most_known)
        leave_out(entry,
                  fmt::format("it has more than {} addresses", most_known));
      else if (std::ranges::find(known, at) == known.end())
        known.push_back(at);
    }
  }
  return book;
}

std::string directory::why_not(const service_info& entry) const {
  if (entry.version != rules_.version)
    return fmt::format("it speaks version {} of the protocol, not {}",
                       entry.version, rules_.version);
  if (entry.is_secured != rules_.is_secured)
    return rules_.is_secured ? "it has no --keys, and we have"
                             : "it has --keys, and we have none";
  return {};
}

std::string directory::why_not(const network_address& at) const {
  if (!rules_.is_secured && !is_this_machine(at.host))
    return fmt::format("{} is another machine, and connections there need "
                       "--keys",
                       print_address(at));
  if (is_this_machine(at.host) && !is_this_machine(at_.root().at.host))
    return fmt::format("{} is this machine, of which a registry elsewhere "
                       "knows nothing",
                       print_address(at));
  return {};
}

std::string directory::describe(const address_book& all) const {
  std::string text;
  for (const auto& [provider, places] : all) {
    text +=
        fmt::format("{}provider {} at ", text.empty() ? "" : ", ", provider);
    for (const auto& at : places)
      text += (&at == &places.front() ? "" : " or ") + print_address(at);
  }
  return fmt::format("the registry {} lists {}", print_root(at_.root()),
                     text.empty() ? "no provider of the scenario" : text);
}

void directory::publish(const registry_news& news) {
  if (news.sentence == last_told_)
    return;
  last_told_ = news.sentence;
  publish_(news);
}

} // namespace sofof::network::mec011
