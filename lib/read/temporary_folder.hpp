#pragma once

#include <string>

namespace d2b {

/// Where temporary files go: the configuration option CPL_TMPDIR, or the system's folder.
[[nodiscard]] std::string temporary_folder();

}  // namespace d2b
