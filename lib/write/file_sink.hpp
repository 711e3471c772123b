#pragma once

#include "dem2buildings/commit_list.hpp"

namespace d2b {

/// Base of sinks (FeatureSink, RasterSink, SurfaceSink) whose result is published by a CommitList: prepare()
/// writes everything that is still pending.
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
