// What a service takes and gives: a value whose type only the service and
// its user know. The framework carries it and never looks inside.
#pragma once

#include "messages/protocol/bytes.hpp"

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sofof {

/// The name under which a payload type travels; every type that becomes a
/// payload specialises it, and has an `archive` (messages/protocol/bytes.hpp).
template <class T>
inline constexpr std::string_view payload_name = {};

/// An immutable value of any type; copying it copies a pointer. Inside a
/// process it stays as it is, between processes it is bytes.
class payload {
public:
  payload() = default;

  template <class T>
  static payload of(T value) {
    static_assert(!payload_name<T>.empty(), "the type needs a payload_name");
    payload p;
    p.type_ = payload_name<T>;
    p.value_ = std::make_shared<const T>(std::move(value));
    p.encode_ = [](const void* x) {
      byte_writer out;
      out(*static_cast<const T*>(x));
      return out.take();
    };
    return p;
  }

  /// @returns the value, or null when it is of another type or when the bytes
  /// it came in are broken.
  template <class T>
  std::shared_ptr<const T> as() const {
    if (type_ != payload_name<T>)
      return nullptr;
    if (value_)
      return std::static_pointer_cast<const T>(value_);
    auto value = std::make_shared<T>();
    byte_reader in{bytes_};
    in(*value);
    return in.done() ? value : nullptr;
  }

  /// @returns the name of the type; empty for no payload.
  std::string_view type() const { return type_; }

  std::vector<std::byte> encoded() const {
    return value_ ? encode_(value_.get()) : bytes_;
  }

  template <class Inspector>
  friend bool inspect(Inspector& f, payload& x) {
    std::string type{x.type_};
    std::vector<std::byte> bytes;
    if constexpr (!Inspector::is_loading)
      bytes = x.encoded();
    if (!f.object(x).fields(f.field("type", type), f.field("bytes", bytes)))
      return false;
    if constexpr (Inspector::is_loading) {
      x = payload{};
      x.type_ = std::move(type);
      x.bytes_ = std::move(bytes);
    }
    return true;
  }

private:
  std::string type_;
  std::shared_ptr<const void> value_;
  std::vector<std::byte> (*encode_)(const void*) = nullptr;
  std::vector<std::byte> bytes_;
};

} // namespace sofof
