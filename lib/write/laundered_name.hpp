#pragma once

#include <string>

#include "dem2buildings/options.hpp"
#include "write/vector_format.hpp"

namespace d2b {

/// What a driver will call a layer that is created with a name. Layers that are there are looked for by this
/// name, because drivers of databases change some characters, and PostgreSQL cuts long names off.
/// @param base of the name of a layer @param suffix of its role, "_contours"; kept where the base is
/// shortened
[[nodiscard]] std::string laundered_name(const std::string& base, const std::string& suffix,
                                         const VectorFormat& format, const WriteOptions& options);

}  // namespace d2b
