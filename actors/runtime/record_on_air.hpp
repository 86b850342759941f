// Tells the records of ITS messages as they are sent.
#pragma once

#include "actors/runtime/recorder.hpp"
#include "actors/runtime/time.hpp"
#include "messages/type_ids.hpp"

namespace sofof::actors {

/// An ITS message leaves now.
template <class Self>
void record_on_air(Self* self, const messages::recorder_actor& recorder,
                   const messages::its_pdu& message) {
  send_record(self, recorder, messages::air_record{now(self), message});
}

/// The same, if it is one or several.
template <class Self>
void record_on_air(Self* self, const messages::recorder_actor& recorder,
                   const messages::payload& what) {
  if (const auto message = what.as<messages::its_pdu>())
    record_on_air(self, recorder, *message);
  else if (const auto several = what.as<messages::its_pdus>())
    for (const auto& one : several->all)
      record_on_air(self, recorder, one);
}

} // namespace sofof::actors
