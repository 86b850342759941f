// ITS messages in the captures of sniffers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace sofof::apps {

/// What stands in a capture besides messages.
struct capture_summary {
  std::uint64_t messages = 0; ///< Good ones and others.
  std::uint64_t others = 0;   ///< Packets that carry no ITS message.
  bool has_errors = false;    ///< A packet or message that cannot be read.
  std::string cut_off; ///< Why the file cannot be read to its end, if so.
};

/// Turns each ITS message of a capture (pcap, pcapng) into a line of JSON:
/// {"packet": 1, "unix_ns": ..., "port": 2001, "message": {...}}, with
/// "signature": "unverified" where there is one, and "error" instead of
/// "message" for what cannot be decoded.
/// @param file  "-": standard input.
/// @throws input_error when it is no capture, or one of another kind.
capture_summary
decode_capture(const std::filesystem::path& file,
               const std::function<void(const std::string&)>& print);

} // namespace sofof::apps
