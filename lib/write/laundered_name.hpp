#pragma once

#include <string>

#include "dem2buildings/options.hpp"
#include "write/vector_format.hpp"

namespace d2b {

/// Returns the name that a driver will give to a layer. Existing layers are looked up by it, because drivers
/// of databases replace some characters, and PostgreSQL truncates long names. @param base of the layer name
/// @param suffix of its role, for example "_contours"; kept if the base is shortened
[[nodiscard]] std::string laundered_name(const std::string& base, const std::string& suffix,
                                         const VectorFormat& format, const WriteOptions& options);

}  // namespace d2b
