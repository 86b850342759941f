// What is wrong with a message, in a sentence: a second, slow pass over one
// that was refused.
#pragma once

#include "messages/etsi/field_path.hpp"
#include "messages/etsi/uper.hpp"

#include <string>

namespace sofof::messages::etsi {

/// @returns e.g. "CAM of protocol version 2", or "message 99 of protocol
/// version 2" where the id has no name in ETSI TS 102 894-2.
std::string text_of(message_key key);

/// @returns the same after "a" or "an".
std::string with_article(message_key key);

/// What was found where.
struct finding {
  std::string path;
  fault what = fault::none;
  std::int64_t value = 0, low = 0, high = 0; ///< As the fault has them.
};

// Sentences without their full stop.
std::string explain(const finding& found);
std::string explain(message_key found, message_key known);

/// Reads, and remembers what was wrong first.
class tracing_reader : public bit_reader {
public:
  explicit tracing_reader(std::span<const std::byte> in)
      : bit_reader{in}, octets_{in.size()} {}

  std::uint64_t get(unsigned width) {
    from_ = at();
    if (width > left())
      fail(fault::ends_early, width);
    return bit_reader::get(width);
  }
  void fail(fault what, auto... numbers) {
    if (!ok())
      return;
    bit_reader::fail(what);
    const finding found{path_.text(), what,
                        static_cast<std::int64_t>(numbers)...};
    sentence_ = explain(found);
    const auto end = 8 * octets_;
    if (what == fault::leftover)
      from_ = end - static_cast<std::size_t>(found.value);
    sentence_ +=
        ", at bit " + std::to_string(from_) + " of " + std::to_string(end);
  }
  void enter(auto name) { path_.enter(name); }
  void leave() { path_.leave(); }

  const std::string& sentence() const { return sentence_; }

private:
  field_path path_;
  std::size_t octets_;
  std::size_t from_ = 0; // where the last number begins
  std::string sentence_;
};

/// Writes nothing, and remembers what would be wrong first.
class tracing_writer : public bit_counter {
public:
  void fail(fault what, auto... numbers) {
    if (sentence_.empty())
      sentence_ =
          explain({path_.text(), what, static_cast<std::int64_t>(numbers)...});
  }
  void enter(auto name) { path_.enter(name); }
  void leave() { path_.leave(); }

  const std::string& sentence() const { return sentence_; }

private:
  field_path path_;
  std::string sentence_;
};

/// @returns why `decode` refuses these octets: a sentence without its full
/// stop; empty if it does not.
template <class T>
std::string explain_decoding(std::span<const std::byte> in) {
  if constexpr (headed<T>)
    if (in.size() >= 2 && key_in(in) != key_of<T>)
      return explain(key_in(in), key_of<T>);
  tracing_reader reader{in};
  T message;
  read_all(reader, message);
  return reader.sentence();
}

/// @returns why `encode` refuses this message, whatever room there is: a
/// sentence without its full stop; empty if it does not.
template <class T>
std::string explain_encoding(const T& message) {
  if constexpr (headed<T>)
    if (key_in(message) != key_of<T>)
      return explain(key_in(message), key_of<T>);
  tracing_writer writer;
  write(writer, message);
  return writer.sentence();
}

} // namespace sofof::messages::etsi
