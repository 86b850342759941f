// Somewhere that the runs of a sweep can be carried out.
#pragma once

#include "scenario/scenario.hpp"

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sofof {

/// A site has gone away; the run may be tried at another one.
class site_lost : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

class run_site {
public:
  virtual ~run_site() = default;

  /// Any thread may call this.
  /// @returns how many runs may be carried out here now, each on a thread of
  /// its own; 0 while the site is away.
  virtual std::size_t slots() const = 0;

  /// @returns what people should know since the last call, a line each.
  virtual std::vector<std::string> news() { return {}; }

  /// Returns when the run has ended; its results are in the folder then.
  /// @param folder       Whatever is there of a run is replaced.
  /// @param interrupted  Once true, it returns soon.
  /// @throws site_lost; anything else says why the run failed.
  virtual void carry_out(const scenario& s, const std::filesystem::path& folder,
                         const std::atomic<bool>& interrupted) = 0;
};

/// This process: a virtual world on the thread that asks.
class own_site final : public run_site {
public:
  /// @param version  Of this program, for the summaries.
  explicit own_site(std::string version) : version_{std::move(version)} {}

  std::size_t slots() const override { return 1; }
  void carry_out(const scenario& s, const std::filesystem::path& folder,
                 const std::atomic<bool>& interrupted) override;

private:
  std::string version_;
};

} // namespace sofof
