// A policy made of parts: a filter, then a choice among what is left.
#include "policies/composition.hpp"

#include "policies/location.hpp"
#include "world/listing.hpp"

namespace sofof {

namespace {

/// @returns the filter of this name; null if there is none.
std::unique_ptr<local_filter> make_local_filter(std::string_view name) {
  if (name == "none")
    return std::make_unique<no_filter<local_context, provider_view>>();
  if (name == "location")
    return std::make_unique<near_provider>();
  return nullptr;
}

std::unique_ptr<central_filter> make_central_filter(std::string_view name) {
  if (name == "none")
    return std::make_unique<no_filter<central_context, request_view>>();
  if (name == "location")
    return std::make_unique<stays_in_area>();
  return nullptr;
}

void list_filter(settings& s, std::unique_ptr<local_filter>& filter) {
  list_named(s, filter, make_local_filter, "filter", {"location", "none"});
}

void list_filter(settings& s, std::unique_ptr<central_filter>& filter) {
  list_named(s, filter, make_central_filter, "filter", {"location", "none"});
}

} // namespace

template <class Policy, class Filter>
void filtered_policy<Policy, Filter>::fields(settings& s) {
  choice_->fields(s);
  s.table("filter", [this](settings& t) { list_filter(t, filter_); });
}

template class filtered_policy<local_policy, local_filter>;
template class filtered_policy<central_policy, central_filter>;

filtered_lodm::filtered_lodm(std::unique_ptr<local_policy> choice)
    : filtered_policy{std::make_unique<near_provider>(), std::move(choice)} {}

local_decision filtered_lodm::decide(const local_context& context) {
  std::string_view objection; // the first
  std::vector<provider_view> left;
  for (const auto& provider : context.providers) {
    const auto why = filter_->objection(context, provider);
    if (why.empty())
      left.push_back(provider);
    else if (objection.empty())
      objection = why;
  }
  if (left.empty())
    return {0, objection.empty() ? "nobody offers it" : objection};
  auto rest = context;
  rest.providers = left;
  return choice_->decide(rest);
}

std::unique_ptr<local_policy> filtered_lodm::clone() const {
  auto copy = std::make_unique<filtered_lodm>(choice_->clone());
  copy->filter_ = filter_->clone();
  return copy;
}

filtered_codm::filtered_codm(std::unique_ptr<central_policy> choice)
    : filtered_policy{std::make_unique<stays_in_area>(), std::move(choice)} {}

std::vector<central_decision>
filtered_codm::decide(const central_context& context) {
  std::vector<central_decision> all;
  std::vector<request_view> left;
  for (const auto& request : context.requests) {
    all.push_back({false, filter_->objection(context, request)});
    if (all.back().why.empty())
      left.push_back(request);
  }
  auto rest = context;
  rest.requests = left;
  const auto chosen = choice_->decide(rest);
  auto next = chosen.begin();
  for (auto& decision : all)
    if (decision.why.empty())
      decision = *next++;
  return all;
}

std::unique_ptr<central_policy> filtered_codm::clone() const {
  auto copy = std::make_unique<filtered_codm>(choice_->clone());
  copy->filter_ = filter_->clone();
  return copy;
}

} // namespace sofof
