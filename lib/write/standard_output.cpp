#include "write/standard_output.hpp"

#include <cpl_vsi.h>

namespace d2b {

void set_standard_output(std::FILE* stream) {
    VSIStdoutSetRedirection(std::fwrite, stream);
}

}  // namespace d2b
