// Where a message comes from, for actors that peers can reach.
#pragma once

namespace sofof {

/// @returns whether the message that `self` handles now was sent by an actor of
/// this process.
template <class Self>
bool is_from_here(Self* self) {
  const auto& sender = self->current_sender();
  return sender && sender->node() == self->node();
}

} // namespace sofof
