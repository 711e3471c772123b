#pragma once

#include "core/context.hpp"
#include "diagnose/nothing_found.hpp"

namespace d2b {

/// Emits the warnings about a search for buildings: an implausible ground, a raster that may not be a
/// surface, an NDVI without values, sparse points, blurred walls, and the probable reason if nothing was
/// found. Each cause is reported once. Silent if no point is valid or all have one elevation, because
/// empty_result() reports that.
void warn_of_search(const Search& search, bool found_any, Context& context);

}  // namespace d2b
