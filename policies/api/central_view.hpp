// How a provider that decides about many at once sees them.
#pragma once

#include "base/options/option_visitor.hpp"
#include "base/protocol.hpp"
#include "policies/api/context.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace sofof::policies {

/// Options of all policies that decide so.
struct central_options {
  double epoch_s = 0.25; ///< Requests wait so long for each other.
  double price = 0.05;   ///< Of a change, in units of gains, ≥ 0.

  /// Lists the options once.
  void visit_options(option_visitor& s) {
    // The answer has to be back before vehicles give up.
    s.field("epoch_s", epoch_s,
            {1e-3, 0.8 * to_seconds(protocol::request_timeout)});
    s.field("price", price, {0, 1});
  }
};

/// @param utilisation  What a service takes of this provider, a share of all
///                     workers.
/// @returns the mean computing time of one of its results, s.
double computing_s(double utilisation, const periodic_task& task,
                   std::size_t workers);

/// Gains count no more than this, either way: who tells absurd ones shall not
/// drown those of others.
inline constexpr double greatest_gain = 10;

/// @returns what a vehicle says it wins at a provider, within `greatest_gain`;
/// of several the first; nullopt if it does not say.
std::optional<double> told_gain(std::span<const candidate> told,
                                provider_id provider);

/// What being here counts for. Who asks wants it, so it is at least `price` and
/// a little more, the less it takes the more: also where a vehicle knows
/// nothing of the link yet, and tells a gain below zero, or tells none.
/// @param utilisation  What it takes of this provider, ≥ 0.
/// @param price        Of a change, ≥ 0, in units of gains.
double local_gain(std::span<const candidate> told, provider_id self,
                  double utilisation, double price);

/// Another provider, as requests tell of it.
struct other_provider {
  provider_id id = 0;
  double utilisation = 0; ///< The highest that is told, in [0, 1].
};

/// @returns the providers beside this one that requests name, in the order in
/// which they do, 16 at most.
std::vector<other_provider> others_told(const central_context& context);

} // namespace sofof::policies
