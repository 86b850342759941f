// Serial numbers, line by line.
#include "network/keys/revocation_list.hpp"

#include "network/keys/certificate.hpp"
#include "network/network_error.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sofof::network {

namespace {

constexpr std::string_view blanks = " \t\r";

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(blanks);
  if (first == text.npos)
    return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

} // namespace

std::string parse_serial(std::string_view text) {
  constexpr std::size_t most_digits = 40; // 20 octets: RFC 5280, 4.1.2.2
  std::string serial;
  for (const auto c : text) {
    if (c == ':')
      continue;
    if (c >= 'a' && c <= 'f')
      serial += static_cast<char>(c - 'a' + 'A');
    else if ((c >= '0' && c <= '9') || (c >= 'A' && c <= 'F'))
      serial += c;
    else
      return {};
  }
  // OpenSSL prints whole octets.
  serial.erase(0, std::min(serial.find_first_not_of('0'), serial.size()));
  if (serial.size() % 2 == 1)
    serial.insert(0, 1, '0');
  return serial.size() <= most_digits ? serial : std::string{};
}

revocation_list::revocation_list(std::string_view text, std::string_view file) {
  for (std::size_t number = 1; !text.empty(); ++number) {
    const auto end = std::min(text.find('\n'), text.size());
    const auto line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const auto written = trimmed(line.substr(0, line.find('#')));
    if (written.empty())
      continue;
    auto serial = parse_serial(written);
    if (serial.empty())
      throw network_error{fmt::format(
          "{}:{}: this is no serial number; `openssl x509 -noout -serial -in "
          "cert.pem` prints that of a certificate",
          file, number)};
    serials_.push_back(std::move(serial));
  }
  std::ranges::sort(serials_);
  const auto rest = std::ranges::unique(serials_);
  serials_.erase(rest.begin(), rest.end());
}

bool revocation_list::contains(const X509& certificate) const {
  return !serials_.empty() && contains(serial_of(certificate));
}

bool revocation_list::contains(const std::string& serial) const {
  return std::ranges::binary_search(serials_, serial);
}

} // namespace sofof::network
