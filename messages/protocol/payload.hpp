// What a service takes and gives: a value whose type only the service and
// its user know. The framework carries it and never looks inside.
#pragma once

#include "messages/protocol/bytes.hpp"

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sofof::messages {

/// The name under which a payload type travels; every type that becomes a
/// payload specialises it, and lists its fields (base/fields.hpp).
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
    return payload{std::make_shared<const own<T>>(std::move(value))};
  }

  bool empty() const { return !held_; }

  /// @returns the value, or null when it is of another type or when the bytes
  /// it came in are broken.
  template <class T>
  std::shared_ptr<const T> as() const {
    static_assert(!payload_name<T>.empty(), "the type needs a payload_name");
    if (type() != payload_name<T>)
      return nullptr;
    if (const auto* value = static_cast<const T*>(held_->value()))
      return {held_, value};
    auto value = std::make_shared<T>();
    const auto bytes = held_->encoded();
    byte_reader in{bytes};
    in(*value);
    return in.done() ? value : nullptr;
  }

  /// @returns the name of the type; empty for no payload.
  std::string_view type() const {
    return held_ ? held_->type() : std::string_view{};
  }

  std::vector<std::byte> encoded() const {
    return held_ ? held_->encoded() : std::vector<std::byte>{};
  }

  /// @returns how many bytes `encoded` has.
  std::size_t encoded_size() const { return held_ ? held_->size() : 0; }

  template <class Inspector>
  friend bool inspect(Inspector& f, payload& x) {
    std::string type{x.type()};
    std::vector<std::byte> bytes;
    if constexpr (!Inspector::is_loading)
      bytes = x.encoded();
    if (!f.object(x).fields(f.field("type", type), f.field("bytes", bytes)))
      return false;
    if constexpr (Inspector::is_loading) {
      x = payload{};
      if (!type.empty())
        x.held_ =
            std::make_shared<const foreign>(std::move(type), std::move(bytes));
    }
    return true;
  }

private:
  /// What copies share.
  class content {
  public:
    virtual ~content() = default;
    virtual std::string_view type() const = 0;
    virtual const void* value() const = 0; // null: there are only bytes
    virtual std::vector<std::byte> encoded() const = 0;
    virtual std::size_t size() const = 0; // of these
  };

  /// A value of this process.
  template <class T>
  class own final : public content {
  public:
    explicit own(T value) : value_{std::move(value)} {}
    std::string_view type() const override { return payload_name<T>; }
    const void* value() const override { return &value_; }
    std::vector<std::byte> encoded() const override {
      byte_writer out;
      out(value_);
      return out.take();
    }
    std::size_t size() const override {
      byte_counter out;
      out(value_);
      return out.count();
    }

  private:
    T value_;
  };

  /// What another process has sent.
  class foreign final : public content {
  public:
    foreign(std::string type, std::vector<std::byte> bytes)
        : type_{std::move(type)}, bytes_{std::move(bytes)} {}
    std::string_view type() const override { return type_; }
    const void* value() const override { return nullptr; }
    std::vector<std::byte> encoded() const override { return bytes_; }
    std::size_t size() const override { return bytes_.size(); }

  private:
    std::string type_;
    std::vector<std::byte> bytes_;
  };

  explicit payload(std::shared_ptr<const content> held)
      : held_{std::move(held)} {}

  std::shared_ptr<const content> held_;
};

} // namespace sofof::messages
