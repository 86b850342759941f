// Text that a page carries compressed: zlib, Base64.
#include "experiments/report/compressed.hpp"

#include <cstddef>
#include <cstdint>
#include <new>
#include <zlib.h>

namespace sofof::experiments::report {

namespace {

std::string base64(std::string_view bytes) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                       "abcdefghijklmnopqrstuvwxyz"
                                       "0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = i; k < i + 3; ++k)
      three = three << 8
              | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0u);
    for (int shift = 18; shift >= 0; shift -= 6)
      text += letters[three >> shift & 63];
  }
  const auto missing = (3 - bytes.size() % 3) % 3;
  text.replace(text.size() - missing, missing, missing, '=');
  return text;
}

} // namespace

std::string compressed(std::string_view text) {
  auto size = compressBound(text.size());
  std::string bytes(size, '\0');
  const auto done = compress2(reinterpret_cast<Bytef*>(bytes.data()), &size,
                              reinterpret_cast<const Bytef*>(text.data()),
                              text.size(), Z_BEST_COMPRESSION);
  if (done != Z_OK) // there is room enough: memory is short
    throw std::bad_alloc{};
  bytes.resize(size);
  return base64(bytes);
}

} // namespace sofof::experiments::report
