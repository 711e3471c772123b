#include "read/dataset_kind.hpp"

#include "read/fetch_gate.hpp"
#include "read/gdal_handles.hpp"
#include "read/gdal_messages.hpp"
#include "read/vector_layer.hpp"

namespace d2b::reading {

bool is_vector_dataset(const std::string& path) {
    const NetworkGuard gate(path);
    const GdalMessages quiet;
    const DatasetOwner dataset = open_guarded(path, GDAL_OF_VECTOR | GDAL_OF_READONLY);
    return dataset && !geometry_layers(dataset.get()).empty();
}

}  // namespace d2b::reading
