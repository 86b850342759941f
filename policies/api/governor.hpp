// What has the last word on a vehicle's decision: the third part of it.
#pragma once

#include "policies/api/context.hpp"

#include <memory>
#include <string_view>

namespace sofof::policies {

/// Changes what a policy has decided. Governors stand in a row; each sees what
/// the one before it says. As policies, they decide from what they are given
/// and were told.
class governor {
public:
  virtual ~governor() = default;

  /// @param context  All that come into question, whatever the policy's filter
  ///                 says of them.
  virtual local_decision govern(const local_context& context,
                                const local_decision& wanted) = 0;

  virtual void observe(const cycle_outcome&) {}

  /// As `policy::epoch_s`.
  virtual double epoch_s() const { return 0; }

  /// As `policy::needs_scene`.
  virtual bool needs_scene() const { return false; }

  /// As `policy::needs_forecast`.
  virtual bool needs_forecast() const { return false; }

  /// As `policy::foresees_home`.
  virtual bool foresees_home(const local_context&) const { return false; }

  /// Lists the options once (base/options/option_visitor.hpp).
  virtual void visit_options(option_visitor&) {}

  virtual std::string_view name() const = 0;

  virtual std::unique_ptr<governor> clone() const = 0;
};

} // namespace sofof::policies
