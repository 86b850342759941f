// Several functions as one, for std::visit.
#pragma once

namespace sofof {

/// Calls the one of its functions that fits best: `const auto&` is for what no
/// other one names.
template <class... Functions>
struct overloaded : Functions... {
  using Functions::operator()...;
};

template <class... Functions>
overloaded(Functions...) -> overloaded<Functions...>;

} // namespace sofof
