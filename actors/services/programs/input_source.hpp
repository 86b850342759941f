// Where the inputs of a program come from, by name.
#pragma once

#include "actors/services/programs/vehicle_view.hpp"
#include "base/ids.hpp"
#include "base/options/option_visitor.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

namespace sofof::actors {

/// One kind of input, for all vehicles.
class input_source {
public:
  virtual ~input_source() = default;

  virtual std::string_view name() const = 0;

  virtual void visit_options(option_visitor&) {}

  /// Reads what it needs.
  /// @param beside  The folder of the scenario.
  /// @param most    Octets of an input.
  /// @throws std::invalid_argument in words for the user.
  virtual void load(const std::filesystem::path& /*beside*/,
                    std::size_t /*most*/) {}

  /// @returns the files that it has read, in their order.
  virtual std::vector<std::filesystem::path> files() const { return {}; }

  /// @returns the service whose results it hands on; empty: none.
  virtual std::string_view program() const { return {}; }

  /// @param number  Of the input, from 0, of this vehicle.
  /// @returns an input; empty: there is none now.
  virtual std::vector<std::byte> next(const vehicle_view& view,
                                      station_id station,
                                      std::uint64_t number) const = 0;
};

using input_source_ptr = std::shared_ptr<input_source>;

/// @returns the source of that name; null: there is none.
input_source_ptr make_input_source(std::string_view name);

/// @returns all names.
std::vector<std::string_view> input_source_names();

} // namespace sofof::actors
