#pragma once

#include <cpl_conv.h>

namespace d2b::reading {

/// Sets a configuration option of GDAL in this thread during its lifetime, unless the user has set it.
class ScopedConfigOption {
  public:
    ScopedConfigOption(const char* key, const char* value)
        : key_(key), set_(CPLGetConfigOption(key, nullptr) == nullptr) {
        if (set_)
            CPLSetThreadLocalConfigOption(key_, value);
    }
    ScopedConfigOption(const ScopedConfigOption&) = delete;
    ScopedConfigOption& operator=(const ScopedConfigOption&) = delete;
    ~ScopedConfigOption() {
        if (set_)
            CPLSetThreadLocalConfigOption(key_, nullptr);
    }

  private:
    const char* key_;
    bool set_;
};

/// Keeps GDAL from writing an .aux.xml next to datasets that are opened, written or closed during its
/// lifetime.
class NoSidecar {
    ScopedConfigOption option_{"GDAL_PAM_ENABLED", "NO"};
};

}  // namespace d2b::reading
