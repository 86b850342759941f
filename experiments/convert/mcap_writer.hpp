// Writes MCAP, a container of messages with time and schema.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sofof::experiments::convert {

/// A file of JSON messages: chunks without compression, each with its checksum
/// and an index by channel, and a summary at the end. All that stays in memory
/// is one chunk and the index of chunks.
/// Source: MCAP Format Specification, mcap.dev/spec, version 0.
class mcap_writer {
public:
  using channel = std::uint16_t;

  /// @param put  Takes the octets of the file, in their order.
  explicit mcap_writer(std::function<void(std::string_view)> put);

  /// @param schema       Its name: the same for channels of the same kind.
  /// @param json_schema  Of the messages; that of the first channel with the
  ///                     schema counts.
  channel add_channel(std::string_view topic, std::string_view schema,
                      std::string_view json_schema);

  /// @param unix_ns  When it was said and logged.
  void write(channel on, std::uint64_t unix_ns, std::string_view json);

  /// Completes the file; nothing may follow.
  void finish();

private:
  struct span {
    std::uint64_t first_ns = UINT64_MAX, last_ns = 0;
    void add(std::uint64_t ns);
  };

  void put(std::string_view octets);
  void end_chunk();

  std::function<void(std::string_view)> put_;
  std::uint64_t written_ = 0;
  std::map<std::string, std::uint16_t, std::less<>> schemas_;
  std::uint16_t channels_ = 0;
  std::string definitions_; // of schemas and channels, for the summary
  std::string chunk_index_; // records of it, for the summary
  std::uint32_t chunks_ = 0;
  std::map<channel, std::uint64_t> messages_;
  span all_;
  // The chunk under way:
  std::string chunk_;
  std::map<channel, std::vector<std::pair<std::uint64_t, std::uint64_t>>>
      index_; // times and places
  span in_chunk_;
};

} // namespace sofof::experiments::convert
