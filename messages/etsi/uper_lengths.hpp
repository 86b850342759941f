// Numbers of the packed encoding rules that writing and reading share.
#pragma once

#include <cstddef>

namespace sofof::messages::etsi {

/// A small number of no fixed range: an index beyond the root, a count of
/// additions. X.691, 11.6.
inline constexpr unsigned small_width = 6;

/// The length of an open type or of an extended number in octets, unfragmented.
/// X.691, 11.9.
inline constexpr std::size_t longest = 0x3fff;

} // namespace sofof::messages::etsi
