#pragma once

#include <cstdint>
#include <string>

#include "core/context.hpp"
#include "features/polygon_maker.hpp"

namespace d2b {

/// Warns of features that are not written as they were drawn, with what GEOS said of each: of the first few
/// by their ids, of all others in one sentence.
class InvalidWarnings {
  public:
    explicit InvalidWarnings(Context& context) : context_(context) {}

    /// @param kind "Building" or "Contour" @param made whether or not it has had trouble
    void note(const std::string& kind, std::int64_t id, const FeaturePolygon& made);
    void finish();

  private:
    Context& context_;
    std::int64_t count_ = 0;
};

}  // namespace d2b
