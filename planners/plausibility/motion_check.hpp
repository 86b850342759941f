// Does what a station tells of a body fit what it told before?
#pragma once

#include "base/time.hpp"
#include "world/sensing/perception.hpp"

#include <optional>

namespace sofof::planners {

/// A body at a time.
struct timed_body {
  time_point at;
  world::perceived_object what;
};

/// @returns the body as it is so much later (earlier: < 0) at constant speed.
world::perceived_object moved_on(world::perceived_object x, double dt_s);

/// @returns by how much a body is farther from where its motion leads than
/// speed and time explain, m; what its speed or its heading has changed more
/// than a road user's can counts with the way that this is worth in the time
/// between. 0 when all is explained, or when more than 2 s lie between.
/// @param after  Not older than `before`.
double unexplained_m(const timed_body& before, const timed_body& after);

/// What one station tells of one body. A jump is not believed until three
/// words in a row, over half a second, agree on the new place: a receiver of
/// satellites may err once, and whoever makes positions up never agrees.
class steady_word {
public:
  /// @returns 0 when the word fits and is to be believed, else by how much it
  /// does not, m. A word that was overtaken on its way has to fit as well.
  double check(const timed_body& word);

private:
  bool agrees(const timed_body& word);

  std::optional<timed_body> believed_; // the newest of them
  double off_m_ = 0;                   // of the newest word that was compared
  std::optional<timed_body> rival_;    // the newest word that does not fit
  time_point rival_since_;
  int rivals_ = 0; // that agree with each other
};

} // namespace sofof::planners
