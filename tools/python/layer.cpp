#include "python/layer.hpp"

#include <algorithm>
#include <cstddef>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <span>
#include <utility>

#include "dem2buildings/wkb.hpp"

namespace d2b {
namespace {

namespace py = pybind11;
using LayerPtr = std::shared_ptr<CollectedLayer>;

py::array object_array(std::size_t size) {
    return py::array(py::dtype("O"), std::vector<py::ssize_t>{static_cast<py::ssize_t>(size)});
}

/// Fills an array of objects. @param object gives the i-th
template <typename Object>
py::array objects(std::size_t size, const Object& object) {
    py::array array = object_array(size);
    // A new array of objects holds None everywhere.
    auto* const items = static_cast<PyObject**>(array.mutable_data());
    for (std::size_t i = 0; i < size; ++i)
        Py_XDECREF(std::exchange(items[i], py::object(object(i)).release().ptr()));
    return array;
}

template <typename Number>
py::array view(const std::vector<Number>& values, const py::handle& owner) {
    py::array array(py::dtype::of<Number>(),
                    std::vector<py::ssize_t>{static_cast<py::ssize_t>(values.size())}, values.data(), owner);
    array.attr("flags").attr("writeable") = false;
    return array;
}

py::object masked(const py::array& values, const std::vector<std::uint8_t>& null, const py::handle& owner) {
    const py::object mask = view(null, owner).attr("view")("bool");
    return py::module_::import("numpy.ma").attr("MaskedArray")(values, mask);
}

/// One value as Python has it; None for NULL.
py::object value_of(const FieldColumn& column, std::size_t i) {
    if (column.null[i] != 0)
        return py::none();
    return std::visit([i](const auto& values) -> py::object { return py::cast(values[i]); }, column.values);
}

py::array wkb_of(const CollectedLayer& layer) {
    MultiPolygonWkb wkb(layer.spec.with_z, layer.spec.with_arcs);
    return objects(layer.features.size(), [&](std::size_t i) {
        const std::span<const std::byte> bytes = wkb.encode(layer.features[i]);
        return py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    });
}

/// @param elevations of its positions; null if all have z
py::tuple coordinates(const WorldRing& ring, const CollectedLayer& layer, double z,
                      const double* elevations) {
    py::tuple positions(ring.size() + 1);
    for (std::size_t i = 0; i <= ring.size(); ++i) {
        const Position& p = ring[i % ring.size()];
        if (layer.spec.with_z)
            positions[i] = py::make_tuple(p.x, p.y, elevations != nullptr ? elevations[i % ring.size()] : z);
        else
            positions[i] = py::make_tuple(p.x, p.y);
    }
    return positions;
}

py::dict geometry_of(const CollectedLayer& layer, const Feature& feature) {
    py::dict geometry;
    if (feature.place) {
        geometry["type"] = "Point";
        geometry["coordinates"] = py::make_tuple(feature.place->x, feature.place->y);
        return geometry;
    }
    py::tuple polygons(feature.parts.size());
    for (std::size_t p = 0; p < feature.parts.size(); ++p) {
        const WorldPolygon& polygon = feature.parts[p];
        py::tuple rings(1 + polygon.interiors.size());
        const double* elevations = polygon.elevations.empty() ? nullptr : polygon.elevations.data();
        rings[0] = coordinates(polygon.exterior, layer, feature.z, elevations);
        std::size_t before = polygon.exterior.size();
        for (std::size_t r = 0; r < polygon.interiors.size(); ++r) {
            rings[r + 1] = coordinates(polygon.interiors[r], layer, feature.z,
                                       elevations != nullptr ? elevations + before : nullptr);
            before += polygon.interiors[r].size();
        }
        polygons[p] = std::move(rings);
    }
    geometry["type"] = "MultiPolygon";
    geometry["coordinates"] = std::move(polygons);
    return geometry;
}

/// @param i from 0
py::dict feature_of(const CollectedLayer& layer, std::size_t i) {
    py::dict properties;
    for (std::size_t c = 0; c < layer.columns.size(); ++c)
        properties[py::str(layer.spec.fields[c].name)] = value_of(layer.columns[c], i);
    py::dict feature;
    feature["type"] = "Feature";
    feature["id"] = value_of(layer.columns.front(), i);
    feature["properties"] = std::move(properties);
    feature["geometry"] = geometry_of(layer, layer.features[i]);
    return feature;
}

/// Counts as Python does: -1 is the last one.
py::dict item(const CollectedLayer& layer, py::ssize_t i) {
    const auto size = static_cast<py::ssize_t>(layer.features.size());
    if (i < -size || i >= size)
        throw py::index_error("the layer has " + std::to_string(size) + " features");
    return feature_of(layer, static_cast<std::size_t>(i < 0 ? i + size : i));
}

py::dict collection_of(const CollectedLayer& layer) {
    py::list features;
    for (std::size_t i = 0; i < layer.features.size(); ++i)
        features.append(feature_of(layer, i));
    py::dict collection;
    collection["type"] = "FeatureCollection";
    collection["features"] = std::move(features);
    return collection;
}

py::dict columns_of(const py::object& self) {
    const auto& layer = self.cast<const CollectedLayer&>();
    py::dict columns;
    for (std::size_t c = 0; c < layer.columns.size(); ++c)
        columns[py::str(layer.spec.fields[c].name)] = array_of(layer.columns[c], self);
    return columns;
}

py::dict fields_of(const CollectedLayer& layer) {
    py::dict fields;
    for (const FieldSpec& field : layer.spec.fields) {
        py::dict words;
        words["alias"] = field.alias;
        words["unit"] = field.unit;
        words["description"] = field.description;
        fields[py::str(field.name)] = std::move(words);
    }
    return fields;
}

std::string repr(const CollectedLayer& layer) {
    return "<dem2buildings.Layer '" + layer.spec.name + "': " + std::to_string(layer.features.size()) +
           " features, " + std::to_string(layer.columns.size()) + " columns>";
}

}  // namespace

py::object array_of(const FieldColumn& column, const py::handle& owner) {
    if (const auto* const texts = std::get_if<std::vector<std::string>>(&column.values))
        return objects(texts->size(), [&](std::size_t i) { return value_of(column, i); });
    if (const auto* const numbers = std::get_if<std::vector<double>>(&column.values))
        return view(*numbers, owner);
    const py::array values = view(std::get<std::vector<std::int64_t>>(column.values), owner);
    const bool complete = std::ranges::count(column.null, 0) == std::ssize(column.null);
    return complete ? py::object(values) : masked(values, column.null, owner);
}

void define_layer(py::module_& module) {
    py::class_<CollectedLayer, LayerPtr>(module, "Layer",
                                         "Features of one kind. A layer is a sequence of GeoJSON-like "
                                         "dictionaries, and has __geo_interface__.")
        .def("__len__", [](const CollectedLayer& layer) { return layer.features.size(); })
        .def("__getitem__", &item)
        .def("__iter__",
             [](const py::object& self) {
                 return py::reinterpret_steal<py::object>(PySeqIter_New(self.ptr()));
             })
        .def("__repr__", &repr)
        .def_property_readonly(
            "name", [](const CollectedLayer& layer) { return layer.spec.name; },
            "buildings, contours, roofs, doubtful, rejected, problems or missing")
        .def_property_readonly(
            "crs",
            [](const CollectedLayer& layer) -> py::object {
                return layer.crs_wkt.empty() ? py::object(py::none()) : py::object(py::str(layer.crs_wkt));
            },
            "The coordinate reference system as WKT; None if unknown.")
        .def_property_readonly("fields", &fields_of,
                               "A description of each column: a dictionary of alias, unit and description.")
        .def_property_readonly(
            "columns", &columns_of,
            "One NumPy array per field, of int64, float64 or str; no value is masked, NaN or "
            "None. Arrays of numbers "
            "look into the layer and cannot be changed.")
        .def_property_readonly(
            "wkb", &wkb_of,
            "A NumPy array of bytes, the MultiPolygon (of problems the Point) of each feature as "
            "well-known binary.")
        .def_property_readonly("__geo_interface__", &collection_of,
                               "All features as a GeoJSON-like FeatureCollection.");
}

}  // namespace d2b
