// Filter "none", of both sides: every offer and every request passes.
#include "policies/entry.hpp"

namespace sofof::policies {

namespace {

/// A filter that lets everything through.
template <class Context, class Candidate>
class no_filter final : public filter<Context, Candidate> {
public:
  reason objection(const Context&, const Candidate&) const override {
    return {};
  }
  std::string_view name() const override { return "none"; }
  std::unique_ptr<filter<Context, Candidate>> clone() const override {
    return std::make_unique<no_filter>(*this);
  }
};

constexpr std::string_view summary = "Lets everything through.";

} // namespace

local_filter_entry local_filter_none() {
  return {{"none", summary, "yes", "nothing", "ours"},
          unfiltered<local_filter, no_filter<local_context, provider_view>>};
}

central_filter_entry central_filter_none() {
  return {{"none", summary, "yes", "nothing", "ours"},
          unfiltered<central_filter, no_filter<central_context, request_view>>};
}

} // namespace sofof::policies
