#pragma once

#include <string>

namespace d2b {

/// For sentences: a length to the metre, below ten to the decimetre, as "43" or "0.3".
[[nodiscard]] std::string rounded(double value);
/// A share of one in per cent: "12 %", "0.3 %", or "less than 0.1 %".
[[nodiscard]] std::string percent(double share);
/// A cause that is told by itself: a capital at its beginning and a full stop at its end.
[[nodiscard]] std::string as_sentence(std::string cause);

}  // namespace d2b
