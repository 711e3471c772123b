#pragma once

namespace d2b {

/// Registers GDAL's drivers unless the process has registered any. Called by all functions that open files.
void register_formats();

/// Registers GDAL's drivers and configures the process for the programs: GDAL prints nothing to stderr by
/// itself. Call once, before other threads start.
void start_gdal();

}  // namespace d2b
