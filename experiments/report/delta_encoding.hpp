// Columns of numbers as small whole ones.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <span>

namespace sofof::experiments::report {

/// Writes numbers as whole multiples of 10^-places, or their differences (of
/// order 1 or 2, the numbers before the first being 0) where these are smaller:
/// neighbours in a track differ little, and so do their differences.
/// @param values  What is not finite is a gap.
/// @param places  Decimals to keep; fewer, or tens and hundreds, where numbers
///                would have more than 28 bits.
/// @returns [places, order, numbers], and a list of the gaps' indices where
/// there are any; a gap's number is that before it.
nlohmann::json delta_encoding(std::span<const double> values, int places);

/// The same with as many decimals as give seven digits to the largest value.
nlohmann::json delta_encoding(std::span<const double> values);

} // namespace sofof::experiments::report
