// What a learner remembers of the past, to learn from it more than once.
#pragma once

#include "policies/algorithms/learning/action_set.hpp"

#include <cassert>
#include <span>
#include <vector>

namespace sofof::policies {

/// What became of an action. The spans belong to whoever made it.
struct experience {
  std::span<const double> state; ///< Its features, finite.
  std::size_t action = 0;
  double reward = 0;            ///< Finite.
  std::span<const double> next; ///< Features; empty when the episode is over.
  action_set next_allowed;      ///< Where none is, nothing more is hoped.
};

/// The latest experiences; when it is full, a new one takes the place of the
/// oldest.
class replay {
public:
  /// @param features  Of a state, ≥ 1.
  /// @param capacity  In experiences, ≥ 1; memory is taken as they come.
  replay(std::size_t features, std::size_t capacity)
      : features_{features}, capacity_{capacity} {
    assert(features >= 1 && capacity >= 1);
  }

  void add(const experience& lived);

  std::size_t size() const { return entries_.size(); }
  /// @param place  < size; in no order that means anything.
  experience operator[](std::size_t place) const;

private:
  struct entry {
    std::size_t action;
    double reward;
    bool over;
    action_set next_allowed;
  };
  std::size_t features_;
  std::size_t capacity_;
  std::size_t added_ = 0;
  std::vector<entry> entries_;
  std::vector<double> states_; // here and next, one after the other
};

} // namespace sofof::policies
