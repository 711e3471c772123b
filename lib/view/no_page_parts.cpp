#include "view/page_parts.hpp"

namespace d2b {

const PageParts* page_parts() {
    return nullptr;
}

}  // namespace d2b
