#pragma once

#include <string>

namespace d2b {

/// What messages and reports call a destination: a password in it, as the name of a database may have, is
/// left out.
[[nodiscard]] std::string spoken_destination(const std::string& destination);

}  // namespace d2b
