// A policy made of parts: a filter, then a choice among what is left.
#include "policies/filtered.hpp"

#include "base/options/option_helpers.hpp"
#include "policies/registry.hpp"

namespace sofof::policies {

namespace {

void list_filter(option_visitor& s, std::unique_ptr<local_filter>& filter) {
  visit_choice(s, filter, make_local_filter, "filter", local_filter_names());
}

void list_filter(option_visitor& s, std::unique_ptr<central_filter>& filter) {
  visit_choice(s, filter, make_central_filter, "filter",
               central_filter_names());
}

} // namespace

template <class Policy, class Filter, class Context, class Candidate>
void filtered_policy<Policy, Filter, Context, Candidate>::visit_options(
    option_visitor& s) {
  choice_->visit_options(s);
  s.table("filter", [this](option_visitor& t) { list_filter(t, filter_); });
}

template class filtered_policy<local_policy, local_filter, local_context,
                               provider_view>;
template class filtered_policy<central_policy, central_filter, central_context,
                               request_view>;

filtered_lodm::filtered_lodm(std::unique_ptr<local_policy> choice)
    : filtered_policy{make_local_filter("location"), std::move(choice)} {}

local_decision filtered_lodm::decide(const local_context& context) {
  reason objection; // the first
  std::vector<provider_view> left;
  for (const auto& provider : context.providers) {
    const auto why = filter_->objection(context, provider);
    if (why.empty())
      left.push_back(provider);
    else if (objection.empty())
      objection = why;
  }
  if (left.empty() && !context.current)
    return as_it_is(objection.empty() ? "nobody offers it" : objection);
  auto rest = context;
  rest.here = where_it_runs(context);
  rest.providers = left;
  std::vector<chain_link> chain{context.chain.begin(), context.chain.end()};
  for (auto& link : chain)
    std::erase_if(link.providers, [&](const provider_view& provider) {
      return provider.id != link.place
             && !filter_->objection(context, provider).empty();
    });
  rest.chain = chain;
  return choice_->decide(rest);
}

bool filtered_lodm::foresees_home(const local_context& context) const {
  const auto* here = where_it_runs(context);
  return (here && !filter_->objection(context, *here).empty())
         || choice_->foresees_home(context);
}

std::unique_ptr<local_policy> filtered_lodm::clone() const {
  auto copy = std::make_unique<filtered_lodm>(choice_->clone());
  copy->filter_ = filter_->clone();
  return copy;
}

filtered_codm::filtered_codm(std::unique_ptr<central_policy> choice)
    : filtered_policy{make_central_filter("location"), std::move(choice)} {}

std::vector<central_decision>
filtered_codm::decide(const central_context& context) {
  std::vector<central_decision> all;
  std::vector<request_view> left;
  for (const auto& request : context.requests) {
    all.push_back({refused{}, filter_->objection(context, request)});
    if (all.back().why.empty())
      left.push_back(request);
  }
  auto rest = context;
  rest.requests = left;
  const auto chosen = choice_->decide(rest);
  auto next = chosen.begin();
  for (auto& decision : all)
    if (decision.why.empty())
      decision = next == chosen.end()
                     ? central_decision{refused{}, "not decided"}
                     : *next++;
  all.insert(all.end(), next, chosen.end()); // of sessions
  return all;
}

std::unique_ptr<central_policy> filtered_codm::clone() const {
  auto copy = std::make_unique<filtered_codm>(choice_->clone());
  copy->filter_ = filter_->clone();
  return copy;
}

} // namespace sofof::policies
