#pragma once

#include <memory>

#include "compare/find_changes.hpp"
#include "compare/surveyed_building.hpp"
#include "dem2buildings/compare.hpp"
#include "dem2buildings/surfaces.hpp"
#include "score/measure.hpp"

namespace d2b::compare {

/// Opens a page for browsers that shows the buildings of both surveys, in turns, in the colours of their
/// changes.
/// @throws OptionError, OutputError as resolve_file_target(); OptionError if the library was built without
/// pages
[[nodiscard]] std::unique_ptr<SurfaceSink> open_change_page(const SurveyRequest& request);

/// Writes the blocks of both surveys to a page: outlines in the plane of the comparison, as high as their
/// p90, on level ground. @throws OutputError
void write_change_page(const SurveyChanges& changes, const SurveyedPlace& old_place,
                       const SurveyedPlace& new_place, const score::MeasurePlane& plane, SurfaceSink& page);

}  // namespace d2b::compare
