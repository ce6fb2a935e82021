// Types of values in crate files, and their numbers.
#pragma once

#include <cstddef>
#include <cstdint>

#include "compute/scene_file/import/usd/crate_bytes.h"

namespace scree::imports::crate {

// As crate files number them; pxr/usd/usd/crateDataTypes.h. Others have no values that count here.
enum Type : unsigned {
    boolean = 1,
    byte = 2,
    int32 = 3,
    uint32 = 4,
    int64 = 5,
    uint64 = 6,
    half = 7,
    single = 8,
    real = 9,
    text = 10,
    token = 11,
    asset = 12,
    matrix2 = 13,
    matrix3 = 14,
    matrix4 = 15,
    quatd = 16,
    quatf = 17,
    quath = 18,
    vec2d = 19,
    vec4i = 30,
    dictionary = 31,
    token_edits = 32,
    string_edits = 33,
    path_edits = 34,
    reference_edits = 35,
    path_list = 40,
    token_list = 41,
    specifier = 42,
    permission = 43,
    variability = 44,
    selections = 45,
    samples = 46,
    payload = 47,
    doubles = 48,
    offsets = 49,
    string_list = 50,
    blocked = 51,
    payload_edits = 55,
    time_code = 56,
};

struct Layout {
    Type part = boolean;
    std::size_t width = 0;  // numbers of a value; 0: it has none
};
Layout layout_of(unsigned type);
std::size_t bytes_of(Type part);
double number_at(CrateCursor& from, Type part);

}  // namespace scree::imports::crate
