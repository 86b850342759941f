// A short number for a long text.
#pragma once

#include <cstdint>
#include <string_view>

namespace sofof {

/// FNV-1a, 64 bits (Fowler, Noll & Vo). The same everywhere; no secret.
constexpr std::uint64_t fingerprint(std::string_view text) {
  std::uint64_t h = 0xcbf29ce484222325;
  for (const unsigned char c : text)
    h = (h ^ c) * 0x100000001b3;
  return h;
}

} // namespace sofof
