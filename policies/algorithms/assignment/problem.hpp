// Which provider serves which vehicle: what is given, and what an answer is.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace sofof::policies::assignment {

/// A number for each pair: vehicles × providers.
using pair_table =
    Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using pair_flags =
    Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Who serves a vehicle: the provider with this index, or the vehicle itself.
using choice = std::optional<int>;
inline constexpr choice local = std::nullopt;

/// What providers have a limited amount of: utilisation, bandwidth.
struct resource {
  /// What a vehicle takes of a provider that serves it, ≥ 0, in units of the
  /// capacity.
  pair_table demand;
  /// One per provider, ≥ 0; infinity: as much as anybody wants.
  std::vector<double> capacity;
};

/// A generalised assignment problem in which staying local is always allowed.
///
///   max Σ g_ij x_ij − μ Σ (x̄_ij (1 − x_ij) + (1 − x̄_ij) x_ij)
///   s.t. Σ_i x_ij ≤ 1 for each vehicle j,
///        Σ_j u_ij x_ij ≤ U_i for each provider i and each resource,
///        x_ij = 0 where i may not serve j,  x_ij in {0, 1}
///
/// Links of the chain of one vehicle are "vehicles" of their own here. If j
/// leans on k, g_ij is the gain where i serves k too, and else less by l_ij.
///
/// Numbers of a pair that is not eligible are never read.
struct problem {
  /// g_ij: what is gained by x_ij = 1 over local computing; may be negative.
  pair_table gains;
  pair_flags eligible;
  std::vector<resource> resources;
  /// x̄: who serves each vehicle now, whether still eligible or not.
  std::vector<choice> present;
  /// μ ≥ 0, in units of the gains; to be paid for each x_ij that changes, thus
  /// twice by a vehicle that goes from one provider to another.
  double switching_price = 0;
  /// k: on whom each vehicle leans, without circles; empty: nobody leans on
  /// anybody, and l is not read.
  std::vector<std::optional<int>> leans_on{};
  pair_table lost_alone{}; ///< l_ij ≥ 0.

  int vehicles() const { return static_cast<int>(gains.rows()); }
  int providers() const { return static_cast<int>(gains.cols()); }
};

struct solution {
  /// One per vehicle.
  std::vector<choice> choices;
  /// The objective; negative when it costs more to change than is gained.
  double value = 0;
};

/// @throws std::invalid_argument when sizes disagree or a number is outside its
/// range; the sentence names it.
void check(const problem& p);

/// @returns what a choice adds to the objective, its switching price paid, with
/// whom it leans on beside it.
double worth(const problem& p, int vehicle, choice c);

/// @returns the objective of choices, one per vehicle.
double value(const problem& p, const std::vector<choice>& choices);

/// @returns whether choices respect eligibility and capacities. A sum of
/// demands may exceed a capacity by 1e-9 of it: sums of decimals are not exact.
bool feasible(const problem& p, const std::vector<choice>& choices);

/// @returns what is lost of a vehicle's gain by this choice as the one that it
/// leans on is not there, if others make theirs.
double loss_alone(const problem& p, const std::vector<choice>& choices,
                  int vehicle, choice c);

/// @returns whether nobody loses anything so.
bool nobody_is_alone(const problem& p, const std::vector<choice>& choices);

/// @returns the vehicles in the same order, but each after whom it leans on.
std::vector<int> leaning_last(const problem& p, const std::vector<int>& order);

} // namespace sofof::policies::assignment
