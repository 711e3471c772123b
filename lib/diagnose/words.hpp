#pragma once

#include <string>

namespace d2b {

/// Formats a length for a sentence, to the metre, or to the decimetre below ten: "43", "0.3".
[[nodiscard]] std::string rounded(double value);
/// Formats a share as a percentage: "12 %", "0.3 %", or "less than 0.1 %".
[[nodiscard]] std::string percent(double share);
/// Turns a clause into a sentence: capitalises it and adds a full stop.
[[nodiscard]] std::string as_sentence(std::string cause);

}  // namespace d2b
