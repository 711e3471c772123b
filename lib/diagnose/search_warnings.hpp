#pragma once

#include "core/context.hpp"
#include "diagnose/nothing_found.hpp"

namespace d2b {

/// Warns of what makes a search for buildings doubtful: a ground that cannot be right, a surface that may be
/// none, an NDVI that says nothing, thin points, smeared walls; and where nothing was found, of why that
/// probably is. Each cause once. Silent where no point is valid, or all have one elevation: empty_result()
/// says that.
void warn_of_search(const Search& search, bool found_any, Context& context);

}  // namespace d2b
