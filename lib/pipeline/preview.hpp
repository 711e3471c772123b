#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dem2buildings/commit_list.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"
#include "preview/preview_sink.hpp"
#include "write/picture_file.hpp"

namespace d2b {

/// The picture of -preview, on the way of the features to their sink.
class Preview {
  public:
    /// @param features must outlive this @throws OptionError, OutputError where the picture cannot be written
    Preview(const Options& options, FeatureSink& features, const DemInfo& dem);

    /// Where the run's features are to go: through the picture, if there is one.
    [[nodiscard]] FeatureSink& features() { return sink_ ? *sink_ : features_; }
    /// Where its elevations are to go; nullptr where there is no picture.
    [[nodiscard]] RasterSink* elevations() { return sink_ ? &sink_->relief() : nullptr; }
    /// After the run. @param commit shows the picture while this lives @throws OutputError
    void prepare(CommitList& commit);
    /// What has been noticed since the last call.
    [[nodiscard]] std::vector<std::string> take_warnings();

  private:
    FeatureSink& features_;
    std::unique_ptr<PictureFile> file_;
    std::optional<PreviewSink> sink_;
};

/// Where the picture goes.
[[nodiscard]] RasterTarget picture_target(const Options& options);
/// What the picture shows. @throws OptionError
[[nodiscard]] MapGround ground_of(const Options& options, const DemInfo& dem);

}  // namespace d2b
