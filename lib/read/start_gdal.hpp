#pragma once

namespace d2b {

/// Registers GDAL's drivers where the process has registered none. What opens files calls it.
void register_formats();

/// Registers GDAL's drivers and sets the process up for the tools: no message of GDAL's reaches stderr by
/// itself. Call once, before other threads start.
void start_gdal();

}  // namespace d2b
