// A mean and how sure it is.
#pragma once

namespace sofof::experiments::study {

/// Of an interval of 95 %.
inline constexpr double outside_each_side = 0.025;

/// A mean of all values together, and where it lies with 95 % confidence.
struct interval {
  double mean = 0;
  double low = 0;
  double high = 0;

  double half_width() const { return (high - low) / 2; }
};

/// Values that belong together, those of one run, say.
struct group {
  double sum = 0;
  double count = 0;
};

} // namespace sofof::experiments::study
