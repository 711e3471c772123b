#include <string>

#include <GeographicLib/Config.h>
#include <proj.h>

#include "core/crs.hpp"

namespace d2b {

/// Built from the numbers, because the text in PJ_INFO is shared and rewritten by every call of any thread.
std::string proj_version() {
    const PJ_INFO info = proj_info();
    return std::to_string(info.major) + "." + std::to_string(info.minor) + "." + std::to_string(info.patch);
}

std::string geographiclib_version() {
    return GEOGRAPHICLIB_VERSION_STRING;
}

}  // namespace d2b
