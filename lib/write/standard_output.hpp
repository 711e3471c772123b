#pragma once

#include <cstdio>

namespace d2b {

/// Where /vsistdout/ writes to from now on, in the whole process: stdout, or another stream, which leaves
/// stdout to what GDAL's drivers print.
void set_standard_output(std::FILE* stream);

}  // namespace d2b
