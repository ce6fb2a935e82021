// The JSON Schema of shapes.
#include <nlohmann/json.hpp>

#include "compute/scene_file/shapes_json.h"

namespace scree {

nlohmann::ordered_json shape_schema() {
    return nlohmann::ordered_json::parse(R"schema({
    "type": "object",
    "oneOf": [
        {
            "required": ["sphere"],
            "additionalProperties": false,
            "properties": {
                "sphere": {
                    "type": "object",
                    "required": ["radius"],
                    "additionalProperties": false,
                    "properties": {"radius": {"$ref": "#/$defs/size"}}
                }
            }
        },
        {
            "required": ["capsule"],
            "additionalProperties": false,
            "description": "along the body's y axis",
            "properties": {
                "capsule": {
                    "type": "object",
                    "required": ["radius", "half_height"],
                    "additionalProperties": false,
                    "properties": {
                        "radius": {"$ref": "#/$defs/size"},
                        "half_height": {
                            "type": "number",
                            "minimum": 0,
                            "maximum": 100000,
                            "description": "m, from the centre to the centre of a cap"
                        }
                    }
                }
            }
        },
        {
            "required": ["box"],
            "additionalProperties": false,
            "properties": {
                "box": {
                    "type": "object",
                    "required": ["half_extents"],
                    "additionalProperties": false,
                    "properties": {
                        "half_extents": {
                            "type": "array",
                            "items": {"$ref": "#/$defs/size"},
                            "minItems": 3,
                            "maxItems": 3
                        }
                    }
                }
            }
        },
        {
            "required": ["cylinder"],
            "additionalProperties": false,
            "description": "along the body's y axis",
            "properties": {
                "cylinder": {
                    "type": "object",
                    "required": ["radius", "half_height"],
                    "additionalProperties": false,
                    "properties": {
                        "radius": {"$ref": "#/$defs/size"},
                        "half_height": {"$ref": "#/$defs/size"}
                    }
                }
            }
        },
        {
            "required": ["cone"],
            "additionalProperties": false,
            "description": "along the body's y axis, the apex up; its centre of mass lies a quarter of its height above its base",
            "properties": {
                "cone": {
                    "type": "object",
                    "required": ["radius", "height"],
                    "additionalProperties": false,
                    "properties": {
                        "radius": {"$ref": "#/$defs/size"},
                        "height": {"$ref": "#/$defs/size"}
                    }
                }
            }
        },
        {
            "required": ["hull"],
            "additionalProperties": false,
            "description": "the convex hull of the points; the body's position is where their origin lies",
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
                            "description": "m, not in one plane; inner and repeated points do not matter. More than 64 corners are simplified"
                        }
                    }
                }
            }
        },
        {
            "required": ["compound"],
            "additionalProperties": false,
            "description": "several convex shapes on one body; the body's position is where their origin lies. Where two overlap, the mass of both counts",
            "properties": {
                "compound": {
                    "type": "object",
                    "required": ["parts"],
                    "additionalProperties": false,
                    "properties": {
                        "parts": {
                            "type": "array",
                            "minItems": 1,
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
                                    }
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
            "description": "triangles, solid behind their faces; only for \"fixed\" and \"kinematic\" bodies",
            "properties": {
                "mesh": {
                    "type": "object",
                    "oneOf": [
                        {
                            "required": ["file"],
                            "additionalProperties": false,
                            "properties": {
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
        },
        {
            "required": ["plane"],
            "additionalProperties": false,
            "description": "infinite, solid behind the normal; only for \"fixed\" bodies, whose position and orientation it ignores",
            "properties": {
                "plane": {
                    "type": "object",
                    "additionalProperties": false,
                    "properties": {
                        "normal": {"$ref": "#/$defs/vector", "default": [0, 1, 0], "description": "any length but 0"},
                        "offset": {
                            "type": "number",
                            "minimum": -1000000,
                            "maximum": 1000000,
                            "default": 0,
                            "description": "m, along the normal from the origin"
                        }
                    }
                }
            }
        }
    ]
})schema");
}

}  // namespace scree
