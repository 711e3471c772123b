#include "view/page_parts.hpp"

namespace d2b::view {

const PageParts* page_parts() {
    return nullptr;
}

}  // namespace d2b::view
