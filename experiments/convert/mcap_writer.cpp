// Records are an opcode, a length and fields, all little-endian.
#include "experiments/convert/mcap_writer.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <zlib.h>

namespace sofof::experiments::convert {

namespace {

constexpr std::string_view magic{"\x89MCAP0\r\n", 8};
constexpr std::size_t chunk_size = std::size_t{1} << 20;

enum class opcode : std::uint8_t {
  header = 1,
  footer = 2,
  schema = 3,
  channel = 4,
  message = 5,
  chunk = 6,
  message_index = 7,
  chunk_index = 8,
  statistics = 11,
  data_end = 15,
};

/// The fields of a record.
class fields {
public:
  template <class T>
  fields& add(T x) {
    for (std::size_t i = 0; i < sizeof x; ++i)
      text_ += static_cast<char>(static_cast<std::uint64_t>(x) >> (8 * i));
    return *this;
  }
  /// With its length before it.
  fields& add_text(std::string_view x) {
    add(static_cast<std::uint32_t>(x.size()));
    text_ += x;
    return *this;
  }
  const std::string& text() const { return text_; }

private:
  std::string text_;
};

/// @returns what stands before the fields of a record.
std::string head_of(opcode what, std::size_t size) {
  return fields{}
      .add(static_cast<std::uint8_t>(what))
      .add(std::uint64_t{size})
      .text();
}

std::string record(opcode what, const fields& of) {
  return head_of(what, of.text().size()) + of.text();
}

std::uint32_t checksum(std::string_view octets) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(octets.data()), octets.size()));
}

} // namespace

void mcap_writer::span::add(std::uint64_t ns) {
  first_ns = std::min(first_ns, ns);
  last_ns = std::max(last_ns, ns);
}

mcap_writer::mcap_writer(std::function<void(std::string_view)> put)
    : put_{std::move(put)} {
  this->put(magic);
  this->put(record(opcode::header, fields{}.add_text("").add_text("sofof")));
}

void mcap_writer::put(std::string_view octets) {
  put_(octets);
  written_ += octets.size();
}

mcap_writer::channel mcap_writer::add_channel(std::string_view topic,
                                              std::string_view schema,
                                              std::string_view json_schema) {
  std::string added;
  auto known = schemas_.find(schema);
  if (known == schemas_.end()) {
    const auto id = static_cast<std::uint16_t>(schemas_.size() + 1);
    known = schemas_.emplace(schema, id).first;
    added = record(opcode::schema, fields{}
                                       .add(id)
                                       .add_text(schema)
                                       .add_text("jsonschema")
                                       .add_text(json_schema));
  }
  ++channels_;
  added += record(opcode::channel, fields{}
                                       .add(channels_)
                                       .add(known->second)
                                       .add_text(topic)
                                       .add_text("json")
                                       .add(std::uint32_t{0})); // no metadata
  chunk_ += added;
  definitions_ += added;
  return channels_;
}

void mcap_writer::write(channel on, std::uint64_t unix_ns,
                        std::string_view json) {
  assert(on >= 1 && on <= channels_);
  index_[on].emplace_back(unix_ns, chunk_.size());
  const auto number = static_cast<std::uint32_t>(messages_[on]++);
  const auto head = fields{}.add(on).add(number).add(unix_ns).add(unix_ns);
  chunk_ += head_of(opcode::message, head.text().size() + json.size());
  chunk_ += head.text();
  chunk_ += json;
  in_chunk_.add(unix_ns);
  if (chunk_.size() >= chunk_size)
    end_chunk();
}

void mcap_writer::end_chunk() {
  if (chunk_.empty())
    return;
  if (index_.empty())
    in_chunk_ = {0, 0}; // definitions alone
  const auto head = fields{}
                        .add(in_chunk_.first_ns)
                        .add(in_chunk_.last_ns)
                        .add(std::uint64_t{chunk_.size()})
                        .add(checksum(chunk_))
                        .add_text("") // no compression
                        .add(std::uint64_t{chunk_.size()});
  const auto start = written_;
  put(head_of(opcode::chunk, head.text().size() + chunk_.size()));
  put(head.text());
  put(chunk_);
  const auto end = written_;
  fields places;
  for (const auto& [on, messages] : index_) {
    fields one;
    one.add(on).add(static_cast<std::uint32_t>(messages.size() * 2
                                               * sizeof(std::uint64_t)));
    for (const auto& [time, place] : messages)
      one.add(time).add(place);
    places.add(on).add(written_);
    put(record(opcode::message_index, one));
  }
  fields index;
  index.add(in_chunk_.first_ns)
      .add(in_chunk_.last_ns)
      .add(start)
      .add(end - start)
      .add_text(places.text())
      .add(written_ - end)
      .add_text("")
      .add(std::uint64_t{chunk_.size()})
      .add(std::uint64_t{chunk_.size()});
  chunk_index_ += record(opcode::chunk_index, index);
  ++chunks_;
  if (!index_.empty()) {
    all_.add(in_chunk_.first_ns);
    all_.add(in_chunk_.last_ns);
  }
  chunk_.clear();
  index_.clear();
  in_chunk_ = {};
}

void mcap_writer::finish() {
  end_chunk();
  put(record(opcode::data_end, fields{}.add(std::uint32_t{0}))); // no checksum
  std::uint64_t count = 0;
  fields counts;
  for (const auto& [on, messages] : messages_) {
    counts.add(on).add(messages);
    count += messages;
  }
  const auto statistics = fields{}
                              .add(count)
                              .add(static_cast<std::uint16_t>(schemas_.size()))
                              .add(std::uint32_t{channels_})
                              .add(std::uint32_t{0}) // attachments
                              .add(std::uint32_t{0}) // metadata
                              .add(chunks_)
                              .add(count > 0 ? all_.first_ns : 0)
                              .add(all_.last_ns)
                              .add_text(counts.text());
  const auto begin = written_;
  auto summary =
      definitions_ + record(opcode::statistics, statistics) + chunk_index_;
  const auto places = fields{}.add(begin).add(std::uint64_t{0});
  summary +=
      head_of(opcode::footer, places.text().size() + sizeof(std::uint32_t))
      + places.text();
  put(summary);
  put(fields{}.add(checksum(summary)).text());
  put(magic);
}

} // namespace sofof::experiments::convert
