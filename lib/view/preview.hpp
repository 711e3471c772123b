#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dem2buildings/commit_list.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"
#include "view/preview_sink.hpp"
#include "write/file_writer.hpp"

namespace d2b::view {

/// Picture of -preview. Intercepts the features and elevations on their way to their sinks.
class Preview {
  public:
    /// @param features must outlive this @throws OptionError, OutputError if the picture cannot be written
    Preview(const Options& options, FeatureSink& features, const DemInfo& dem);

    /// Returns the sink for the run's features: the picture's if there is one, otherwise the given one.
    [[nodiscard]] FeatureSink& features() { return sink_ ? *sink_ : features_; }
    /// Returns the sink for the run's elevations; nullptr if there is no picture.
    [[nodiscard]] RasterSink* elevations() { return sink_ ? &sink_->relief() : nullptr; }
    /// Prepares the picture after the run. @param commit publishes it and must not outlive this @throws
    /// OutputError
    void prepare(CommitList& commit);
    /// Returns the warnings since the last call.
    [[nodiscard]] std::vector<std::string> take_warnings();

  private:
    FeatureSink& features_;
    std::optional<writing::FileWriter> file_;
    std::optional<PreviewSink> sink_;
};

/// Returns the destination of the picture.
[[nodiscard]] writing::FileTarget picture_target(const Options& options);
/// Returns the grid and CRS that the picture shows. @throws OptionError
[[nodiscard]] MapArea map_area_of(const Options& options, const DemInfo& dem);

}  // namespace d2b::view
