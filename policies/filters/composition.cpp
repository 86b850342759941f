// A policy made of parts: a filter, then a choice among what is left.
#include "policies/filters/composition.hpp"

#include "base/options/option_helpers.hpp"
#include "policies/filters/location.hpp"

namespace sofof {

namespace {

template <class Filter>
struct filter_entry {
  policy_info notes;
  std::unique_ptr<Filter> (*make)();
};

template <class Filter, class Whole>
std::unique_ptr<Filter> made() {
  return std::make_unique<Whole>();
}

const policy_info none{"none", "Lets everything through.", "yes", "nothing",
                       "ours"};

const std::vector<filter_entry<local_filter>>& local_filters() {
  static const std::vector<filter_entry<local_filter>> all{
      {{"location",
        "Lets through where the way ahead stays long enough near a provider.",
        "d_passed > d_min, the way on the planned path before it leaves the "
        "disc of radius r_off round the provider",
        "the planned path, where providers are",
        "Dehler & Buchholz, IEEE RA-L 10(5), 2025",
        near_provider::parameters()},
       made<local_filter, near_provider>},
      {none, made<local_filter, no_filter<local_context, provider_view>>}};
  return all;
}

const std::vector<filter_entry<central_filter>>& central_filters() {
  static const std::vector<filter_entry<central_filter>> all{
      {{"location", "Lets vehicles through that stay long enough in the area.",
        "t_in_area >= t_min, the way on the route before it leaves the area by "
        "the present speed; and until t_min the route is on the map",
        "the route and the speed that requests tell",
        "Dehler & Buchholz, IEEE RA-L 10(5), 2025",
        stays_in_area::parameters()},
       made<central_filter, stays_in_area>},
      {none, made<central_filter, no_filter<central_context, request_view>>}};
  return all;
}

template <class Filter>
std::unique_ptr<Filter> find(const std::vector<filter_entry<Filter>>& all,
                             std::string_view name) {
  for (const auto& entry : all)
    if (entry.notes.name == name)
      return entry.make();
  return nullptr;
}

void list_filter(option_visitor& s, std::unique_ptr<local_filter>& filter) {
  visit_choice(s, filter, make_local_filter, "filter",
               names_of(local_filters()));
}

void list_filter(option_visitor& s, std::unique_ptr<central_filter>& filter) {
  visit_choice(s, filter, make_central_filter, "filter",
               names_of(central_filters()));
}

} // namespace

std::vector<policy_info> local_filter_notes() {
  return notes_of(local_filters());
}

std::vector<policy_info> central_filter_notes() {
  return notes_of(central_filters());
}

std::unique_ptr<local_filter> make_local_filter(std::string_view name) {
  return find(local_filters(), name);
}

std::unique_ptr<central_filter> make_central_filter(std::string_view name) {
  return find(central_filters(), name);
}

template <class Policy, class Filter>
void filtered_policy<Policy, Filter>::visit_options(option_visitor& s) {
  choice_->visit_options(s);
  s.table("filter", [this](option_visitor& t) { list_filter(t, filter_); });
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
  if (left.empty() && context.current == 0)
    return {0, objection.empty() ? "nobody offers it" : objection};
  auto rest = context;
  rest.here = where_it_runs(context);
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
      decision = next == chosen.end() ? central_decision{false, "not decided"}
                                      : *next++;
  all.insert(all.end(), next, chosen.end()); // of sessions
  return all;
}

std::unique_ptr<central_policy> filtered_codm::clone() const {
  auto copy = std::make_unique<filtered_codm>(choice_->clone());
  copy->filter_ = filter_->clone();
  return copy;
}

} // namespace sofof
