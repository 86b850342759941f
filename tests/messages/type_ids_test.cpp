// The numbers of the message types.
#include "messages/type_ids.hpp"

#include <caf/init_global_meta_objects.hpp>
#include <doctest/doctest.h>

#include <set>
#include <string>

using namespace sofof;

TEST_CASE("every message type has a name of its own, by which processes that "
          "talk compare them") {
  std::set<std::string> names;
  for (auto id = caf::id_block::sofof::begin; id < caf::id_block::sofof::end;
       ++id) {
    CAPTURE(id);
    const auto name = to_string(caf::query_type_name(id));
    CHECK(name.find("sofof::") != std::string::npos);
    CHECK(names.insert(name).second);
  }
  CHECK(names.contains("sofof::messages::service_request"));
}
