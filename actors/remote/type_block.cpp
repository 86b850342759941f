// What makes two programs of this project understand each other.
#include "actors/remote/type_block.hpp"

#include "base/fingerprint.hpp"
#include "messages/type_ids.hpp"

#include <caf/detail/meta_object.hpp>
#include <fmt/format.h>

namespace sofof::actors {

std::uint64_t fingerprint_of_types() {
  std::string names;
  for (auto id = caf::id_block::sofof::begin; id < caf::id_block::sofof::end;
       ++id) {
    const auto name = caf::query_type_name(id);
    names.append(name.begin(), name.end());
    names += ';';
  }
  return fingerprint(names);
}

std::string spoken(std::uint32_t protocol, std::uint64_t types) {
  return fmt::format("protocol {} with messages {:016x}", protocol, types);
}

} // namespace sofof::actors
