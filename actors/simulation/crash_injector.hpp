// Ends an actor at a time, without goodbye: what happens to a computer whose
// power is cut.
#pragma once

#include "base/time.hpp"

#include <caf/actor.hpp>
#include <caf/actor_system.hpp>

namespace sofof::actors {

/// @param victim  Is killed: it tells nobody, but whoever monitors it hears.
/// @param after   From now on. The actor that is returned waits for that, or
///                until the victim has ended; once it has ended itself nothing
///                happens any more.
caf::actor spawn_crash_injector(caf::actor_system& sys, caf::actor victim,
                                duration after);

} // namespace sofof::actors
