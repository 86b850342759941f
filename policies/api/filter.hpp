// What comes into question at all: the first part of a decision.
#pragma once

#include "policies/api/context.hpp"

#include <memory>
#include <string_view>

namespace sofof {

/// Says of one candidate whether a policy may choose it. As policies, filters
/// decide from what they are given and nothing else.
template <class Context, class Candidate>
class filter {
public:
  virtual ~filter() = default;

  /// @returns what speaks against it, a short literal; empty if nothing does.
  virtual std::string_view objection(const Context& context,
                                     const Candidate& candidate) const = 0;

  /// Lists the options once (base/options/option_visitor.hpp).
  virtual void visit_options(option_visitor&) {}

  virtual std::string_view name() const = 0;

  virtual std::unique_ptr<filter> clone() const = 0;
};

/// Which providers a vehicle may ask.
using local_filter = filter<local_context, provider_view>;

/// Which requests a provider may accept.
using central_filter = filter<central_context, request_view>;

/// A filter that lets everything through.
template <class Context, class Candidate>
class no_filter final : public filter<Context, Candidate> {
public:
  std::string_view objection(const Context&, const Candidate&) const override {
    return {};
  }
  std::string_view name() const override { return "none"; }
  std::unique_ptr<filter<Context, Candidate>> clone() const override {
    return std::make_unique<no_filter>(*this);
  }
};

} // namespace sofof
