// What comes into question at all: the first part of a decision.
#pragma once

#include "base/reason.hpp"
#include "policies/api/context.hpp"

#include <memory>
#include <string_view>

namespace sofof::policies {

/// Says of one candidate whether a policy may choose it. As policies, filters
/// decide from what they are given and nothing else.
template <class Context, class Candidate>
class filter {
public:
  virtual ~filter() = default;

  /// @returns what speaks against it; empty if nothing does.
  virtual reason objection(const Context& context,
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

} // namespace sofof::policies
