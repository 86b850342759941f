// Keeps a provider in a registry.
#include "network/mec/registration.hpp"

#include <fmt/format.h>

#include <utility>

namespace sofof::network::mec011 {

namespace {

using namespace std::chrono_literals;

/// An entry is looked after so often.
constexpr duration looks_after = 5s;
/// A registry that does not answer is asked again with pauses from ... to.
constexpr duration first_pause = 500ms;
constexpr duration longest_pause = 10s;

} // namespace

registration::registration(registry at, std::string application,
                           service_info own, random_stream draws,
                           std::function<void(const registry_news&)> publish)
    : at_{std::move(at)},
      application_{std::move(application)}, own_{std::move(own)}, draws_{draws},
      publish_{std::move(publish)}, pauses_{first_pause, longest_pause} {
  own_.id.clear();
  (void)pauses_.next_wait(0); // there is one after the first attempt, too
}

duration registration::step() {
  try {
    keep();
    pauses_ = exponential_backoff{first_pause, longest_pause};
    (void)pauses_.next_wait(0);
    return looks_after;
  } catch (const network_error& problem) {
    publish(
        {false, fmt::format("the registry {} does not keep {}: {}; trying "
                            "again",
                            print_root(at_.root()), name(), problem.what())});
    return pauses_.next_wait(draws_.uniform(++steps_));
  }
}

void registration::keep() {
  const auto was_known = !own_.id.empty();
  if (was_known && !at_.find(application_, own_.id)) {
    own_.id.clear(); // it has started again, say
    is_confirmed_ = false;
  }
  if (own_.id.empty())
    add();
  if (!is_confirmed_) {
    at_.confirm_ready(application_);
    is_confirmed_ = true;
  }
  publish({true, fmt::format("{} is in the registry {} as service {}", name(),
                             print_root(at_.root()), own_.id)});
}

// What a process of the same provider has left there leads nowhere.
void registration::add() {
  for (const auto& x : at_.providers_of(application_).services)
    if (x.provider == own_.provider)
      at_.remove(application_, x.id);
  own_.id = at_.add(application_, own_);
}

// A registry that does not change what it lists may remove it.
void registration::end() {
  if (own_.id.empty())
    return;
  own_.is_active = false;
  try {
    try {
      at_.update(application_, own_);
    } catch (const registry_refusal&) {
      at_.remove(application_, own_.id);
    }
    publish({true, fmt::format("{} is no longer ACTIVE in the registry {}",
                               name(), print_root(at_.root()))});
  } catch (const network_error& problem) {
    publish(
        {false, fmt::format("the registry {} may still list {} as ACTIVE: {}",
                            print_root(at_.root()), name(), problem.what())});
  }
}

void registration::publish(const registry_news& news) {
  if (news.sentence == last_told_)
    return;
  last_told_ = news.sentence;
  publish_(news);
}

std::string registration::name() const {
  return "provider " + own_.provider;
}

} // namespace sofof::network::mec011
