#pragma once

#include <string>
#include <string_view>

namespace d2b::writing {

/// Compresses with zlib (RFC 1950). @throws OutputError
[[nodiscard]] std::string zlib_compressed(std::string_view bytes);

}  // namespace d2b::writing
