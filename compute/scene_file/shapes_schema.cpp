// The JSON Schema of shapes. Shapes whose fields are numbers and vectors follow from the list (compute/shapes.h).
#include <nlohmann/json.hpp>
#include <type_traits>

#include "compute/scene_file/shapes_json.h"
#include "compute/schema/range_text.h"

namespace scree {

namespace {

using nlohmann::ordered_json;

ordered_json number_schema(FieldRange range) {
    if (range.least == size_range.least && range.most == size_range.most) return {{"$ref", "#/$defs/size"}};
    // The shortest digits of the float: 100000, not 99999.9999.
    return {{"type", "number"}, {"minimum", std::stod(plain(range.least))}, {"maximum", std::stod(plain(range.most))}};
}

ordered_json vector_schema(FieldRange range, bool is_direction) {
    if (is_direction) return {{"$ref", "#/$defs/vector"}};
    return {{"type", "array"}, {"items", number_schema(range)}, {"minItems", 3}, {"maxItems", 3}};
}

template <class Owner>
ordered_json type_and_default(const ShapeField<Owner, float>& field) {
    ordered_json schema = number_schema(field.range);
    if (!field.required) schema["default"] = Owner{}.*field.member;
    return schema;
}
template <class Owner>
ordered_json type_and_default(const ShapeField<Owner, vec3>& field) {
    ordered_json schema = vector_schema(field.range, field.is_direction());
    const vec3 usual = Owner{}.*field.member;
    if (!field.required) schema["default"] = {usual.x, usual.y, usual.z};
    return schema;
}

ordered_json plain_schema(const char* name, const char* about, const ordered_json& required, const ordered_json& properties) {
    ordered_json fields = {{"type", "object"}};
    if (!required.empty()) fields["required"] = required;
    fields["additionalProperties"] = false;
    fields["properties"] = properties;
    return {{"required", {name}}, {"additionalProperties", false}, {"description", about}, {"properties", {{name, fields}}}};
}

// Shapes with lists, whose schema is more than ranges.
template <class OfShape>
constexpr bool has_lists = std::is_same_v<OfShape, Hull> || std::is_same_v<OfShape, Compound> || std::is_same_v<OfShape, Mesh> ||
                           std::is_same_v<OfShape, HeightField>;

template <class OfShape>
ordered_json plain_schema() {
    ordered_json required = ordered_json::array(), properties = ordered_json::object();
    for_each_shape_field<OfShape>([&](const auto& field) {
        if (field.required) required.push_back(field.name);
        ordered_json& schema = properties[field.name] = type_and_default(field);
        schema["description"] = field.about;
    });
    return plain_schema(ShapeInfo<OfShape>::name, ShapeInfo<OfShape>::about, required, properties);
}

ordered_json decomposition_schema() {
    return ordered_json::parse(R"schema({
    "type": "object",
    "additionalProperties": false,
    "description": "a solid of convex parts, as of a dynamic body; left out: the numbers here",
    "properties": {
        "error": {
            "type": "number",
            "minimum": 0.002,
            "maximum": 0.5,
            "default": 0.02,
            "description": "greatest distance between the surfaces, in longest extents of the mesh"
        },
        "parts": {"type": "integer", "minimum": 1, "maximum": 256, "default": 32, "description": "at most; fewer have a greater error"},
        "vertices": {"type": "integer", "minimum": 8, "maximum": 64, "default": 64, "description": "of a part, at most"}
    }
})schema");
}

ordered_json schemas_with_lists() {
    ordered_json shapes = ordered_json::parse(R"schema([
        {
            "required": ["hull"],
            "additionalProperties": false,
            "description": "the convex hull of the points; the body's position is the origin of the points",
            "properties": {
                "hull": {
                    "type": "object",
                    "required": ["points"],
                    "additionalProperties": false,
                    "properties": {
                        "points": {
                            "type": "array",
                            "minItems": 4,
                            "items": {
                                "type": "array",
                                "items": {"type": "number", "minimum": -100000, "maximum": 100000},
                                "minItems": 3,
                                "maxItems": 3
                            },
                            "description": "m, not coplanar; inner and repeated points are ignored. Hulls of more than 64 vertices are simplified"
                        }
                    }
                }
            }
        },
        {
            "required": ["compound"],
            "additionalProperties": false,
            "description": "several convex shapes on one body, or none; the body's position is the origin of the parts. Masses of overlapping parts add up",
            "properties": {
                "compound": {
                    "type": "object",
                    "required": ["parts"],
                    "additionalProperties": false,
                    "properties": {
                        "parts": {
                            "type": "array",
                            "maxItems": 10000,
                            "items": {
                                "type": "object",
                                "required": ["shape"],
                                "additionalProperties": false,
                                "properties": {
                                    "shape": {"$ref": "#/$defs/shape", "description": "any but plane, compound, mesh and height_field"},
                                    "position": {
                                        "type": "array",
                                        "items": {"type": "number", "minimum": -100000, "maximum": 100000},
                                        "minItems": 3,
                                        "maxItems": 3,
                                        "default": [0, 0, 0],
                                        "description": "in the body's frame, m"
                                    },
                                    "orientation": {
                                        "type": "array",
                                        "items": {"$ref": "#/$defs/number"},
                                        "minItems": 4,
                                        "maxItems": 4,
                                        "default": [0, 0, 0, 1],
                                        "description": "quaternion x, y, z, w of any length but 0"
                                    },
                                    "density": {
                                        "type": "number",
                                        "minimum": 0,
                                        "maximum": 1000000,
                                        "default": 0,
                                        "description": "kg/m^3; 0: the body's own"
                                    },
                                    "filter": {"$ref": "#/$defs/filter", "description": "left out: the body's own"},
                                    "role": {
                                        "enum": ["solid", "sensor", "drawn"],
                                        "default": "solid",
                                        "description": "solid, a sensor, or only drawn; only solid parts have mass. All are as the body if that is not solid"
                                    },
                                    "material": {"$ref": "#/$defs/material", "description": "left out: the body's own"},
                                    "skinned": {"type": "boolean", "default": false, "description": "pictures show the compound's skins in its place"}
                                }
                            }
                        },
                        "skins": {
                            "type": "array",
                            "description": "meshes that pictures show in place of the parts that are skinned; nothing collides with them",
                            "items": {
                                "type": "object",
                                "required": ["vertices", "triangles"],
                                "additionalProperties": false,
                                "properties": {
                                    "vertices": {"type": "array", "items": {"$ref": "#/$defs/vector"}, "description": "m"},
                                    "triangles": {"type": "array", "items": {"type": "array", "items": {"type": "integer", "minimum": 0}, "minItems": 3, "maxItems": 3}},
                                    "position": {"$ref": "#/$defs/vector", "default": [0, 0, 0], "description": "in the body's frame, m"},
                                    "orientation": {"type": "array", "items": {"$ref": "#/$defs/number"}, "minItems": 4, "maxItems": 4, "default": [0, 0, 0, 1], "description": "quaternion x, y, z, w of any length but 0"}
                                }
                            }
                        }
                    }
                }
            }
        },
        {
            "required": ["mesh"],
            "additionalProperties": false,
            "description": "triangles: of a \"fixed\" or \"kinematic\" body a surface, solid behind its faces; of a \"dynamic\" one a solid of convex parts",
            "properties": {
                "mesh": {
                    "type": "object",
                    "oneOf": [
                        {
                            "required": ["file"],
                            "additionalProperties": false,
                            "properties": {
                                "decompose": null,
                                "file": {
                                    "type": "string",
                                    "minLength": 1,
                                    "description": "an .obj, .gltf or .glb file, from where the scene's file is"
                                },
                                "scale": {
                                    "type": "number",
                                    "minimum": 0.000001,
                                    "maximum": 1000000,
                                    "default": 1,
                                    "description": "m of a unit of the file"
                                }
                            }
                        },
                        {
                            "required": ["vertices", "triangles"],
                            "additionalProperties": false,
                            "properties": {
                                "decompose": null,
                                "vertices": {
                                    "type": "array",
                                    "minItems": 3,
                                    "items": {
                                        "type": "array",
                                        "items": {"type": "number", "minimum": -100000, "maximum": 100000},
                                        "minItems": 3,
                                        "maxItems": 3
                                    },
                                    "description": "in the body's frame, m"
                                },
                                "triangles": {
                                    "type": "array",
                                    "minItems": 1,
                                    "items": {
                                        "type": "array",
                                        "items": {"type": "integer", "minimum": 0},
                                        "minItems": 3,
                                        "maxItems": 3
                                    },
                                    "description": "numbers of vertices, from 0, counter-clockwise seen from outside"
                                }
                            }
                        }
                    ]
                }
            }
        },
        {
            "required": ["height_field"],
            "additionalProperties": false,
            "description": "ground over a grid whose middle is the body's position; only for \"fixed\" and \"kinematic\" bodies",
            "properties": {
                "height_field": {
                    "type": "object",
                    "required": ["columns", "rows", "heights"],
                    "additionalProperties": false,
                    "properties": {
                        "columns": {"type": "integer", "minimum": 2, "maximum": 30000, "description": "points along x"},
                        "rows": {"type": "integer", "minimum": 2, "maximum": 30000, "description": "points along z"},
                        "spacing": {"$ref": "#/$defs/size", "default": 1, "description": "m, between neighbours"},
                        "heights": {
                            "type": "array",
                            "items": {"type": "number", "minimum": -100000, "maximum": 100000},
                            "description": "m along y, columns * rows of them, row by row"
                        }
                    }
                }
            }
        }
])schema");
    for (ordered_json& shape : shapes)
        if (shape["properties"].contains("mesh"))
            for (ordered_json& form : shape["properties"]["mesh"]["oneOf"])
                form["properties"]["decompose"] = decomposition_schema();
    return shapes;
}

}  // namespace

ordered_json shape_schema() {
    ordered_json shapes = schemas_with_lists();
    for_each_shape([&](const auto& shape) {
        using OfShape = std::remove_cvref_t<decltype(shape)>;
        if constexpr (!has_lists<OfShape>) shapes.push_back(plain_schema<OfShape>());
        return true;
    });
    return {{"type", "object"}, {"oneOf", shapes}};
}

}  // namespace scree
