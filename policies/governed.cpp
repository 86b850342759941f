// An LODM and its governors.
#include "policies/governed.hpp"

#include "base/options/option_helpers.hpp"
#include "policies/registry.hpp"

#include <algorithm>
#include <cassert>

namespace sofof::policies {

governed_lodm::governed_lodm(std::unique_ptr<local_policy> whole)
    : whole_{std::move(whole)} {
  assert(whole_);
}

local_decision governed_lodm::decide(const local_context& context) {
  auto decision = whole_->decide(context);
  for (const auto& next : governors_)
    decision = next->govern(context, decision);
  return decision;
}

void governed_lodm::observe(const cycle_outcome& outcome) {
  whole_->observe(outcome);
  for (const auto& next : governors_)
    next->observe(outcome);
}

void governed_lodm::observe(const refusal_outcome& outcome) {
  whole_->observe(outcome);
}

void governed_lodm::observe(const episode_outcome& outcome) {
  whole_->observe(outcome);
}

double governed_lodm::epoch_s() const {
  auto least = whole_->epoch_s();
  for (const auto& next : governors_)
    if (const auto s = next->epoch_s(); s > 0 && (least == 0 || s < least))
      least = s;
  return least;
}

bool governed_lodm::needs_scene() const {
  return whole_->needs_scene()
         || std::ranges::any_of(governors_, &governor::needs_scene);
}

bool governed_lodm::needs_forecast() const {
  return whole_->needs_forecast()
         || std::ranges::any_of(governors_, &governor::needs_forecast);
}

bool governed_lodm::foresees_home(const local_context& context) const {
  return whole_->foresees_home(context)
         || std::ranges::any_of(governors_, [&](const auto& x) {
              return x->foresees_home(context);
            });
}

void governed_lodm::visit_options(option_visitor& s) {
  whole_->visit_options(s);
  s.tables("govern", governors_.size(),
           [this](std::size_t i, option_visitor& t) {
             if (i == governors_.size())
               governors_.emplace_back();
             visit_choice(t, governors_[i], make_governor, "governor",
                          governor_names());
           });
}

std::string governed_lodm::title() const {
  auto text = whole_->title();
  for (const auto& next : governors_)
    text.append(" + ").append(next->name());
  return text;
}

std::unique_ptr<local_policy> governed_lodm::clone() const {
  auto copy = std::make_unique<governed_lodm>(whole_->clone());
  for (const auto& next : governors_)
    copy->governors_.push_back(next->clone());
  return copy;
}

} // namespace sofof::policies
