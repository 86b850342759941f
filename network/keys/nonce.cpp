// Numbers that nobody can guess.
#include "network/keys/nonce.hpp"

#include "network/keys/openssl.hpp"

#include <openssl/rand.h>

namespace sofof::network {

std::string draw_nonce() {
  std::string octets(32, '\0');
  require_openssl(RAND_bytes(reinterpret_cast<unsigned char*>(octets.data()),
                             static_cast<int>(octets.size()))
                      == 1,
                  "RAND_bytes");
  return octets;
}

} // namespace sofof::network
