// Which numbers of vehicles are tried, to find how many a provider carries.
#pragma once

#include <cstdint>
#include <optional>

namespace sofof::experiments::load_test {

/// Twice as many each time until it was too many, then halfway between what
/// was carried and what was too many, until a tenth is left between them.
class load_search {
public:
  /// @param first  > 0.
  /// @param most   More are never tried; >= first.
  load_search(std::int64_t first, std::int64_t most);

  /// @returns the next number to try; nullopt once the search is over.
  std::optional<std::int64_t> next() const;

  /// @param tried  What `next` gave.
  void add(std::int64_t tried, bool was_carried);

  /// @returns the most that were carried; 0 for none.
  std::int64_t carried() const { return carried_; }
  /// @returns the fewest that were too many; nullopt if there were none.
  std::optional<std::int64_t> too_many() const { return too_many_; }

private:
  std::int64_t first_, most_;
  std::int64_t carried_ = 0;
  std::optional<std::int64_t> too_many_;
};

} // namespace sofof::experiments::load_test
