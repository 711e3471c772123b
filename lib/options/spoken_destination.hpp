#pragma once

#include <string>

namespace d2b {

/// Returns the destination for messages and reports, with passwords redacted: the name of a database may
/// contain one.
[[nodiscard]] std::string spoken_destination(const std::string& destination);

}  // namespace d2b
