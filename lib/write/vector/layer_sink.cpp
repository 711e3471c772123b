#include "write/vector/layer_sink.hpp"

#include "dem2buildings/open_sinks.hpp"
#include "read/gdal_setup.hpp"
#include "write/vector/vector_format.hpp"

namespace d2b::writing {

std::unique_ptr<FeatureSink> open_layer_sink(WriteOptions options, const std::string& layer,
                                             const Callbacks& callbacks) {
    reading::register_formats();
    options.layers = Layers::buildings;
    if (format_for(options).multiple_layers || is_stream(options.destination))
        options.layer_name = layer;
    return open_sink(options, callbacks);
}

}  // namespace d2b::writing
