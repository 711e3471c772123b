#pragma once

#include <gtest/gtest.h>
#include <ogr_api.h>

#include "cli/read_back.hpp"

namespace d2b::test {

using Geometry = reading::GeometryOwner;

/// All of a layer as one.
inline Geometry united(const Layer& layer) {
    const Geometry all(OGR_G_CreateGeometry(wkbMultiPolygon));
    for (const Record& record : layer.records) {
        const bool several = wkbFlatten(OGR_G_GetGeometryType(record.geometry())) == wkbMultiPolygon;
        const int parts = several ? OGR_G_GetGeometryCount(record.geometry()) : 1;
        for (int i = 0; i < parts; ++i)
            EXPECT_EQ(OGR_G_AddGeometry(all.get(), several ? OGR_G_GetGeometryRef(record.geometry(), i)
                                                           : record.geometry()),
                      OGRERR_NONE);
    }
    return Geometry(OGR_G_UnionCascaded(all.get()));
}

}  // namespace d2b::test
