// What vehicles connect to by TLS.
#pragma once

#include <cstdint>

namespace sofof::network {

/// Which of them: providers connect to a broker, too.
enum class tls_service : std::uint8_t { provider, broker };

} // namespace sofof::network
