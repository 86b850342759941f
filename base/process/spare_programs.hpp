// Programs that wait for work.
#pragma once

#include "base/process/kept_program.hpp"

#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

namespace sofof {

/// Programs that have been started ahead, since one may take longer to start
/// than anybody waits for its first result. Several threads may use it.
class spare_programs {
public:
  /// Starts so many.
  spare_programs(kept_setup setup, std::size_t count);

  /// Starts another one in its place.
  /// @returns the one that has been there longest; null: there is none.
  std::unique_ptr<framed_program> take();

  /// Reaps those that have died.
  void look();

private:
  void fill();
  void forget_dead();

  kept_setup setup_;
  std::size_t count_;
  std::mutex lock_;
  std::vector<std::unique_ptr<framed_program>> spares_;
};

} // namespace sofof
