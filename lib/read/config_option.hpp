#pragma once

#include <cpl_conv.h>

namespace d2b {

/// Sets a configuration option of GDAL in this thread during its lifetime, unless the user has set it.
class ConfigOption {
  public:
    ConfigOption(const char* key, const char* value)
        : key_(key), set_(CPLGetConfigOption(key, nullptr) == nullptr) {
        if (set_)
            CPLSetThreadLocalConfigOption(key_, value);
    }
    ConfigOption(const ConfigOption&) = delete;
    ConfigOption& operator=(const ConfigOption&) = delete;
    ~ConfigOption() {
        if (set_)
            CPLSetThreadLocalConfigOption(key_, nullptr);
    }

  private:
    const char* key_;
    bool set_;
};

}  // namespace d2b
