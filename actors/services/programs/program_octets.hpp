// What programs take and give: octets that only they understand.
#pragma once

#include "messages/protocol/payload.hpp"

#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

namespace sofof::actors {

struct program_octets {
  std::vector<std::byte> octets;
};

void visit_fields(auto& v, program_octets& x) {
  v("octets", x.octets);
}

} // namespace sofof::actors

template <>
inline constexpr std::string_view
    sofof::messages::payload_name<sofof::actors::program_octets> =
        "program_octets";
