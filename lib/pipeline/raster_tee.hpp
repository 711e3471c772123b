#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dem2buildings/sinks.hpp"

namespace d2b {

/// Forwards a raster to two sinks, either of which may be nullptr.
class RasterTee final : public RasterSink {
  public:
    RasterTee(RasterSink* one, RasterSink* other) : one_(one), other_(other) {}

    /// Returns the sink to write to; nullptr if neither sink exists.
    [[nodiscard]] RasterSink* sink() {
        return one_ != nullptr && other_ != nullptr ? this : one_ != nullptr ? one_ : other_;
    }
    void write(const Window& part, std::span<const float> values) override {
        one_->write(part, values);
        other_->write(part, values);
    }
    void finish() override {
        one_->finish();
        other_->finish();
    }
    void prepare(CommitList& commit) override {
        one_->prepare(commit);
        other_->prepare(commit);
    }
    [[nodiscard]] std::vector<std::string> take_warnings() override {
        std::vector<std::string> warnings = one_->take_warnings();
        for (std::string& warning : other_->take_warnings())
            warnings.push_back(std::move(warning));
        return warnings;
    }

  private:
    RasterSink* one_;
    RasterSink* other_;
};

}  // namespace d2b
