// Columns of numbers as few characters.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <span>

namespace sofof::report {

/// Writes numbers as whole multiples of 10^-places: their differences (of
/// order 0, 1 or 2, whichever is shortest, the numbers before the first being
/// 0) as unsigned numbers (0, -1, 1, -2, … become 0, 1, 2, 3, …), in blocks of
/// 64 with a byte that says how many bits each of them has, low bits first,
/// in Base64.
/// @param values  What is not finite is a gap.
/// @param places  Decimals to keep; fewer, or tens and hundreds, where numbers
///                would have more than 28 bits.
/// @returns [count, places, order, text], and a list of the gaps' indices
/// where there are any.
nlohmann::json delta_encoding(std::span<const double> values, int places);

/// The same with as many decimals as give seven digits to the largest value.
nlohmann::json delta_encoding(std::span<const double> values);

} // namespace sofof::report
