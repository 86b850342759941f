// Figures as Prometheus collects them.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace sofof::recording {

/// What a collector asked for.
enum class exposition_format : std::uint8_t {
  text,        ///< Prometheus text format, version 0.0.4.
  openmetrics, ///< OpenMetrics text format, version 1.0.0.
};

/// @param accept  Media types that a client takes.
exposition_format format_for(std::string_view accept);
/// @returns its media type.
std::string_view type_of(exposition_format format);

/// Writes families of figures, one after the other.
/// Sources: prometheus.io/docs/instrumenting/exposition_formats,
/// the OpenMetrics specification, 1.0.0.
class exposition {
public:
  using labels =
      std::initializer_list<std::pair<std::string_view, std::string_view>>;
  enum class kind : std::uint8_t { counter, gauge, histogram };

  explicit exposition(exposition_format format) : format_{format} {}

  /// Begins a family; its samples follow.
  /// @param name  In base units; of a counter without "_total".
  /// @param unit  The name's last word if it is one: "seconds".
  void family(std::string_view name, kind what, std::string_view help,
              std::string_view unit = {});

  void sample(const labels& of, double value);
  void sample(const labels& of, std::uint64_t value);

  /// @param limits  Of the buckets, rising, without the last one, +Inf.
  /// @param counts  Of what is in each but not in one before; one more.
  void histogram(const labels& of, std::span<const double> limits,
                 std::span<const std::uint64_t> counts, double sum);

  /// @returns all of it; to be called once.
  std::string finish();

private:
  void line(std::string_view suffix, const labels& of, std::string_view le,
            std::string_view value);

  exposition_format format_;
  std::string name_;
  kind kind_ = kind::gauge;
  std::string text_;
};

} // namespace sofof::recording
