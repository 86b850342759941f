// What every decision policy has in common.
#pragma once

#include "base/ids.hpp"
#include "base/options/option_visitor.hpp"
#include "base/reason.hpp"
#include "base/time.hpp"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace sofof::policies {

/// What cycles of a service were like.
struct cycle_outcome {
  time_point at;             ///< When the result came.
  std::string_view service;  ///< Its name.
  service_place computed_at; ///< Where its results came from.
  double latency_s = 0;      ///< Infinite when nothing came.
  bool missed = false;       ///< Later than the limit, or not at all.
  double energy_j = 0;       ///< Of the vehicle, for each of them.
  double cycles = 1;         ///< How many it stands for, > 0.
  station_id station = 0;    ///< Of the vehicle.
};

/// A request that came to nothing.
struct refusal_outcome {
  time_point at;
  std::string_view service; ///< Its name.
  provider_id provider = 0;
  std::string_view why;   ///< As the provider says; "no answer" if it does not.
  station_id station = 0; ///< Of the vehicle.
};

/// What one whole offloading was like.
struct episode_outcome {
  std::string_view service; ///< Its name.
  provider_id provider = 0;
  double remote_s = 0;         ///< Time on the remote source.
  std::string_view end_reason; ///< One of protocol's reasons.
  station_id station = 0;      ///< Of the vehicle.
};

/// A program that decides in place of a policy, as options name it.
template <class Policy>
struct program_use {
  std::string
      command;        ///< Program and arguments, as `command_words` reads them.
  std::string folder; ///< Where it runs, relative to `origin`.
  duration time_limit = std::chrono::seconds{5}; ///< For each answer, > 0.
  /// Folder of the file that names it, once that is known.
  std::string origin{};
  /// Asks it; null until a run connects it. Shared by all clones.
  std::shared_ptr<Policy> decider{};
};

/// A file with what a learner has learned before.
struct snapshot_use {
  std::string file;  ///< As options name it; empty: none.
  std::string shape; ///< What has to be the same to use it, in words.
};

/// Decides from a context and nothing else: the same context (and learned
/// state) gives the same decision. Time and randomness come in the context.
template <class Context, class Decision, class Candidate>
class policy {
public:
  virtual ~policy() = default;

  virtual Decision decide(const Context& context) = 0;

  /// @returns what speaks against a candidate whatever else there is; empty if
  /// nothing does.
  virtual reason objection(const Context&, const Candidate&) const {
    return {};
  }

  /// Feedback: planning cycles.
  virtual void observe(const cycle_outcome&) {}
  /// Feedback: nobody took it.
  virtual void observe(const refusal_outcome&) {}
  /// Feedback: one offloading, when it has ended.
  virtual void observe(const episode_outcome&) {}

  /// How often it wants to be asked, s, >= 0. In the vehicle 0 is whenever a
  /// provider offers something; else also so often, wherever the service runs,
  /// and cycles on board are told at the same pace. At a provider 0 is for
  /// every request as it comes; else requests wait, and those of one epoch are
  /// decided together.
  virtual double epoch_s() const { return 0; }

  /// @returns whether it is to be told under which response time a vehicle's
  /// scene is safe: `local_context::safe_response`.
  virtual bool needs_scene() const { return false; }

  /// @returns whether it decides about the services of a vehicle's chain
  /// together: `local_context::chain`.
  virtual bool needs_chain() const { return false; }

  /// @returns whether it wants to be told what results will be like along the
  /// way: `local_context::forecasts`.
  virtual bool needs_forecast() const { return false; }

  /// In the vehicle: for a service that runs at a provider.
  /// @returns whether it may come home soon: where the way leads, or for what
  /// this policy would decide.
  virtual bool foresees_home(const Context&) const { return false; }

  /// @returns what it has learned, as text for `restore`; empty for nothing.
  virtual std::string snapshot() const { return {}; }
  /// Takes up what another one of this kind and options has learned.
  /// @returns why the text is no such snapshot, and then all stays as it was;
  /// else nullopt.
  virtual std::optional<std::string> restore(std::string_view) {
    return "this policy learns nothing";
  }

  /// @returns the program that decides in its place; null where there is none.
  virtual program_use<policy>* program() { return nullptr; }
  /// @returns the file that it has learned from, or may; null if it learns
  /// nothing that lasts.
  virtual snapshot_use* learned_from() { return nullptr; }

  /// Lists the options once (base/options/option_visitor.hpp).
  virtual void visit_options(option_visitor&) {}

  virtual std::string_view name() const = 0;
  /// @returns its name, with those of governors behind it, for results.
  virtual std::string title() const { return std::string{name()}; }

  /// @returns a policy with the same options and learned state; every
  /// vehicle and provider has one of its own.
  virtual std::unique_ptr<policy> clone() const = 0;
};

} // namespace sofof::policies
