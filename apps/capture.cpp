// libpcap reads the file; what is in a frame is ours.
#include "apps/capture.hpp"

#include "base/input_error.hpp"
#include "base/text/json.hpp"
#include "messages/etsi/json.hpp"
#include "messages/v2x/captured_frame.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <optional>
#include <pcap/pcap.h>
#include <span>
#include <string_view>
#include <variant>

namespace sofof::apps {

namespace {

namespace fs = std::filesystem;
using messages::link_layer;

using capture_handle = std::unique_ptr<pcap_t, decltype(&pcap_close)>;

capture_handle open_capture(const fs::path& file) {
  if (file != "-" && fs::is_directory(file))
    throw input_error{fmt::format("{}: this is a folder; give a capture of "
                                  "Wireshark, tcpdump or run --pcap.",
                                  file.string())};
  std::array<char, PCAP_ERRBUF_SIZE> why{};
  capture_handle handle{
      file == "-" ? pcap_fopen_offline_with_tstamp_precision(
          stdin, PCAP_TSTAMP_PRECISION_NANO, why.data())
                  : pcap_open_offline_with_tstamp_precision(
                      file.c_str(), PCAP_TSTAMP_PRECISION_NANO, why.data()),
      &pcap_close};
  if (!handle) {
    const std::string_view reason{why.data()};
    const auto name = file.string();
    throw input_error{fmt::format("{}{}: no capture can be read here.",
                                  reason.starts_with(name) ? "" : name + ": ",
                                  reason)};
  }
  return handle;
}

std::optional<link_layer> link_layer_of(int type) {
  switch (type) {
    case DLT_EN10MB:
      return link_layer::ethernet;
    case DLT_IEEE802_11:
      return link_layer::ieee80211;
    case DLT_IEEE802_11_RADIO:
      return link_layer::radiotap;
    case DLT_LINUX_SLL:
      return link_layer::linux_cooked;
    case DLT_LINUX_SLL2:
      return link_layer::linux_cooked_2;
    default:
      return std::nullopt;
  }
}

/// @returns ns; nullopt for what no capture of this world can say.
std::optional<std::int64_t> since_1970(const timeval& at) {
  constexpr std::int64_t ns_per_s = 1'000'000'000;
  std::int64_t s_in_ns = 0, ns = 0;
  if (__builtin_mul_overflow(at.tv_sec, ns_per_s, &s_in_ns)
      || __builtin_add_overflow(s_in_ns, at.tv_usec, &ns))
    return std::nullopt;
  return ns;
}

/// @param error  What is wrong with it; empty: nothing.
std::string in_json(std::uint64_t number, const pcap_pkthdr& at,
                    const messages::captured_packet& found,
                    std::string& error) {
  auto text = fmt::format(R"({{"packet": {})", number);
  if (const auto ns = since_1970(at.ts))
    text += fmt::format(R"(, "unix_ns": {})", *ns);
  std::string message;
  if (const auto* x = std::get_if<messages::btp_packet>(&found)) {
    text += fmt::format(R"(, "port": {})", x->port);
    if (x->is_signed)
      text += R"(, "signature": "unverified")";
    const auto [decoded, why] = messages::etsi::decode_message(x->message);
    if (decoded)
      messages::etsi::append_json(message, *decoded);
    error = why;
  } else {
    error = std::get<messages::broken_packet>(found).why;
  }
  if (error.empty())
    return text + R"(, "message": )" + message + '}';
  text += R"(, "error": )";
  append_quoted(text, error);
  return text + '}';
}

} // namespace

capture_summary
decode_capture(const fs::path& file,
               const std::function<void(const std::string&)>& print) {
  const auto capture = open_capture(file);
  const auto type = pcap_datalink(capture.get());
  const auto begins_with = link_layer_of(type);
  if (!begins_with) {
    const auto* name = pcap_datalink_val_to_name(type);
    throw input_error{fmt::format(
        "{}: its packets begin with {}, and only Ethernet, IEEE 802.11, "
        "radiotap and Linux cooked captures are known.",
        file.string(), name ? name : fmt::format("link type {}", type))};
  }
  capture_summary all;
  pcap_pkthdr* header = nullptr;
  const u_char* octets = nullptr;
  int status = 0;
  for (std::uint64_t number = 1;
       (status = pcap_next_ex(capture.get(), &header, &octets)) == 1;
       ++number) {
    const auto found = messages::find_message(
        *begins_with,
        {reinterpret_cast<const std::byte*>(octets), header->caplen});
    if (std::holds_alternative<messages::other_packet>(found)) {
      ++all.others;
      continue;
    }
    ++all.messages;
    std::string error;
    print(in_json(number, *header, found, error));
    all.has_errors = all.has_errors || !error.empty();
  }
  if (status == PCAP_ERROR)
    all.cut_off = pcap_geterr(capture.get());
  return all;
}

} // namespace sofof::apps
