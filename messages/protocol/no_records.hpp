// Gets all records and keeps none.
#pragma once

#include "messages/protocol/record.hpp"

namespace sofof::messages {

struct no_records : record_sink {
  void on_record(const record&) override {}
};

} // namespace sofof::messages
