#pragma once

#include "dem2buildings/commit_list.hpp"

namespace d2b {

/// A sink (FeatureSink, RasterSink, SurfaceSink) whose result a CommitList shows: what is left to write is
/// prepare().
template <typename Sink>
class FileSink : public Sink {
  public:
    void prepare(CommitList& commit) override = 0;
    void finish() final {
        CommitList alone;
        this->prepare(alone);
        alone.publish();
    }
};

}  // namespace d2b
