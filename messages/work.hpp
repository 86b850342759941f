// What two hosts say to each other when one carries out a run for the other.
#pragma once

#include "messages/bytes.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace sofof {

/// Who orders a run, and how it can prove that it may.
struct worker_hello {
  std::string program;     ///< Another build may give other results.
  std::string certificate; ///< PEM; empty where connections are not secured.
  std::vector<std::byte> signature; ///< Of what `proof_of_orders` says.
};

/// Part of a file. The parts of one come one after the other, and so do files.
struct file_piece {
  std::string file; ///< Its name, without a folder.
  std::string octets;
};

/// No part is longer; octets.
inline constexpr std::size_t longest_piece = 256 * 1024;

/// How a run is getting on.
struct run_report {
  bool ended = false;
  std::string failure; ///< Why there is no result; empty if there is one.
};

/// @returns what is signed by who orders runs: that somebody who was given this
/// number just now does.
inline std::vector<std::byte> proof_of_orders(const std::string& nonce) {
  constexpr std::string_view purpose = "SOFOF orders runs";
  byte_writer text;
  text(std::string{purpose}, nonce);
  return text.take();
}

template <class Inspector>
bool inspect(Inspector& f, worker_hello& x) {
  return f.object(x).fields(f.field("program", x.program),
                            f.field("certificate", x.certificate),
                            f.field("signature", x.signature));
}

template <class Inspector>
bool inspect(Inspector& f, file_piece& x) {
  return f.object(x).fields(f.field("file", x.file),
                            f.field("octets", x.octets));
}

template <class Inspector>
bool inspect(Inspector& f, run_report& x) {
  return f.object(x).fields(f.field("ended", x.ended),
                            f.field("failure", x.failure));
}

} // namespace sofof
