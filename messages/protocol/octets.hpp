// How many octets a message takes between processes.
#pragma once

#include "messages/protocol/inspect.hpp"
#include "messages/protocol/payload.hpp"
#include "messages/protocol/service_name.hpp"

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace sofof::messages {

/// Goes through a message as the serializer does that writes it, and counts
/// what that would write.
class octet_counter {
public:
  static constexpr bool is_loading = false;

  std::size_t count() const { return count_; }

  template <class T>
  bool value(T& x) {
    return add(x);
  }

  template <class T>
  octet_counter& object(T&) {
    return *this;
  }

  template <class T>
  auto field(std::string_view, T& x) {
    return [&x](octet_counter& f) { return f.add(x); };
  }
  template <class Get, class Set>
  auto field(std::string_view, Get get, Set set) {
    return [=](octet_counter& f) { return f.apply(get, set); };
  }

  template <class... Fields>
  bool fields(Fields... all) {
    return (all(*this) && ...);
  }

  template <class Get, class Set>
  bool apply(Get get, Set) {
    auto x = get();
    return add(x);
  }

private:
  template <class T>
  bool add(T& x) {
    if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::byte>) {
      count_ += sizeof(T);
      return true;
    } else {
      return inspect_value(*this, x);
    }
  }
  template <class Rep, class Period>
  bool add(std::chrono::duration<Rep, Period>&) {
    count_ += sizeof(Rep);
    return true;
  }
  template <class T>
  bool add(std::optional<T>& x) {
    ++count_; // whether it is there
    return !x || add(*x);
  }
  template <class T>
  bool add(std::vector<T>& xs) {
    add_size(xs.size());
    for (auto& x : xs)
      if (!add(x))
        return false;
    return true;
  }
  bool add(std::string& text) { return add_bytes(text.size()); }
  bool add(service_name& name) { return add_bytes(name.view().size()); }
  bool add(payload& x) {
    return add_bytes(x.type().size()) && add_bytes(x.encoded_size());
  }

  bool add_bytes(std::size_t size) {
    add_size(size);
    count_ += size;
    return true;
  }
  // Seven bits an octet.
  void add_size(std::size_t size) {
    do
      ++count_;
    while ((size >>= 7) != 0);
  }

  std::size_t count_ = 0;
};

/// @returns what a message takes in CAF's binary form.
template <class Message>
std::size_t octets_of(const Message& message) {
  octet_counter f;
  // Inspectors serve both directions, hence take a mutable reference.
  return f.value(const_cast<Message&>(message)) ? f.count() : 0;
}

} // namespace sofof::messages
