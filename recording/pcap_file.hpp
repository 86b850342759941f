// A capture of all ITS messages of a run, as Wireshark opens it.
#pragma once

#include "base/files/output_file.hpp"
#include "messages/etsi/its_time.hpp"
#include "messages/protocol/record.hpp"

#include <filesystem>

namespace sofof::recording {

/// Messages one after the other as their senders broadcast them: Ethernet,
/// GeoNetworking, BTP-B; times to the nanosecond.
/// Source: the pcap format of libpcap.
class pcap_file {
public:
  /// Refuses, without touching anything, what surely cannot be opened.
  /// @throws input_error.
  static void check(const std::filesystem::path& path);

  /// @param clock  Tells the time of day of the run.
  /// @throws input_error when it cannot be opened.
  pcap_file(std::filesystem::path path, messages::etsi::its_clock clock);

  /// @throws input_error when the disk refuses it.
  void write(const messages::air_record& x);

  void flush() { file_.flush(); }
  void close() { file_.close(); }

private:
  output_file file_;
  messages::etsi::its_clock clock_;
};

} // namespace sofof::recording
