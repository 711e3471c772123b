#pragma once

#include <string>

#include "dem2buildings/report.hpp"

namespace d2b {

/// The report as a JSON object with a line feed at its end; keys always in the same order. Numbers read back
/// as they were; numbers that are not finite are null. Bytes that are no UTF-8 are replaced.
[[nodiscard]] std::string json_report(const RunReport& report);

}  // namespace d2b
