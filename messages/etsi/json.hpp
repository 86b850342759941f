// Messages as JSON: their fields by their names in ASN.1, in order, a message a
// line. Close to the JSON encoding rules (ITU-T X.697):
//
//   numbers       as they are encoded, without units
//   ENUMERATED    "name"; of a later version, the number of its place
//   BIT STRING    "0110", the first bit first
//   CHOICE        {"alternative": value}
//   OPTIONAL      left out when absent
//   DEFAULT       always there; may be left out in what is read
//   unknown       what stands behind a length that nobody knows: "0a1b", hex
#pragma once

#include "messages/etsi/message.hpp"

#include <string>
#include <string_view>

namespace sofof::messages::etsi {

/// Appends a message as an object without line breaks.
void append_json(std::string& out, const message& m);

/// Reads what `append_json` writes; white space and the order of members do not
/// matter. What the header says tells which message it is.
/// @returns a message whose numbers are in range, or what is wrong where.
outcome<message> message_from_json(std::string_view text);

} // namespace sofof::messages::etsi
