#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/context.hpp"

namespace d2b {

/// As long as it lives, the report of a context tells of one run. Where the context has seen a run before,
/// that run's report goes, but for what was warned of since, when files were opened, say.
class OwnReport {
  public:
    explicit OwnReport(Context& context) : context_(context) {
        std::vector<std::string>& warnings = context_.report.warnings;
        if (!context_.told || *context_.told > warnings.size())  // else the caller has taken it away
            return;
        warnings.erase(warnings.begin(), warnings.begin() + static_cast<std::ptrdiff_t>(*context_.told));
        RunReport fresh;
        fresh.warnings = std::move(warnings);
        context_.report = std::move(fresh);
    }
    OwnReport(const OwnReport&) = delete;
    OwnReport& operator=(const OwnReport&) = delete;
    ~OwnReport() { context_.told = context_.report.warnings.size(); }

  private:
    Context& context_;
};

}  // namespace d2b
